//@ names moments_of
// Four moments of z = 2 c - 1, c the code, 0..1, in a basis that minimises rounding errors and stays within 0..1 (Peters, "Moment
// Shadow Mapping for Translucent Occluders, Soft Shadows and Single Scattering", JCGT 6 (1), 2017).
vec4 moments_of(float c) {
    float z = 2.0 * c - 1.0, z2 = z * z;
    return vec4(0.5 + z * (1.5 - 2.0 * z2), 4.0 * z2 * (1.0 - z2), 0.5 + z * (0.8660254 - 0.3849002 * z2), 0.5 * z2 * (1.0 + z2));
}
