// colour = ambient x albedo x occlusion + sum over lights of (1 - strength (1 - visibility)) x (diffuse + specular) + emissive,
// in linear space, after exposure. ADDITIVE: only the sum over lights. The ambient light is that of the hemispheres; with
// ENVIRONMENT_DIFFUSE that of the environment; with ENVIRONMENT what the environment shows in reflections is added.
#include "lib/flat_constants.glsl"
#include "lib/surface.glsl"
#include "lib/light.glsl"
#include "lib/shadow_place.glsl"
#include "lib/srgb.glsl"
#include "lib/tone.glsl"
#include "lib/environment.glsl"

#ifdef WITH_LIGHTMAP_TEXTURE
uniform mediump sampler2D u_texture_lightmap;
#endif
#ifdef WITH_COAT_TEXTURE
uniform mediump sampler2D u_texture_coat;
#endif
#ifdef WITH_COAT_ROUGHNESS_TEXTURE
uniform mediump sampler2D u_texture_coat_roughness;
#endif
#ifdef WITH_ROUGHNESS_TEXTURE
uniform mediump sampler2D u_texture_roughness;
#endif
#ifdef WITH_EMISSIVE_TEXTURE
uniform mediump sampler2D u_texture_emissive;
#endif
#ifdef WITH_OCCLUSION_TEXTURE
uniform mediump sampler2D u_texture_occlusion;
#endif
#ifdef WITH_NORMAL_TEXTURE
uniform mediump sampler2D u_texture_normal;
in vec3 v_tangent; // unit, times the scale of the normal map
flat in float v_bitangent_sign;
#endif

#ifdef WITH_ENVIRONMENT
uniform mediump samplerCube u_environment;
#endif
#ifdef WITH_IRRADIANCE
in vec3 v_irradiance;
#ifdef WITH_DOUBLE_SIDED
in vec3 v_irradiance_odd; // negated on the back
#endif
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

vec3 surface_emission() {
    vec3 emission = v_emissive.rgb * u_pass[PASS_EXPOSURE].x;
#ifdef WITH_EMISSIVE_TEXTURE
    emission *= texture(u_texture_emissive, v_uv_emissive).rgb;
#endif
    return emission;
}

// Unit normal of the shaded surface; smooth_normal: that of the mesh. MikkTSpace: the interpolated vectors are not normalised again, and
// the bitangent is made here. Shadows keep the normal of the mesh.
vec3 surface_mapped_normal(vec3 smooth_normal) {
#ifdef WITH_NORMAL_TEXTURE
    vec3 m = texture(u_texture_normal, v_uv_normal).xyz * 2.0 - 1.0;
    m.y *= v_bitangent_sign;
    vec3 n = normalize(m.x * v_tangent + m.y * cross(v_normal, v_tangent) + m.z * v_normal);
    return DOUBLE_SIDED && !gl_FrontFacing ? -n : n;
#else
    return smooth_normal;
#endif
}

// At normal incidence, of what is no metal: KHR_materials_ior, KHR_materials_specular.
vec3 surface_reflectance() {
#ifdef WITH_REFLECTANCE
    return u_factors[0].rgb;
#else
    return vec3(0.04);
#endif
}

// Inputs of the BRDF, the same for all lights. Normalised Blinn-Phong: (n + 8) / 8 pi; LIGHT_COLOR contains the 1 / pi.
struct surface {
    vec3 normal, to_eye, diffuse, specular;
    vec3 smooth_normal; // of the mesh, towards the viewer, not of unit length; with a normal map
    float exponent;
    vec3 f0; // with ENVIRONMENT or TRANSMISSION: environment_facing_share()
    float roughness, alpha;
#ifdef WITH_COAT
    vec3 coat_normal; // unit
    float coat, coat_roughness; // share of the light that the coat reflects
#endif
#ifdef WITH_TRANSMISSION
    vec3 through; // factors on what is behind
#endif
};

