// Means over squares from a summed-area table (SAT: Crow, "Summed-Area Tables for Texture Mapping", 1984); the number of reads
// does not depend on the size. Each texel holds the sum from the tile's lower left corner up to and including itself, in fixed
// point. Sums wrap around; a difference of two is exact as long as the sum between them fits into 32 bits: TABLE_SCALE.
// Edges are counted in texels from the map's lower left corner: edge i is between texels i - 1 and i.

// Half side of the square that replaces a disk of radius 1: of equal area in the search, of equal variance in the filter.
const float TABLE_SEARCH = 0.886;
const float TABLE_FILTER = 0.866;
// Two blocker searches: in the square that contains all blockers of the receiver, where blockers close to the receiver can hardly
// be separated from its own plane; and within TABLE_CLOSE texels of the receiver, with weight TABLE_CLOSER.
const float TABLE_CLOSE = 1.0;
const float TABLE_CLOSER = 3.0;

vec4 table_value(uvec4 sum, float reach) { return vec4(sum) * (1.0 / TABLE_SCALE(reach)); }

uvec4 table_sum(highp usampler2D table, int x, int y) { return texelFetch(table, ivec2(x, y) - 1, 0); }

uvec4 table_between(highp usampler2D table, ivec2 low, ivec2 high) {
    return table_sum(table, high.x, high.y) - table_sum(table, low.x, high.y) - table_sum(table, high.x, low.y) +
           table_sum(table, low.x, low.y);
}

// Radius of the blocker search, texels.
float table_widest(shadow_place s) {
    return clamp(s.penumbra.PENUMBRA_RADIUS * (shadow_penumbra_depth(s, s.at.z) - s.penumbra.PENUMBRA_NEAREST), 1.0, s.reach / TABLE_SEARCH);
}

// Radius at the receiver of the penumbra of a blocker at `code`, texels.
float table_penumbra(shadow_place s, float code, float widest) {
    return clamp(s.penumbra.PENUMBRA_RADIUS * (shadow_penumbra_depth(s, s.at.z) - shadow_penumbra_depth(s, code)), 1.0, widest);
}

// Edges in whole texels, three per axis in ascending order, of the square around s.at that is 2 * radius wide.
void table_edges(shadow_place s, float radius, out ivec2 low, out ivec2 middle, out ivec2 high) {
    vec2 p = s.at.xy * s.size.xy + 0.5;
    middle = ivec2(clamp(p, s.window.xy + 2.0, s.window.zw - 1.0));
    low = max(min(ivec2(p - radius), middle - 1), ivec2(s.window.xy) + 1);
    high = min(max(ivec2(p + radius), middle + 1), ivec2(s.window.zw));
}

// Mean over the square that is 2 * radius texels wide, with its edges at whole texels: sufficient for a blocker search. beyond:
// value outside of the tile.
vec4 table_mean_about(highp usampler2D table, shadow_place s, float radius, vec4 beyond) {
    ivec2 low, middle, high;
    table_edges(s, radius, low, middle, high);
    vec2 p = s.at.xy * s.size.xy + 0.5, side = vec2(high - low), whole = max(floor(p + radius) - floor(p - radius), side);
    float share = 1.0 / (whole.x * whole.y);
    return table_value(table_between(table, low, high), s.reach) * share + beyond * (1.0 - side.x * side.y * share);
}

// Differences of a row of sums: the partly covered texels at the left and right end, and the whole texels between them.
struct table_row { uvec4 left, inside, right; };

table_row table_row_at(highp usampler2D table, ivec4 x, int y) {
    uvec4 a = table_sum(table, x.x, y), b = table_sum(table, x.y, y), c = table_sum(table, x.z, y), d = table_sum(table, x.w, y);
    return table_row(b - a, c - b, d - c);
}

vec4 table_weigh(table_row above, table_row below, vec2 ends) {
    return vec4(above.left - below.left) * ends.x + vec4(above.inside - below.inside) + vec4(above.right - below.right) * ends.y;
}

// Mean over the square with exact edges, which may cut texels, so that it is continuous. beyond: value outside of the tile.
vec4 table_mean(highp usampler2D table, shadow_place s, float radius, vec4 beyond) {
    vec2 p = s.at.xy * s.size.xy;
    vec2 low = clamp(p - radius, s.window.xy + 1.0, s.window.zw - 1.0), high = clamp(p + radius, low + 1.0, s.window.zw);
    ivec2 a = ivec2(low), b = ivec2(high), last = min(b + 1, ivec2(s.window.zw));
    ivec4 x = ivec4(a.x, a.x + 1, b.x, last.x);
    vec2 first = 1.0 - fract(low), cut = fract(high), ends = vec2(first.x, cut.x);
    table_row row_0 = table_row_at(table, x, a.y), row_1 = table_row_at(table, x, a.y + 1);
    table_row row_2 = table_row_at(table, x, b.y), row_3 = table_row_at(table, x, last.y);
    vec4 sum = table_weigh(row_1, row_0, ends) * first.y + table_weigh(row_2, row_1, ends) + table_weigh(row_3, row_2, ends) * cut.y;
    vec2 side = high - low;
    vec2 covered = max(min(p + radius, s.window.zw) - max(p - radius, s.window.xy + 1.0), 0.0);
    float inside = covered.x * covered.y / (4.0 * radius * radius);
    return mix(beyond, sum * (1.0 / (TABLE_SCALE(s.reach) * side.x * side.y)), min(inside, 1.0));
}
