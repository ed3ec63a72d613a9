/* Shadow masks against truth, knowing about edges. A map has texels and a rasteriser has pixels, so
 * next to the outline of a shadow or of a thing both answers are right; away from edges only one
 * is. Acne and leaks are counted away from edges, gaps (peter-panning) and everything wrong with
 * the edges in. A pixel is acne when it is darker than half; faint acne is measured on the safely
 * lit pixels, by how much they are darkened and how many by over 5 %. */
#ifndef GN_TRUTH_MASK_H
#define GN_TRUTH_MASK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What the truth is, pixel by pixel, row 0 on top; storage is the caller's. */
struct gn_mask_truth {
    int width_px, height_px;
    const uint8_t *lit;      /* 1 lit, 0 dark */
    const int32_t *item;     /* -1: background */
    const float *point_ws;   /* 3 per pixel */
    const float *normal_ws;  /* 3 per pixel */
    const float *distance_m; /* from the eye */
    const float *band_px; /* how wide the edges are at this pixel; NULL: 2 everywhere; at least 2 */
    const float *safe_px; /* from this distance to an edge on a lit pixel must be fully lit;
                             INFINITY: nowhere. NULL: 5 everywhere */
};

struct gn_mask_score {                               /* counts of pixels */
    uint64_t pixels, lit, dark, away_lit, away_dark; /* of the truth; away: from edges */
    uint64_t acne;                                   /* away_lit but dark in the shot */
    uint64_t leak;                                   /* away_dark but lit in the shot */
    uint64_t gap;                                    /* dark but lit in the shot, edges included */
    uint64_t wrong;                                  /* all that differ, edges included */
    uint64_t safe;     /* lit in the truth and at least safe_px from edges */
    uint64_t darkened; /* of those: darker than .95 in the shot */
    double darkness;   /* sum over those of 1 - shot */
};
/* Shares in per cent; darkening: mean over the safely lit pixels. */
double gn_mask_acne(const struct gn_mask_score *score);
double gn_mask_darkening(const struct gn_mask_score *score);
double gn_mask_darkened(const struct gn_mask_score *score);
double gn_mask_leak(const struct gn_mask_score *score);
double gn_mask_gap(const struct gn_mask_score *score);
double gn_mask_wrong(const struct gn_mask_score *score);

/* Distance of each pixel's middle to the nearest edge pixel's (0 on one), into out (width x
 * height). Edge pixels: the truth differs from one of the 8 neighbours, or the thing seen does
 * (another item, a step in depth of over 2 % of the distance off the plane of both, or normals more
 * than 45 degrees apart). Exact Euclidean (Felzenszwalb, Huttenlocher, "Distance transforms of
 * sampled functions", 2012). */
void gn_mask_edges(const struct gn_mask_truth *truth, float *out);
/* Whether pixel i is further from the edges than they are wide. */
bool gn_mask_is_away(const struct gn_mask_truth *truth, const float *edges, size_t i);

/* What one pixel adds to a score, but to its `pixels`. shown: 1 lit .. 0 dark; below .5 (or NaN) is
 * dark. away: from edges; safe: in the truth fully lit with any filter. */
struct gn_mask_pixel {
    bool lit, away, safe;
    float shown;
};
void gn_mask_count(struct gn_mask_score *score, const struct gn_mask_pixel *pixel);
/* shot: of the same size; the first of so many channels counts. compare_by: with the distances that
 * gn_mask_edges() has found. */
void gn_mask_compare_by(const struct gn_mask_truth *truth, const float *edges, const float *shot,
                        int channels, struct gn_mask_score *score);
void gn_mask_compare(const struct gn_mask_truth *truth, const float *shot, int channels,
                     struct gn_mask_score *score);

#endif
