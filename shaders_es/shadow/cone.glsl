//@ names shadow_visibility cone_ring cone_aslant
// Soft shadows by a cone map. A blocker darkens a receiver only if it lies in the cone from the receiver to the lamp. Turned round:
// behind each blocker grows a cone, by `k` texels of radius per unit of depth code, which is one constant for a map of depths, as a
// penumbra's width is linear in them for suns, spots and tiles of point lights alike. The cone map has, for each place of the map,
// x: where the first cone begins there, y: the depth of its blocker; both as k (code - 1): texels. In front of x all is lit. Behind
// it the distance from y is the penumbra's radius, over which taps compare (percentage-closer filtering).
// Made by filter/cone_*.frag when the map was drawn. cone_at(): lib/cone_*.glsl.
// A surface nearly edge-on to the light sees only the part of the lamp above its own horizon, which taps measure badly.
// Each tap is compared with the receiver's plane. Four taps are a ring, a quarter turn apart. RINGS, SHADOW_TAPS: a point of each ring,
// from src/shadow/taps.c, where the first lies on the x axis, and others so that they share products.
#include "lib/noise.glsl"

// a, b: from `at` to a tap, and to the one a quarter turn on.
float cone_ring(MAP_SAMPLER map, vec3 at, vec3 a, vec3 b) {
    return texture(map, at + a) + texture(map, at - a) + texture(map, at + b) + texture(map, at - b);
}

// A lamp is a disk that faces the receiver. Off the axis of a map of tangents its penumbra is an ellipse there, longer by distance /
// depth along the direction to the axis: up to 1.4 at the edges of a point light's tiles.
vec2 cone_aslant(vec2 v, shadow_place s) { return v + s.aslant * dot(s.tangent, v); }

float shadow_visibility(MAP_SAMPLER map, MOMENTS_SAMPLER cones, shadow_place s) {
    float k = s.penumbra.PENUMBRA_RADIUS * s.penumbra.PENUMBRA_SCALE;
    float depth = k * s.at.z - k;
    vec2 cone = cone_at(cones, s.at.xy, s.size);
    if (depth < cone.x) return s.horizon;
    float radius = clamp(depth - cone.y, 1.0, s.widest);
    vec2 turn = noise_quarter(), scale = radius * s.size.zw;
    vec2 right = cone_aslant(turn, s) * scale, up = cone_aslant(vec2(-turn.y, turn.x), s) * scale;
    // The reference value must not pass the far end (lib/map_depth.glsl): one limit for all taps. A receiver behind the far end is
    // not in the map, and needs no plane.
    vec2 slope = s.at.z < 1.0 ? s.slope : vec2(0.0);
    vec3 x = vec3(right, dot(slope, right)), y = vec3(up, dot(slope, up));
    vec3 at = vec3(s.at.xy, min(s.at.z, 1.0 - abs(x.z) - abs(y.z)));
    float lit = cone_ring(map, at, x * SHADOW_TAPS[0].x, y * SHADOW_TAPS[0].x);
    if (RINGS == 4) { // two that mirror each other
        vec3 xx = x * SHADOW_TAPS[1].x, xy = x * SHADOW_TAPS[1].y, yx = y * SHADOW_TAPS[1].x, yy = y * SHADOW_TAPS[1].y;
        lit += cone_ring(map, at, xx + yy, yx - xy) + cone_ring(map, at, xx - yy, yx + xy);
    } else {
        lit += cone_ring(map, at, (x + y) * SHADOW_TAPS[1].x, (y - x) * SHADOW_TAPS[1].x);
    }
    if (RINGS >= 3) lit += cone_ring(map, at, x * SHADOW_TAPS[RINGS - 1].x, y * SHADOW_TAPS[RINGS - 1].x);
    return min(lit * (0.25 / float(RINGS)), s.horizon);
}
