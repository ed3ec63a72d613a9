//@ names shadow_visibility
// Taps evenly spread over a disk of three texels: radius by the square root, turned by the golden angle.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) { return taps_lit(map, s, 3.0, noise_turn()); }
