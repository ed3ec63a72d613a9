//@ names shadow_visibility
// One hardware tap: the four texels round the point, weighed bilinearly.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) { return map_lit_linear(map, s.at, s); }
