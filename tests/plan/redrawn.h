/* What of a light's map would be drawn again with the next plan. */
#ifndef GN_TESTS_PLAN_REDRAWN_H
#define GN_TESTS_PLAN_REDRAWN_H

#include "frame/plan.h"

struct gn_kept { /* what the tiles of a light hold: of the map, and filtered. Zeroed: nothing */
    uint64_t hash[2][GN_SHADOW_TILES_MAX];
    uint32_t points; /* of a lamp */
};
struct gn_redrawn {
    uint32_t passes, draws, filters; /* of the map; of those passes; of its filter */
};

/* Adds what a GPU that holds that has to draw for this plan, by slot, as gl/run.c has it; the tiles
 * hold that afterwards. Both: GN_ALL_SHADOWS_MAX. */
void gn_redrawn_add(const struct gn_plan *plan, struct gn_kept *kept, struct gn_redrawn *redrawn);

#endif
