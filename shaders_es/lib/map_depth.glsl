//@ names map_lit map_lit_linear
// Depth texture with a comparison sampler, LEQUAL. at: uv over the map (0..1) and depth, clamped to the far end (1); 1 = lit.
// Outside of the map the cleared border texels are read: lit. Fixed-point depth formats clamp the reference value (OpenGL ES 3.0,
// "Texture Comparison Modes"), but some drivers store 24 bits as floats and do not: everything past the far end would be dark.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2DShadow

float map_lit(MAP_SAMPLER map, vec3 at, shadow_place s) { return texture(map, vec3(at.xy, min(at.z, 1.0))); }

// Filters four comparisons bilinearly: the sampler is LINEAR.
float map_lit_linear(MAP_SAMPLER map, vec3 at, shadow_place s) { return map_lit(map, at, s); }
