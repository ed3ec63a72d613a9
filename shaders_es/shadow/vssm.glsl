//@ names shadow_visibility vssm_beyond vssm_variance
// Variance soft shadow maps (Yang, Dong, Feng, Seidel, Guo, "Variance Soft Shadow Mapping", 2010): as pcss, but how far blockers are and
// how much they let through is read from the mean and the variance over a square, by Chebyshev's inequality, which is exact where
// there are but two distances: that of the blockers and that of the receiver. Both are those of casters: where the map is clear light
// passes, and a receiver that is in no map leaves the blockers alone. Behind m + v / (m - z) there is as much as in front.
// A plane seen edge-on is many distances: the wide square in which blockers are looked for holds it from far nearer to far farther,
// its variance is the plane's, and the blocker found is none. So the few texels right above are asked first, which have none of
// that, and the wide square only where these do not block.
#include "lib/table.glsl"

// Of the mean over casters, by how much the receiver lies behind it; a square of this radius.
float vssm_beyond(shadow_place s, vec4 m, float radius) { return max(s.at.z - shadow_cut(s, radius, m.w) - m.x / m.w, 0.0); }

float vssm_variance(vec4 m) {
    float mean = m.x / m.w;
    return max(mean * (1.0 - mean) - 0.25 * m.y / m.w, 2.5e-7 / m.w);
}

// The code of the blockers in a square of this radius, and the share of it that they take, of all: 0 where there are none.
vec2 vssm_blockers(shadow_place s, vec4 m, float radius) {
    if (m.w < 1e-4) return vec2(0.0);
    float beyond = vssm_beyond(s, m, radius);
    if (beyond <= 0.0) return vec2(0.0);
    float v = vssm_variance(m);
    return vec2(max(m.x / m.w - v / beyond, 0.0), min(m.w, 1.0) * beyond * beyond / (v + beyond * beyond));
}

float shadow_visibility(MOMENTS_SAMPLER table, shadow_place s) {
    float widest = table_widest(s);
    vec2 found = vssm_blockers(s, table_mean_about(table, s, 1.0), 1.0);
    if (found.y < 0.5) found = vssm_blockers(s, table_mean_about(table, s, TABLE_SEARCH * widest), TABLE_SEARCH * widest);
    if (found.y == 0.0) return 1.0;
    float radius = TABLE_FILTER * table_penumbra(s, found.x, widest);
    return 1.0 - vssm_blockers(s, table_mean(table, s, radius, vec4(0.0)), radius).y;
}
