//@ names cone_store cone_fetch cone_at cone_depth
// Cone map as the bits of two half floats in an integer, to which every ES 3.0 GPU draws. What it holds: shadow/cone.glsl.
#include "lib/cone_linear.glsl"
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS_SAMPLER usampler2D
#define MOMENTS_OUT uvec4

uvec4 cone_store(vec2 cone) { return uvec4(packHalf2x16(cone), 0u, 0u, 1u); }

vec2 cone_fetch(MOMENTS_SAMPLER cones, ivec2 texel) { return unpackHalf2x16(texelFetch(cones, texel, 0).r); }

// As in lib/cone_16f.glsl.
vec2 cone_at(MOMENTS_SAMPLER cones, vec2 uv) {
    vec2 size = vec2(textureSize(cones, 0));
    ivec4 at = cone_corners(uv, size);
    return cone_mix(cone_fetch(cones, at.xy), cone_fetch(cones, at.zy), cone_fetch(cones, at.xw), cone_fetch(cones, at.zw), uv, size);
}

// As in lib/cone_16f.glsl, without mipmaps.
float cone_depth(MOMENTS_SAMPLER cones, vec2 uv, vec2 cone, float texels) { return cone.y; }