// KHR_materials_clearcoat: a smooth layer with an index of refraction of 1.5 and the normal of the mesh. The rest of the surface gets,
// and shows, what it does not reflect.
void surface_add_coat(vec3 smooth_normal, inout surface s) {
#ifdef WITH_COAT
    vec2 coat = u_factors[1].xy;
#ifdef WITH_COAT_TEXTURE
    coat.x *= texture(u_texture_coat, v_uv_coat).r;
#endif
#ifdef WITH_COAT_ROUGHNESS_TEXTURE
    coat.y *= texture(u_texture_coat_roughness, v_uv_coat_roughness).g;
#endif
    s.coat_normal = smooth_normal;
    s.coat_roughness = coat.y;
    vec3 facing = environment_facing_share(vec3(0.04), coat.y * coat.y);
    s.coat = coat.x * environment_share(facing, coat.y, dot(smooth_normal, s.to_eye)).x;
#endif
}

// KHR_materials_transmission of a thin wall: of what is not reflected, the share that is not diffuse shows what is behind, in the base
// colour; straight, whatever the roughness. Reflections stay whole.
void surface_add_transmission(inout surface s) {
#ifdef WITH_TRANSMISSION
    float clear = surface_transmission();
    s.through = min(s.diffuse, 1.0) * clear * (1.0 - environment_share(s.f0, s.roughness, dot(s.normal, s.to_eye)));
#ifdef WITH_COAT
    s.through *= 1.0 - s.coat;
#endif
    s.diffuse *= 1.0 - clear;
#endif
}

surface surface_make(vec4 base, vec3 smooth_normal) {
    surface s;
    s.normal = surface_mapped_normal(smooth_normal);
    s.smooth_normal = DOUBLE_SIDED && !gl_FrontFacing ? -v_normal : v_normal;
    s.diffuse = base.rgb;
    if (SPECULAR) {
        vec2 rm = surface_roughness();
        float alpha = max(rm.x * rm.x, 0.002);
        s.exponent = 2.0 / (alpha * alpha) - 2.0;
        vec3 f0 = surface_reflectance();
        s.f0 = METAL ? mix(f0, base.rgb, rm.y) : f0;
        s.roughness = rm.x;
        s.alpha = alpha;
#ifdef WITH_ENVIRONMENT
        if (METAL) s.f0 = base.rgb * rm.y + (f0 - f0 * rm.y);
#endif
#if defined WITH_ENVIRONMENT || defined WITH_TRANSMISSION
        s.f0 = environment_facing_share(s.f0, alpha);
#endif
        s.specular = s.f0 * (0.125 * s.exponent + 1.0);
        if (METAL) s.diffuse = base.rgb * (1.0 - rm.y);
        s.to_eye = surface_to_eye();
        surface_add_coat(smooth_normal, s);
        surface_add_transmission(s);
    }
    return s;
}

// Cosine of the angle of incidence. With a normal map the mesh, too, has to face the light: a bump that leans towards a light behind the
// surface fades over the last quarter.
float surface_cosine(surface s, light_sample l) {
    float c = dot(s.normal, l.to_light);
    if (NORMAL_TEXTURE) c = min(c, 4.0 * dot(s.smooth_normal, l.to_light));
    return max(c, 0.0);
}

// Radiance of a white diffuse surface in the ambient light; a light map stands for all that is not of a light of the scene.
vec3 surface_irradiance(surface s) {
#ifdef WITH_LIGHTMAP_TEXTURE
    return texture(u_texture_lightmap, v_uv_lightmap).rgb * (u_factors[0].w * u_pass[PASS_EXPOSURE].x);
#elif defined WITH_IRRADIANCE
    vec3 irradiance = v_irradiance;
#ifdef WITH_DOUBLE_SIDED
    irradiance += gl_FrontFacing ? v_irradiance_odd : -v_irradiance_odd;
#endif
    if (NORMAL_TEXTURE) irradiance = max(irradiance + environment_slope(s.normal - s.smooth_normal), 0.0);
    return irradiance;
#else
    vec3 ambient = PASS(PASS_SKY).rgb;
    if (HEMISPHERE) ambient = mix(PASS(PASS_GROUND).rgb, ambient, 0.5 * s.normal.y + 0.5);
    return ambient;
#endif
}

