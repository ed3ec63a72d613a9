// Cone map (shadow/cone.glsl), a flooding step: of this texel and its eight neighbours at a distance, the cone that begins first
// here. Steps of halving distances let each blocker reach all texels (jump flooding: Rong, Tan, "Jump Flooding in GPU with
// Applications to Voronoi Diagram and Distance Transform", I3D 2006).
#include "lib/pass.glsl"

uniform MOMENTS_SAMPLER u_map_0;
layout(location = 0) out MOMENTS_OUT o_cone;

// A path of straight and diagonal steps is up to 8 % longer than the distance.
const float CONE_DETOUR = 0.96;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), low = ivec2(u_pass[FILTER_RECT].xy), high = ivec2(u_pass[FILTER_RECT].zw);
    int far = int(u_pass[FILTER_CONE].y);
    float texels = CONE_DETOUR * u_pass[FILTER_CONE].z;
    vec2 best = cone_fetch(u_map_0, at);
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            vec2 cone = cone_fetch(u_map_0, clamp(at + far * ivec2(x, y), low, high)); // beyond the tile: nearer, but not for less
            cone.x += texels * length(vec2(x, y));
            if (cone.x < best.x) best = cone;
        }
    o_cone = cone_store(vec2(min(best.x, CONE_FAR), best.y));
}
