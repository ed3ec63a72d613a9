//@ names moments_store moments_fetch moments_at moments_step
// Three moments in 0..1 (x, y and w) of 21 bits each in two 32-bit integers, w split over the upper 11 bits of both. Filtered in
// the shader.
#undef MOMENTS
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS vec4
#define MOMENTS_SAMPLER usampler2D
#define MOMENTS_OUT uvec4

const float moments_step = 1.0 / 2097151.0;

uvec4 moments_store(vec4 m) {
    uvec3 third = uvec3(clamp(m.xyw, 0.0, 1.0) * 2097151.0 + 0.5);
    return uvec4(third.x | third.z << 21, third.y | third.z >> 11 << 21, 0u, 1u);
}

vec4 moments_fetch(MOMENTS_SAMPLER map, ivec2 texel) {
    uvec2 t = texelFetch(map, texel, 0).xy, rest = t >> 21;
    return vec4(t & 0x1fffffu, 0u, rest.x | rest.y << 11) * (1.0 / 2097151.0);
}

// Bilinear lookup at uv (0..1 over the map), clamped to the edge. size: as in shadow_place.
vec4 moments_at(MOMENTS_SAMPLER map, vec2 uv, vec4 size) {
    vec2 p = uv * size.xy - 0.5;
    ivec2 last = ivec2(size.xy) - 1;
    ivec2 a = clamp(ivec2(floor(p)), ivec2(0), last), b = min(a + 1, last);
    vec2 w = fract(p);
    return mix(mix(moments_fetch(map, a), moments_fetch(map, ivec2(b.x, a.y)), w.x),
               mix(moments_fetch(map, ivec2(a.x, b.y)), moments_fetch(map, b), w.x), w.y);
}
