/* Technique truth: a prepared plan's visibility, by rays. */
#ifndef GN_STAGE_RAYS_H
#define GN_STAGE_RAYS_H

#include "stage/stage.h"

/* Casts the rays of each light of the view's plan that is drawn with truth, at its pose, and gives
 * them to GL, or gives it the rays that the view has; none: does nothing. Blocks, with all
 * processors. */
bool gn_stage_cast(struct gn_stage *stage, const struct gn_view *view, const struct gn_plan *plan,
                   struct gn_err *err);

/* How many of the sun's positions each pixel's surface faces and sees, by a ray for each: into out,
 * of the plan's width x height, row 0 on top; GN_CAST_BACKGROUND where there is no surface. to_ws:
 * unit vectors to them. Blocks likewise. */
bool gn_stage_cast_sun(const struct gn_stage *stage, const struct gn_view *view,
                       const struct gn_plan *plan, const float (*to_ws)[3], uint32_t count,
                       float *out, struct gn_err *err);

/* gn_stage_cast() in a thread of low priority, with copies of the pose and the camera; the scene
 * must outlive it. NULL: err has the reason; a plan without such lights is a failure. Once they are
 * done, gn_view.rays takes them for plans of the same lights and size. */
struct gn_rays *gn_rays_begin(const struct gn_stage *stage, const struct gn_view *view,
                              const struct gn_plan *plan, struct gn_err *err);
double gn_rays_progress(const struct gn_rays *rays); /* 0 to 1 */
bool gn_rays_are_done(const struct gn_rays *rays);
/* Ends the thread first, which takes some milliseconds. */
void gn_rays_destroy(struct gn_rays *rays);

#endif
