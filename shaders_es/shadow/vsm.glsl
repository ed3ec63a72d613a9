//@ names shadow_visibility VSM_BLEED
// Variance shadow maps (Donnelly, Lauritzen, "Variance Shadow Maps", 2006): by Chebyshev's inequality at most s^2 / (s^2 + (z - m)^2)
// of the light passes, exactly so behind one caster before one receiver. What two casters one behind the other let through so is cut
// off below VSM_BLEED, and the rest is stretched (Lauritzen, GPU Gems 3, ch. 8).
const float VSM_BLEED = 0.2;

float shadow_visibility(MOMENTS_SAMPLER map, shadow_place s) {
    vec2 m = moments_at(map, s.at.xy, s.size).xy;
    float beyond = max(min(s.at.z, s.far) - m.x, 0.0);
    float variance = max(m.x * (1.0 - m.x) - 0.25 * m.y, max(moments_step, 1e-6));
    float lit = variance / (variance + beyond * beyond);
    return shadow_outside(s) ? 1.0 : clamp((lit - VSM_BLEED) * (1.0 / (1.0 - VSM_BLEED)), 0.0, 1.0);
}
