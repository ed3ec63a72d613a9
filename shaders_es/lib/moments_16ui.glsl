//@ names moments_store moments_fetch moments_at moments_step
// Moments in 0..1 as 16-bit integers, filtered in the shader.
#undef MOMENTS
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS vec4
#define MOMENTS_SAMPLER usampler2D
#define MOMENTS_OUT uvec4

const float moments_step = 1.0 / 65535.0;

uvec4 moments_store(vec4 m) { return uvec4(clamp(m, 0.0, 1.0) * 65535.0 + 0.5); }

vec4 moments_fetch(MOMENTS_SAMPLER map, ivec2 texel) { return vec4(texelFetch(map, texel, 0)) * (1.0 / 65535.0); }

// Bilinear lookup at uv (0..1 over the map), clamped to the edge. size: as in shadow_place.
vec4 moments_at(MOMENTS_SAMPLER map, vec2 uv, vec4 size) {
    vec2 p = uv * size.xy - 0.5;
    ivec2 last = ivec2(size.xy) - 1;
    ivec2 a = clamp(ivec2(floor(p)), ivec2(0), last), b = min(a + 1, last);
    vec2 w = fract(p);
    return mix(mix(moments_fetch(map, a), moments_fetch(map, ivec2(b.x, a.y)), w.x),
               mix(moments_fetch(map, ivec2(a.x, b.y)), moments_fetch(map, b), w.x), w.y);
}
