//@ names shadow_visibility
// One depth comparison (Williams, "Casting Curved Shadows on Curved Surfaces", 1978).
float shadow_visibility(MAP_SAMPLER map, shadow_place s) { return map_lit(map, s.at, s); }
