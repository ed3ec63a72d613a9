//@ names moments_of
// Moments z .. z^4 of a distance, 0..1, under an affine transform that makes each fill 0..1 and minimises rounding errors: the
// quantisation of Peters and Klein, "Moment Shadow Mapping", I3D 2015.
vec4 moments_of(float z) {
    float z2 = z * z;
    mat4 spread = mat4(-2.07224649, 13.7948857237, 0.105877704, 9.7924062118,
                       32.23703778, -59.4683975703, -1.9077466311, -33.7652110555,
                       -68.571074599, 82.0359750338, 9.3496555107, 47.9456096605,
                       39.3703274134, -35.364903257, -6.6543490743, -23.9728048165);
    return spread * vec4(z, z2, z * z2, z2 * z2) + vec4(0.035955884801, 0.0, 0.0, 0.0);
}
