/* The passes that draw the shadow maps. */
#include "frame/private.h"

static void label_shadow(const struct gn_frame *frame, uint32_t slot, uint32_t tile,
                         struct gn_pass *pass) {
    static const char *const sides[GN_SHADOW_TILES_MAX] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    const struct gn_shadow_view *view = &frame->shadows[slot];
    bool point = view->tile_count > 1;
    snprintf(pass->label, sizeof pass->label, "shadow %u %s%s%.*s", slot, point ? sides[tile] : "",
             point ? " " : "", 36, frame->scene->lights[view->light].name);
}

static void shadow_pass(struct gn_frame *frame, const struct gn_pose *pose, uint32_t slot,
                        uint32_t index, const struct gn_frame_opts *opts) {
    struct gn_shadow_view *view = &frame->shadows[slot];
    const struct gn_shadow_tile *tile = &view->tiles[index];
    struct gn_pass *pass = gn_frame_begin_pass(frame);
    label_shadow(frame, slot, index, pass);
    pass->target =
        (struct gn_target){GN_TARGET_SHADOW, slot, view->width_px, view->height_px, view->encoding};
    pass->clear = true;
    pass->clear_color[0] = view->far_code;
    pass->depth_write = view->encoding != GN_ENCODING_MASK;
    pass->discard_depth = pass->depth_write && view->encoding != GN_ENCODING_DEPTH;
    pass->border_px = 1;
    if (view->tile_count > 1) {
        pass->border_px = 0;
        pass->rect = (struct gn_rect){tile->x_px, tile->y_px, view->map_px, view->map_px};
    }
    pass->tile = index;
    pass->content_hash = tile->content_hash;
    float(*constants)[4] =
        gn_frame_constants(frame, GN_CONSTANTS_SHADOW + slot * GN_SHADOW_TILES_MAX + index);
    pass->constants = constants;
    gn_frame_shadow_constants(view, index, constants);
    struct gn_selection casters = {.casts = frame->memory[slot][index].casts,
                                   .view = view,
                                   .mirrored = tile->mirrored,
                                   .opts = opts};
    if (!tile->empty) gn_frame_draw_items(frame, pose, &casters);
    gn_frame_end_pass(frame);
}

void gn_frame_map_passes(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *opts) {
    for (uint32_t slot = 0; slot < frame->shadow_count; slot++)
        if (frame->shadows[slot].encoding != GN_ENCODING_STENCIL)
            for (uint32_t tile = 0; tile < frame->shadows[slot].tile_count; tile++)
                shadow_pass(frame, pose, slot, tile, opts);
}
