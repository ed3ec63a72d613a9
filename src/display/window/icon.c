#include "display/window/icon.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

enum { SAMPLES = 4 }; /* to each side of a pixel */

static const uint8_t plate[3] = {0xe8, 0xdc, 0xc0}, rim[3] = {0x8a, 0x6a, 0x3a},
                     shadow[3] = {0x5a, 0x52, 0x4a}, blade[3] = {0xd0, 0x7a, 0x20};

/* Whether the point is in the triangle, whose corners go round in either direction. */
static bool is_inside(const float t[3][2], float x, float y) {
    bool left = false, right = false;
    for (int i = 0; i < 3; i++) {
        const float *a = t[i], *b = t[(i + 1) % 3];
        const float side = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        left |= side < 0.0f;
        right |= side > 0.0f;
    }
    return !(left && right);
}

/* x, y: -1..1 from the centre, y down. NULL: outside of the dial. */
static const uint8_t *color_at(float x, float y) {
    static const float gnomon[3][2] = {{-0.1f, 0.35f}, {0.1f, 0.35f}, {0.05f, -0.8f}};
    static const float cast[3][2] = {{-0.1f, 0.35f}, {0.1f, 0.35f}, {0.72f, -0.1f}};
    const float r = hypotf(x, y);
    if (r > 0.98f) return NULL;
    if (is_inside(gnomon, x, y)) return blade;
    if (r > 0.84f) return rim;
    return is_inside(cast, x, y) ? shadow : plate;
}

void gn_window_icon(uint8_t *rgba, int side) {
    for (int i = 0; i < side * side; i++) {
        const int row = i / side;
        unsigned sum[3] = {0}, hits = 0;
        for (int k = 0; k < SAMPLES * SAMPLES; k++) {
            const int sub_row = k / SAMPLES;
            const float x = (float)(i % side) + ((float)(k % SAMPLES) + 0.5f) / SAMPLES,
                        y = (float)row + ((float)sub_row + 0.5f) / SAMPLES;
            const uint8_t *c =
                color_at(2.0f * x / (float)side - 1.0f, 2.0f * y / (float)side - 1.0f);
            for (int j = 0; c && j < 3; j++) sum[j] += c[j];
            hits += c ? 1 : 0;
        }
        for (int j = 0; j < 3; j++) rgba[4 * i + j] = hits ? (uint8_t)(sum[j] / hits) : 0;
        rgba[4 * i + 3] = (uint8_t)(255 * hits / (SAMPLES * SAMPLES));
    }
}
