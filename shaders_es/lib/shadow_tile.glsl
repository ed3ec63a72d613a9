// Point lights: the map is an atlas of 3 x 2 tiles, the faces of a cube. Columns are the world axes x, y, z; the lower row looks
// along the positive, the upper row along the negative direction. A tile covers 45 degrees to each side plus a gutter for
// filters.

struct shadow_tile {
    bool along_x, along_z; // axis of the tile; neither: y
    float side;            // 1 or -1: direction from the light along the axis
    vec3 q;                // from the point to the light: xy along the other two axes in their order; z depth, positive
    vec2 beside;           // factors on the x and y derivatives of the visibility that shadow_mixed() adds
};

// v, world space, in the frame of the tile; z is along the axis. On a Pi 4 selects are cheaper than branches and than a table of
// constants per tile.
vec3 shadow_tile_turn(shadow_tile t, vec3 v) {
    return vec3(t.along_x ? v.y : v.x, t.along_z ? v.y : v.z, t.along_x ? v.x : t.along_z ? v.z : v.y);
}

// v: from the point to the light, world space.
void shadow_tile_set(inout shadow_tile t, vec3 v) {
    t.q = shadow_tile_turn(t, v);
    t.side = t.q.z > 0.0 ? -1.0 : 1.0;
    t.q.z *= -t.side;
}

// uv over the map.
vec2 shadow_tile_uv(const int slot, shadow_tile t) {
    vec2 middle = t.along_x ? vec2(1.0 / 6.0, 0.5) : t.along_z ? vec2(5.0 / 6.0, 0.5) : vec2(0.5);
    middle.y -= 0.25 * t.side;
    return middle - t.q.xy / t.q.z * SHADOW(slot, SHADOW_TILES).xy;
}

float shadow_tile_depth(vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

// From the point to the light after the normal offset. c: cosine between n and the direction to the light.
vec3 shadow_tile_raised(const int slot, vec3 v, vec3 n, float c, float depth) {
    float offset = SHADOW(slot, SHADOW_BIAS).BIAS_NORMAL * depth;
    return v - n * (SHADOW_BACKS && c < 0.0 ? -offset : offset);
}

// The tile of the point after the bias, so that near an edge the lookup stays within one tile.
shadow_tile shadow_tile_raised_of(const int slot, vec3 v, vec3 n, float c) {
    vec3 raised = shadow_tile_raised(slot, v, n, c, shadow_tile_depth(v)), a = abs(raised);
    shadow_tile t;
    t.along_z = a.z > max(a.x, a.y);
    t.along_x = a.x >= max(a.y, a.z); // never with along_z
    shadow_tile_set(t, raised);
    return t;
}

// Two tiles have different texel grids, so filtered shadows differ across an edge. Near an edge (CODE_SHARED) the four pixels of a
// quad sample all tiles near it: the right pixels the tile along z, the left ones those along x and y, one in either row; also the
// right ones where z is not near. A pixel whose tile is not near samples another that is. shadow_mixed() gives each pixel the mean of the quad, weighted by how near the tiles
// are to it: the weights are continuous, halves on an edge and thirds in a corner (Penner, "Shader Amortization using Pixel Quad
// Message Passing", GPU Pro 2, 2011). A pixel has its tile by its place in the quad and not by which tile is the nearest, so pixels of
// a quad need not agree on that; in a column they agree on z, since a pixel without z blends with the one above or below it. This also holds for GPUs that compute one derivative per quad, from the left pixels and either row.
shadow_tile shadow_tile_shared(const int slot, vec3 v, vec3 n, float c) {
    float depth = shadow_tile_depth(v);
    vec3 near = max(abs(v) - depth * SHADOW(slot, SHADOW_CODE).CODE_SHARED, 0.0); // 0: not near
    float left = near.x + near.y;
    vec2 turn = fract(0.5 * gl_FragCoord.xy); // 1/4 or 3/4
    vec2 prefers = exp2(50.0 * turn - 25.0);  // 2 ^ -12.5 or 2 ^ 12.5: what the pixel samples, if it is near
    float upwards = 2.0 * dFdy(turn.y);       // 1 or -1: pictures of odd height may have quads aligned to the top
    shadow_tile t;
    t.along_z = (near.z + abs(dFdy(near.z))) * prefers.x > left; // at least that of the other row
    t.along_x = !t.along_z && near.x * prefers.y > near.y;
    t.beside.x = (t.along_z ? -left : near.z) / (left + near.z);
    t.beside.y = t.along_z ? 0.0 : (t.along_x ? -near.y : near.x) * upwards / left;
    shadow_tile_set(t, shadow_tile_raised(slot, v, n, c, depth));
    return t;
}

// As shadow_slope_spot(), in the frame of the tile.
vec2 shadow_tile_slope(const int slot, const bool radial, shadow_tile t, vec3 face, float height) {
    vec4 tiles = SHADOW(slot, SHADOW_TILES);
    vec3 n = shadow_tile_turn(t, face) * vec3(1.0, 1.0, t.side);
    if (!radial) return shadow_slope_deep(n.xy * SHADOW(slot, SHADOW_SLOPE).xy, height, t.q.z);
    float inverse = 1.0 / t.q.z;
    vec3 l = normalize(vec3(t.q.xy, -t.q.z));
    vec3 u = vec3(1.0, 0.0, t.q.x * inverse) * (tiles.x * inverse);
    vec3 v = vec3(0.0, 1.0, t.q.y * inverse) * (tiles.y * inverse);
    return shadow_slope(u, v, -l * SHADOW(slot, SHADOW_PLACE).PLACE_CODE_SCALE, n, l);
}
