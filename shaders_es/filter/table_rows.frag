// Summed-area table, 1 of 5: prefix sums of each row within blocks of TABLE_BLOCK texels of the tile. map_code() comes from
// lib/map_*.glsl of the light's encoding, moments_of() from moments/ of its technique.
#include "lib/pass.glsl"

uniform MAP_SAMPLER u_map_0;
layout(location = 0) out MOMENTS_OUT o_moments;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), corner = ivec2(u_pass[FILTER_RECT].xy);
    vec2 texel = u_pass[FILTER_SIZE].zw;
    float reach = u_pass[FILTER_TABLE].x;
    vec2 code = u_pass[FILTER_CODE].xy;
    vec4 sum = vec4(0.0); // rounded once per sum: half of the error of summing rounded texels
    for (int x = at.x - (at.x - corner.x) % TABLE_BLOCK; x <= at.x; x++)
        sum += moments_of(clamp(code.y + code.x * map_code(u_map_0, (vec2(x, at.y) + 0.5) * texel), 0.0, 1.0));
    o_moments = table_fixed(sum, reach);
}
