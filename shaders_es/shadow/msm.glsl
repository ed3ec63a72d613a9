//@ names shadow_visibility MSM_BIAS MSM_FULL MSM_MIDDLE msm_dark
// Moment shadow maps (Peters, Klein, "Moment Shadow Mapping", I3D 2015): visibility is the upper bound over all distributions of
// casters with the same four moments. It is reached by three casters, one of them at the receiver (the "Hamburger" bound).

// Rounded moments may be invalid (of no distribution), so they are blended by this weight with MSM_MIDDLE, the moments of three
// casters at the ends and the middle of the range (Peters et al., "Beyond Hard Shadows: Moment Shadow Maps for Single Scattering,
// Soft Shadows and Translucent Occluders", JCGT 2017).
const float MSM_BIAS = max(2.0 * moments_step, 3e-6);
// Darkness that counts as full shadow: the blend lowers it, and the bound leaks light where blocker and receiver meet.
const float MSM_FULL = 0.925;
const vec4 MSM_MIDDLE = vec4(0.5, 0.407, 0.3605, 0.33725);

// Fraction of the light blocked in front of z (0..1): the lower bound for the moments b.
float msm_dark(vec4 b, float z) {
    // Cholesky decomposition of the Hankel matrix of the moments, solved for (1, z, z^2).
    float spread = max(b.y - b.x * b.x, 1e-8);
    float skew = (b.z - b.x * b.y) / spread;
    float rest = max(b.w - b.y * b.y - (b.z - b.x * b.y) * skew, 1e-10);
    float c2 = z * z - b.y - skew * (z - b.x);
    float c1 = (z - b.x) / spread;
    c2 /= rest;
    c1 -= skew * c2;
    float c0 = 1.0 - b.x * c1 - b.y * c2;
    // The other two casters: roots of c2 x^2 + c1 x + c0.
    float inverse = 1.0 / (abs(c2) < 1e-6 ? 1e-6 : c2);
    float p = -0.5 * c1 * inverse;
    float r = sqrt(max(p * p - c0 * inverse, 0.0));
    float near = p - r, far = p + r;
    if (z <= near) return 0.0;
    if (z <= far) return (z * far - b.x * (z + far) + b.y) / max((far - near) * (z - near), 1e-12);
    return 1.0 - (near * far - b.x * (near + far) + b.y) / max((z - near) * (z - far), 1e-12);
}

float shadow_visibility(MOMENTS_SAMPLER map, shadow_place s) {
    mat4 gather = mat4(0.2227744146, 0.1549679261, 0.1451988946, 0.163127443,
                       0.0771972861, 0.1394629426, 0.2120202157, 0.2591432266,
                       0.7926986636, 0.7963415838, 0.7258694464, 0.6539092497,
                       0.0319417555, -0.1722823173, -0.2758014811, -0.3376131734);
    vec4 m = moments_at(map, s.at.xy, s.size) - vec4(0.035955884801, 0.0, 0.0, 0.0);
    float dark = msm_dark(mix(gather * m, MSM_MIDDLE, MSM_BIAS), clamp(s.at.z, 0.0, s.far));
    return dark > 0.0 && !shadow_outside(s) ? clamp(1.0 - dark * (1.0 / MSM_FULL), 0.0, 1.0) : 1.0;
}
