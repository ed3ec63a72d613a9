// From a surface to where its shadow is looked up: the point is pushed along its normal and towards the light, by texels of the
// map, so that a surface does not shadow itself; nothing of this is in the map. Normal offset: after Holbert, "Saying Goodbye to
// Shadow Acne", 2011; the slope term covers what a texel of a tilted surface spans in depth.

#define SHADOW(slot, what) PASS(PASS_SHADOWS + (slot)*SHADOW_SIZE + (what))

mat4 shadow_matrix(const int slot) {
    return mat4(SHADOW(slot, SHADOW_MAP), SHADOW(slot, SHADOW_MAP + 1), SHADOW(slot, SHADOW_MAP + 2), SHADOW(slot, SHADOW_MAP + 3));
}

// How far to push, world space. n, l: unit, normal and direction to the light; n_a: cosine of n and a, the unit vector that the
// map's code grows along, of either sign; texel: scale of the plane units here, metres. Across a texel the code changes by texel
// sin(n, a) / cos(n, l): nothing on a surface that a is normal to. One seen from its dark side is pushed to the lit one: whether it
// faces the light is for the caller.
vec3 shadow_push(const int slot, vec3 n, vec3 l, float n_a, float texel) {
    vec4 bias = SHADOW(slot, SHADOW_BIAS);
    float c = dot(n, l);
    float s = sqrt(max(1.0 - min(c * c, n_a * n_a), 0.0));
    float side = c < 0.0 ? -1.0 : 1.0;
    float slope = min(s / max(abs(c), 0.001), bias.BIAS_SLOPE_MAX);
    return n * (side * bias.BIAS_NORMAL * s * texel) + l * (bias.BIAS_SLOPE * slope * texel + bias.BIAS_ULP);
}

// Directional: linear in p, so it may be made per vertex. uv and code. On a plane with any light: then nothing is pushed, and l
// may be anything.
vec3 shadow_point_directional(const int slot, vec3 p, vec3 n, vec3 l) {
    return (shadow_matrix(slot) * vec4(p + shadow_push(slot, n, l, dot(n, l), 1.0), 1.0)).xyz;
}

// Spot: a texel grows with the depth along the axis, which is the w of the projection. radial: the map holds distances.
vec3 shadow_point_spot(const int slot, const bool radial, vec3 p, vec3 n, vec3 l) {
    mat4 m = shadow_matrix(slot);
    vec3 axis = vec3(m[0].w, m[1].w, m[2].w);
    float depth = dot(axis, p) + m[3].w;
    vec3 q = p + shadow_push(slot, n, l, dot(n, radial ? l : axis), depth);
    vec4 h = m * vec4(q, 1.0);
    vec4 place = SHADOW(slot, SHADOW_PLACE);
    vec3 at = h.xyz / h.w;
    if (radial) at.z = length(q - place.xyz) * place.PLACE_CODE_SCALE + SHADOW(slot, SHADOW_CODE).CODE_OFFSET;
    return at;
}
