//@ names map_code
// Depth texture with a sampler without comparison, NEAREST: for techniques that need the depth of blockers.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2D

float map_code(MAP_SAMPLER map, vec2 uv) { return texture(map, uv).r; }
