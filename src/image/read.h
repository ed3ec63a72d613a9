/* Reading PNG and JPEG pictures from memory. Messages begin with the name of the format. */
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
bool gn_jpeg_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
bool gn_jpeg_read(const uint8_t *data, size_t size, const uint32_t px[2], uint8_t *rgba,
                  struct gn_err *err);

/* Bytes that reading takes beside the pixels, of a file of which the size was read. */
uint64_t gn_png_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]);
uint64_t gn_jpeg_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]);

#endif
