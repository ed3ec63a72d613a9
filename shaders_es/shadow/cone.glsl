//@ names shadow_visibility cone_ring cone_aslant CONE_SPREAD CONE_MEAN
// Soft shadows by a cone map. A blocker darkens a receiver only if it lies in the cone from the receiver to the lamp. Turned round:
// behind each blocker grows a cone, by `k` texels of radius per unit of depth code, which is one constant for a map of depths, as a
// penumbra's width is linear in them for suns, spots and tiles of point lights alike. The cone map has, for each place of the map,
// x: where the first cone begins there, y: the depth of its blocker; both as k (code - 1): texels. In front of x all is lit. Behind
// it the distance from y is the penumbra's radius, over which taps compare (percentage-closer filtering).
// Made by filter/cone_*.frag when the map was drawn. cone_at(), cone_depth(): lib/cone_*.glsl.
// Where the first blocker changes from place to place, y jumps, and x does not. So y is a mean over a width that grows with the
// distance behind x: no edge is seen there.
// At the rim of the first cone all is still lit: `inside` radii behind x a straight edge hides about inside^2 of the lamp. What taps
// find beyond that is of blockers in whose cones the place is not, unless the inner ring finds them, too: feet stay dark.
// The four pixels of a quad have turns and radii of their own, and take the mean: four times the taps. What differs by more than
// CONE_MEAN may be an edge, and stays.
// A surface nearly edge-on to the light sees only the part of the lamp above its own horizon, which taps measure badly.
// Each tap is compared with the receiver's plane. Four taps are a ring, a quarter turn apart. RINGS, SHADOW_TAPS: a point of each ring,
// from src/shadow/taps.c, where the first lies on the x axis, and others so that they share products.
#include "lib/noise.glsl"

const float CONE_SPREAD = 0.09; // of the radii of a quad
const float CONE_MEAN = 0.125;

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
    vec2 cone = cone_at(cones, s.at.xy), pixel = dFdx(s.at.xy) * s.size.xy;
    // Of shadow_mixed(), which takes means itself, all pixels are alike.
    vec2 pair = s.beside == vec2(0.0) ? fract(0.5 * gl_FragCoord.xy) : vec2(0.5);
    float inside = depth - cone.x, seen = 1.0, most = 0.0;
    if (inside > 0.0) {
        float radius = clamp(depth - cone_depth(cones, s.at.xy, cone, inside), 1.0, s.widest);
        // A quarter of a ring's quarter turn from pixel to pixel: tangents of half the angle.
        float u = 0.2446 * (noise_quad(pair) + dot(pair, vec2(2.0, 4.0)) - 1.5), w = 1.0 / (1.0 + u * u);
        vec2 turn = vec2(w - u * u * w, 2.0 * u * w);
        float wide = clamp(0.125 * radius * inversesqrt(dot(pixel, pixel)) - 1.0, 0.0, 1.0);
        vec2 scale = radius * (1.0 + wide * CONE_SPREAD * (dot(pair, vec2(4.0, 2.0)) - 3.0)) * s.size.zw;
        vec2 right = cone_aslant(turn, s) * scale, up = cone_aslant(vec2(-turn.y, turn.x), s) * scale;
        // The reference value must not pass the far end (lib/map_depth.glsl): one limit for all taps. A receiver behind the far end
        // is not in the map, and needs no plane.
        vec2 slope = s.at.z < 1.0 ? s.slope : vec2(0.0);
        vec3 x = vec3(right, dot(slope, right)), y = vec3(up, dot(slope, up));
        vec3 at = vec3(s.at.xy, min(s.at.z, 1.0 - abs(x.z) - abs(y.z)));
        float lit = cone_ring(map, at, x * SHADOW_TAPS[0].x, y * SHADOW_TAPS[0].x);
        float rim = max(min(inside / radius, 1.0), 1.0 - 0.25 * lit), least = 1.0 - rim;
        if (RINGS == 4) { // two that mirror each other
            vec3 xx = x * SHADOW_TAPS[1].x, xy = x * SHADOW_TAPS[1].y, yx = y * SHADOW_TAPS[1].x, yy = y * SHADOW_TAPS[1].y;
            lit += cone_ring(map, at, xx + yy, yx - xy) + cone_ring(map, at, xx - yy, yx + xy);
        } else {
            lit += cone_ring(map, at, (x + y) * SHADOW_TAPS[1].x, (y - x) * SHADOW_TAPS[1].x);
        }
        if (RINGS >= 3) lit += cone_ring(map, at, x * SHADOW_TAPS[RINGS - 1].x, y * SHADOW_TAPS[RINGS - 1].x);
        seen = max(lit * (0.25 / float(RINGS)), least);
        most = CONE_MEAN * wide;
    }
    // The mean of the quad: derivatives are differences to the other column, and to the other row.
    vec2 other = 1.0 - 2.0 * pair;
    float across = other.x * dFdx(seen), by = across + other.y * dFdy(seen + across);
    return min(seen + clamp(by, -most, most), s.horizon);
}
