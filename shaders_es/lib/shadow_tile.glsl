// Point lights: the map is an atlas of 3 x 2 tiles, the faces of a cube. Columns are the world axes x, y, z; the lower row looks
// along the positive, the upper row along the negative direction. A tile covers 45 degrees to each side plus a gutter for
// filters.

struct shadow_tile {
    bool along_x, along_z; // axis of the tile; neither: y
    float side;            // 1 or -1: direction along the axis
    vec3 q;                // from the light to the point: xy along the other two axes in their order, z depth
    vec2 beside;           // factors on the x and y derivatives of the visibility that shadow_mixed() adds
};

// v in the frame of the tile; z is side * depth. v: from the light to the point, world space.
vec3 shadow_tile_turn(shadow_tile t, vec3 v) {
    return vec3(t.along_x ? v.y : v.x, t.along_z ? v.y : v.z, t.along_x ? v.x : t.along_z ? v.z : v.y);
}

// The tile of a direction. On a Pi 4 selects cost 13 instructions less than branches (of 180 for pcf with a point light), and 20
// less than a table of constants per tile.
shadow_tile shadow_tile_of(vec3 v) {
    vec3 a = abs(v);
    shadow_tile t;
    float depth = max(a.x, a.y);
    t.along_z = a.z > depth;
    depth = max(depth, a.z);
    t.along_x = a.x >= depth; // never with along_z: then a.z > a.x
    t.q = shadow_tile_turn(t, v);
    t.side = t.q.z < 0.0 ? -1.0 : 1.0;
    t.q.z = depth;
    return t;
}

// uv over the map.
vec2 shadow_tile_uv(const int slot, shadow_tile t) {
    vec2 middle = t.along_x ? vec2(1.0 / 6.0, 0.5) : t.along_z ? vec2(5.0 / 6.0, 0.5) : vec2(0.5);
    middle.y -= 0.25 * t.side;
    return t.q.xy / t.q.z * SHADOW(slot, SHADOW_TILES).xy + middle;
}

// From the light to the point after the normal offset. c: cosine between n and the direction to the light.
vec3 shadow_tile_raised(const int slot, vec3 v, vec3 n, float c, float depth) {
    float offset = SHADOW(slot, SHADOW_BIAS).BIAS_NORMAL * depth;
    return v + n * (SHADOW_BACKS && c < 0.0 ? -offset : offset);
}

// The tile of the point after the bias, so that near an edge the lookup stays within one tile.
shadow_tile shadow_tile_raised_of(const int slot, vec3 v, vec3 n, float c) {
    return shadow_tile_of(shadow_tile_raised(slot, v, n, c, max(max(abs(v.x), abs(v.y)), abs(v.z))));
}

// Two tiles have different texel grids, so filtered shadows differ across an edge. Within CODE_SHARED of an edge the four pixels
// of a quad sample all tiles near it: the lower left pixel the nearest tile, the upper left pixel the second; the right pixels do
// the same or, where a third tile is near, both sample that. shadow_mixed() gives all four the same weighted mean; the weights
// are continuous: halves on an edge, thirds in a corner (Penner, "Shader Amortization using Pixel Quad Message Passing", GPU Pro
// 2, 2011). The tiles are ordered at the centre of the quad, so all four pixels agree. This also holds for GPUs that compute one
// derivative per quad, from the left pixels and either row. Cost on a Pi 4: 62 instructions (of 229 with pcf). Alternatives: two
// tiles only, with a discontinuity in corners, 34; sampling two tiles per pixel in a loop, 71 and half of the threads.
shadow_tile shadow_tile_shared(const int slot, vec3 p, vec3 v, vec3 n, float c) {
    vec2 turn = 2.0 * fract(0.5 * gl_FragCoord.xy) - 1.0; // from the centre of the quad, pixels
    turn.y *= dFdy(turn.y);                               // pictures of odd height may have quads aligned to the top
    vec3 a = abs(v - turn.x * dFdx(p) - turn.y * dFdy(p)) * vec3(1.0, 0.999999, 0.999998); // breaks ties
    float larger = max(a.x, a.y), smaller = min(a.x, a.y);
    float depth = max(larger, a.z), second = max(smaller, min(larger, a.z)), third = min(smaller, a.z);
    float per = SHADOW(slot, SHADOW_CODE).CODE_SHARED;
    vec2 near = max(vec2(third, second) * (per / depth) + (1.0 - per), 0.0); // 1 on the edge
    bvec2 other = greaterThan(turn * near, vec2(0.0));
    float asked = other.x ? third : other.y ? second : depth;
    shadow_tile t;
    t.along_x = a.x == asked;
    t.along_z = a.z == asked;
    t.beside = vec2(near.x / (2.0 + near.x), 0.5 * near.y) - vec2(other);
    if (other.x) t.beside.y = 0.0;
    t.q = shadow_tile_turn(t, shadow_tile_raised(slot, v, n, c, asked));
    t.side = t.q.z < 0.0 ? -1.0 : 1.0;
    t.q.z = abs(t.q.z);
    return t;
}

// As shadow_slope_spot(), in the frame of the tile.
vec2 shadow_tile_slope(const int slot, const bool radial, shadow_tile t, vec3 face, float height) {
    vec4 tiles = SHADOW(slot, SHADOW_TILES);
    vec3 n = shadow_tile_turn(t, face) * vec3(1.0, 1.0, t.side);
    if (!radial) return shadow_slope_deep(n.xy * SHADOW(slot, SHADOW_SLOPE).xy, height, t.q.z);
    float inverse = 1.0 / t.q.z;
    vec3 l = -normalize(t.q);
    vec3 u = vec3(1.0, 0.0, -t.q.x * inverse) * (tiles.x * inverse);
    vec3 v = vec3(0.0, 1.0, -t.q.y * inverse) * (tiles.y * inverse);
    return shadow_slope(u, v, -l * SHADOW(slot, SHADOW_PLACE).PLACE_CODE_SCALE, n, l);
}
