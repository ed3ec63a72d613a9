// The surface at a fragment. Shared by lit.frag and aov.frag.
#include "lib/pass.glsl"

#ifdef WITH_VERTEX_COLOR
in vec4 v_color;
#else
flat in vec4 v_color;
#endif
in vec3 v_position;
in vec3 v_normal;
#define DECLARE_TEXTURE(u_texture, v_uv, slot, second) \
    in vec2 v_uv; \
    uniform mediump sampler2D u_texture;
EACH_TEXTURE(DECLARE_TEXTURE)
flat in vec4 v_surface;  // roughness, metalness, occlusion strength, alpha cutoff
flat in vec4 v_emissive; // radiance; w: 1 = casts
#ifdef WITH_SHADOWS
in vec3 v_shadow[SHADOW_COUNT]; // of slots with SHADOW_LINEAR or SHADOW_PROJECTED, from lit.vert
#endif

uniform vec4 u_factors[1 + FACTOR_VECTORS]; // then FACTOR_.. of layers (src/scene/material.h)
#define FACTOR_REFLECTANCE u_factors[0].rgb // at normal incidence, of what is no metal
#define FACTOR_LIGHTMAP    u_factors[0].w   // intensity

// Share of the light that is not reflected at the surface and that passes it, if it is no metal.
float surface_transmission() { return FACTOR_TRANSMISSION * TEXEL_TRANSMISSION.r; }

// Linear base colour and alpha.
vec4 surface_base() { return v_color * TEXEL_BASE; }

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
