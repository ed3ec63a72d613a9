#include "image/picture.h"

#include <math.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

enum { SIDE_MAX = 32768 };

void gn_picture_init(struct gn_picture *picture, int width_px, int height_px, int channels) {
    *picture = (struct gn_picture){width_px, height_px, channels, NULL};
    picture->data = gn_xalloc((size_t)width_px * height_px * channels, sizeof(float));
}

void gn_picture_finish(struct gn_picture *picture) {
    free(picture->data);
    *picture = (struct gn_picture){0};
}

float *gn_picture_at(const struct gn_picture *picture, int x, int y) {
    return picture->data + ((size_t)y * picture->width_px + x) * picture->channels;
}

static bool size_is_sane(long width, long height) {
    return width > 0 && height > 0 && width <= SIDE_MAX && height <= SIDE_MAX;
}

/* PFM: "Pf" or "PF", width, height, scale (negative: little-endian), one white space, rows from the
 * bottom up */

static float pfm_float(const uint8_t b[4], bool little) {
    uint32_t bits =
        little ? (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24
               : (uint32_t)b[3] | (uint32_t)b[2] << 8 | (uint32_t)b[1] << 16 | (uint32_t)b[0] << 24;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool read_pfm(struct gn_picture *picture, FILE *file, const char *path, struct gn_err *err) {
    char kind;
    long width, height;
    double scale;
    if (fscanf(file, "P%c %ld %ld %lf", &kind, &width, &height, &scale) != 4 ||
        (kind != 'f' && kind != 'F') || !size_is_sane(width, height) || scale == 0 ||
        fgetc(file) == EOF)
        return gn_fail(err, "%s: bad PFM header", path);
    gn_picture_init(picture, (int)width, (int)height, kind == 'F' ? 3 : 1);
    size_t row_floats = (size_t)width * picture->channels;
    uint8_t *row = gn_xalloc(row_floats, 4);
    for (long y = height - 1; y >= 0; y--) {
        if (fread(row, 4, row_floats, file) != row_floats) {
            free(row);
            gn_picture_finish(picture);
            return gn_fail(err, "%s: ends %ld rows early", path, y + 1);
        }
        float *out = gn_picture_at(picture, 0, (int)y);
        for (size_t i = 0; i < row_floats; i++) out[i] = pfm_float(row + 4 * i, scale < 0);
    }
    free(row);
    if (fgetc(file) == EOF) return true;
    gn_picture_finish(picture);
    return gn_fail(err, "%s: bytes after the last row", path);
}

/* --- PNG --- */

static void png_failed(png_structp png, png_const_charp message) {
    gn_fail(png_get_error_ptr(png), "%s", message);
    longjmp(png_jmpbuf(png), 1);
}

static void png_warned(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

static void to_floats(struct gn_picture *picture, const uint8_t *bytes, bool wide) {
    size_t count = (size_t)picture->width_px * picture->height_px * picture->channels;
    for (size_t i = 0; i < count; i++)
        picture->data[i] =
            wide ? (float)(bytes[2 * i] << 8 | bytes[2 * i + 1]) / 65535 : (float)bytes[i] / 255;
}

static bool read_png(struct gn_picture *picture, FILE *file, const char *path, struct gn_err *err) {
    struct gn_err said = {0};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &said, png_failed, png_warned);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    uint8_t *volatile bytes = NULL;
    png_bytep *volatile rows = NULL;
    volatile bool ok = false;
    if (info && !setjmp(png_jmpbuf(png))) {
        png_init_io(png, file);
        png_read_info(png, info);
        png_set_expand(png);
        png_read_update_info(png, info);
        int height = (int)png_get_image_height(png, info);
        size_t stride = png_get_rowbytes(png, info);
        bool wide = png_get_bit_depth(png, info) == 16;
        if (!size_is_sane((long)png_get_image_width(png, info), height))
            png_error(png, "too large");
        bytes = gn_xalloc(height, stride);
        rows = gn_xalloc(height, sizeof *rows);
        for (int y = 0; y < height; y++) rows[y] = bytes + y * stride;
        png_read_image(png, rows);
        png_read_end(png, NULL);
        gn_picture_init(picture, (int)png_get_image_width(png, info), height,
                        png_get_channels(png, info));
        to_floats(picture, bytes, wide);
        ok = true;
    }
    png_destroy_read_struct(&png, &info, NULL);
    free(rows);
    free(bytes);
    return ok || gn_fail(err, "%s: %s", path, said.text[0] ? said.text : "not a PNG");
}

bool gn_picture_read(struct gn_picture *picture, const char *path, struct gn_err *err) {
    *picture = (struct gn_picture){0};
    FILE *file = fopen(path, "rb");
    if (!file) return gn_fail(err, "%s: cannot be read", path);
    int first = fgetc(file);
    rewind(file);
    bool ok =
        first == 'P' ? read_pfm(picture, file, path, err) : read_png(picture, file, path, err);
    fclose(file);
    return ok;
}

static uint8_t to_byte(float v) { return !(v > 0) ? 0 : v >= 1 ? 255 : (uint8_t)lrintf(255 * v); }

static uint8_t *to_bytes(const struct gn_picture *picture) {
    size_t count = (size_t)picture->width_px * picture->height_px;
    uint8_t *bytes = gn_xalloc(count, picture->channels);
    for (size_t i = 0; i < count; i++) {
        const float *v = picture->data + i * picture->channels;
        uint8_t *b = bytes + i * picture->channels;
        for (int c = 0; c < picture->channels; c++)
            b[c] = isnan(v[c]) && picture->channels > 2 && c != 1 ? 255 : to_byte(v[c]);
    }
    return bytes;
}

bool gn_picture_write_png(const struct gn_picture *picture, const char *path, struct gn_err *err) {
    static const png_uint_32 formats[5] = {0, PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB,
                                           PNG_FORMAT_RGBA};
    uint8_t *bytes = to_bytes(picture);
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)picture->width_px,
                       .height = (png_uint_32)picture->height_px,
                       .format = formats[picture->channels]};
    int ok = png_image_write_to_file(&image, path, 0, bytes, 0, NULL);
    free(bytes);
    return ok ? true : gn_fail(err, "%s: %s", path, image.message);
}
