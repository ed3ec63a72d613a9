//@ names map_encode map_code
// Distance 0 (near) .. 1 (far) in four bytes, most significant first. Each channel is rounded before decoding: V3D returns RGBA8
// as half floats, which would leave 11 bits of the distance. The far end is slightly under 1.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2D
#define MAP_OUT vec4

#ifndef MAP_BYTES
#define MAP_BYTES (vec4(1.0 / 256.0, 1.0 / 65536.0, 1.0 / 16777216.0, 1.0 / 4294967296.0))
#endif

vec4 map_encode(float code) {
    vec4 b = fract(clamp(code, 0.0, 0.999999) * vec4(1.0, 256.0, 65536.0, 16777216.0));
    return floor(b * 256.0) / 255.0;
}

float map_code(MAP_SAMPLER map, vec2 uv) { return dot(floor(texture(map, uv) * 255.0 + 0.5), MAP_BYTES); }
