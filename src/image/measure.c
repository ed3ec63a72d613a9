#include "image/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"
#include "image/read.h"
#include "image/write.h"

enum { SIDE_MAX = 32768 };
static const size_t FILE_MAX = (size_t)1 << 30;

/* ---- PFM: "Pf" or "PF", width, height, scale (negative: little-endian), one white space, rows
 * from the bottom up ---- */

static bool is_space(uint8_t byte) { return byte == ' ' || (byte >= '\t' && byte <= '\r'); }

/* A number of the header between white space; NAN: none. *at is left behind it. The file's bytes
 * end in a zero, and a number has no white space in it. */
static double read_number(const struct gn_bytes *file, size_t *at) {
    size_t from = *at;
    while (from < file->size && is_space(file->data[from])) from++;
    char *end;
    const char *text = (const char *)file->data + from;
    if (from == *at || from == file->size || !strchr("+-.0123456789", text[0])) return NAN;
    const double number = strtod(text, &end);
    *at = (size_t)(end - (const char *)file->data);
    return end > text && *at < file->size && is_space(file->data[*at]) ? number : NAN;
}

static float read_float(const uint8_t *b, bool little) {
    const uint32_t bits =
        little ? (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24
               : (uint32_t)b[3] | (uint32_t)b[2] << 8 | (uint32_t)b[1] << 16 | (uint32_t)b[0] << 24;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool is_side(double number) {
    return number >= 1 && number <= SIDE_MAX && number == floor(number);
}

static bool read_pfm(struct gn_pixels *pixels, const struct gn_bytes *file, struct gn_err *err) {
    const size_t channels = file->data[1] == 'F' ? 3 : 1;
    size_t at = 2;
    const double width = read_number(file, &at), height = read_number(file, &at),
                 scale = read_number(file, &at);
    if (!is_side(width) || !is_side(height) || !isfinite(scale) || scale == 0)
        return gn_fail(err, "PFM: bad header: expected PF, width, height, scale");
    at++;
    const size_t w = (size_t)width, h = (size_t)height, row_bytes = 4 * channels * w;
    if (file->size - at != row_bytes * h)
        return gn_fail(err, "PFM: %zu bytes of pixels, not the %zu of %zux%zu", file->size - at,
                       row_bytes * h, w, h);
    pixels->rgb = gn_picture_alloc(w * h, 3 * sizeof *pixels->rgb, err);
    if (!pixels->rgb) return false;
    pixels->width_px = w;
    pixels->height_px = h;
    for (size_t y = 0; y < h; y++)
        for (size_t i = 0; i < 3 * w; i++) {
            const size_t from = channels == 3 ? i : i / 3;
            pixels->rgb[y * 3 * w + i] =
                read_float(file->data + at + (h - 1 - y) * row_bytes + 4 * from, scale < 0);
        }
    return true;
}

/* ---- PNG ---- */

static bool read_png(struct gn_pixels *pixels, const struct gn_bytes *file, struct gn_err *err) {
    uint32_t px[2];
    if (!gn_png_size(file->data, file->size, px, err)) return false;
    if (px[0] == 0 || px[1] == 0 || px[0] > SIDE_MAX || px[1] > SIDE_MAX)
        return gn_fail(err, "PNG: %ux%u pixels, expected 1 to %d a side", px[0], px[1], SIDE_MAX);
    const size_t count = (size_t)px[0] * px[1];
    uint16_t *rgba = gn_picture_alloc(count, 4 * sizeof *rgba, err);
    pixels->rgb = rgba ? gn_picture_alloc(count, 3 * sizeof *pixels->rgb, err) : NULL;
    const bool ok = pixels->rgb && gn_png_read_16(file->data, file->size, px, rgba, err);
    for (size_t i = 0; ok && i < count; i++)
        for (size_t c = 0; c < 3; c++) pixels->rgb[3 * i + c] = (float)rgba[4 * i + c] / 65535.0f;
    pixels->width_px = px[0];
    pixels->height_px = px[1];
    free(rgba);
    return ok;
}

bool gn_pixels_load(struct gn_pixels *pixels, const char *path, struct gn_err *err) {
    static const uint8_t png[] = {0x89, 'P', 'N', 'G'};
    struct gn_bytes file;
    *pixels = (struct gn_pixels){0};
    if (!gn_file_read(path, FILE_MAX, &file, err)) return false;
    bool ok;
    if (file.size >= sizeof png && memcmp(file.data, png, sizeof png) == 0)
        ok = read_png(pixels, &file, err);
    else if (file.size >= 2 && file.data[0] == 'P' && (file.data[1] | 32) == 'f')
        ok = read_pfm(pixels, &file, err);
    else
        ok = gn_fail(err, "neither PNG nor PFM");
    gn_bytes_finish(&file);
    if (ok) return true;
    gn_pixels_finish(pixels);
    return gn_fail_prefix(err, "%s", path);
}

void gn_pixels_finish(struct gn_pixels *pixels) {
    free(pixels->rgb);
    *pixels = (struct gn_pixels){0};
}

/* ---- the measures ---- */

double gn_measure_channel(float a, float b) {
    if (a == b || (isnan(a) && isnan(b))) return 0;
    const double d = fabs((double)a - (double)b);
    return isnan(d) ? INFINITY : d;
}

void gn_measure(const float *a, const float *b, size_t width_px, size_t height_px, int channels,
                double tolerance, struct gn_measure *measure) {
    const size_t pixels = width_px * height_px, each = (size_t)channels;
    size_t over = 0;
    double squares = 0;
    *measure = (struct gn_measure){0};
    for (size_t i = 0; i < pixels; i++) {
        double worst = 0;
        for (size_t c = 0; c < each; c++) {
            const double d = gn_measure_channel(a[i * each + c], b[i * each + c]);
            worst = fmax(worst, d);
            squares += d * d;
        }
        over += worst > tolerance;
        if (worst > measure->max) {
            measure->max = worst;
            measure->worst_x = i % width_px;
            measure->worst_y = i / width_px;
        }
    }
    measure->share = (double)over / (double)pixels;
    measure->rmse = sqrt(squares / ((double)pixels * channels));
}

double gn_measure_psnr_db(const struct gn_measure *measure) { return -20 * log10(measure->rmse); }
