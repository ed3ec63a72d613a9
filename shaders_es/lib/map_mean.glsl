//@ names map_encode map_code map_in_stencil map_is_mean
// Planar mask under a lamp of some size. R8, cleared to 1, LINEAR. Casters subtract the weight of a point of the lamp, each texel
// once per point. Visibility is code * PENUMBRA_SCALE + PENUMBRA_BIAS, which counts the points drawn so far.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2D
#define MAP_OUT vec4

const bool map_in_stencil = false;
const bool map_is_mean = true;

// Blended: one * texel - one * output. An alpha of 0 keeps all of the texel.
vec4 map_encode(float code) { return vec4(code, 0.0, 0.0, 0.0); }

float map_code(MAP_SAMPLER map, vec2 uv) { return texture(map, uv).r; }
