//@ names moments_store moments_fetch moments_at moments_step
// Moments as half floats, filtered by the sampler. MOMENTS_MIDDLE is subtracted: half floats are most precise near 0.
#undef MOMENTS
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS vec4
#define MOMENTS_SAMPLER sampler2D
#define MOMENTS_OUT vec4

const float moments_step = 1.0 / 4096.0;

vec4 moments_store(vec4 m) { return m - MOMENTS_MIDDLE; }

vec4 moments_fetch(MOMENTS_SAMPLER map, ivec2 texel) { return texelFetch(map, texel, 0) + MOMENTS_MIDDLE; }

vec4 moments_at(MOMENTS_SAMPLER map, vec2 uv, vec4 size) { return texture(map, uv) + MOMENTS_MIDDLE; }
