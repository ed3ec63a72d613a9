// Alpha of an unseen floor times its weight, and that, in bytes, filtered by the sampler (filter/floor.frag).
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS_SAMPLER sampler2D
#define MOMENTS_OUT vec4
