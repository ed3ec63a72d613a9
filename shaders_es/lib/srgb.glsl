// IEC 61966-2-1. color: linear, clamped to 0..1 here.
vec3 srgb_from_linear(vec3 color) {
    vec3 c = clamp(color, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}
