// Lookup of a shadow: position in the map and parameters for the techniques. Compilers remove what a technique does not use.
#include "lib/flat_constants.glsl"
#include "lib/light.glsl"
#include "lib/shadow_point.glsl"

#ifdef WITH_SPREAD
in float v_spread; // normal_spread() of lib/vertex.glsl
#else
const float v_spread = 0.0;
#endif

struct shadow_place {
    vec3 at;    // uv over the map (0..1) and code of the receiver, after the bias (shadow_push())
    vec4 size;  // xy: width and height of the map in texels; zw: their inverse
    float far;  // code of the far end: the clear value of the map
    vec2 slope; // gradient of the code on the receiver's plane, per uv
    // Width of penumbrae: the PENUMBRA_.. of SHADOW_PENUMBRA, for this fragment. Penumbra depth grows with the distance from the
    // light: scale * code + bias, or the negative inverse of that. A blocker at penumbra depth b casts on a receiver at r a
    // penumbra of radius * (r - b) texels; no blocker is nearer than `nearest`. For a directional light, penumbra depth is linear
    // in the distance; for a spot or point light, whose map is in tangents, in -1 / distance.
    vec4 penumbra;
    bool inverse; // penumbra depth is the negative inverse
    float reach;  // largest offset from `at` that a technique may read, texels: SAT, and any technique with tiles
    float widest; // largest radius of a filter, texels
    float filter_radius; // the one that is set, texels
    vec2 tangent, aslant; // point: of the angle to the axis of the tile, along u and v; that / (1 + distance / depth)
    float horizon; // share of the lamp that is above the receiver's own horizon, 0..1
    vec4 window;  // lower left and upper right edge of the tile, texels: the limit of reads
    vec2 beside;  // as in shadow_tile and shadow_cascade
};

// True outside of the map, where all is lit: the border texels of a filtered map need not be.
bool shadow_outside(shadow_place s) { return any(greaterThan(abs(s.at.xy - 0.5), vec2(0.5))); }

// Largest difference between the mean code of the receiver's plane over a square and the receiver's own code. If the receiver is
// a caster, ends within the square at a straight edge and covers the fraction `share` of it, then the centroid of that part is at
// most radius (1 - share) from the centre of the square. radius: half of the square's side, texels.
float shadow_cut(shadow_place s, float radius, float share) { return dot(abs(s.slope), s.size.zw) * radius * max(1.0 - share, 0.0); }

// Visibility lit * scale without the outermost 2 % of the filter's weight at both ends: texels as far away as those are behind the
// plane of a lit surface in spite of the bias (bias_texels in src/shadow/technique.h).
float shadow_trimmed(float lit, float scale) { return clamp(lit * (1.04 * scale) - 0.02, 0.0, 1.0); }

float shadow_penumbra_depth(shadow_place s, float code) {
    float x = s.penumbra.PENUMBRA_SCALE * code + s.penumbra.PENUMBRA_BIAS;
    return s.inverse ? -1.0 / x : x;
}

// Gradient of the code per uv on the plane with normal n; u, v, code: their gradients in world space. Solves
// gradient(code) = slope.x grad(u) + slope.y grad(v) + c n. The slope is infinite on a plane edge-on to the light, so n is tilted
// towards the light until |dot(n, l)| is 0.1.
vec2 shadow_slope(vec3 u, vec3 v, vec3 code, vec3 n, vec3 l) {
    float c = dot(n, l);
    n += l * (c < 0.0 ? min(-0.1 - c, 0.0) : max(0.1 - c, 0.0));
    return vec2(dot(cross(code, v), n), dot(cross(u, code), n)) / dot(cross(u, v), n);
}

// What the normal of a plane has along u and v, times the factors of SHADOW_SLOPE.
vec2 shadow_across(const int slot, vec3 n) {
    return vec2(dot(SHADOW(slot, SHADOW_SLOPE).xyz, n), dot(SHADOW(slot, SHADOW_SLOPE + 1).xyz, n));
}

// height, of either sign, but not nearer to 0 than `least`. SHADOW_BACKS: surfaces that are turned away from the light matter.
float shadow_height(float height, float least) { return SHADOW_BACKS && height < 0.0 ? min(height, -least) : max(height, least); }

