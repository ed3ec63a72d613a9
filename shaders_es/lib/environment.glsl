// Light from all directions: src/environment/. With ENVIRONMENT_SCALED PASS_SKY.w is the factor on its radiance, else that is 1.

// A vertex is enough for diffuse light, which changes little from one normal to the next. A normal map adds environment_slope().
#ifdef WITH_ENVIRONMENT_DIFFUSE
#define WITH_IRRADIANCE 1
#endif

// A direction in the environment's own frame, which is turned about +Y.
vec3 environment_direction(vec3 d) {
#ifdef WITH_ENVIRONMENT_TURNED
    vec2 turn = u_pass[PASS_ENVIRONMENT + ENVIRONMENT_TURN].xy;
    d = vec3(turn.x * d.x - turn.y * d.z, d.y, turn.x * d.z + turn.y * d.x);
#endif
    return d;
}

// Radiance of a white diffuse surface with the normal n, in two parts: on the other side the second one is negated. Ramamoorthi,
// Hanrahan, "An Efficient Representation for Irradiance Environment Maps" (2001).
void environment_diffuse(vec3 n, out vec3 even, out vec3 odd) {
    n = environment_direction(n);
#define HARMONIC(i) u_pass[PASS_ENVIRONMENT + i].xyz
    odd = HARMONIC(1) * n.y + HARMONIC(2) * n.z + HARMONIC(3) * n.x;
    even = HARMONIC(0) + HARMONIC(4) * (n.x * n.y) + HARMONIC(5) * (n.y * n.z) + HARMONIC(6) * (3.0 * n.z * n.z - 1.0) +
           HARMONIC(7) * (n.x * n.z) + HARMONIC(8) * (n.x * n.x - n.y * n.y);
    even = max(even, 0.0);
    odd = clamp(odd, -even, even); // no light is negative on either side
}

// What diffuse light gains where the normal differs by that much: the linear harmonics alone, a third of the instructions.
vec3 environment_slope(vec3 by) {
    by = environment_direction(by);
    return HARMONIC(1) * by.y + HARMONIC(2) * by.z + HARMONIC(3) * by.x;
}

// Share of white light from all sides that a surface reflects to an eye in front of it, by its reflectance at normal incidence; alpha:
// roughness squared. What one reflection loses between microfacets (of GGX on average 0.01, 0.12, 0.34, 0.59 at roughness 1/4 .. 1)
// comes back by further ones, each dimmed by f0: Fdez-Aguera, "A Multiple-Scattering Microfacet Model for Real-Time Image-Based
// Lighting" (2019). The sum of a metal is f0 (1 - lost) / (1 - lost f0), within 5 % of this; of a dielectric the first reflection is
// all. White reflects all.
vec3 environment_facing_share(vec3 f0, float alpha) {
    float lost = 0.65 * alpha;
    return f0 * (1.0 - lost * (1.0 - f0 * (0.42 + 0.58 * f0)));
}

// The same for an eye at that cosine. Karis, "Physically Based Shading on Mobile" (2014): his term b, without a factor of 1.04 and
// terms under 0.005; and what rough surfaces reflect more at an angle, of those that reflect at all: with its further reflections GGX
// of roughness 1 and f0 0.27 has 0.12, 0.15 and 0.18 at cosines of 0.9, 0.5 and 0.3. Within 12 % of GGX's mean over a sphere.
vec3 environment_share(vec3 facing, float roughness, float n_v) {
    float smooth_part = 1.0 - roughness, low = 1.0 - max(n_v, 0.0);
    float b = smooth_part * min(smooth_part * smooth_part, exp2(-9.28 * n_v));
    b += min(0.19, 2.7 * facing.g) * (roughness * roughness) * (low * low * low);
    return facing + b * (1.0 - facing);
}

// Where a surface looks for what it reflects. Rough ones gather it around their normal: what lies behind their horizon is nothing
// that they could reflect. Not of unit length.
vec3 environment_along(vec3 normal, vec3 to_eye, float n_v, float roughness) {
    float toward = 2.0 * roughness * roughness;
    return environment_direction((2.0 * n_v + toward * toward) * normal - to_eye);
}
