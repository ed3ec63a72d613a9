//@ names shadow_visibility
// Four taps half a texel away along both diagonals: a 3 x 3 texel tent.
float shadow_visibility(MAP_SAMPLER map, vec3 at, vec4 size) {
    float h = 0.5 * size.z;
    float lit = map_lit_linear(map, at + vec3(-h, -h, 0.0), size);
    lit += map_lit_linear(map, at + vec3(h, -h, 0.0), size);
    lit += map_lit_linear(map, at + vec3(-h, h, 0.0), size);
    lit += map_lit_linear(map, at + vec3(h, h, 0.0), size);
    return 0.25 * lit;
}
