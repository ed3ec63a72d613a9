// Summed-area table, 5 of 5: adds to each texel the sum of the blocks before it in its column.
#include "lib/pass.glsl"

uniform MOMENTS_SAMPLER u_map_0; // step 3: column sums within blocks
uniform MOMENTS_SAMPLER u_map_1; // step 4: sums of the preceding blocks
layout(location = 0) out MOMENTS_OUT o_moments;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), corner = ivec2(u_pass[FILTER_RECT].xy);
    int block = int(u_pass[FILTER_TABLE].y) + (at.y - corner.y) / TABLE_BLOCK;
    o_moments = texelFetch(u_map_0, at, 0) + texelFetch(u_map_1, ivec2(block, at.x - corner.x), 0);
}
