/* Pictures as the tests hold them: floats, row 0 on top. */
#ifndef GN_IMAGE_PICTURE_H
#define GN_IMAGE_PICTURE_H

#include <stdbool.h>
#include <stddef.h>

#include "core/err.h"

struct gn_picture {
    int width_px, height_px;
    int channels; /* 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA */
    float *data; /* malloc'ed; PNG: value / 255 or / 65535, still encoded as in the file; PFM: as it
                    is */
};

/* Zeroed. */
void gn_picture_init(struct gn_picture *picture, int width_px, int height_px, int channels);
void gn_picture_finish(struct gn_picture *picture); /* a zeroed one may be finished */
float *gn_picture_at(const struct gn_picture *picture, int x, int y);

/* .pfm (grey "Pf" or RGB "PF", either byte order) or .png (8 or 16 bit, palette expanded), told
 * apart by content. */
bool gn_picture_read(struct gn_picture *picture, const char *path, struct gn_err *err);
/* 8-bit PNG of round(255 v), clamped; infinities are white, NaN magenta (or black where there is no
 * colour). */
bool gn_picture_write_png(const struct gn_picture *picture, const char *path, struct gn_err *err);

#endif