// The same for a directional light, whose u, v and code are at right angles.
vec2 shadow_slope_directional(const int slot, vec3 n, vec3 l) { return shadow_across(slot, n) / shadow_height(dot(n, l), 0.1); }

// A map of depths seen from a point: the inverse of the depth, and the code with it, is linear in u and v on a plane. across: of the
// normal, what points along u and v, times its factors; height: of the light over the plane; depth: of the receiver, metres. The
// slope is infinite on a plane through the light: its height is at least a tenth of the depth.
vec2 shadow_slope_deep(vec2 across, float height, float depth) {
    return across / shadow_height(height, 0.1 * depth);
}

// Share of a lamp's disk above the horizon of a surface. height: of its middle, radii of the lamp times HORIZON_SLOPE.
float shadow_horizon(float height) { return clamp((SHADOW_BACKS ? abs(height) : height) + 0.5, 0.0, 1.0); }

// Spot: projective map, at a depth. Of distances: the gradient of x / w is (grad x - (x / w) grad w) / w.
vec2 shadow_slope_spot(const int slot, const bool radial, vec3 at, float depth, vec3 n, float height, vec3 l) {
    if (!radial) return shadow_slope_deep(shadow_across(slot, n), height, depth);
    mat4 m = shadow_matrix(slot);
    vec3 x = vec3(m[0].x, m[1].x, m[2].x), y = vec3(m[0].y, m[1].y, m[2].y), axis = vec3(m[0].w, m[1].w, m[2].w);
    vec3 u = (x - at.x * axis) / depth, v = (y - at.y * axis) / depth;
    return shadow_slope(u, v, -l * SHADOW(slot, SHADOW_PLACE).PLACE_CODE_SCALE, n, l);
}

#include "lib/shadow_tile.glsl"
#include "lib/shadow_cascade.glsl"

