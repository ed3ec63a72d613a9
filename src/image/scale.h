/* Pictures made smaller. */
#ifndef GN_IMAGE_SCALE_H
#define GN_IMAGE_SCALE_H

#include <stddef.h>
#include <stdint.h>

enum gn_scale_kind {
    GN_SCALE_COLOR,  /* sRGB: averaged in linear light */
    GN_SCALE_DATA,   /* numbers */
    GN_SCALE_NORMALS /* directions, x 127.5 + 127.5: averages get length 1 again */
};

/* Each pixel of out is the average of the pixels of rgba that it covers, in parts where these are
 * cut. No side of `to` is larger than that of `from`, none is 0. */
void gn_picture_scale(const uint8_t *rgba, const uint32_t from[2], enum gn_scale_kind kind,
                      uint8_t *out, const uint32_t to[2]);

#endif
