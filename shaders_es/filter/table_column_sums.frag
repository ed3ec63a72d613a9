// Summed-area table, 4 of 5: as step 2 for columns, with x and y of the result swapped, so that both steps use the same narrow
// texture.
#include "lib/pass.glsl"

uniform MOMENTS_SAMPLER u_map_0;
layout(location = 0) out MOMENTS_OUT o_moments;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy) - ivec2(u_pass[FILTER_TABLE].y, 0), corner = ivec2(u_pass[FILTER_RECT].xy);
    uvec4 sum = uvec4(0u);
    for (int block = 1; block <= at.x; block++)
        sum += texelFetch(u_map_0, corner + ivec2(at.y, block * TABLE_BLOCK - 1), 0);
    o_moments = sum;
}
