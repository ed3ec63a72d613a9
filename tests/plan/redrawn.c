#include "plan/redrawn.h"

#include <string.h>

void gn_redrawn_add(const struct gn_plan *plan, struct gn_kept *kept, struct gn_redrawn *redrawn) {
    struct gn_kept next[GN_ALL_SHADOWS_MAX];
    memcpy(next, kept, sizeof next);
    for (uint32_t i = 0; i < plan->pass_count; i++) {
        const struct gn_pass *pass = &plan->passes[i];
        if (pass->kind == GN_PASS_PICTURE || pass->kind == GN_PASS_GIVEN) continue;
        const bool filter = pass->kind == GN_PASS_FILTER;
        const uint32_t slot = pass->target.slot, tile = pass->content.tile,
                       points = pass->kind == GN_PASS_MAP ? pass->map.point_count : 0;
        if (kept[slot].hash[filter][tile] == pass->content.hash && points <= kept[slot].points)
            continue;
        redrawn[slot].passes += !filter;
        redrawn[slot].filters += filter;
        if (!filter) redrawn[slot].draws += pass->draw_count;
        next[slot].hash[filter][tile] = pass->content.hash;
        if (points) next[slot].points = points;
    }
    memcpy(kept, next, sizeof next);
}
