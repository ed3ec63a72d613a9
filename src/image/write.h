/* Writes pictures: PNG by libpng, PFM (Debevec's float map, little-endian, bottom row first).
 * Written whole or not at all. */
#ifndef GN_IMAGE_WRITE_H
#define GN_IMAGE_WRITE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"
#include "core/file.h"

enum gn_picture_format { GN_PICTURE_PNG, GN_PICTURE_PFM };
/* By the name's suffix; a usage error for any other. */
bool gn_picture_format_of(const char *path, enum gn_picture_format *format, struct gn_err *err);

/* Zeroed memory for pixels of so many bytes each, freed by free(). The user chooses the size, so
 * out of memory is a runtime error: NULL. */
void *gn_picture_alloc(size_t pixels, size_t bytes, struct gn_err *err);

/* All take the top row first. srgb: marks the values as sRGB-encoded. */
bool gn_picture_write_png8(const char *path, const uint8_t *rgba, int width_px, int height_px,
                           bool srgb, struct gn_err *err);
/* The same with straight alpha. */
bool gn_picture_write_png8_alpha(const char *path, const uint8_t *rgba, int width_px, int height_px,
                                 bool srgb, struct gn_err *err);
/* From RGB, sRGB-encoded, into memory; gn_bytes_finish() frees it also after a failure.
 * May run in any thread. */
bool gn_picture_encode_png8(const uint8_t *rgb, int width_px, int height_px, struct gn_bytes *out,
                            struct gn_err *err);
/* From RGBA, in memory likewise. PNG: without an alpha that is 255 everywhere, of no colour space;
 * JPEG: without alpha, quality 92, colour at full resolution; WebP: lossless, or of that quality.
 */
bool gn_picture_encode_png_rgba(const uint8_t *rgba, int width_px, int height_px,
                                struct gn_bytes *out, struct gn_err *err);
bool gn_picture_encode_jpeg(const uint8_t *rgba, int width_px, int height_px, struct gn_bytes *out,
                            struct gn_err *err);
bool gn_picture_encode_webp(const uint8_t *rgba, int width_px, int height_px, bool lossless,
                            struct gn_bytes *out, struct gn_err *err);
bool gn_webp_is_lossless(const uint8_t *data, size_t size);
bool gn_picture_write_png16_grey(const char *path, const float *grey, int width_px, int height_px,
                                 struct gn_err *err);
/* channels: 1 or 3 */
bool gn_picture_write_pfm(const char *path, const float *values, int channels, int width_px,
                          int height_px, struct gn_err *err);

#endif
