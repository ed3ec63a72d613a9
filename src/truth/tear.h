/* How torn and how grainy a soft shadow looks, which a mean error does not tell: a wide error that
 * changes slowly is not seen, a small step is. Measured is by how much a picture's shadow is
 * steeper than the truth is anywhere near:
 *
 *   value  visibility x N.L, after a Gaussian; its gradient's length, beyond the largest that truth
 *          has within 6 px, after the same Gaussian
 *   tear   after 2.5 px, where single pixels are averaged: steps, stripes, outlines inside a
 * penumbra grain  after 1 px: the same, and the pattern of taps that differ from pixel to pixel
 *
 * as the mean over the pixels within 8 px of a penumbra (truth of .02 to .98), that are lit (N.L
 * over .02) and do not lie on an edge of depth or normal. A shadow that is moved or blurred has
 * none. Neither the Gaussian nor what is near reaches over an edge: taps stop there, along rows and
 * columns, so that the outline of a thing is neither measured nor an excuse for what is beside it.
 */
#ifndef GN_TRUTH_TEAR_H
#define GN_TRUTH_TEAR_H

#include <stddef.h>
#include <stdint.h>

struct gn_tear_view { /* what the pictures show; arrays of width x height, row 0 on top */
    int width_px, height_px;
    const float *truth;      /* visibility, 0 dark to 1 lit; what is no number is not measured */
    const float *facing;     /* N.L, 0 to 1, as a factor on visibility; NULL: 1 everywhere */
    const float *normal_ws;  /* unit, three a pixel; NULL: no edges of normal are known */
    const float *distance_m; /* from the eye; not finite: the background, or an unseen floor before
                                it; NULL: a surface everywhere, and no edges of depth are known */
};

/* N.L of a light in that direction (of any length but 0) as a share of what a level floor gets, at
 * most 1, and 1 where there is no distance: what shows there is a floor. A light from below: N.L.
 * Three values a pixel of the normals, one of the distances (NULL: finite) and of `facing`. */
void gn_tear_face(const float *normal_ws, const float *distance_m, const double to_light[3],
                  size_t pixels, float *facing);

enum gn_tear_part {
    GN_TEAR_ALL,
    GN_TEAR_FLOOR,   /* where distance_m is not finite */
    GN_TEAR_SURFACE, /* elsewhere */
    GN_TEAR_PARTS
};
struct gn_tear_score {
    double tear, grain; /* per cent per pixel; 0 is the best. NAN: under 200 pixels are measured */
    double rmse;        /* of visibility x N.L over the same pixels, 0 to 1; or NAN */
    long pixels;
};

enum { GN_TEAR_SIGMAS = 2 };
struct gn_tear { /* of one truth, for any number of pictures; zeroed, it may be finished */
    int width_px, height_px;
    float *facing, *truth;                 /* truth: x N.L; all owned */
    float *limit[GN_TEAR_SIGMAS];          /* what a gradient may be, a pixel */
    uint8_t *flat, *inner, *measured_part; /* no edge; nor the four neighbours; enum gn_tear_part,
                                              or 0 where nothing is measured */
};
/* Copies what it needs of the view. */
void gn_tear_init(struct gn_tear *tear, const struct gn_tear_view *view);
void gn_tear_finish(struct gn_tear *tear);
/* Of a picture of the same size: the first of so many channels counts, cut to 0..1; what is no
 * number is dark. */
void gn_tear_compare(const struct gn_tear *tear, const float *shot, int channels,
                     struct gn_tear_score score[GN_TEAR_PARTS]);

#endif
