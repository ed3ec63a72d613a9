#include "image/scale.h"

#include <math.h>
#include <string.h>

#include "core/srgb.h"

/* How much of pixel i lies in low .. high. */
static double covered(uint32_t i, double low, double high) {
    return fmin(high, (double)i + 1) - fmax(low, (double)i);
}

/* The average of the rectangle at x, y: 4 floats, 0 to 1, in linear light if table is. */
static void average(const uint8_t *rgba, const uint32_t from[2], const float table[256],
                    const double low[2], const double high[2], float out[4]) {
    double sum[4] = {0}, area = 0;
    for (uint32_t y = (uint32_t)low[1]; y < from[1] && (double)y < high[1]; y++) {
        const double height = covered(y, low[1], high[1]);
        for (uint32_t x = (uint32_t)low[0]; x < from[0] && (double)x < high[0]; x++) {
            const double weight = height * covered(x, low[0], high[0]);
            const uint8_t *p = rgba + 4 * ((size_t)y * from[0] + x);
            for (int k = 0; k < 3; k++) sum[k] += weight * (double)table[p[k]];
            sum[3] += weight * p[3] / 255;
            area += weight;
        }
    }
    for (int k = 0; k < 4; k++) out[k] = (float)(sum[k] / area);
}

static void normalize(float v[3]) {
    float n[3], length = 0;
    for (int k = 0; k < 3; k++) {
        n[k] = 2 * v[k] - 1;
        length += n[k] * n[k];
    }
    length = sqrtf(length);
    for (int k = 0; k < 3 && length > 1e-6f; k++) v[k] = .5f + .5f * n[k] / length;
}

void gn_picture_scale(const uint8_t *rgba, const uint32_t from[2], enum gn_scale_kind kind,
                      uint8_t *out, const uint32_t to[2]) {
    float table[256];
    for (int i = 0; i < 256; i++)
        table[i] = kind == GN_SCALE_COLOR ? gn_srgb_decode((float)i / 255.0f) : (float)i / 255.0f;
    for (uint32_t y = 0; y < to[1]; y++)
        for (uint32_t x = 0; x < to[0]; x++) {
            const uint32_t at[] = {x, y};
            double low[2], high[2];
            for (int k = 0; k < 2; k++) {
                low[k] = (double)at[k] * from[k] / to[k];
                high[k] = ((double)at[k] + 1) * from[k] / to[k];
            }
            float c[4];
            average(rgba, from, table, low, high, c);
            if (kind == GN_SCALE_NORMALS) normalize(c);
            for (int k = 0; k < 4; k++) {
                const float value = k < 3 && kind == GN_SCALE_COLOR ? gn_srgb_encode(c[k]) : c[k];
                out[4 * ((size_t)y * to[0] + x) + (size_t)k] =
                    (uint8_t)lrintf(255 * fminf(fmaxf(value, 0), 1));
            }
        }
}
