//@ names shadow_visibility
// One hardware tap: the four texels round the point, weighed bilinearly.
float shadow_visibility(MAP_SAMPLER map, vec3 at, vec4 size) { return map_lit_linear(map, at, size); }
