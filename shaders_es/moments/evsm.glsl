//@ names moments_of MOMENTS_CLEAR
// Exponents of a caster's distance z, 0..1, and their squares: e^(a z') and -e^(-b z') with z' = 2 z - 1. a, b: as large as their
// squares fit into the storage. Before them 1; where the map is clear, nothing.
const float MOMENTS_CLEAR = 0.9995; // of the far end all encodings are nearer to 1 than this, and no caster is, but those behind all that is seen

mat3x2 moments_of(float z) {
    vec2 w = exp(moments_exponents * vec2(2.0 * z - 1.0, 1.0 - 2.0 * z)) * vec2(1.0, -1.0);
    return z < MOMENTS_CLEAR ? mat3x2(vec2(1.0), w, w * w) : mat3x2(0.0);
}
