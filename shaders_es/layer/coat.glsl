// KHR_materials_clearcoat: a smooth layer with an index of refraction of 1.5 and the normal of the mesh. The rest of the surface gets,
// and shows, what it does not reflect.
#include "lib/shade.glsl"

vec3 coat_normal; // unit
float coat_roughness;
float coat_alpha_squared; // of what is reflected, within a pixel
float coat_share; // of the light, that the coat reflects
vec3 coat_sum;    // radiance that reaches the eye by way of the coat, before that share

void coat_begin(vec3 smooth_normal, inout surface s) {
    coat_normal = smooth_normal;
    coat_roughness = FACTOR_COAT_ROUGHNESS * TEXEL_COAT_ROUGHNESS.g;
    float alpha = coat_roughness * coat_roughness;
    float once = 0.04 * (1.0 - 0.64 * alpha); // from the front: of a coat the rest is less than grazing light adds
    coat_share = FACTOR_COAT * TEXEL_COAT.r * environment_share(vec3(once), coat_roughness, dot(smooth_normal, s.to_eye)).x;
    s.through *= 1.0 - coat_share;
    coat_alpha_squared = min(alpha * alpha + surface_spread, 1.0);
    coat_sum = vec3(0.0);
}

void coat_ambient(surface s) {
    vec3 along = 2.0 * dot(coat_normal, s.to_eye) * coat_normal - s.to_eye;
    if (ENVIRONMENT) coat_sum = surface_mirrored(s, environment_direction(along), sqrt(sqrt(coat_alpha_squared)));
}

void coat_light(surface s, light_sample l, float seen) {
    vec3 h = l.to_light + s.to_eye;
    float n_h = max(dot(coat_normal, h) * inversesqrt(dot(h, h)), 0.0001);
    float exponent = 2.0 / max(coat_alpha_squared, 0.000004) - 2.0;
    if (ENVIRONMENT_KEY) seen *= sqrt(coat_alpha_squared); // as in surface_highlight()
    coat_sum += l.color * (max(dot(coat_normal, l.to_light), 0.0) * seen * pow(n_h, exponent) * (0.125 * exponent + 1.0));
}

void coat_end(surface s, inout vec3 color) { color = mix(color, coat_sum, coat_share); }
