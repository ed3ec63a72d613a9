//@ names cone_store cone_fetch cone_at cone_depth
// Cone map as the bytes of two half floats, low byte first. What it holds: shadow/cone.glsl.
#include "lib/cone_linear.glsl"
#undef MOMENTS_SAMPLER
#undef MOMENTS_OUT
#define MOMENTS_SAMPLER sampler2D
#define MOMENTS_OUT vec4

vec4 cone_store(vec2 cone) {
    uint bits = packHalf2x16(cone);
    return vec4(bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u, bits >> 24) * (1.0 / 255.0);
}

vec2 cone_fetch(MOMENTS_SAMPLER cones, ivec2 texel) {
    uvec4 bytes = uvec4(texelFetch(cones, texel, 0) * 255.0 + 0.5);
    return unpackHalf2x16(bytes.x | bytes.y << 8 | bytes.z << 16 | bytes.w << 24);
}

// As in lib/cone_16f.glsl.
vec2 cone_at(MOMENTS_SAMPLER cones, vec2 uv) {
    vec2 size = vec2(textureSize(cones, 0));
    ivec4 at = cone_corners(uv, size);
    return cone_mix(cone_fetch(cones, at.xy), cone_fetch(cones, at.zy), cone_fetch(cones, at.xw), cone_fetch(cones, at.zw), uv, size);
}

// As in lib/cone_16f.glsl, without mipmaps.
float cone_depth(MOMENTS_SAMPLER cones, vec2 uv, vec2 cone, float texels) { return cone.y; }
