//@ names taps_lit taps_to_map
// Fraction of lit taps over a disk: the TAPS / 2 points of the unit disk in SHADOW_TAPS, and their opposites. radius: texels.
// Each tap is compared with the receiver's plane at the tap, so that a wide filter does not make a surface shadow itself.
#include "lib/noise.glsl"

// From the unit disk to uv and code.
mat2x3 taps_to_map(shadow_place s, float radius, mat2 turn) {
    vec2 scale = radius * s.size.zw;
    vec2 x = turn[0] * scale, y = turn[1] * scale;
    return mat2x3(vec3(x, dot(s.slope, x)), vec3(y, dot(s.slope, y)));
}

// map_lit(): of lib/map_depth.glsl where the sampler compares, else of lib/map_lit.glsl.
float taps_lit(MAP_SAMPLER map, shadow_place s, float radius, mat2 turn) {
    mat2x3 to_map = taps_to_map(s, radius, turn);
    float lit = 0.0;
    for (int i = 0; i < TAPS / 2; i++) {
        vec3 d = to_map * SHADOW_TAPS[i];
        lit += map_lit(map, s.at + d, s) + map_lit(map, s.at - d, s);
    }
    return lit * (1.0 / float(TAPS));
}
