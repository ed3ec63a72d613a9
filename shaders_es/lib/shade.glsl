// What a lit surface reflects, for lit.frag and the layers in layer/. A layer NAME defines four functions; those of all layers of the
// program are called as LAYERS_BEGIN and so on, from the base upwards (src/scene/material.h, src/gl/compose.c):
// NAME_begin(smooth_normal, s): what it takes of the surface below
// NAME_ambient(s): adds what it reflects of the ambient light
// NAME_light(s, l, seen): adds what it reflects of one light; seen: visibility of highlights, 1 = lit
// NAME_end(s, color): puts it over the radiance of what is below
// FACTOR_.. are its factors, TEXEL_.. texels of its textures, 1 where there is none.
#include "lib/flat_constants.glsl"
#include "lib/surface.glsl"
#include "lib/light.glsl"
#include "lib/environment.glsl"
#include "lib/occlusion.glsl"

#ifdef WITH_NORMAL_TEXTURE
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

// What is added to the square of alpha, because the normals of the mesh differ within a pixel: without that, highlights of bevels and
// seams come and go from pixel to pixel. Tokuyoshi, Kaplanyan, "Improved Geometric Specular Antialiasing" (2019), over half a pixel.
// Of metal and coats, which show highlights most.
float surface_spread = 0.0;

// Takes derivatives: not behind a branch or a discard.
void surface_measure_spread() {
    vec3 dx = dFdx(v_normal), dy = dFdy(v_normal);
    surface_spread = min(0.5 * (dot(dx, dx) + dot(dy, dy)), 0.18);
}

// x: roughness, y: metalness
vec2 surface_roughness() { return v_surface.xy * TEXEL_ROUGHNESS.gb; }

vec3 surface_emission() { return v_emissive.rgb * u_pass[PASS_EXPOSURE].x * TEXEL_EMISSIVE.rgb; }

// Unit normal of the shaded surface; smooth_normal: that of the mesh. MikkTSpace: the interpolated vectors are not normalised again, and
// the bitangent is made here. Shadows keep the normal of the mesh.
vec3 surface_mapped_normal(vec3 smooth_normal) {
#ifdef WITH_NORMAL_TEXTURE
    vec3 m = TEXEL_NORMAL.xyz * 2.0 - 1.0;
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
    return FACTOR_REFLECTANCE;
#else
    return vec3(0.04);
#endif
}

// Inputs of the BRDF, the same for all lights. Normalised Blinn-Phong: (n + 8) / 8 pi; LIGHT_COLOR contains the 1 / pi.
struct surface {
    vec3 normal, to_eye, diffuse, specular;
    vec3 smooth_normal; // of the mesh, towards the viewer, not of unit length; with a normal map
    float exponent;
    vec3 f0; // with ENVIRONMENT or TRANSMISSION: environment_metal_share()
    float roughness;
    float lobe, alpha, alpha_squared; // roughness of what is reflected, within a pixel, its square and the square of that
    vec3 through; // factors on what is behind
    float open;   // share of the ambient light that arrives: surface_open()
};

surface surface_make(vec4 base, vec3 smooth_normal) {
    surface s;
    s.normal = surface_mapped_normal(smooth_normal);
    s.smooth_normal = DOUBLE_SIDED && !gl_FrontFacing ? -v_normal : v_normal;
    s.diffuse = base.rgb;
    s.through = vec3(0.0);
    s.open = 1.0;
    if (SPECULAR) {
        vec2 rm = surface_roughness();
        s.roughness = s.lobe = rm.x;
        float alpha = rm.x * rm.x;
        s.alpha_squared = alpha * alpha;
        if (METAL) {
            s.alpha_squared = min(s.alpha_squared + surface_spread, 1.0);
            alpha = sqrt(s.alpha_squared);
            s.lobe = sqrt(alpha);
        }
        s.alpha = max(alpha, 0.002);
        s.exponent = 2.0 / (METAL ? max(s.alpha_squared, 0.000004) : s.alpha * s.alpha) - 2.0; // the same; it is the form that costs less
        vec3 f0 = surface_reflectance();
        s.f0 = f0;
        if (METAL) {
#ifdef WITH_ENVIRONMENT
            vec3 metal = base.rgb * rm.y;
            s.f0 = metal + (f0 - f0 * rm.y); // white stays white
            s.diffuse = base.rgb - metal;
#else
            s.f0 = mix(f0, base.rgb, rm.y);
            s.diffuse = base.rgb * (1.0 - rm.y);
#endif
        }
#if defined WITH_ENVIRONMENT || defined WITH_TRANSMISSION
        s.f0 = environment_metal_share(s.f0, rm.x, dot(s.normal, surface_to_eye()));
#endif
        s.specular = s.f0 * (0.125 * s.exponent + 1.0);
        s.to_eye = surface_to_eye();
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
    return TEXEL_LIGHTMAP.rgb * (FACTOR_LIGHTMAP * u_pass[PASS_EXPOSURE].x);
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

// Share of the ambient light that arrives; base: of the surface.
float surface_open(surface s, vec3 base) {
    float open = environment_scale();
#ifdef WITH_OCCLUDED
    // The picture is of details, the volume of the whole: the smaller counts. What is in the way is as bright as this surface, and as
    // open: the sum of all bounces, of the mean colour, after Jimenez and others, "Practical Realtime Strategies for Accurate Indirect
    // Occlusion" (2016), who fit it per channel.
    float seen = occlusion_at(NORMAL_TEXTURE ? s.smooth_normal : s.normal);
#ifdef WITH_OCCLUSION_TEXTURE
    seen = min(seen, 1.0 + v_surface.z * (TEXEL_OCCLUSION.r - 1.0));
#endif
    return open * seen / (1.0 - (base.r + base.g + base.b) * (0.3333 - 0.3333 * seen));
#else
#ifdef WITH_OCCLUSION_TEXTURE
    if (CATCHER) open *= texture(u_texture_occlusion, (v_position.xz - v_surface.xy) * v_surface.w + 0.5).r;
    else open *= 1.0 + v_surface.z * (TEXEL_OCCLUSION.r - 1.0);
#endif
    return open;
#endif
}

// Radiance that the environment, in steps of roughness, sends from a direction in its own frame; with ENVIRONMENT.
vec3 surface_mirrored(surface s, vec3 along, float roughness) {
#ifdef WITH_ENVIRONMENT
    float scale = s.open * (ENVIRONMENT_SCALED && !ENVIRONMENT_DIFFUSE ? PASS(PASS_SKY).w : 1.0);
    return textureLod(u_environment, along, roughness * ENVIRONMENT_ROUGHEST).rgb * scale;
#else
    return vec3(0.0);
#endif
}

// Reflected radiance of the ambient light. Without SPECULAR it lacks the albedo.
vec3 surface_ambient(surface s, vec3 base) {
    vec3 ambient = surface_irradiance(s);
#ifdef WITH_ENVIRONMENT
    float n_v = dot(s.normal, s.to_eye);
    vec3 along = environment_along(s.normal, s.to_eye, n_v, s.alpha_squared);
    vec3 share = environment_share(s.f0, s.roughness, n_v);
    vec3 reflected = textureLod(u_environment, along, s.lobe * ENVIRONMENT_ROUGHEST).rgb;
    if (ENVIRONMENT_DIFFUSE) return mix(s.diffuse * ambient, reflected, share) * s.open;
    return s.diffuse * ambient * s.open + reflected * (share * (ENVIRONMENT_SCALED ? PASS(PASS_SKY).w * s.open : s.open));
#else
    ambient *= s.open;
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
