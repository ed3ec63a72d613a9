// Bilinear filtering of a cone map that no sampler filters. size: that of the cone map in texels.

// Lower left (xy) and upper right (zw) of the four texels around uv (0..1 over the map), clamped to the edge.
ivec4 cone_corners(vec2 uv, vec2 size) {
    ivec2 low = ivec2(floor(uv * size - 0.5)), last = ivec2(size) - 1;
    return ivec4(clamp(low, ivec2(0), last), clamp(low + 1, ivec2(0), last));
}

// Cones at (0,0) (1,0) (0,1) (1,1) of the corners.
vec2 cone_mix(vec2 a, vec2 b, vec2 c, vec2 d, vec2 uv, vec2 size) {
    vec2 weight = fract(uv * size - 0.5);
    return mix(mix(a, b, weight.x), mix(c, d, weight.x), weight.y);
}
