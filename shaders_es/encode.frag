// Encodes the linear picture as sRGB bytes, for GPUs without sRGB render targets.
#include "lib/srgb.glsl"

uniform highp sampler2D u_map_0;
layout(location = 0) out vec4 o_color;

void main() { o_color = vec4(srgb_from_linear(texelFetch(u_map_0, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }
