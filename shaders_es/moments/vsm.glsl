//@ names moments_of MOMENTS_CLEAR
// Moments of a caster's distance z, 0..1: x = z, y = 4 (z - z^2), w = 1 (coverage); 0 where the map is empty. All are in 0..1.
// After averaging they are means over casters times the fraction w of texels covered by casters. With x and y divided by w, the
// variance is x (1 - x) - y / 4. Rounding changes it by at most 1.25 steps of the storage; with z^2 instead of y it would be 3.

// Distances above this are empty texels: the far end is, in every encoding; of casters only those behind everything visible are.
const float MOMENTS_CLEAR = 0.9995;

vec4 moments_of(float z) { return z < MOMENTS_CLEAR ? vec4(z, 4.0 * z * (1.0 - z), 0.0, 1.0) : vec4(0.0); }
