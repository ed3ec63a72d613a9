/* Limits how many filtered maps are updated in one frame when many lights move. A light over the
 * budget keeps its map and the view that it was drawn for: its shadow is some frames old but
 * consistent. Lights that have waited longest come first. */
#include "frame/private.h"

static bool is_filtered(const struct gn_shadow_view *view) {
    return view->moments != GN_MOMENTS_NONE;
}

/* Whether shaders may read the old map in the new one's place. */
static bool can_keep_map(const struct gn_shadow_view *old, const struct gn_shadow_view *new) {
    return is_filtered(old) && old->light == new->light && old->technique == new->technique &&
           old->encoding == new->encoding && old->moments == new->moments &&
           old->map.width_px == new->map.width_px && old->map.height_px == new->map.height_px &&
           old->map.tile_count == new->map.tile_count &&
           old->map.cascade_count == new->map.cascade_count &&
           old->all_receive == new->all_receive && old->empty == new->empty;
}

static uint64_t texels_to_make(const struct gn_shadow_view *old, const struct gn_shadow_view *new) {
    uint64_t tiles = 0;
    for (uint32_t tile = 0; tile < new->map.tile_count; tile++)
        tiles += gn_frame_filter_hash(old, tile) != gn_frame_filter_hash(new, tile);
    return tiles * new->map.tile_px *new->map.tile_px;
}

static void update_kept(struct gn_frame *frame, uint32_t slot) {
    frame->kept[slot].view = frame->shadows[slot];
    frame->kept[slot].waited = 0;
}

/* Of those that wait, the one that has done so longest; shadow_count: none waits. */
static uint32_t find_longest_waiting(const struct gn_frame *frame, const uint64_t *texels) {
    uint32_t found = frame->shadow_count;
    for (uint32_t slot = 0; slot < frame->shadow_count; slot++)
        if (texels[slot] > 0 &&
            (found == frame->shadow_count || frame->kept[slot].waited > frame->kept[found].waited))
            found = slot;
    return found;
}

void gn_frame_hold_maps(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    uint64_t texels[GN_ALL_SHADOWS_MAX] = {0}, spent = 0;
    if (opts->shadow.filter_texels == 0 || opts->all_seen) return;
    for (uint32_t slot = 0; slot < frame->shadow_count; slot++) {
        const struct gn_shadow_view *view = &frame->shadows[slot];
        if (!is_filtered(view)) continue;
        if (can_keep_map(&frame->kept[slot].view, view))
            texels[slot] = texels_to_make(&frame->kept[slot].view, view);
        else
            spent += (uint64_t)view->map.width_px * view->map.height_px;
        if (texels[slot] == 0) update_kept(frame, slot);
    }
    for (uint32_t slot; (slot = find_longest_waiting(frame, texels)) < frame->shadow_count;
         texels[slot] = 0) {
        if (spent == 0 || spent + texels[slot] <= opts->shadow.filter_texels) {
            spent += texels[slot];
            update_kept(frame, slot);
        } else {
            frame->shadows[slot] = frame->kept[slot].view;
            frame->kept[slot].waited++;
            frame->plan.waits = true;
        }
    }
}
