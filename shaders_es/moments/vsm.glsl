//@ names moments_of
// Two moments of a distance z, 0..1, both in 0..1: z and 4 (z - z^2). The variance is then x (1 - x) - y / 4 of their averages, and
// takes from rounding at most 1.25 steps of its storage, where z^2 in the second's place would cost 3.
vec4 moments_of(float z) { return vec4(z, 4.0 * z * (1.0 - z), 0.0, 0.0); }
