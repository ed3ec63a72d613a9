//@ names shadow_visibility
// Soft shadows by a cone map. A blocker darkens a receiver only if it lies in the cone from the receiver to the lamp. Turned round:
// behind each blocker grows a cone, by `k` texels of radius per unit of depth code, which is one constant for a map of depths, as a
// penumbra's width is linear in them for suns, spots and tiles of point lights alike. The cone map has, for each place of the map,
// x: where the first cone begins there, y: the depth of its blocker; both as k (code - 1): texels. In front of x all is lit. Behind
// it the distance from y is the penumbra's radius, over which taps compare (percentage-closer filtering).
// Made by filter/cone_*.frag when the map was drawn. cone_at(): lib/cone_*.glsl.
// Each tap is compared with the receiver's plane. Four taps are a ring, a quarter turn apart: RINGS, TAPS_RINGS of compose.c.
#include "lib/noise.glsl"

float shadow_visibility(MAP_SAMPLER map, MOMENTS_SAMPLER cones, shadow_place s) {
    float k = s.penumbra.PENUMBRA_RADIUS * s.penumbra.PENUMBRA_SCALE;
    float depth = k * s.at.z - k;
    vec2 cone = cone_at(cones, s.at.xy, s.size);
    if (depth < cone.x) return 1.0;
    float radius = clamp(depth - cone.y, 1.0, s.widest);
    vec2 turn = noise_quarter(), scale = radius * s.size.zw;
    vec2 right = turn * scale, up = vec2(-turn.y, turn.x) * scale;
    vec3 x = vec3(right, dot(s.slope, right)), y = vec3(up, dot(s.slope, up));
    // The reference value must not pass the far end (lib/map_depth.glsl): one limit for all taps. Behind the far end, where the
    // receiver is not in the map, its plane is as steep as seen from there.
    if (s.at.z > 1.0) x.z *= -cone.y / radius, y.z *= -cone.y / radius;
    vec3 at = vec3(s.at.xy, min(s.at.z, 1.0 - abs(x.z) - abs(y.z)));
    float lit = 0.0;
    for (int i = 0; i < RINGS; i++) {
        vec3 a = x * TAPS_RINGS[i].x + y * TAPS_RINGS[i].y, b = y * TAPS_RINGS[i].x - x * TAPS_RINGS[i].y;
        lit += texture(map, at + a) + texture(map, at - a) + texture(map, at + b) + texture(map, at - b);
    }
    return lit * (0.25 / float(RINGS));
}
