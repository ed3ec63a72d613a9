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

// Share of white light from all sides that a surface of that roughness reflects to an eye at the cosine n_v, without what grazing light
// adds; f0: reflectance at normal incidence. What one reflection loses between microfacets (of GGX at roughness 1 0.69 from the front,
// 0.44 at a cosine of 0.3) comes back by further ones, each dimmed by f0: Fdez-Aguera, "A Multiple-Scattering Microfacet Model for
// Real-Time Image-Based Lighting" (2019). The sum of a metal is f0 (1 - lost) / (1 - lost f0), within 5 % of this. White reflects all.
vec3 environment_metal_share(vec3 f0, float roughness, float n_v) {
    n_v = abs(n_v); // normals of a map, or within a triangle, may face away
    float lost = 0.67 * (roughness * roughness * roughness) * (n_v * (2.0 - n_v));
    return f0 * (1.0 - lost + f0 * (0.42 * lost + 0.58 * lost * f0));
}

// With what grazing light adds: Karis, "Physically Based Shading on Mobile" (2014), his term b without a factor of 1.04. Of a random walk
// between microfacets (tests/image/microfacets.h) it differs by 0.008, root mean square over roughnesses, cosines and reflectances.
vec3 environment_share(vec3 metal, float roughness, float n_v) {
    float smooth_part = 1.0 - roughness, grazing = exp2(-9.28 * n_v);
    float b = smooth_part * min(smooth_part * smooth_part, grazing);
    return metal + b * (1.0 - metal);
}

// Where a surface looks for what it reflects. Rough ones gather it around their normal: what lies behind their horizon is nothing
// that they could reflect. Not of unit length.
vec3 environment_along(vec3 normal, vec3 to_eye, float n_v, float alpha_squared) {
    return environment_direction((2.0 * n_v + 4.0 * alpha_squared) * normal - to_eye);
}
