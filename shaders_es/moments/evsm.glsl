//@ names moments_of
// Exponents of a distance z, 0..1, and their squares: e^(a z') and -e^(-b z') with z' = 2 z - 1. a, b: as large as their squares fit
// into the storage.
vec4 moments_of(float z) {
    vec2 w = exp(moments_exponents * vec2(2.0 * z - 1.0, 1.0 - 2.0 * z)) * vec2(1.0, -1.0);
    return vec4(w, w * w);
}
