//@ names shadow_visibility vssm_variance vssm_lit_code VSSM_BESIDE
// Variance soft shadow maps (Yang, Dong, Feng, Seidel, Guo, "Variance Soft Shadow Mapping", 2010): as pcss, but how far blockers are and
// how much they let through is read from the mean and the variance over a square, by Chebyshev's inequality, which is exact where
// there are but two distances: that of the blockers and that of what is lit. Behind m + v / (m - z) there is as much as in front.
#include "lib/table.glsl"

const float VSSM_BESIDE = 0.005; // codes: nearer to the receiver than this nothing is told from the receiver itself

float vssm_variance(vec4 moments) { return max(moments.x * (1.0 - moments.x) - 0.25 * moments.y, 2.5e-7); }

// The code of what is lit in a square with mean m and variance v: the receiver's own, t, or, where the receiver is in no map, as a
// ground that throws no shadow, that of what is seen behind it: farthest. Only if blockers come out before the receiver so.
// beside: how far the receiver's plane rises in the square.
float vssm_lit_code(float m, float v, float t, float farthest, float beside) {
    float d = farthest - m;
    if (d <= 0.0) return t;
    return mix(t, farthest, clamp((t - m + v / d) / (beside + VSSM_BESIDE) - 0.5, 0.0, 1.0));
}

float shadow_visibility(MOMENTS_SAMPLER table, shadow_place s) {
    float t = min(s.at.z, s.far), rise = dot(abs(s.slope), s.size.zw);
    float widest = table_widest(s), radius = TABLE_SEARCH * widest;
    ivec2 low, middle, high;
    table_edges(s, radius, low, middle, high);
    // Four quarters, as Yang has it where the mean is behind the receiver: the farthest is lit.
    vec4 a = table_value(table_between(table, low, middle), s.reach);
    vec4 b = table_value(table_between(table, ivec2(middle.x, low.y), ivec2(high.x, middle.y)), s.reach);
    vec4 c = table_value(table_between(table, ivec2(low.x, middle.y), ivec2(middle.x, high.y)), s.reach);
    vec4 d = table_value(table_between(table, middle, high), s.reach);
    vec2 below = vec2(middle - low), above = vec2(high - middle);
    vec4 areas = vec4(below.x, above.x, below.x, above.x) * vec4(below.yy, above.yy);
    vec4 means = vec4(a.x, b.x, c.x, d.x) / areas;
    float farthest = max(max(max(means.x, means.y), max(means.z, means.w)), t);
    vec4 m = (a + b + c + d) / dot(areas, vec4(1.0));
    float v = vssm_variance(m);
    float beyond = vssm_lit_code(m.x, v, t, farthest, rise * radius) - m.x;
    if (beyond <= 0.0) return 1.0;
    radius = TABLE_FILTER * table_penumbra(s, max(m.x - v / beyond, 0.0), widest);
    m = table_mean(table, s, radius, vec4(1.0, 0.0, 0.0, 0.0));
    v = vssm_variance(m);
    beyond = max(vssm_lit_code(m.x, v, t, farthest, rise * radius) - m.x, 0.0);
    return v / (v + beyond * beyond);
}
