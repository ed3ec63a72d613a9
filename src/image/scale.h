/* Pictures made smaller. */
#ifndef GN_IMAGE_SCALE_H
#define GN_IMAGE_SCALE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum gn_scale_kind {
    GN_SCALE_COLOR,  /* sRGB: averaged in linear light */
    GN_SCALE_DATA,   /* numbers */
    GN_SCALE_NORMALS /* directions, x 127.5 + 127.5: averages get length 1 again */
};

/* By rows, so that the larger picture is nowhere in memory: each pixel of out is the average of
 * those of the larger picture that it covers, in parts where these are cut. No side of `to` is
 * larger than that of `from`, none is 0. */
enum { GN_SCALER_CODES = 4096 };
struct gn_scaler {
    uint32_t from[2], to[2];
    enum gn_scale_kind kind;
    uint32_t read, written; /* rows of the larger and of the smaller picture */
    double table[256], alpha[256];
    uint8_t codes[GN_SCALER_CODES + 1]; /* of linear light, sRGB */
    double *sums; /* of the row that is being made: weighted R, G, B, A and the weights */
    uint8_t *out;
};
/* Bytes that it takes beside out; false: out of memory. */
uint64_t gn_scaler_bytes(const uint32_t to[2]);
bool gn_scaler_init(struct gn_scaler *scaler, const uint32_t from[2], enum gn_scale_kind kind,
                    uint8_t *out, const uint32_t to[2]);
void gn_scaler_finish(struct gn_scaler *scaler);
/* The next row from the top, as gn_picture_row in read.h; scaler is a struct gn_scaler. */
void gn_scaler_row(void *scaler, const uint8_t *rgba);

#endif
