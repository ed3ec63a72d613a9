//@ names shadow_visibility
// PCF with taps on a Vogel disk of FILTER_RADIUS texels: radius by the square root, angle in steps of the golden angle (Vogel, "A Better
// Way to Construct the Sunflower Head", 1979). taps_lit() of lib/taps.glsl compares with map_code() of the light's
// encoding (lib/map_*.glsl); what stands before it: add_lookup() in src/gl/compose.c.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) { return taps_lit(map, s, FILTER_RADIUS, noise_turn()); }
