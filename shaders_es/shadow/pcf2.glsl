//@ names shadow_visibility
// PCF with one bilinear tap, by the sampler where the map is a depth texture: four texels around the point.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) { return map_lit_linear(map, s.at, s); }
