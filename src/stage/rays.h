/* Technique truth: a prepared plan's visibility, by rays. */
#ifndef GN_STAGE_RAYS_H
#define GN_STAGE_RAYS_H

#include "stage/stage.h"

/* Casts the rays of each light of the plan that is drawn with truth, at the stage's pose, and gives
 * them to GL; none: does nothing. Blocks, with all processors. limits: with defaults filled in. */
bool gn_stage_cast(struct gn_stage *stage, const struct gn_plan *plan,
                   const struct gn_scene_limits *limits, struct gn_err *err);

#endif
