// Alpha of an unseen floor in a byte, filtered by the sampler (filter/floor.frag).
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS_SAMPLER sampler2D
#define MOMENTS_OUT vec4
