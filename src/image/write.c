#include "image/write.h"

#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/file.h"

bool gn_picture_format_of(const char *path, enum gn_picture_format *format, struct gn_err *err) {
    const char *dot = strrchr(path, '.');
    *format = dot && strcmp(dot, ".pfm") == 0 ? GN_PICTURE_PFM : GN_PICTURE_PNG;
    if (dot && (strcmp(dot, ".png") == 0 || *format == GN_PICTURE_PFM)) return true;
    return gn_fail_usage(err, "-o %s: unknown picture format: use .png or .pfm", path);
}

void *gn_picture_alloc(size_t pixels, size_t bytes, struct gn_err *err) {
    void *memory = calloc(pixels ? pixels : 1, bytes);
    if (!memory)
        gn_fail(err, "out of memory for a picture of %zu pixels: use a smaller --size or --map",
                pixels);
    return memory;
}

struct buffer {
    uint8_t *data;
    size_t size, room;
    bool full; /* out of memory */
};

static void append_bytes(png_structp png, png_bytep data, png_size_t size) {
    struct buffer *b = png_get_io_ptr(png);
    if (b->size + size > b->room && !b->full) {
        uint8_t *more = realloc(b->data, 2 * (b->size + size));
        if (more) b->data = more, b->room = 2 * (b->size + size);
        b->full = !more;
    }
    if (b->full) return;
    memcpy(b->data + b->size, data, size);
    b->size += size;
}

static void no_flush(png_structp png) { (void)png; }
static void ignore_warning(png_structp png, png_const_charp text) { (void)png, (void)text; }

/* rows: bit depth 8 RGB or RGBA, or 16 grey, big-endian, tightly packed. libpng can fail here only
 * for lack of memory for its small tables: it aborts. */
static struct buffer encode_png(const uint8_t *rows, int color_type, int depth, size_t stride,
                                int width_px, int height_px, bool srgb) {
    struct buffer buffer = {0};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, ignore_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) abort();
    png_set_write_fn(png, &buffer, append_bytes, no_flush);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_compression_level(png, 4);
    png_set_IHDR(png, info, (png_uint_32)width_px, (png_uint_32)height_px, depth, color_type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
    png_write_info(png, info);
    for (int y = 0; y < height_px; y++) png_write_row(png, rows + (size_t)y * stride);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return buffer;
}

static bool write_png(const char *path, const uint8_t *rows, int color_type, int depth,
                      size_t stride, int width_px, int height_px, bool srgb, struct gn_err *err) {
    struct buffer buffer = encode_png(rows, color_type, depth, stride, width_px, height_px, srgb);
    bool ok = buffer.full ? gn_fail(err, "%s: out of memory: use a smaller --size", path)
                          : gn_file_write(path, buffer.data, buffer.size, err);
    free(buffer.data);
    return ok;
}

bool gn_picture_encode_png8(const uint8_t *rgb, int width_px, int height_px, struct gn_bytes *out,
                            struct gn_err *err) {
    struct buffer buffer =
        encode_png(rgb, PNG_COLOR_TYPE_RGB, 8, (size_t)width_px * 3, width_px, height_px, true);
    *out = (struct gn_bytes){buffer.data, buffer.size};
    return !buffer.full ||
           gn_fail(err, "out of memory for a picture of %d x %d", width_px, height_px);
}

bool gn_picture_encode_png_rgba(const uint8_t *rgba, int width_px, int height_px,
                                struct gn_bytes *out, struct gn_err *err) {
    const size_t count = (size_t)width_px * (size_t)height_px;
    bool opaque = true;
    for (size_t i = 0; i < count; i++) opaque &= rgba[4 * i + 3] == 255;
    const size_t channels = opaque ? 3 : 4;
    uint8_t *rows = count > 0 ? malloc(count * channels) : NULL;
    *out = (struct gn_bytes){0};
    if (!rows) return gn_fail(err, "PNG: out of memory");
    for (size_t i = 0; i < count; i++) memcpy(rows + channels * i, rgba + 4 * i, channels);
    struct buffer buffer = encode_png(rows, opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA, 8,
                                      (size_t)width_px * channels, width_px, height_px, false);
    free(rows);
    *out = (struct gn_bytes){buffer.data, buffer.size};
    return !buffer.full || gn_fail(err, "PNG: out of memory");
}

bool gn_picture_write_png8(const char *path, const uint8_t *rgba, int width_px, int height_px,
                           bool srgb, struct gn_err *err) {
    size_t count = (size_t)width_px * (size_t)height_px;
    uint8_t *rgb = gn_picture_alloc(count, 3, err);
    if (!rgb) return false;
    for (size_t i = 0; i < count; i++) memcpy(rgb + 3 * i, rgba + 4 * i, 3);
    bool ok = write_png(path, rgb, PNG_COLOR_TYPE_RGB, 8, (size_t)width_px * 3, width_px, height_px,
                        srgb, err);
    free(rgb);
    return ok;
}

bool gn_picture_write_png8_alpha(const char *path, const uint8_t *rgba, int width_px, int height_px,
                                 bool srgb, struct gn_err *err) {
    return write_png(path, rgba, PNG_COLOR_TYPE_RGB_ALPHA, 8, (size_t)width_px * 4, width_px,
                     height_px, srgb, err);
}

bool gn_picture_write_png16_grey(const char *path, const float *grey, int width_px, int height_px,
                                 struct gn_err *err) {
    size_t count = (size_t)width_px * (size_t)height_px;
    uint8_t *rows = gn_picture_alloc(count, 2, err);
    if (!rows) return false;
    for (size_t i = 0; i < count; i++) {
        float clamped = grey[i] > 0.0f ? fminf(grey[i], 1.0f) : 0.0f;
        unsigned code = (unsigned)lrintf(clamped * 65535.0f);
        rows[2 * i] = (uint8_t)(code >> 8);
        rows[2 * i + 1] = (uint8_t)code;
    }
    bool ok = write_png(path, rows, PNG_COLOR_TYPE_GRAY, 16, (size_t)width_px * 2, width_px,
                        height_px, false, err);
    free(rows);
    return ok;
}

bool gn_picture_write_pfm(const char *path, const float *values, int channels, int width_px,
                          int height_px, struct gn_err *err) {
    char header[64];
    int length = snprintf(header, sizeof header, "%s\n%d %d\n-1.0\n", channels == 1 ? "Pf" : "PF",
                          width_px, height_px);
    size_t row = (size_t)width_px * (size_t)channels, count = row * (size_t)height_px;
    uint8_t *file = gn_picture_alloc((size_t)length + count, 4, err);
    if (!file) return false;
    memcpy(file, header, (size_t)length);
    for (int y = 0; y < height_px; y++)
        for (size_t x = 0; x < row; x++) { /* bottom row first, little-endian */
            uint8_t *to = file + length + 4 * ((size_t)(height_px - 1 - y) * row + x);
            uint32_t bits;
            memcpy(&bits, &values[(size_t)y * row + x], sizeof bits);
            for (int k = 0; k < 4; k++) to[k] = (uint8_t)(bits >> 8 * k);
        }
    bool ok = gn_file_write(path, file, (size_t)length + 4 * count, err);
    free(file);
    return ok;
}