// Factor on diffuse light of the environment; the hemispheres have none.
float environment_scale() { return ENVIRONMENT_DIFFUSE && ENVIRONMENT_SCALED ? PASS(PASS_SKY).w : 1.0; }

// Share of the ambient light that arrives.
float surface_open() {
    float open = environment_scale();
#ifdef WITH_OCCLUSION_TEXTURE
    if (CATCHER) open *= texture(u_texture_occlusion, (v_position.xz - v_surface.xy) * v_surface.w + 0.5).r;
    else open *= 1.0 + v_surface.z * (texture(u_texture_occlusion, v_uv_occlusion).r - 1.0);
#endif
    return open;
}

// Reflected radiance of the ambient light. Without SPECULAR it lacks the albedo.
vec3 surface_ambient(surface s, vec3 base) {
    vec3 ambient = surface_irradiance(s);
    float open = surface_open();
#ifdef WITH_ENVIRONMENT
    float n_v = dot(s.normal, s.to_eye);
    vec3 along = environment_along(s.normal, s.to_eye, n_v, s.roughness);
    vec3 share = environment_share(s.f0, s.roughness, n_v); // seen from behind, below 0: as at a grazing angle
    vec3 reflected = textureLod(u_environment, along, s.roughness * ENVIRONMENT_ROUGHEST).rgb;
    if (ENVIRONMENT_DIFFUSE) return mix(s.diffuse * ambient, reflected, share) * open;
    return s.diffuse * ambient * open + reflected * (share * (ENVIRONMENT_SCALED ? PASS(PASS_SKY).w * open : open));
#else
    ambient *= open;
    return SPECULAR ? ambient * base : ambient;
#endif
}

// n_h: cosine between the normal and the half vector. ENVIRONMENT_KEY: that share of the light is alpha, and the environment shows
// the rest (gn_environment_key_share()).
vec3 surface_highlight(surface s, float n_h) {
    float lobe = pow(n_h, s.exponent);
#ifdef WITH_ENVIRONMENT // which needs f0 anyway
    if (ENVIRONMENT_KEY) lobe *= s.alpha;
    return s.f0 * (lobe * (0.125 * s.exponent + 1.0));
#else
    return s.specular * lobe;
#endif
}

// Reflected radiance of one light; seen: visibility, 1 = lit; shine: that of highlights, with SHADOW_SPECULAR. Without SPECULAR it lacks the albedo, which main() multiplies in.
vec3 surface_light(surface s, light_sample l, float seen, float shine) {
    vec3 arriving = l.color * (surface_cosine(s, l) * seen);
    if (!SPECULAR) return arriving;
    vec3 h = l.to_light + s.to_eye;
#ifdef WITH_ENVIRONMENT // which needs both cosines anyway
    float along = dot(s.normal, l.to_light) + dot(s.normal, s.to_eye);
#else
    float along = dot(s.normal, h);
#endif
    float n_h = max(along * inversesqrt(dot(h, h)), 0.0001); // pow(0, 0) is undefined
    if (SHADOW_SPECULAR)
        return s.diffuse * arriving + surface_highlight(s, n_h) * l.color * (surface_cosine(s, l) * shine);
    return (s.diffuse + surface_highlight(s, n_h)) * arriving;
}

// Radiance that reaches the eye by way of the coat, before the share s.coat of it: of the environment, and of a light.
vec3 coat_ambient(surface s) {
#if defined WITH_COAT && defined WITH_ENVIRONMENT
    vec3 along = environment_direction(2.0 * dot(s.coat_normal, s.to_eye) * s.coat_normal - s.to_eye);
    float scale = surface_open() * (ENVIRONMENT_SCALED && !ENVIRONMENT_DIFFUSE ? PASS(PASS_SKY).w : 1.0);
    return textureLod(u_environment, along, s.coat_roughness * ENVIRONMENT_ROUGHEST).rgb * scale;
#else
    return vec3(0.0);
#endif
}

