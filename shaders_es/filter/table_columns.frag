// Summed-area table, 3 of 5: adds to each row sum the sum of the blocks before it, then sums columns within blocks.
#include "lib/pass.glsl"

uniform MOMENTS_SAMPLER u_map_0; // step 1: row sums within blocks
uniform MOMENTS_SAMPLER u_map_1; // step 2: sums of the preceding blocks
layout(location = 0) out MOMENTS_OUT o_moments;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), corner = ivec2(u_pass[FILTER_RECT].xy);
    int block = int(u_pass[FILTER_TABLE].y) + (at.x - corner.x) / TABLE_BLOCK;
    uvec4 sum = uvec4(0u);
    for (int y = at.y - (at.y - corner.y) % TABLE_BLOCK; y <= at.y; y++)
        sum += texelFetch(u_map_0, ivec2(at.x, y), 0) + texelFetch(u_map_1, ivec2(block, y - corner.y), 0);
    o_moments = sum;
}
