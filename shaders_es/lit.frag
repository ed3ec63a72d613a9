// colour = ambient x albedo x occlusion + sum over lights of (1 - strength (1 - visibility)) x (diffuse + specular) + emissive,
// in linear space, after exposure. ADDITIVE: only the sum over lights.
#include "lib/flat_constants.glsl"
#include "lib/surface.glsl"
#include "lib/light.glsl"
#include "lib/shadow_place.glsl"
#include "lib/srgb.glsl"

#ifdef WITH_ROUGHNESS_TEXTURE
uniform mediump sampler2D u_texture_roughness;
#endif
#ifdef WITH_EMISSIVE_TEXTURE
uniform mediump sampler2D u_texture_emissive;
#endif
#ifdef WITH_OCCLUSION_TEXTURE
uniform mediump sampler2D u_texture_occlusion;
#endif

layout(location = 0) out vec4 o_color;

// x: roughness, y: metalness
vec2 surface_roughness() {
    vec2 factors = v_surface.xy;
#ifdef WITH_ROUGHNESS_TEXTURE
    factors *= texture(u_texture_roughness, v_uv_roughness).gb;
#endif
    return factors;
}

vec3 surface_ambient(vec3 n) {
    vec3 ambient = PASS(PASS_SKY).rgb;
    if (HEMISPHERE) ambient = mix(PASS(PASS_GROUND).rgb, ambient, 0.5 * n.y + 0.5);
#ifdef WITH_OCCLUSION_TEXTURE
    ambient *= 1.0 + v_surface.z * (texture(u_texture_occlusion, v_uv_occlusion).r - 1.0);
#endif
    return ambient;
}

vec3 surface_emission() {
    vec3 emission = v_emissive.rgb * u_pass[PASS_EXPOSURE].x;
#ifdef WITH_EMISSIVE_TEXTURE
    emission *= texture(u_texture_emissive, v_uv_emissive).rgb;
#endif
    return emission;
}

// Inputs of the BRDF, the same for all lights. Normalised Blinn-Phong: (n + 8) / 8 pi; LIGHT_COLOR contains the 1 / pi.
struct surface {
    vec3 normal, to_eye, diffuse, specular;
    float exponent;
};

surface surface_make(vec4 base) {
    surface s;
    s.normal = surface_normal();
    s.diffuse = base.rgb;
    if (SPECULAR) {
        vec2 rm = surface_roughness();
        float alpha = max(rm.x * rm.x, 0.002);
        s.exponent = 2.0 / (alpha * alpha) - 2.0;
        s.specular = (METAL ? mix(vec3(0.04), base.rgb, rm.y) : vec3(0.04)) * (0.125 * s.exponent + 1.0);
        if (METAL) s.diffuse = base.rgb * (1.0 - rm.y);
        s.to_eye = surface_to_eye();
    }
    return s;
}

// Reflected radiance of one light; seen: visibility, 1 = lit; shine: that of highlights, with SHADOW_SPECULAR. Without SPECULAR it lacks the albedo, which main() multiplies in.
vec3 surface_light(surface s, light_sample l, float seen, float shine) {
    vec3 arriving = l.color * (max(dot(s.normal, l.to_light), 0.0) * seen);
    if (!SPECULAR) return arriving;
    float n_h = max(dot(s.normal, normalize(l.to_light + s.to_eye)), 0.0001); // pow(0, 0) is undefined
    if (SHADOW_SPECULAR)
        return s.diffuse * arriving + s.specular * pow(n_h, s.exponent) * l.color * (max(dot(s.normal, l.to_light), 0.0) * shine);
    return (s.diffuse + s.specular * pow(n_h, s.exponent)) * arriving;
}

// Light `slot` of the pass at this fragment, unshadowed but with the transmittance of its slide.
light_sample light_here(const int slot, const int type) {
    light_sample l = light_at(slot, type, v_position);
#ifdef WITH_SLIDES
    l.color *= slide_of(slot, v_position);
#endif
    return l;
}

// src/gl/compose.c writes the loops over lights as macros, so that every argument is a constant of the program:
// EACH_SHADOWED_LIGHT(F) is one F(slot, LIGHT_.., radial, shadow_visibility_N, u_map_SLOT) per shadowed light. radial is true if
// the map holds distances (point and spot lights, encodings other than depth); N is the first slot with the same technique, encoding
// and moments. A technique that also reads u_filtered_SLOT, what the map is filtered into, has shadow_both_SLOT instead, which
// calls it. EACH_OPEN_LIGHT(F) is one F(slot, LIGHT_..) per light without a shadow.
// SHADOW_LINEAR[slot], also from compose.c, is true where uv and code are linear over a triangle: directional lights without
// cascades, and planar shadows. lit.vert computes them there as v_shadow[slot], and where SHADOW_PROJECTED[slot], of a spot, x, y and
// w of its projection; else v_shadow[slot] is 0 and unused.
// CUT_LAST, also from compose.c: holes are cut after the lights, since derivatives are undefined after a discard.
// With SHADOW_SPECULAR, LIGHT_COLOR.w has the strength of the shadow, and what it leaves of highlights in steps of 1 / 255, times 2.
#define ADD_SHADOWED_LIGHT(slot, type, radial, visibility, map) \
    { \
        light_sample l = light_here(slot, type); \
        shadow_place place = shadow_place_of(slot, type, radial, v_shadow[slot], v_position, s.normal, face, l); \
        float seen = shadow_mixed(slot, place, visibility(map, place)); \
        float taken = LIGHT(slot, LIGHT_COLOR).w; \
        float left = SHADOW_SPECULAR ? floor(taken * 0.5) : 0.0; \
        if (SHADOW_SPECULAR) taken -= 2.0 * left; \
        light += surface_light(s, l, 1.0 - taken * (1.0 - seen), mix(left / 255.0, 1.0, seen)); \
    }
#define ADD_OPEN_LIGHT(slot, type) light += surface_light(s, light_here(slot, type), 1.0, 1.0);

void main() {
    vec3 face = surface_face_normal();
    vec4 base = surface_base();
    if (!CUT_LAST) surface_cut(base);
    vec3 color = base.rgb;
    if (!UNLIT) {
        surface s = surface_make(base);
        vec3 light = ADDITIVE ? vec3(0.0) : surface_ambient(s.normal);
        if (SPECULAR) light *= base.rgb;
        EACH_SHADOWED_LIGHT(ADD_SHADOWED_LIGHT)
        EACH_OPEN_LIGHT(ADD_OPEN_LIGHT)
        color = SPECULAR ? light : light * base.rgb;
        if (EMISSIVE) color += surface_emission();
    }
    if (ENCODE_SRGB) color = srgb_from_linear(color);
    o_color = ALPHA_BLEND ? vec4(color * base.a, base.a) : vec4(color, 1.0);
    if (ADDITIVE) o_color.a = 0.0; // with premultiplied blending this adds
    if (CUT_LAST) surface_cut(base);
}
