// Cone map (shadow/cone.glsl), second step: beside an edge the cones of the nearer surface begin a texel of the cone map earlier, so
// that a filter of the least width is not cut. Where a surface goes on at the same slope there is no edge: lit surfaces would pay
// for nothing.
#include "lib/pass.glsl"

uniform MOMENTS_SAMPLER u_map_0;
layout(location = 0) out MOMENTS_OUT o_cone;

const float CONE_ROUNDING = 1.0 / 512.0; // twice that of a half float

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), low = ivec2(u_pass[FILTER_RECT].xy), high = ivec2(u_pass[FILTER_RECT].zw);
    vec2 own = cone_fetch(u_map_0, at), best = own;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            vec2 near = cone_fetch(u_map_0, clamp(at + ivec2(x, y), low, high));
            vec2 opposite = cone_fetch(u_map_0, clamp(at - ivec2(x, y), low, high));
            float slope = opposite.x < CONE_FAR ? max(opposite.y - own.y, 0.0) : 0.0;
            bool edge = own.x >= CONE_FAR || near.y < own.y - 1.5 * slope + CONE_ROUNDING * own.y;
            if (edge && near.x < best.x) best = near;
        }
    o_cone = cone_store(best);
}
