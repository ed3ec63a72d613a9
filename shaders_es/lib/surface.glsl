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

#ifdef WITH_TRANSMISSION_TEXTURE
uniform mediump sampler2D u_texture_transmission;
#endif
// [0] rgb: reflectance at normal incidence of what is no metal; w: intensity of the light map. [1] x: clear coat; y: its roughness;
// z: transmission
uniform vec4 u_factors[2];

// Share of the light that is not reflected at the surface and that passes it, if it is no metal.
float surface_transmission() {
#ifdef WITH_TRANSMISSION_TEXTURE
    return u_factors[1].z * texture(u_texture_transmission, v_uv_transmission).r;
#else
    return u_factors[1].z;
#endif
}

// Linear base colour and alpha.
vec4 surface_base() {
    vec4 base = v_color;
#ifdef WITH_BASE_TEXTURE
    base *= texture(u_texture_base, v_uv_base);
#endif
    return base;
}

// Alpha mask: discards fragments below the cutoff. BLENDED_REST: those above, which are in the picture. Derivatives in neighbouring fragments are undefined after this.
// What transmits by a texture is cut by that: opaque where it transmits nothing.
void surface_cut(vec4 base) {
#ifdef WITH_TRANSMISSION_TEXTURE
    if (!ALPHA_BLEND && (BLENDED_REST || !TRANSMISSION)) base.a = 1.0 - surface_transmission();
#endif
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
