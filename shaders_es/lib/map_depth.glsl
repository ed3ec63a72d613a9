//@ names map_lit map_lit_linear
// Depth texture behind a comparing sampler, LEQUAL. at: uv over the map (0..1) and depth (0..1), past the far end = the far end;
// 1 = lit. Outside the map its cleared rim is read: lit. A depth of fixed point clamps what it is compared with (OpenGL ES 3.0,
// "Texture Comparison Modes"), but some drivers keep 24 bits as floats and do not: then all past the far end were dark.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2DShadow

float map_lit(MAP_SAMPLER map, vec3 at, shadow_place s) { return texture(map, vec3(at.xy, min(at.z, 1.0))); }

// Weighs four texels: the sampler is LINEAR.
float map_lit_linear(MAP_SAMPLER map, vec3 at, shadow_place s) { return map_lit(map, at, s); }
