//@ names moments_of MOMENTS_CLEAR
// Exponential moments of a caster's distance z, 0..1: 1 (coverage), the warps e^(a z') and -e^(-b z') with z' = 2 z - 1, and
// their squares; 0 where the map is empty. a and b are the largest whose squares fit into the storage.

// Distances above this are empty texels: the far end is, in every encoding; of casters only those behind everything visible are.
const float MOMENTS_CLEAR = 0.9995;

mat3x2 moments_of(float z) {
    vec2 w = exp(moments_exponents * vec2(2.0 * z - 1.0, 1.0 - 2.0 * z)) * vec2(1.0, -1.0);
    return z < MOMENTS_CLEAR ? mat3x2(vec2(1.0), w, w * w) : mat3x2(0.0);
}
