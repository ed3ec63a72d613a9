//@ names shadow_visibility
// Share of the light that the surface in this pixel sees, by rays (src/truth): lib/map_screen.glsl. A transparent surface before it
// gets the same.
float shadow_visibility(MAP_SAMPLER map, shadow_place s) { return map_code(map, s.at.xy); }
