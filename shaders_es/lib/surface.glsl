// The surface at a fragment. Shared by lit.frag and aov.frag.
#include "lib/pass.glsl"

#ifdef WITH_VERTEX_COLOR
in vec4 v_color;
#else
flat in vec4 v_color;
#endif
in vec3 v_position;
in vec3 v_normal;
#define DECLARE_UV(v_uv, slot, second) in vec2 v_uv;
EACH_TEXTURE(DECLARE_UV)
flat in vec4 v_surface;  // roughness, metalness, occlusion strength, alpha cutoff
flat in vec4 v_emissive; // radiance; w: 1 = casts
#ifdef WITH_SHADOWS
in vec3 v_shadow[SHADOW_COUNT]; // of slots with SHADOW_LINEAR or SHADOW_PROJECTED, from lit.vert
#endif

#ifdef WITH_BASE_TEXTURE
uniform mediump sampler2D u_texture_base;
#endif

// Linear base colour and alpha.
vec4 surface_base() {
    vec4 base = v_color;
#ifdef WITH_BASE_TEXTURE
    base *= texture(u_texture_base, v_uv_base);
#endif
    return base;
}

// Alpha mask: discards fragments below the cutoff. BLENDED_REST: those above, which are in the picture. Derivatives in neighbouring fragments are undefined after this.
void surface_cut(vec4 base) {
    if (ALPHA_MASK && base.a < v_surface.w) discard;
    if (BLENDED_REST && base.a >= v_surface.w) discard;
}

// Unit, towards the viewer on both sides of a double-sided surface.
vec3 surface_normal() {
    vec3 n = normalize(v_normal);
    return DOUBLE_SIDED && !gl_FrontFacing ? -n : n;
}

// Unit vector towards the camera.
vec3 surface_to_eye() { return normalize(PASS(PASS_EYE).xyz - v_position * PASS(PASS_EYE).w); }

// Unit normal of the triangle, towards the viewer. Takes derivatives: not behind a branch.
vec3 surface_face_normal() {
    vec3 n = normalize(cross(dFdx(v_position), dFdy(v_position)));
    return dot(n, surface_to_eye()) < 0.0 ? -n : n;
}
