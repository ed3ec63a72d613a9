// Cone map (shadow/cone.glsl), first step: the nearest blocker in each block of two by two texels. map_code() comes from
// lib/map_*.glsl of the light's encoding, cone_store() from lib/cone_*.glsl.
#include "lib/pass.glsl"

uniform MAP_SAMPLER u_map_0;
layout(location = 0) out MOMENTS_OUT o_cone;

void main() {
    vec4 texel = u_pass[FILTER_SIZE];
    vec2 low = (2.0 * gl_FragCoord.xy - 0.5) * texel.zw, high = low + texel.zw; // centres of the block's corners
    float code = min(min(map_code(u_map_0, low), map_code(u_map_0, high)),
                     min(map_code(u_map_0, vec2(low.x, high.y)), map_code(u_map_0, vec2(high.x, low.y))));
    float depth = max(u_pass[FILTER_CONE].x * (code - 1.0), -CONE_FAR);
    o_cone = cone_store(code < 1.0 ? vec2(depth) : vec2(CONE_FAR, 0.0));
}
