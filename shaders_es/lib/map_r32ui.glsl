//@ names map_encode map_code
// Integer texture with the bits of the distance as a float, metres: lossless.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER usampler2D
#define MAP_OUT uvec4

uvec4 map_encode(float code) { return uvec4(floatBitsToUint(code), 0u, 0u, 1u); }

float map_code(MAP_SAMPLER map, vec2 uv) { return uintBitsToFloat(texture(map, uv).r); }
