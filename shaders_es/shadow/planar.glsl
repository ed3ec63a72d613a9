//@ names shadow_visibility
// map_code() comes from lib/map_mask.glsl, lib/map_mean.glsl or lib/map_stencil.glsl, the light's encoding.
// Planar shadow mask, four bilinear taps half a texel away along both diagonals: a 3 x 3 texel tent. With the stencil, visibility
// is a constant of the pass.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) {
    if (map_in_stencil) return s.far;
    vec2 a = s.at.xy - 0.5 * s.size.zw;
    vec2 b = s.at.xy + 0.5 * s.size.zw;
    float lit = map_code(map, a) + map_code(map, vec2(b.x, a.y)) + map_code(map, vec2(a.x, b.y)) + map_code(map, b);
    if (map_is_mean) return 0.25 * s.penumbra.PENUMBRA_SCALE * lit + s.penumbra.PENUMBRA_BIAS;
    return 0.25 * lit;
}
