/* Reading PNG, JPEG, WebP and Radiance pictures from memory. Messages begin with the name of the
 * format.
 */
#ifndef GN_IMAGE_READ_H
#define GN_IMAGE_READ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

/* The size in the header; then the pixels, width x height x 4 bytes of RGBA, top row first.
 */
bool gn_png_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
bool gn_png_read(const uint8_t *data, size_t size, const uint32_t px[2], uint8_t *rgba,
                 struct gn_err *err);
/* The same in 16 bits each, of the machine's byte order; of 8 bits v becomes 257 v. */
bool gn_png_read_16(const uint8_t *data, size_t size, const uint32_t px[2], uint16_t *rgba,
                    struct gn_err *err);
/* Of a PNG whose size was read: it has a channel of alpha, or colours that are transparent. */
bool gn_png_has_alpha(const uint8_t *data, size_t size);
bool gn_jpeg_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
bool gn_jpeg_read(const uint8_t *data, size_t size, const uint32_t px[2], uint8_t *rgba,
                  struct gn_err *err);
/* Lossy and lossless, no animations; false everywhere in a build without libwebp. */
bool gn_webp_is_read(void);
bool gn_webp_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
bool gn_webp_read(const uint8_t *data, size_t size, const uint32_t px[2], uint8_t *rgba,
                  struct gn_err *err);

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

#endif
