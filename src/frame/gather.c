/* Gathers the points of a lamp in its planar mask. Nothing has moved while the hash of the mask's
 * content stays the same: then each frame adds points, until all are there and no frame is wanted
 * any more. When it changes the mask begins again. The points so far are what the picture shows. */
#include "blocks.glsl"
#include "core/arena.h"
#include "frame/private.h"
#include "shadow/lamp.h"
#include "shadow/planar.h"

_Static_assert(PASS_CODE_ADD + 1 == GN_POINT_CONSTANTS, "constants of casters");

enum { FADE_FRAMES = 20 };

/* A floor first shows the points of one frame, and goes on towards all of them in steps that are
 * not seen: in each frame 1 / n of what is left, in the last one, with n = 1, all. */
static void fade_floor(struct gn_frame *frame, uint32_t slot, uint32_t before, uint32_t more) {
    struct gn_shadow_floor *floor = &frame->shadows[slot].floor;
    const struct gn_shadow_lamp *lamp = &frame->shadows[slot].lamp;
    uint32_t *left = &frame->gathered[slot].left;
    if (before == 0) {
        *left = 0;
        if (lamp->drawn < lamp->count) *left = FADE_FRAMES + lamp->count / more;
        floor->weight = 1.0f;
    } else {
        if (*left > 0) --*left;
        floor->weight = 1.0f / (float)(*left + 1);
    }
    floor->left = *left;
    frame->plan.is_behind |= *left > 0;
}

void gn_frame_gather_points(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    for (uint32_t slot = 0; slot < frame->view_count; slot++) {
        struct gn_shadow_view *view = &frame->shadows[slot];
        struct gn_shadow_lamp *lamp = &view->lamp;
        const uint64_t hash = view->raster.tiles[0].content_hash;
        if (lamp->count == 0) continue;
        const bool is_floor = frame->floor.is_apart && slot == frame->floor.slot;
        const uint32_t before =
            frame->gathered[slot].hash == hash ? frame->gathered[slot].drawn : 0;
        uint32_t more = opts->shadow.gather_points;
        if (more && is_floor) more = gn_frame_floor_points(frame);
        lamp->drawn = more && before + more < lamp->count ? before + more : lamp->count;
        /* where no point is seen; 256 of 255 end at 0 */
        const uint32_t hidden = lamp->bytes * lamp->drawn / lamp->count;
        view->penumbra.scale = hidden < 255 ? 255.0f / (float)hidden : 1.0f;
        view->penumbra.bias = 1.0f - view->penumbra.scale;
        if (opts->all_seen) continue; /* it is not drawn */
        if (view->technique == GN_TECHNIQUE_FLOOR) fade_floor(frame, slot, before, more);
        frame->gathered[slot].hash = hash;
        frame->gathered[slot].drawn = lamp->drawn;
        frame->plan.is_behind |= lamp->drawn < lamp->count;
    }
}

void gn_frame_set_points(struct gn_frame *frame, uint32_t slot, struct gn_pass *pass) {
    const struct gn_shadow_view *view = &frame->shadows[slot];
    float(**points)[4] = &frame->gathered[slot].points;
    if (view->encoding != GN_ENCODING_MEAN) return;
    /* also while it is empty: a later frame allocates nothing */
    if (!*points) *points = gn_xalloc(GN_LAMP_POINTS_MAX + 1, GN_POINT_CONSTANTS * sizeof **points);
    float(*to)[4] = *points;
    mat4 clip_from_world;
    for (uint32_t i = 0; i < view->lamp.drawn; i++, to += GN_POINT_CONSTANTS) {
        gn_planar_point(view, i, clip_from_world);
        gn_frame_shadow_constants(view, clip_from_world, to);
    }
    if (view->technique == GN_TECHNIQUE_FLOOR && view->lamp.drawn > 0) {
        gn_planar_footprint(view, clip_from_world);
        gn_frame_shadow_constants(view, clip_from_world, to);
        to[PASS_CODE_ADD][0] = 1.0f; /* all of a texel: 0 is under a foot, and nowhere else */
        pass->map.foot = (const float(*)[4])to;
    }
    pass->map.point_count = view->lamp.drawn;
    pass->map.points = *points;
}
