/* Limits how many filtered maps are updated in one frame when many lights move. A light over the
 * budget keeps its map and the view that it was drawn for: its shadow is some frames old but
 * consistent. Lights that have waited longest come first. */
#include "frame/private.h"

static bool is_filtered(const struct gn_shadow_view *view) {
    return view->moments != GN_MOMENTS_NONE;
}

static void update_kept(struct gn_frame *frame, uint32_t slot) {
    frame->kept[slot].view = frame->shadows[slot];
    frame->kept[slot].waited = 0;
}

void gn_frame_hold_maps(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    uint64_t texels[GN_ALL_SHADOWS_MAX] = {0},
             spent = 0; /* texels: to draw, of maps that can wait */
    if (opts->shadow.filter_texels == 0 || opts->all_seen) return;
    for (uint32_t slot = 0; slot < frame->shadow_count; slot++) {
        const struct gn_shadow_view *view = &frame->shadows[slot], *old = &frame->kept[slot].view;
        if (!is_filtered(view)) continue;
        const bool can_wait = /* shaders may read the old map instead of the new one */
            is_filtered(old) && old->light == view->light && old->technique == view->technique &&
            old->encoding == view->encoding && old->moments == view->moments &&
            old->map.width_px == view->map.width_px && old->map.height_px == view->map.height_px &&
            old->map.tile_count == view->map.tile_count &&
            old->map.cascade_count == view->map.cascade_count &&
            old->all_receive == view->all_receive && old->empty == view->empty;
        if (can_wait)
            for (uint32_t tile = 0; tile < view->map.tile_count; tile++) {
                if (gn_frame_filter_hash(old, tile) != gn_frame_filter_hash(view, tile))
                    texels[slot] += (uint64_t)view->map.tile_px * view->map.tile_px;
            }
        else
            spent += (uint64_t)view->map.width_px * view->map.height_px;
        if (texels[slot] == 0) update_kept(frame, slot);
    }
    for (;;) {
        uint32_t slot = frame->shadow_count; /* that has waited longest */
        for (uint32_t i = 0; i < frame->shadow_count; i++)
            if (texels[i] > 0 &&
                (slot == frame->shadow_count || frame->kept[i].waited > frame->kept[slot].waited))
                slot = i;
        if (slot == frame->shadow_count) return;
        if (spent == 0 || spent + texels[slot] <= opts->shadow.filter_texels) {
            spent += texels[slot];
            update_kept(frame, slot);
        } else {
            frame->shadows[slot] = frame->kept[slot].view;
            frame->kept[slot].waited++;
            frame->plan.is_behind = true;
        }
        texels[slot] = 0;
    }
}
