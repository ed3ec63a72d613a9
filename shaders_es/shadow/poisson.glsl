//@ names shadow_visibility
// Taps over a disk of three texels, none too close to another (Bridson, "Fast Poisson Disk Sampling in Arbitrary Dimensions", 2007).
float shadow_visibility(MAP_SAMPLER map, shadow_place s) { return taps_lit(map, s, 3.0, noise_turn()); }
