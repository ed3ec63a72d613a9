//@ names map_lit map_lit_linear
// Comparing by hand, for maps that no sampler compares; map_code() is the encoding's. at: uv over the map and code; past the far end
// = the far end; 1 = lit.
#include "lib/compare.glsl"

float map_lit(MAP_SAMPLER map, vec3 at, shadow_place s) { return step(min(at.z, s.far), map_code(map, at.xy)); }

// Compares the four texels round the point, then weighs them bilinearly.
float map_lit_linear(MAP_SAMPLER map, vec3 at, shadow_place s) {
    vec2 uv = compare_corner(at.xy, s.size);
    vec2 next = uv + s.size.zw;
    vec4 codes = vec4(map_code(map, uv), map_code(map, vec2(next.x, uv.y)),
                      map_code(map, vec2(uv.x, next.y)), map_code(map, next));
    return compare_four(codes, min(at.z, s.far), at.xy, s.size);
}
