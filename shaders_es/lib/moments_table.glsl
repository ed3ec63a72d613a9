//@ names table_fixed
// Summed-area table (SAT): fixed-point sums that wrap around. Not filtered by samplers.
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS_SAMPLER usampler2D
#define MOMENTS_OUT uvec4

uvec4 table_fixed(vec4 moments, float reach) { return uvec4(moments * TABLE_SCALE(reach) + 0.5); }
