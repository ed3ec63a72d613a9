// Box blur, 2 of 2: averages moments along a column, within the tile.
#include "lib/pass.glsl"

uniform MOMENTS_SAMPLER u_map_0;
layout(location = 0) out MOMENTS_OUT o_moments;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), ends = ivec2(u_pass[FILTER_RECT].yw);
    vec4 blur = u_pass[FILTER_BLUR];
    int most = int(blur.y);
    MOMENTS sum = MOMENTS(0.0);
    for (int i = -most; i <= most; i++)
        sum += moments_fetch(u_map_0, ivec2(at.x, clamp(at.y + i, ends.x, ends.y))) * min(blur.x + 0.5 - abs(float(i)), 1.0);
    o_moments = moments_store(sum * blur.z);
}
