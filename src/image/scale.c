#include "image/scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/srgb.h"

enum { SUMS = 5 };

/* How much of pixel i lies in low .. high. */
static double covered(uint32_t i, double low, double high) {
    return fmin(high, (double)i + 1) - fmax(low, (double)i);
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

static float clamp(float value) { return value < 0 ? 0 : value > 1 ? 1 : value; }

static uint8_t to_byte(float value) { return (uint8_t)lrintf(255 * clamp(value)); }

/* Of linear light. Where both ends of a step have one code, so has what is between them. */
static uint8_t color_code(const struct gn_scaler *s, float linear) {
    const uint8_t *step = s->codes + (int)(clamp(linear) * GN_SCALER_CODES);
    const bool sure = linear < 1 && step[0] == step[1];
    return sure ? step[0] : to_byte(gn_srgb_encode(linear));
}

uint64_t gn_scaler_bytes(const uint32_t to[2]) { return (uint64_t)to[0] * SUMS * sizeof(double); }

bool gn_scaler_init(struct gn_scaler *s, const uint32_t from[2], enum gn_scale_kind kind,
                    uint8_t *out, const uint32_t to[2]) {
    *s = (struct gn_scaler){
        .from = {from[0], from[1]}, .to = {to[0], to[1]}, .kind = kind, .out = out};
    for (int i = 0; i < 256; i++) {
        const float value = (float)i / 255.0f;
        s->table[i] = (double)(kind == GN_SCALE_COLOR ? gn_srgb_decode(value) : value);
        s->alpha[i] = (double)i / 255;
    }
    for (int i = 0; i <= GN_SCALER_CODES && kind == GN_SCALE_COLOR; i++)
        s->codes[i] = to_byte(gn_srgb_encode((float)i / GN_SCALER_CODES));
    s->sums = calloc(to[0], SUMS * sizeof *s->sums);
    return s->sums;
}

void gn_scaler_finish(struct gn_scaler *s) { free(s->sums); }

/* Where pixel i of `to` begins in `from`, of that axis; its end is where the next begins. */
static double edge_of(const struct gn_scaler *s, int axis, uint32_t i) {
    return (double)i * s->from[axis] / s->to[axis];
}

/* A pixel of the row whose part `height` is in the row that is being made. */
static void add_pixel(const struct gn_scaler *s, const uint8_t *p, double weight, double *sum) {
    for (int k = 0; k < 3; k++) sum[k] += weight * s->table[p[k]];
    sum[3] += weight * p[3] / 255;
    sum[4] += weight;
}

/* Those that are covered as a whole. */
static void add_pixels(const struct gn_scaler *s, const uint8_t *p, uint32_t count, double *sum) {
    double r = sum[0], g = sum[1], b = sum[2], a = sum[3];
    for (uint32_t i = 0; i < count; i++, p += 4) {
        r += s->table[p[0]];
        g += s->table[p[1]];
        b += s->table[p[2]];
        a += s->alpha[p[3]];
    }
    memcpy(sum, (double[]){r, g, b, a, sum[4] + count}, SUMS * sizeof *sum);
}

static void add_row(struct gn_scaler *s, const uint8_t *rgba, double height) {
    const uint32_t each = s->from[0] / s->to[0];
    const bool whole = height == 1 && each * s->to[0] == s->from[0];
    for (uint32_t i = 0; i < s->to[0]; i++) {
        double *sum = s->sums + (size_t)SUMS * i;
        if (whole) {
            add_pixels(s, rgba + (size_t)4 * each * i, each, sum);
            continue;
        }
        const double low = edge_of(s, 0, i), high = edge_of(s, 0, i + 1);
        for (uint32_t x = (uint32_t)low; x < s->from[0] && (double)x < high; x++)
            add_pixel(s, rgba + (size_t)4 * x, height * covered(x, low, high), sum);
    }
}

static void write_row(struct gn_scaler *s) {
    uint8_t *out = s->out + (size_t)4 * s->to[0] * s->written++;
    for (uint32_t i = 0; i < s->to[0]; i++) {
        const double *sum = s->sums + (size_t)SUMS * i;
        float c[4];
        for (int k = 0; k < 4; k++) c[k] = (float)(sum[k] / sum[4]);
        if (s->kind == GN_SCALE_NORMALS) normalize(c);
        for (int k = 0; k < 4; k++)
            *out++ = k < 3 && s->kind == GN_SCALE_COLOR ? color_code(s, c[k]) : to_byte(c[k]);
    }
    memset(s->sums, 0, s->to[0] * SUMS * sizeof *s->sums);
}

/* It may be cut by the edge between two rows that are made. */
void gn_scaler_row(void *scaler, const uint8_t *rgba) {
    struct gn_scaler *s = scaler;
    const uint32_t y = s->read++;
    while (s->written < s->to[1]) {
        const double low = edge_of(s, 1, s->written), high = edge_of(s, 1, s->written + 1);
        if (low >= (double)y + 1) break;
        add_row(s, rgba, covered(y, low, high));
        if (high > (double)y + 1) break;
        write_row(s);
    }
}
