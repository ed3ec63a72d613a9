//@ names moments_store moments_fetch moments_at moments_step moments_exponents
// Four moments of casters, and the fraction of texels covered by casters (share). The share has 12 bits: the last three of each
// of the four floats. These are means over casters only; as MOMENTS they are multiplied by the share, so that they can be added:
// the columns are the share (twice), two moments, two moments.
#undef MOMENTS
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS mat3x2
#define MOMENTS_SAMPLER usampler2D
#define MOMENTS_OUT uvec4

const float moments_step = 1.0 / 1048576.0;
const vec2 moments_exponents = vec2(40.0, 5.0);

uvec4 moments_store(mat3x2 m) {
    float share = m[0].x;
    uint step = uint(clamp(share, 0.0, 1.0) * 4095.0 + 0.5);
    if (step == 0u) return uvec4(0u);
    uvec4 bits = floatBitsToUint(vec4(m[1], m[2]) * (1.0 / share)) + 4u;
    return (bits & ~7u) | (uvec4(step) >> uvec4(0u, 3u, 6u, 9u) & 7u);
}

mat3x2 moments_fetch(MOMENTS_SAMPLER map, ivec2 texel) {
    uvec4 bits = texelFetch(map, texel, 0), part = (bits & 7u) << uvec4(0u, 3u, 6u, 9u);
    vec4 m = uintBitsToFloat(bits & ~7u);
    return mat3x2(vec2(1.0), m.xy, m.zw) * (float(part.x | part.y | part.z | part.w) * (1.0 / 4095.0));
}

// Bilinear lookup at uv (0..1 over the map), clamped to the edge. size: as in shadow_place.
mat3x2 moments_at(MOMENTS_SAMPLER map, vec2 uv, vec4 size) {
    vec2 p = uv * size.xy - 0.5;
    ivec2 last = ivec2(size.xy) - 1;
    ivec2 a = clamp(ivec2(floor(p)), ivec2(0), last), b = min(a + 1, last);
    vec2 w = fract(p), v = 1.0 - w;
    return (moments_fetch(map, a) * v.x + moments_fetch(map, ivec2(b.x, a.y)) * w.x) * v.y +
           (moments_fetch(map, ivec2(a.x, b.y)) * v.x + moments_fetch(map, b) * w.x) * w.y;
}
