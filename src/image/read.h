/* Reading PNG, JPEG, WebP and Radiance pictures from memory. Messages begin with the name of the
 * format.
 */
#ifndef GN_IMAGE_READ_H
#define GN_IMAGE_READ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

/* A row of RGBA, from the top; valid during the call. */
typedef void gn_picture_row(void *user, const uint8_t *rgba);

/* The size in the header; then the pixels, width x height x 4 bytes of RGBA, top row first. shrink:
 * the decoder leaves out detail, so that the pixels are those of a picture with sides of
 * gn_shrunk_px, at most GN_SHRINK_MOST.
 */
bool gn_png_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
bool gn_png_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                 uint8_t *rgba, struct gn_err *err);
/* So many rows from the top, of one whose rows follow each other in the file. A shrunk one is of
 * the first passes. */
bool gn_png_is_interlaced(const uint8_t *data);
bool gn_png_is_deep(const uint8_t *data); /* 16 bits a channel */
bool gn_png_rows(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t count,
                 gn_picture_row *row, void *user, struct gn_err *err);
/* All of it in 16 bits each, of the machine's byte order; of 8 bits v becomes 257 v. */
bool gn_png_read_16(const uint8_t *data, size_t size, const uint32_t px[2], uint16_t *rgba,
                    struct gn_err *err);
/* Of a PNG whose size was read: it has a channel of alpha, or colours that are transparent. */
bool gn_png_has_alpha(const uint8_t *data, size_t size);
bool gn_jpeg_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
bool gn_jpeg_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                  uint8_t *rgba, struct gn_err *err);
/* Lossy and lossless, no animations; false everywhere in a build without libwebp. */
bool gn_webp_is_read(void);
bool gn_webp_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
bool gn_webp_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                  uint8_t *rgba, struct gn_err *err);

/* Radiance (.hdr): rows from the top, each of width x 4 bytes of RGBE, valid during the call. At
 * most 33554432 pixels. EXPOSURE= is ignored, as viewers do. */
typedef void gn_hdr_row(void *user, uint32_t y, const uint8_t *rgbe);
bool gn_hdr_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
bool gn_hdr_read(const uint8_t *data, size_t size, gn_hdr_row *row, void *user, struct gn_err *err);
/* Linear colour of one pixel: mantissa x 2^(exponent - 136), as Radiance's viewers without the
 * half. */
void gn_hdr_color(const uint8_t rgbe[4], float rgb[3]);

/* Bytes that reading takes beside the pixels, of a file of which the size was read. */
uint64_t gn_png_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]);
uint64_t gn_jpeg_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]);
uint64_t gn_webp_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]);

enum { GN_SHRINK_MOST = 3 };
/* The side of what a decoder makes of px with that shrink, and the bytes of its pixels. */
static inline uint32_t gn_shrunk_px(uint32_t px, uint32_t shrink) {
    return (uint32_t)(((uint64_t)px + (1u << shrink) - 1) >> shrink);
}
static inline uint64_t gn_shrunk_bytes(const uint32_t px[2], uint32_t shrink) {
    return UINT64_C(4) * gn_shrunk_px(px[0], shrink) * gn_shrunk_px(px[1], shrink);
}

#endif
