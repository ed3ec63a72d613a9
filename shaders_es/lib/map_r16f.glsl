//@ names map_encode map_code
// Half-float colour texture, NEAREST: centred distance, -1 (near) .. 1 (far), or metres (r16f-raw).
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2D
#define MAP_OUT vec4

vec4 map_encode(float code) { return vec4(code, 0.0, 0.0, 1.0); }

float map_code(MAP_SAMPLER map, vec2 uv) { return texture(map, uv).r; }
