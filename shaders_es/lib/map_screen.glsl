//@ names map_code map_in_stencil
// Visibility of the light at each pixel of the picture, computed on the CPU: R32UI with the bits of a float, as large as the picture.
#undef MAP_SAMPLER
#define MAP_SAMPLER usampler2D

const bool map_in_stencil = false;

// uv: unused, the pixel decides.
float map_code(MAP_SAMPLER map, vec2 uv) { return uintBitsToFloat(texelFetch(map, ivec2(gl_FragCoord.xy), 0).r); }
