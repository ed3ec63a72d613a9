//@ names shadow_visibility
// PCF with taps on a Poisson disk of FILTER_RADIUS texels (Bridson, "Fast Poisson Disk Sampling in Arbitrary Dimensions", 2007), by
// taps_lit() of lib/taps.glsl.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) { return taps_lit(map, s, FILTER_RADIUS, noise_turn()); }
