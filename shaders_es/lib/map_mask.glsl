//@ names map_encode map_code map_in_stencil map_is_mean
// Planar shadow mask: visibility of the light on the plane. R8, cleared to 1, LINEAR. All casters write 0, in any order.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2D
#define MAP_OUT vec4

const bool map_in_stencil = false;
const bool map_is_mean = false;

vec4 map_encode(float code) { return vec4(0.0); }

float map_code(MAP_SAMPLER map, vec2 uv) { return texture(map, uv).r; }
