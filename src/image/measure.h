/* How much two pictures differ. */
#ifndef GN_IMAGE_MEASURE_H
#define GN_IMAGE_MEASURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

struct gn_pixels { /* RGB, row 0 on top; a zeroed one may be finished */
    size_t width_px, height_px;
    float *rgb; /* owned. PNG: value / 255 or / 65535, as in the file; PFM: as it is */
};
/* Reads a .png (8 or 16 bit) or a .pfm, distinguished by content; alpha is dropped, grey becomes
 * three equal channels. Refuses over 1 GB of file and over 32768 pixels a side. */
bool gn_pixels_load(struct gn_pixels *pixels, const char *path, struct gn_err *err);
void gn_pixels_finish(struct gn_pixels *pixels);

struct gn_measure {
    double max;   /* largest difference of any channel */
    double share; /* of the pixels, those with a channel that differs by more than the tolerance;
                     0..1 */
    double rmse;  /* root of the mean square difference of all channels */
    size_t worst_x, worst_y; /* where max is first */
};
/* The difference of two values. NaN differs by infinity from all but NaN; equal infinities do not
 * differ. */
double gn_measure_channel(float a, float b);
/* Of two arrays of width x height pixels of so many channels, at least one pixel. */
void gn_measure(const float *a, const float *b, size_t width_px, size_t height_px, int channels,
                double tolerance, struct gn_measure *measure);
/* 20 log10 (1 / rmse): infinite where it is 0. */
double gn_measure_psnr_db(const struct gn_measure *measure);

#endif
