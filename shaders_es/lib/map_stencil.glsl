//@ names map_code map_in_stencil
// No map: casters marked the picture's stencil, and a pass draws only what is marked alike. Its far end says how much light
// arrives there.
#undef MAP_SAMPLER
#define MAP_SAMPLER sampler2D

const bool map_in_stencil = true;

float map_code(MAP_SAMPLER map, vec2 uv) { return 1.0; }
