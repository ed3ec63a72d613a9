//@ names shadow_visibility EVSM_LEAST EVSM_REACH EVSM_BLEED evsm_bound
// Exponential variance shadow maps (Lauritzen, McCool, "Layered Variance Shadow Maps", 2008): Chebyshev's bound of the distance
// warped by e^(a z), which reduces light bleeding behind a second caster, and by -e^(-b z), for steep casters that the first
// leaves too light. Visibility is the lesser of both bounds, applied to the fraction of texels covered by casters; the rest is lit.

// Least variance, in units of the squared warp: rounded moments never reach 0, and a flat surface varies within a texel.
const float EVSM_LEAST = max(4.0 * moments_step, 1e-5);
const float EVSM_REACH = 4.5; // half of the widest blur, texels
// Light that the bound leaks where blocker and receiver meet: subtracted, the rest rescaled.
const float EVSM_BLEED = 0.03;

vec2 evsm_bound(vec2 mean, vec2 square, vec2 w) {
    vec2 variance = max(square - mean * mean, EVSM_LEAST * w * w);
    vec2 beyond = max(w - mean, 0.0);
    return variance / (variance + beyond * beyond);
}

float shadow_visibility(MOMENTS_SAMPLER map, shadow_place s) {
    mat3x2 m = moments_at(map, s.at.xy, s.size);
    float share = m[0].x, whole = 1.0 / max(share, 1e-4);
    float z = 2.0 * clamp(s.at.z - shadow_cut(s, EVSM_REACH, share), 0.0, s.far) - 1.0;
    vec2 w = exp(moments_exponents * vec2(z, -z)) * vec2(1.0, -1.0);
    vec2 bound = evsm_bound(m[1] * whole, m[2] * whole, w);
    float lit = max((min(bound.x, bound.y) - EVSM_BLEED) * (1.0 / (1.0 - EVSM_BLEED)), 0.0);
    return shadow_outside(s) || share < 1e-4 ? 1.0 : 1.0 - share * (1.0 - lit);
}
