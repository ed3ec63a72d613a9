//@ names shadow_visibility
// One comparison (Williams, "Casting Curved Shadows on Curved Surfaces", 1978).
float shadow_visibility(MAP_SAMPLER map, vec3 at, vec4 size) { return map_lit(map, at, size); }
