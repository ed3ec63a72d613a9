//@ names shadow_visibility VSM_BLEED VSM_REACH
// Variance shadow maps (Donnelly, Lauritzen, "Variance Shadow Maps", 2006): by Chebyshev's inequality visibility is at most
// s^2 / (s^2 + (z - m)^2), with equality for one blocker in front of one receiver. Light bleeding behind two casters is reduced by
// subtracting VSM_BLEED and rescaling the rest (Lauritzen, GPU Gems 3, ch. 8). This applies to the fraction of texels covered by
// casters; the rest is lit, whether the receiver is in the map (is a caster) or not.
const float VSM_BLEED = 0.2;
const float VSM_REACH = 4.5; // half of the widest blur, texels

float shadow_visibility(MOMENTS_SAMPLER map, shadow_place s) {
    vec4 m = moments_at(map, s.at.xy, s.size);
    float share = clamp(m.w, moments_step, 1.0);
    vec2 mean = m.xy / share;
    float beyond = max(s.at.z - shadow_cut(s, VSM_REACH, share) - mean.x, 0.0);
    float variance = max(mean.x * (1.0 - mean.x) - 0.25 * mean.y, max(moments_step / share, 1e-6));
    float lit = clamp((variance / (variance + beyond * beyond) - VSM_BLEED) * (1.0 / (1.0 - VSM_BLEED)), 0.0, 1.0);
    return shadow_outside(s) ? 1.0 : 1.0 - clamp(m.w, 0.0, 1.0) * (1.0 - lit);
}
