/* What a plan draws, counted by drawing it once without a GPU (raster.h): for each draw of each
 * pass, in their order, with the depth that earlier ones left. No GL. */
#ifndef GN_COST_DRAWN_H
#define GN_COST_DRAWN_H

#include "cost/raster.h"
#include "frame/plan.h"

/* Fills counts[plan->draw_count]. Counted are items, floors, and what covers its target; not marks,
 * panels, captions. Of a mask of many points of a lamp the first is drawn, and counts for all.
 * Holes of masked surfaces hide nothing, by their textures at full size. pose: that the plan was
 * built of. */
void gn_cost_count(const struct gn_plan *plan, const struct gn_pose *pose,
                   struct gn_raster_count *counts);

#endif