// p, n: position and normal of the surface, world space; face: normal of the triangle; from_vertex: v_shadow[slot], used where
// SHADOW_LINEAR[slot] or SHADOW_PROJECTED[slot]; radial: the map holds distances, not depths. SHADOW_SMOOTH[slot]: the receiver's
// plane is that of the surface's normal, which costs no derivatives. SHADOW_LINEAR, _PROJECTED, _CASCADES, _SHARED, _SMOOTH
// and _SPANS (cascades of filtered maps): add_light_flags() of src/gl/compose.c.
shadow_place shadow_place_of(const int slot, const int type, const bool radial, vec3 from_vertex, vec3 p, vec3 n, vec3 face,
                             light_sample light) {
    shadow_place s;
    vec3 plane = SHADOW_SMOOTH[slot] ? n : face, l = light.to_light;
    // of a light with a place over the surface, and over the plane
    float c = dot(n, l), height = SHADOW_SMOOTH[slot] ? c * light.distance_m : dot(plane, LIGHT(slot, LIGHT_PLACE).xyz - p);
    float spread = SHADOW_SPREAD[slot] ? v_spread : 0.0;
    s.size = SHADOW(slot, SHADOW_MAP_SIZE);
    s.far = SHADOW(slot, SHADOW_CODE).CODE_FAR_END;
    s.penumbra = SHADOW(slot, SHADOW_PENUMBRA);
    s.inverse = type != LIGHT_DIRECTIONAL && radial;
    s.reach = SHADOW(slot, SHADOW_CODE).CODE_REACH;
    s.widest = CONE_WIDEST;
    s.filter_radius = SHADOW(slot, SHADOW_SLOPE).SLOPE_FILTER;
    float over = type == LIGHT_DIRECTIONAL ? c : c * light.distance_m;
    s.horizon = shadow_horizon(over * SHADOW(slot, SHADOW_SLOPE + 1).SLOPE_HORIZON);
    s.window = vec4(0.0, 0.0, s.size.xy);
    s.tangent = s.aslant = s.beside = vec2(0.0);
    if (SHADOW_LINEAR[slot]) {
        s.at = from_vertex;
        s.slope = shadow_slope_directional(slot, plane, l);
    } else if (SHADOW_CASCADES[slot]) {
        shadow_cascade c = shadow_cascade_of(slot, SHADOW_SHARED[slot]);
        s.beside = c.beside;
        s.at = shadow_cascade_at(slot, c, p, n, l, spread);
        s.slope = shadow_cascade_slope(slot, c, plane, l);
        s.penumbra.PENUMBRA_RADIUS /= c.texel;
        // Limits penumbrae to the reach of a tile and, in proportion to the view depth, to PENUMBRA_GROWTH: one
        // component with PENUMBRA_NEAREST, which it holds from here on.
        float depth = shadow_penumbra_depth(s, s.at.z);
        s.penumbra.PENUMBRA_NEAREST =
            max(c.nearest, depth - min(s.reach / s.penumbra.PENUMBRA_RADIUS, s.penumbra.PENUMBRA_GROWTH / gl_FragCoord.w));
        s.widest = min(s.reach, s.penumbra.PENUMBRA_RADIUS * (depth - s.penumbra.PENUMBRA_NEAREST));
        if (SHADOW_SPANS[slot]) {
            s.at.z = (depth - c.nearest) / c.span;
            s.slope *= s.penumbra.PENUMBRA_SCALE / c.span;
            s.penumbra.PENUMBRA_SCALE = c.span;
            s.penumbra.PENUMBRA_BIAS = c.nearest;
        }
        s.window.xy = c.tile * (0.5 * s.size.x);
        s.window.zw = s.window.xy + 0.5 * s.size.x;
    } else if (type == LIGHT_POINT) {
        vec3 v = LIGHT(slot, LIGHT_PLACE).xyz - p;
        shadow_tile t = SHADOW_SHARED[slot] ? shadow_tile_shared(slot, v, n, c) : shadow_tile_raised_of(slot, v, n, c);
        s.beside = t.beside;
        s.at = vec3(shadow_tile_uv(slot, t), shadow_code(slot, radial, length(t.q), t.q.z, 1.0 / t.q.z, c, spread));
        s.slope = shadow_tile_slope(slot, radial, t, plane, height);
        float half_way = 1.0 / (t.q.z + light.distance_m);
        s.tangent = t.q.xy / t.q.z;
        s.aslant = t.q.xy * half_way;
        if (radial) s.penumbra.PENUMBRA_RADIUS *= length(t.q) / t.q.z;
        s.widest = s.reach * (2.0 * t.q.z * half_way); // taps lie within .83 of the radius, longer by distance / depth
        // Limits penumbrae to the gutter.
        s.penumbra.PENUMBRA_NEAREST =
            max(s.penumbra.PENUMBRA_NEAREST, shadow_penumbra_depth(s, s.at.z) - s.reach / s.penumbra.PENUMBRA_RADIUS);
        vec2 tile = s.size.xy * vec2(1.0 / 3.0, 0.5);
        s.window.xy = floor(s.at.xy * vec2(3.0, 2.0)) * tile;
        s.window.zw = s.window.xy + tile;
    } else {
        float depth = from_vertex.z, inverse = 1.0 / depth, offset = SHADOW(slot, SHADOW_BIAS).BIAS_NORMAL * depth;
        float code = shadow_code(slot, radial, light.distance_m - offset * abs(c), depth, inverse, c, spread);
        s.at = vec3(from_vertex.xy * inverse, code);
        s.slope = shadow_slope_spot(slot, radial, s.at, depth, plane, height, l);
        // Off the axis tangents grow by distance / depth.
        if (radial) s.penumbra.PENUMBRA_RADIUS *= light.distance_m * inverse;
    }
    return s;
}

// Visibility of a light at s, 1 = lit, blended between tiles or cascades over the pixels of a quad; seen: the technique's result.
// Takes derivatives: not behind a branch.
float shadow_mixed(const int slot, shadow_place s, float seen) {
    if (!SHADOW_SHARED[slot]) return seen;
    seen += s.beside.y * dFdy(seen);
    return clamp(seen + s.beside.x * dFdx(seen), 0.0, 1.0);
}
