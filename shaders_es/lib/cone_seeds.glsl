// Cone map (shadow/cone.glsl), first step where things move: as filter/cone_seeds.frag, of blocks of SIDE by SIDE texels. map_code()
// comes from lib/map_*.glsl of the light's encoding, cone_store() from lib/cone_*.glsl.
#include "lib/pass.glsl"

uniform MAP_SAMPLER u_map_0;
layout(location = 0) out MOMENTS_OUT o_cone;

void main() {
    vec4 texel = u_pass[FILTER_SIZE];
    vec2 at = (float(SIDE) * gl_FragCoord.xy - 0.5 * float(SIDE - 1)) * texel.zw; // centre of the block's lower left texel
    float code = 1.0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) code = min(code, map_code(u_map_0, at + vec2(x, y) * texel.zw));
    float depth = max(u_pass[FILTER_CONE].x * (code - 1.0), -CONE_FAR);
    o_cone = cone_store(code < 1.0 ? vec2(depth) : vec2(CONE_FAR, 0.0));
}
