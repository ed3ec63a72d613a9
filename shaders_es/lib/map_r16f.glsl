//@ names map_encode map_code map_lit map_lit_linear
// Half-float colour texture, NEAREST: centred distance -1 (near) .. 1 (far), or metres (r16f-raw). size.w: the far end.
#undef MAP_SAMPLER
#undef MAP_OUT
#define MAP_SAMPLER sampler2D
#define MAP_OUT vec4
#include "lib/compare.glsl"

vec4 map_encode(float code) { return vec4(code, 0.0, 0.0, 1.0); }

float map_code(MAP_SAMPLER map, vec2 uv) { return texture(map, uv).r; }

float map_lit(MAP_SAMPLER map, vec3 at, vec4 size) {
    return step(min(at.z, size.w), map_code(map, at.xy));
}

float map_lit_linear(MAP_SAMPLER map, vec3 at, vec4 size) {
    vec2 uv = compare_corner(at.xy, size);
    vec2 next = uv + size.z;
    vec4 codes = vec4(map_code(map, uv), map_code(map, vec2(next.x, uv.y)),
                      map_code(map, vec2(uv.x, next.y)), map_code(map, next));
    return compare_four(codes, at, size);
}
