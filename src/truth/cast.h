/* Whole pictures of what lights see, by all processors. */
#ifndef GN_TRUTH_CAST_H
#define GN_TRUTH_CAST_H

#include <stdatomic.h>

#include "truth/occlusion.h"

#define GN_CAST_BACKGROUND (-1.0f)

struct gn_cast_opts {
    const struct gn_raycast *rays;
    const struct gn_ray_eye *eye;
    const struct gn_ray_lamp *lamps;
    uint32_t lamp_count;
    bool sums; /* out[0] has what is seen of all lamps together, of those that a surface faces */
    const struct gn_occlusion *occlusion; /* in place of lamps: which share of its sky is seen, by
                                             so many rays, in out[0]; NULL: lamps */
    const struct gn_pose *pose;           /* that the rays are of; with occlusion */
    int samples; /* points of a lamp, as in gn_raycast_share(); 1: its middle alone */
    int threads; /* 0: one for each processor that this process may use */
    /* Called by the calling thread now and then; share: 0 to 1. NULL: none. */
    void (*progress)(void *user, double share);
    void *user;
    const atomic_bool *cancel; /* another thread sets it to end the cast early; or NULL */
};
/* For each lamp the visibility of each pixel, 0 dark to 1 lit, row 0 on top; GN_CAST_BACKGROUND
 * where the eye sees nothing. out: lamp_count arrays, or one with sums or occlusion, of the eye's
 * width x height. The same bits with any number of threads. */
void gn_cast(const struct gn_cast_opts *opts, float *const out[]);

#endif
