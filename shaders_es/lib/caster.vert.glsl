// Vertices of casters: clip position, and the inputs of the alpha test. Shared by depth.vert, distance.vert and flat.vert.
#define POSITION_ONLY 1
#include "lib/pass.glsl"
#include "lib/vertex.glsl"

#ifdef WITH_ALPHA_MASK
out vec2 v_uv;
out float v_alpha;
flat out float v_cutoff;
#ifdef WITH_TRANSMISSION_TEXTURE
out vec2 v_uv_transmission;
flat out float v_transmitted;
#endif
#endif

void place_caster(vec3 p) {
    gl_Position = pass_matrix(PASS_CLIP) * vec4(p, 1.0);
#ifdef WITH_ALPHA_MASK
    v_uv = slot_uv(SLOT_BASE, BASE_UV1);
    v_alpha = a_base_color.a * (VERTEX_COLOR ? a_color.a : 1.0);
    v_cutoff = a_surface.w;
#ifdef WITH_TRANSMISSION_TEXTURE
    v_uv_transmission = slot_uv(SLOT_TRANSMISSION, TRANSMISSION_UV1);
    v_transmitted = a_surface.z;
#endif
#endif
}
