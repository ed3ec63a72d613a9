#include "core/srgb.h"

#include <math.h>

float gn_srgb_decode(float code) {
    return code <= 0.04045f ? code / 12.92f : powf((code + 0.055f) / 1.055f, 2.4f);
}

float gn_srgb_encode(float linear) {
    linear = fminf(fmaxf(linear, 0.0f), 1.0f);
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1 / 2.4f) - 0.055f;
}