vec3 coat_light(surface s, light_sample l, float shine) {
#ifdef WITH_COAT
    vec3 h = l.to_light + s.to_eye;
    float n_h = max(dot(s.coat_normal, h) * inversesqrt(dot(h, h)), 0.0001);
    float alpha = max(s.coat_roughness * s.coat_roughness, 0.002);
    float exponent = 2.0 / (alpha * alpha) - 2.0;
    if (ENVIRONMENT_KEY) shine *= alpha; // as in surface_highlight()
    return l.color * (max(dot(s.coat_normal, l.to_light), 0.0) * shine * pow(n_h, exponent) * (0.125 * exponent + 1.0));
#else
    return vec3(0.0);
#endif
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
        if (COAT) coat += coat_light(s, l, SHADOW_SPECULAR ? mix(left / 255.0, 1.0, seen) : 1.0 - taken * (1.0 - seen)); \
        if (CATCHER) open += surface_light(s, l, 1.0, 1.0); \
    }
#define ADD_OPEN_LIGHT(slot, type) \
    { \
        light_sample l = light_here(slot, type); \
        vec3 all = surface_light(s, l, 1.0, 1.0); \
        light += all; \
        if (COAT) coat += coat_light(s, l, 1.0); \
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
    surface s = surface_make(base, surface_normal());
    float covered = ALPHA_BLEND ? base.a : 1.0;
    vec3 color = 1.0 - covered * (1.0 - s.through);
    o_color.a = 1.0 - dot(color, vec3(0.2126, 0.7152, 0.0722));
    o_color.rgb = ENCODE_SRGB ? srgb_from_linear(color) : color;
}
#else
void main() {
    vec3 face = surface_face_normal();
    vec4 base = surface_base();
    if (!CUT_LAST) surface_cut(base);
    vec3 color = base.rgb;
#ifdef WITH_TRANSMISSION
    vec3 through;
#endif
    if (!UNLIT) {
        vec3 smooth_normal = surface_normal();
        surface s = surface_make(base, smooth_normal);
        vec3 light = ADDITIVE ? vec3(0.0) : surface_ambient(s, base.rgb);
        vec3 open = CATCHER ? surface_irradiance(s) * environment_scale() : light; // without shadows, of a catcher
        vec3 coat = COAT && !ADDITIVE ? coat_ambient(s) : vec3(0.0);
        EACH_SHADOWED_LIGHT(ADD_SHADOWED_LIGHT)
        EACH_OPEN_LIGHT(ADD_OPEN_LIGHT)
#ifdef WITH_ENVIRONMENT_DIFFUSE // what full roughness reflects at an IOR of 1.5
        if (!SPECULAR) base.rgb = base.rgb * 0.9836 + 0.0164;
#endif
        color = SPECULAR ? light : light * base.rgb;
        if (EMISSIVE) color += surface_emission();
#ifdef WITH_COAT
        color = mix(color, coat, s.coat);
#endif
#ifdef WITH_TRANSMISSION
        through = s.through;
#endif
        if (CATCHER) base.a = caught_shadow(light, open);
    }
    if (CATCHER) color = vec3(0.0);
#ifdef WITH_TONE
    color = tone_mapped(color);
#endif
    if (ENCODE_SRGB) color = srgb_from_linear(color);
    o_color = ALPHA_BLEND ? vec4(color * base.a, base.a) : vec4(color, 1.0);
#ifdef WITH_TRANSMISSION // grey: the factor on what is behind is 1 - alpha
    o_color.a = TINTED ? 0.0 : o_color.a * (1.0 - through.g);
#endif
    if (ADDITIVE) o_color.a = 0.0; // with premultiplied blending this adds
    if (CUT_LAST) surface_cut(base);
}
#endif
