/* Shadows that swim: the camera or the sun moves slowly, and what changes from frame to frame where
 * the truth does not.
 *
 * Measured is the change of a pixel's visibility from one frame to the next, beyond the largest
 * change of truth within 2 px, where that is at most .02; of pixels within 8 px of a shadow's edge
 * or penumbra that show the same face of the same thing in both frames, as do their neighbours. An
 * edge that a filter makes wider than the truth's may move along: under a sun of no size .15 px a
 * frame times the picture's own gradient is no fault, either.
 */
#ifndef GN_IMAGE_SWIM_H
#define GN_IMAGE_SWIM_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"

enum gn_swim_place {
    GN_SWIM_YARD, /* boxes, bars and posts on a ground, seen from 11 m */
    GN_SWIM_FIELD /* a wall, a bar and posts from the eye's feet to 250 m: cascades */
};
struct gn_swim_opts {
    enum gn_swim_place place;
    bool soft; /* a sun of tangent .05, truth by many rays: a second for each frame; else of no size
                */
    bool sun;  /* the sun turns; else the camera walks */
    int width_px, height_px, frames;
    double pace; /* 1: an edge moves by some twentieth of a pixel a frame */
};
struct gn_swim { /* a moving scene and its truth */
    struct gn_swim_opts opts;
    char *path;
    float *truth;  /* visibility: frames x width x height */
    float *excuse; /* for each pair of frames, each pixel: the change of truth near it; NAN: the
                      pixel is not measured */
};
/* Writes the scene and casts the rays of each frame. False: nothing to finish. */
bool gn_swim_init(struct gn_swim *swim, const struct gn_swim_opts *opts, struct gn_err *err);
void gn_swim_finish(struct gn_swim *swim);

struct gn_swim_score {
    double mean, p99; /* of the changes, per cent of full light; 99 % are at most p99 */
    long changes;
};
/* Draws all frames in turn, in this process, with these further options of render (up to NULL), or
 * NULL. */
bool gn_swim_measure(const struct gn_swim *swim, const char *technique, const char *const args[],
                     struct gn_swim_score *score, struct gn_err *err);
/* The same of pictures that are there: frames x width x height. */
void gn_swim_compare(const struct gn_swim *swim, const float *shots, struct gn_swim_score *score);

#endif
