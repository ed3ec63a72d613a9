/* Soft shadows: the share of a light that every pixel sees, and how far a picture is from it. */
#ifndef GN_TRUTH_PENUMBRA_H
#define GN_TRUTH_PENUMBRA_H

#include "truth/raycast.h"

/* One value for each pixel of the eye, row 0 on top; 1 on the background. Few rays decide whether a
 * pixel or a neighbour of it is in a penumbra; of those many are cast. */
void gn_penumbra_cast(const struct gn_raycast *rays, const struct gn_ray_eye *eye,
                      const struct gn_ray_lamp *lamp, float *out);

struct gn_penumbra_score {
    double soft, rest; /* RMSE over pixels partly lit in truth (.01-.99, grown by 2 px), and over
                          all others */
    double grain;      /* standard deviation of (shot - truth) within those pixels */
    double bias;       /* mean of it */
    long soft_pixels;
};
/* Both of width x height; shot: the first of so many channels counts. */
void gn_penumbra_compare(const float *truth, const float *shot, int channels, int width_px,
                         int height_px, struct gn_penumbra_score *score);

#endif
