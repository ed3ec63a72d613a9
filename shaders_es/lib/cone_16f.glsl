//@ names cone_store cone_fetch cone_at cone_depth
// Cone map as half floats, filtered by the sampler. What it holds: shadow/cone.glsl.
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS_SAMPLER sampler2D
#define MOMENTS_OUT vec2

vec2 cone_store(vec2 cone) { return cone; }

vec2 cone_fetch(MOMENTS_SAMPLER cones, ivec2 texel) { return texelFetch(cones, texel, 0).rg; }

// Bilinear lookup at uv (0..1 over the map), clamped to the edge.
vec2 cone_at(MOMENTS_SAMPLER cones, vec2 uv) { return textureLod(cones, uv, 0.0).rg; }

// Depth of the first blocker, the mean over a square of about as many texels of the cone map to each side; cone: at uv. Maps of
// several tiles have no mipmaps: there it is that at uv.
float cone_depth(MOMENTS_SAMPLER cones, vec2 uv, vec2 cone, float texels) { return textureLod(cones, uv, log2(texels)).g; }
