// Point lights: the map is an atlas of 3 x 2 tiles. Each looks along an axis of the world (x, y, z are columns, the negative ends
// the upper row), 45 degrees to each side and a gutter more, for what is read beside a place near its edge.

struct shadow_tile {
    bool along_x, along_z; // its axis; neither: y
    float side;            // 1 or -1: which end of it
    vec3 q;                // from the light to the point: across the tile in the order of the other axes, and depth
    vec2 beside;           // what of the answer's derivatives is added to it: shadow_mixed()
};

// v: from the light to the point, world space. The same place in the tile's frame, with depth times side last.
vec3 shadow_tile_turn(shadow_tile t, vec3 v) {
    return vec3(t.along_x ? v.y : v.x, t.along_z ? v.y : v.z, t.along_x ? v.x : t.along_z ? v.z : v.y);
}

// Selects cost 13 instructions less than branches on a Pi 4 (of 180 for all of pcf with a point light), and 20 less than rows of
// constants by the tile's number.
shadow_tile shadow_tile_of(vec3 v) {
    vec3 a = abs(v);
    shadow_tile t;
    float depth = max(a.x, a.y);
    t.along_z = a.z > depth;
    depth = max(depth, a.z);
    t.along_x = a.x >= depth; // not both: then z would not be the larger
    t.q = shadow_tile_turn(t, v);
    t.side = t.q.z < 0.0 ? -1.0 : 1.0;
    t.q.z = depth;
    return t;
}

// Where to look it up: uv and code. radial: the map holds distances.
vec3 shadow_tile_at(const int slot, const bool radial, shadow_tile t) {
    vec4 tiles = SHADOW(slot, SHADOW_TILES);
    vec2 middle = t.along_x ? vec2(1.0 / 6.0, 0.5) : t.along_z ? vec2(5.0 / 6.0, 0.5) : vec2(0.5);
    middle.y = t.side < 0.0 ? 0.75 : 0.25;
    float inverse = 1.0 / t.q.z;
    float code = radial ? length(t.q) * SHADOW(slot, SHADOW_PLACE).PLACE_CODE_SCALE + SHADOW(slot, SHADOW_CODE).CODE_OFFSET
                        : tiles.w * inverse + tiles.z;
    return vec3(t.q.xy * inverse * tiles.xy + middle, code);
}

// The tile is that of the pushed point: all that is looked up for a point just beside an edge lies on one side of it.
shadow_tile shadow_tile_pushed(const int slot, const bool radial, vec3 p, vec3 n, vec3 l) {
    vec3 v = p - SHADOW(slot, SHADOW_PLACE).xyz;
    shadow_tile t = shadow_tile_of(v);
    return shadow_tile_of(v + shadow_push(slot, n, l, radial ? dot(n, l) : shadow_tile_turn(t, n).z, t.q.z));
}

// The texels of two tiles lie differently, so a filter makes different shades of them on either side of an edge. Round it, up to
// CODE_SHARED to each side, the four pixels of a quad share the tiles that are near: the lower left one asks the nearest, the upper
// left one the next, and those on the right as well unless a third is near: then both ask that. shadow_mixed() gives all four the
// same mean, whose weights change from tile to tile without a step: by halves on an edge, by thirds in a corner (Penner, "Shader
// Amortization using Pixel Quad Message Passing", GPU Pro 2, 2011). Who is who is told from the quad's middle, so all four agree; and
// it is right for derivatives that are taken once a quad as well, of its left pixels and of either row. On a Pi 4 this costs 62
// instructions (of 229 with pcf); two tiles alone, with a step in the corners, 34, asking twice there, in a loop, 71 and half of
// the threads.
shadow_tile shadow_tile_shared(const int slot, const bool radial, vec3 p, vec3 n, vec3 l) {
    vec3 v = p - SHADOW(slot, SHADOW_PLACE).xyz;
    vec2 turn = 2.0 * fract(0.5 * gl_FragCoord.xy) - 1.0; // from the quad's middle, pixels
    turn.y *= dFdy(turn.y);                               // in a picture of an odd height quads may begin at its top
    vec3 a = abs(v - turn.x * dFdx(p) - turn.y * dFdy(p)) * vec3(1.0, 0.999999, 0.999998); // no two are the same
    float larger = max(a.x, a.y), smaller = min(a.x, a.y);
    float depth = max(larger, a.z), second = max(smaller, min(larger, a.z)), third = min(smaller, a.z);
    vec2 near = max(1.0 - (depth - vec2(third, second)) / (depth * SHADOW(slot, SHADOW_CODE).CODE_SHARED), 0.0);
    bvec2 other = bvec2(turn.x > 0.0 && near.x > 0.0, turn.y > 0.0 && near.y > 0.0);
    float asked = other.x ? third : other.y ? second : depth;
    shadow_tile t;
    t.along_x = a.x == asked;
    t.along_z = a.z == asked;
    t.beside = vec2(near.x / (2.0 + near.x), 0.5 * near.y) - vec2(other);
    if (other.x) t.beside.y = 0.0;
    t.q = shadow_tile_turn(t, v);
    t.side = t.q.z < 0.0 ? -1.0 : 1.0;
    t.q = shadow_tile_turn(t, v + shadow_push(slot, n, l, radial ? dot(n, l) : shadow_tile_turn(t, n).z, abs(t.q.z)));
    t.q.z = abs(t.q.z);
    return t;
}

// As shadow_slope_spot, in the tile's frame.
vec2 shadow_tile_slope(const int slot, const bool radial, shadow_tile t, vec3 face) {
    vec4 tiles = SHADOW(slot, SHADOW_TILES);
    float inverse = 1.0 / t.q.z;
    vec3 l = -normalize(t.q);
    vec3 n = shadow_tile_turn(t, face) * vec3(1.0, 1.0, t.side);
    vec3 u = vec3(1.0, 0.0, -t.q.x * inverse) * (tiles.x * inverse);
    vec3 v = vec3(0.0, 1.0, -t.q.y * inverse) * (tiles.y * inverse);
    vec3 code = radial ? -l * SHADOW(slot, SHADOW_PLACE).PLACE_CODE_SCALE : vec3(0.0, 0.0, -tiles.w * inverse * inverse);
    return shadow_slope(u, v, code, n, l);
}
