// Position of a surface point in the shadow map. Bias against self-shadowing: the point is pushed along its normal and towards
// the light, in units of texels; the map itself is not biased. Normal offset: after Holbert, "Saying Goodbye to Shadow Acne",
// 2011; the slope offset covers the depth range of a tilted surface within a texel.

#define SHADOW(slot, what) PASS(PASS_SHADOWS + (slot)*SHADOW_SIZE + (what))

mat4 shadow_matrix(const int slot) {
    return mat4(SHADOW(slot, SHADOW_MAP), SHADOW(slot, SHADOW_MAP + 1), SHADOW(slot, SHADOW_MAP + 2), SHADOW(slot, SHADOW_MAP + 3));
}

// The bias as a vector that is added to the point, world space. n, l: unit normal and unit direction to the light; a: unit
// direction in which the code grows, of either sign (l for distances, the axis for depths); n_a: cosine between n and a; texel:
// scale of the plane units at the point, metres. Across a texel the code changes by texel sin(n, a) / cos(n, l): by 0 on a surface
// normal to a. A surface seen from its unlit side is pushed to the lit side: callers test whether it faces the light.
// spread: normal_spread() for techniques that need the bias of the face, else 0. The face's normal may be further from l than n is;
// its cosine to l is at least about |cos(n, l)| - spread, and the bias is that of this cosine. Where the bias is computed per vertex
// (SHADOW_LINEAR), a normal turned away from the light may belong to a face with cos(face, l) > 0.25: the normal offset of such a
// vertex is 0, and the limit of the slope is higher, against stripes on faces at grazing light.
vec3 shadow_push(const int slot, vec3 n, vec3 l, float n_a, float texel, float spread) {
    vec4 bias = SHADOW(slot, SHADOW_BIAS);
    float c = dot(n, l), turned = abs(c) - spread, least = min(turned, abs(n_a));
    float s = sqrt(max(1.0 - least * least, 0.0));
    float side = c >= 0.0 ? 1.0 : SHADOW_LINEAR[slot] && c > 0.25 - spread ? 0.0 : -1.0;
    float slope_max = bias.BIAS_SLOPE_MAX + (SHADOW_LINEAR[slot] ? 20.0 * spread : 0.0);
    float slope = min(s / max(turned, 0.001), slope_max);
    return n * (side * bias.BIAS_NORMAL * s * texel) + l * (bias.BIAS_SLOPE * slope * texel + bias.BIAS_ULP);
}

// Directional lights: uv and code, linear in p, so it may be computed per vertex. Also planar shadows of any light: their bias is
// 0, so l does not matter.
vec3 shadow_point_directional(const int slot, vec3 p, vec3 n, vec3 l, float spread) {
    return (shadow_matrix(slot) * vec4(p + shadow_push(slot, n, l, dot(n, l), 1.0, spread), 1.0)).xyz;
}

// Spots and points: the normal offset does not depend on the direction of the light, so it may be computed per vertex, and the rest
// is towards the light (shadow_code()), which moves no lookup. side: 1, or -1 on a surface seen from its unlit side.

// Spot lights: x, y and w of the projection, linear in p. On a coarse mesh a face may graze where the normal does not: the normal
// offset grows with the spread. Where the light grazes a plane the limit of the slope leaves this offset alone to hold the point over
// it, and .3 of the bias is less than half a texel: with |c| under .125 it grows to all of the bias.
vec3 shadow_point_spot(const int slot, vec3 p, vec3 n, float spread) {
    mat4 m = shadow_matrix(slot);
    float c = dot(n, normalize(SHADOW(slot, SHADOW_PLACE).xyz - p));
    float side = c >= 0.0 ? 1.0 : SHADOW_SPREAD[slot] && c > 0.25 - spread ? 0.0 : -1.0;
    float quarters = max(0.8325 - 4.65 * (abs(c) + spread), 0.25 + spread);
    float depth = m[0].w * p.x + m[1].w * p.y + m[2].w * p.z + m[3].w;
    vec3 q = p + n * (side * quarters * SHADOW(slot, SHADOW_BIAS).BIAS_FOUR * depth);
    return m[3].xyw + m[0].xyw * q.x + m[1].xyw * q.y + m[2].xyw * q.z; // the sum begun with its constant takes 3 instructions less
}

// Code of a receiver, moved towards the light. Across a texel of a plane the code changes by texel tan(n, l), for which 1 / cos -
// BIAS_FLAT stands; maps of depths have the latter in PLACE_CODE_SCALE. c: cosine between normal and direction
// to the light; depth: along the axis; inverse: 1 / depth; distance_m: for maps of distances (radial).
float shadow_code(const int slot, const bool radial, float distance_m, float depth, float inverse, float c, float spread) {
    vec4 bias = SHADOW(slot, SHADOW_BIAS);
    float scale = SHADOW(slot, SHADOW_PLACE).PLACE_CODE_SCALE;
    float slope = 1.0 / max(abs(c) - spread, bias.BIAS_LEAST);
    float length_or_inverse = radial ? distance_m - bias.BIAS_SLOPE * (slope - BIAS_FLAT) * depth : inverse;
    if (!radial) scale += bias.BIAS_SLOPE * slope;
    return length_or_inverse * scale + SHADOW(slot, SHADOW_CODE).CODE_OFFSET;
}
