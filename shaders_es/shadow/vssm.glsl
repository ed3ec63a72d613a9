//@ names shadow_visibility vssm_blockers
// Variance soft shadow maps (Yang, Dong, Feng, Seidel, Kautz, "Variance Soft Shadow Mapping", 2010): as pcss, but the distance of
// the blockers and the visibility are computed from mean m and variance v over a square, by Chebyshev's inequality, which is
// exact for two distances: the blockers' and the receiver's z. The blockers are then at m + v / (m - z). Mean and variance are
// those of casters: where the map is empty it is lit, and if the receiver is not in the map, only blockers remain.
#include "lib/table.glsl"

// x: code of the blockers in a square of this radius (texels), y: fraction of the whole square that they cover, 0 without blockers.
// A sloped receiver covers a range of depths, of variance `own`, at most v. With a fraction p of blockers that are nearer by d, the
// mean is nearer than the receiver by beyond = p d, and the variance is v = (1 - p) (p d d + own), hence
// own p p + (v + beyond beyond - own) p = beyond beyond. If the receiver is not in the map, p is 1, which is correct too.
vec2 vssm_blockers(shadow_place s, vec4 m, float radius) {
    if (m.w < 1e-4) return vec2(0.0);
    float mean = m.x / m.w, beyond = s.at.z - shadow_cut(s, radius, m.w) - mean;
    if (beyond <= 0.0) return vec2(0.0);
    float v = max(mean * (1.0 - mean) - 0.25 * m.y / m.w, 2.5e-7 / m.w);
    vec2 across = radius * s.slope * s.size.zw;
    float own = min(dot(across, across) / 3.0, v), square = beyond * beyond, b = v + square - own;
    float share = min(2.0 * square / (b + sqrt(b * b + 4.0 * own * square)), 1.0);
    return vec2(max(mean + beyond - beyond / share, 0.0), min(m.w, 1.0) * share);
}

float shadow_visibility(MOMENTS_SAMPLER table, shadow_place s) {
    float widest = table_widest(s), wide = TABLE_SEARCH * widest;
    vec2 far = vssm_blockers(s, table_mean_about(table, s, wide, vec4(0.0)), wide);
    vec2 near = vssm_blockers(s, table_mean_about(table, s, TABLE_CLOSE, vec4(0.0)), TABLE_CLOSE);
    near.y *= TABLE_CLOSER;
    float found = far.y + near.y;
    if (found == 0.0) return 1.0;
    float radius = TABLE_FILTER * table_penumbra(s, (far.x * far.y + near.x * near.y) / found, widest);
    return 1.0 - vssm_blockers(s, table_mean(table, s, radius, vec4(0.0)), radius).y;
}
