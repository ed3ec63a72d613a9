//@ names moments_of MOMENTS_CLEAR
// Two moments of a caster's distance z, 0..1, both in 0..1: z and 4 (z - z^2), and 1; where the map is clear, nothing. Averages are
// those over casters, times the share that these have. The variance is then x (1 - x) - y / 4 of x and y by w, and takes from
// rounding at most 1.25 steps of its storage, where z^2 in the second's place would cost 3.
const float MOMENTS_CLEAR = 0.9995; // of the far end all encodings are nearer to 1 than this, and no caster is, but those behind all that is seen

vec4 moments_of(float z) { return z < MOMENTS_CLEAR ? vec4(z, 4.0 * z * (1.0 - z), 0.0, 1.0) : vec4(0.0); }
