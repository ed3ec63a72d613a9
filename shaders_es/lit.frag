// colour = ambient x albedo x occlusion + sum over lights of (1 - strength (1 - visibility)) x (diffuse + specular) + emissive,
// in linear space, after exposure. ADDITIVE: only the sum over lights. The ambient light is that of the hemispheres; with
// ENVIRONMENT_DIFFUSE that of the environment; with ENVIRONMENT what the environment shows in reflections is added.
#include "lib/shade.glsl"
#include "lib/shadow_place.glsl"
#include "lib/srgb.glsl"
#include "lib/tone.glsl"

layout(location = 0) out vec4 o_color;

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
// CATCHER, of an unseen floor: `open` is the same sum without shadows.
#define ADD_SHADOWED_LIGHT(slot, type, radial, visibility, map) \
    { \
        light_sample l = light_here(slot, type); \
        shadow_place place = shadow_place_of(slot, type, radial, v_shadow[slot], v_position, smooth_normal, face, l); \
        float seen = shadow_mixed(slot, place, visibility(map, place)); \
        float taken = LIGHT(slot, LIGHT_COLOR).w; \
        float left = SHADOW_SPECULAR ? floor(taken * 0.5) : 0.0; \
        if (SHADOW_SPECULAR) taken -= 2.0 * left; \
        light += surface_light(s, l, 1.0 - taken * (1.0 - seen), mix(left / 255.0, 1.0, seen)); \
        LAYERS_LIGHT(s, l, SHADOW_SPECULAR ? mix(left / 255.0, 1.0, seen) : 1.0 - taken * (1.0 - seen)) \
        if (CATCHER) open += surface_light(s, l, 1.0, 1.0); \
    }
#define ADD_OPEN_LIGHT(slot, type) \
    { \
        light_sample l = light_here(slot, type); \
        vec3 all = surface_light(s, l, 1.0, 1.0); \
        light += all; \
        LAYERS_LIGHT(s, l, 1.0) \
        if (CATCHER) open += all; \
    }

// Share of the light that shadows take from a shadow catcher; none at the rim of its square, whose centre and size v_surface has.
float caught_shadow(vec3 light, vec3 open) {
    const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
    float taken = 1.0 - dot(light, luminance) / max(dot(open, luminance), 1e-6);
    return taken * clamp(2.0 - 2.0 * length((v_position.xz - v_surface.xy) * v_surface.z), 0.0, 1.0);
}

#if defined WITH_TRANSMISSION && defined WITH_UNLIT
// The tint of a surface whose own light comes with the next draw; alpha: what it covers. With GN_BLEND_TINT.
void main() {
    vec4 base = surface_base();
    surface_cut(base);
    base.rgb = max(base.rgb, v_emissive.r); // 1: as if it were white
    vec3 smooth_normal = surface_normal();
    surface s = surface_make(base, smooth_normal);
    LAYERS_BEGIN(smooth_normal, s)
    float covered = ALPHA_BLEND ? base.a : 1.0;
    vec3 color = 1.0 - covered * (1.0 - s.through);
    o_color.a = 1.0 - dot(color, vec3(0.2126, 0.7152, 0.0722));
    o_color.rgb = ENCODE_SRGB ? srgb_from_linear(color) : color;
}
#else
void main() {
    vec3 face = surface_face_normal();
    if (METAL || COAT) surface_measure_spread();
    vec4 base = surface_base();
    if (!CUT_LAST) surface_cut(base);
    vec3 color = base.rgb, through = vec3(0.0);
    if (!UNLIT) {
        vec3 smooth_normal = surface_normal();
        surface s = surface_make(base, smooth_normal);
        if (!ADDITIVE) s.open = surface_open(s, base.rgb);
        LAYERS_BEGIN(smooth_normal, s)
        vec3 light = ADDITIVE ? vec3(0.0) : surface_ambient(s, base.rgb);
        vec3 open = CATCHER ? surface_irradiance(s) * environment_scale() : light; // without shadows, of a catcher
        if (!ADDITIVE) { LAYERS_AMBIENT(s) }
        EACH_SHADOWED_LIGHT(ADD_SHADOWED_LIGHT)
        EACH_OPEN_LIGHT(ADD_OPEN_LIGHT)
#ifdef WITH_ENVIRONMENT_DIFFUSE // what full roughness reflects at an IOR of 1.5
        if (!SPECULAR) base.rgb = base.rgb * 0.981 + 0.019;
#endif
        color = SPECULAR ? light : light * base.rgb;
        if (EMISSIVE) color += surface_emission();
        LAYERS_END(s, color)
        through = s.through;
        if (CATCHER) base.a = caught_shadow(light, open);
    }
    if (CATCHER) color = vec3(0.0);
#ifdef WITH_TONE
    color = tone_mapped(color);
#endif
    if (ENCODE_SRGB) color = srgb_from_linear(color);
    o_color = ALPHA_BLEND ? vec4(color * base.a, base.a) : vec4(color, 1.0);
    if (TRANSMISSION) o_color.a = TINTED ? 0.0 : o_color.a * (1.0 - through.g); // grey: the factor on what is behind is 1 - alpha
    if (ADDITIVE) o_color.a = 0.0; // with premultiplied blending this adds
    if (CUT_LAST) surface_cut(base);
}
#endif
