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

// The same value for each two by two pixels. pair: where in them the pixel is, 1/4 or 3/4.
float noise_quad(vec2 pair) {
    if (!TAPS_TURN) return 0.47;
    return fract(52.9829189 * fract(dot(0.5 * gl_FragCoord.xy - pair, vec2(0.06711056, 0.00583715))));
}
