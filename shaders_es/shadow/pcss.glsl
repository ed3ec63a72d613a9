//@ names shadow_visibility
// map_code(): lib/map_*.glsl of the light's encoding. taps_..(), noise_turn(): lib/taps.glsl, lib/noise.glsl. TAPS, SHADOW_TAPS
// and the order of files: add_lights() and add_lookup() in src/gl/compose.c.
// Percentage-closer soft shadows (Fernando, "Percentage-Closer Soft Shadows", 2005): the mean distance of the blockers in the part
// of the map that can contain them, then PCF as wide as their penumbra is at the receiver.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) {
    mat2 turn = noise_turn();
    float depth = shadow_penumbra_depth(s, s.at.z);
    float widest = max(s.penumbra.PENUMBRA_RADIUS * (depth - s.penumbra.PENUMBRA_NEAREST), 1.0);
    mat2x3 to_map = taps_to_map(s, widest, turn);
    float blocked = 0.0, codes = 0.0;
    for (int i = 0; i < TAPS / 2; i++) {
        vec3 d = to_map * SHADOW_TAPS[i];
        vec3 a = s.at + d, b = s.at - d;
        vec2 code = vec2(map_code(map, a.xy), map_code(map, b.xy));
        vec2 blocks = 1.0 - step(min(vec2(a.z, b.z), s.far), code);
        blocked += blocks.x + blocks.y;
        codes += dot(blocks, code);
    }
    if (blocked < 0.5) return 1.0;
    float radius = s.penumbra.PENUMBRA_RADIUS * (depth - shadow_penumbra_depth(s, codes / blocked));
    return taps_lit(map, s, clamp(radius, 1.0, widest), turn);
}
