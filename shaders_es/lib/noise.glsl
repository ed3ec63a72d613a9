// Per-pixel rotation of the sample pattern by 0..360 degrees: undersampling becomes noise instead of banding. Deterministic; the
// identity if TAPS_TURN is false. Interleaved gradient noise: Jimenez, "Next Generation Post Processing in Call of Duty: Advanced
// Warfare", SIGGRAPH 2014.
float noise_gradient() { return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }

mat2 noise_turn() {
    if (!TAPS_TURN) return mat2(1.0);
    float angle = 6.2831853 * noise_gradient();
    float c = cos(angle), s = sin(angle);
    return mat2(c, s, -s, c);
}

// Cosine and sine of a rotation by 0..90 degrees, without either function: for patterns that a quarter turn maps to themselves.
vec2 noise_quarter() {
    if (!TAPS_TURN) return vec2(1.0, 0.0);
    float u = noise_gradient(), w = 1.0 / (1.0 + u * u);
    return vec2(w - u * u * w, 2.0 * u * w);
}
