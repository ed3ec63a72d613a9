// One picture among others: to the mean of them with its weight, or that mean over the technique's picture while nothing moves.
// Means of parts are cut where a screen cuts them: at the edge of what is brighter the pictures of a pixel's parts differ.
#include "lib/pass.glsl"
#include "lib/srgb.glsl"

uniform highp sampler2D u_map_0;
layout(location = 0) out vec4 o_color;

void main() {
    vec3 color = texelFetch(u_map_0, ivec2(gl_FragCoord.xy), 0).rgb;
    color = min(color, u_pass[MEAN_SHARE].y);
    if (ENCODE_SRGB) color = srgb_from_linear(color);
    float share = u_pass[MEAN_SHARE].x;
    o_color = vec4(color * share, ADDITIVE ? 0.0 : share);
}
