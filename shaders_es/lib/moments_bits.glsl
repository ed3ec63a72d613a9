//@ names moments_store moments_fetch moments_at moments_step
// Moments as the bits of 32-bit floats: every ES 3.0 GPU renders to integer formats, and few filter 32-bit floats in a sampler.
#undef MOMENTS
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS vec4
#define MOMENTS_SAMPLER usampler2D
#define MOMENTS_OUT uvec4

const float moments_step = 1.0 / 8388608.0;

uvec4 moments_store(vec4 m) { return floatBitsToUint(m); }

vec4 moments_fetch(MOMENTS_SAMPLER map, ivec2 texel) { return uintBitsToFloat(texelFetch(map, texel, 0)); }

// Bilinear lookup at uv (0..1 over the map), clamped to the edge. size: as in shadow_place.
vec4 moments_at(MOMENTS_SAMPLER map, vec2 uv, vec4 size) {
    vec2 p = uv * size.xy - 0.5;
    ivec2 last = ivec2(size.xy) - 1;
    ivec2 a = clamp(ivec2(floor(p)), ivec2(0), last), b = min(a + 1, last);
    vec2 w = fract(p);
    return mix(mix(moments_fetch(map, a), moments_fetch(map, ivec2(b.x, a.y)), w.x),
               mix(moments_fetch(map, ivec2(a.x, b.y)), moments_fetch(map, b), w.x), w.y);
}
