//@ names map_code
// Depth texture behind a sampler that does not compare, NEAREST: for techniques that need the distance of blockers.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2D

float map_code(MAP_SAMPLER map, vec2 uv) { return texture(map, uv).r; }
