/* Texels of three small floats: GL_R11F_G11F_B10F. */
#include "environment/environment.h"

#include <math.h>

/* An unsigned float of 5 bits of exponent, rounded; at most the format's largest number. */
static uint32_t small_float(float v, int mantissa_bits) {
    const float ones = (float)(1 << mantissa_bits), most = 65536.0f * (1.0f - 0.5f / ones);
    int exponent;
    if (!(v > 0.0f)) return 0;
    v = fminf(v, most);
    if (v < 0x1p-14f) return (uint32_t)roundf(v * 0x1p14f * ones);
    const float mantissa = 2.0f * frexpf(v, &exponent) - 1.0f;
    const uint32_t biased = (uint32_t)(exponent - 1 + 15);
    return (biased << mantissa_bits) + (uint32_t)roundf(mantissa * ones);
}

static float from_small_float(uint32_t bits, int mantissa_bits) {
    const float ones = (float)(1 << mantissa_bits);
    const uint32_t exponent = bits >> mantissa_bits, mantissa = bits & ((1u << mantissa_bits) - 1);
    if (exponent == 0) return (float)mantissa / ones * 0x1p-14f;
    return ldexpf(1.0f + (float)mantissa / ones, (int)exponent - 15);
}

uint32_t gn_environment_pack(const float rgb[3]) {
    return small_float(rgb[0], 6) | small_float(rgb[1], 6) << 11 | small_float(rgb[2], 5) << 22;
}

void gn_environment_unpack(uint32_t texel, float rgb[3]) {
    rgb[0] = from_small_float(texel & 0x7ff, 6);
    rgb[1] = from_small_float(texel >> 11 & 0x7ff, 6);
    rgb[2] = from_small_float(texel >> 22, 5);
}
