//@ names map_lit map_lit_linear
// Comparison in the shader, for maps without a comparison sampler. map_code() comes from lib/map_*.glsl of the light's encoding.
// at: uv over the map and code, clamped to the far end; 1 = lit.
#include "lib/compare.glsl"

float map_lit(MAP_SAMPLER map, vec3 at, shadow_place s) { return step(min(at.z, s.far), map_code(map, at.xy)); }

// Compares the four texels around the point, then filters bilinearly.
float map_lit_linear(MAP_SAMPLER map, vec3 at, shadow_place s) {
    vec2 uv = compare_corner(at.xy, s.size);
    vec2 next = uv + s.size.zw;
    vec4 codes = vec4(map_code(map, uv), map_code(map, vec2(next.x, uv.y)),
                      map_code(map, vec2(uv.x, next.y)), map_code(map, next));
    return compare_four(codes, min(at.z, s.far), at.xy, s.size);
}
