//@ names map_code map_in_stencil map_is_mean
// No map: casters mark the stencil of the picture, and a pass draws only pixels with one stencil value. CODE_FAR_END of the pass
// is the visibility there.
#undef MAP_SAMPLER
#define MAP_SAMPLER sampler2D

const bool map_in_stencil = true;
const bool map_is_mean = false;

float map_code(MAP_SAMPLER map, vec2 uv) { return 1.0; }
