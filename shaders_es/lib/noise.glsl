// Per-pixel rotation of the sample pattern by 0..360 degrees: undersampling becomes noise instead of banding. Deterministic; the
// identity if TAPS_TURN is false. Interleaved gradient noise: Jimenez, "Next Generation Post Processing in Call of Duty: Advanced
// Warfare", SIGGRAPH 2014.
mat2 noise_turn() {
    if (!TAPS_TURN) return mat2(1.0);
    float angle = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    float c = cos(angle), s = sin(angle);
    return mat2(c, s, -s, c);
}
