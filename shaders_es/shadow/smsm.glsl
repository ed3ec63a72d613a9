//@ names shadow_visibility SMSM_BIAS SMSM_CLEAR smsm_moments smsm_blocked
// Moment soft shadow mapping (Peters, Muenstermann, Wetzstein, Klein, "Improved Moment Shadow Maps for Translucent Occluders,
// Soft Shadows and Single Scattering", JCGT 6 (1), 2017): as vssm, but with four moments, which separate three distances.
#include "lib/table.glsl"

const vec4 SMSM_CLEAR = vec4(0.0, 0.0, 0.98112522, 1.0); // moments of the far end
const float SMSM_BIAS = 5e-6; // 6e-7 in the paper, whose SAT has finer steps than one for wide penumbrae

// Moments of z = 2 c - 1 from their stored basis (moments/smsm.glsl), blended slightly with those of a distribution over all z,
// so that they stay valid after rounding.
vec4 smsm_moments(vec4 m) {
    float p = m.x - 0.5, q = m.z - 0.5;
    vec4 b = vec4(1.7320508 * q - p / 3.0, 0.125 * m.y + m.w, (1.2990381 * q) - 0.75 * p, m.w - 0.125 * m.y);
    return mix(b, vec4(0.0, 0.628, 0.0, 0.628), SMSM_BIAS);
}

// For the distribution with the moments b at three points, one of them z0: the fraction of casters in front of z0 (a lower bound
// for all distributions with these moments), and that times their mean z.
vec2 smsm_blocked(vec4 b, float z0) {
    // Cholesky decomposition of the Hankel matrix of the moments, solved for c0 + c1 z + c2 z^2; the other two points are its
    // roots.
    float spread = max(b.y - b.x * b.x, 1e-7);
    float skew = (b.z - b.x * b.y) / spread;
    float rest = max(b.w - b.y * b.y - (b.z - b.x * b.y) * skew, 1e-9);
    float u = z0 - b.x;
    float c2 = (z0 * z0 - b.y - skew * u) / rest;
    float c1 = u / spread - skew * c2, c0 = 1.0 - b.x * c1 - b.y * c2;
    float inverse = 1.0 / (abs(c2) < 1e-6 ? 1e-6 : c2);
    float half_sum = -0.5 * c1 * inverse, root = sqrt(max(half_sum * half_sum - c0 * inverse, 1e-12));
    vec2 z = vec2(half_sum - root, half_sum + root), other = z.yx;
    vec2 w = (z0 * other - b.x * (z0 + other) + b.y) / ((other - z) * (z0 - z));
    w = mix(vec2(0.0), w, lessThan(z, vec2(z0)));
    return vec2(w.x + w.y, dot(w, z));
}

// The plane of a sloped receiver contributes to the mean, up to 2 * across * radius in front of z0, so it would block itself. In
// blocker searches only what is half as far in front of z0 counts as a blocker. In the filter that offset alone is too strict,
// since the fraction is a lower bound already, so the fraction in front of z0 itself is mixed in; and the offset is limited to
// half of the distance to the blockers, to those of the close search where it found some.
float shadow_visibility(MOMENTS_SAMPLER table, shadow_place s) {
    float z0 = 2.0 * clamp(s.at.z, -1.0, s.far) - 1.0, across = dot(abs(s.slope), s.size.zw);
    float widest = table_widest(s), wide = TABLE_SEARCH * widest;
    vec2 far = smsm_blocked(smsm_moments(table_mean_about(table, s, wide, SMSM_CLEAR)), z0 - across * wide);
    vec2 near = smsm_blocked(smsm_moments(table_mean_about(table, s, TABLE_CLOSE, SMSM_CLEAR)), z0 - across * TABLE_CLOSE);
    vec2 found = far + TABLE_CLOSER * near;
    float z = min((0.001 * z0 + found.y) / (0.001 + found.x), z0);
    float radius = TABLE_FILTER * table_penumbra(s, 0.5 + 0.5 * max(z, -1.0), widest);
    vec4 b = smsm_moments(table_mean(table, s, radius, SMSM_CLEAR));
    float before = 0.5 * (z0 - mix(z, (0.001 * z0 + near.y) / (0.001 + near.x), clamp(near.x, 0.0, 1.0)));
    float all = smsm_blocked(b, z0).x, sure = smsm_blocked(b, z0 - min(across * radius, before)).x;
    float blocked = 0.5 * (min(all, sure) + min(all, 3.0 * sure));
    return blocked > 0.0 ? 1.0 - min(blocked, 1.0) : 1.0; // NaN is lit
}
