/* The passes that draw the shadow maps: one a map, or a tile of it; of a directional light's map
 * that goes with the eye one a page, and one that puts the pages together (shadow/pages.h). */
#include <stdio.h>
#include <string.h>

#include "frame/private.h"

static void label_shadow(const struct gn_frame *frame, uint32_t slot, uint32_t tile,
                         struct gn_pass *pass) {
    static const char *const sides[GN_SHADOW_TILES_MAX] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    const struct gn_shadow_view *view = &frame->shadows[slot];
    bool point = view->tile_count > 1;
    snprintf(pass->label, sizeof pass->label, "shadow %u %s%s%.*s", slot, point ? sides[tile] : "",
             point ? " " : "", view->paged ? 29 : 36, frame->scene->lights[view->light].name);
}

/* What all passes of a map have in common. */
static struct gn_pass *begin_pass(struct gn_frame *frame, uint32_t slot, uint32_t index,
                                  mat4 clip_from_world) {
    const struct gn_shadow_view *view = &frame->shadows[slot];
    struct gn_pass *pass = gn_frame_begin_pass(frame);
    label_shadow(frame, slot, index, pass);
    pass->target = (struct gn_target){.kind = GN_TARGET_SHADOW,
                                      .slot = slot,
                                      .width_px = view->width_px,
                                      .height_px = view->height_px,
                                      .encoding = view->encoding};
    pass->clear = true;
    pass->clear_color[0] = view->far_code;
    pass->depth_write = view->encoding != GN_ENCODING_MASK;
    pass->discard_depth = pass->depth_write && view->encoding != GN_ENCODING_DEPTH;
    float(*constants)[4] =
        gn_frame_constants(frame, GN_CONSTANTS_SHADOW + slot * GN_SHADOW_TILES_MAX + index);
    pass->constants = constants;
    gn_frame_shadow_constants(view, clip_from_world, constants);
    return pass;
}

/* ---- a map, or a tile of one ---- */

static void bound_tile(const struct gn_shadow_view *view, uint32_t index, struct gn_pass *pass) {
    const struct gn_shadow_tile *tile = &view->tiles[index];
    if (view->tile_count > 1)
        pass->rect = pass->viewport =
            (struct gn_rect){tile->x_px, tile->y_px, view->map_px, view->map_px};
    else if (view->page_count > 0)
        pass->rect = (struct gn_rect){view->drawn_px[0], view->drawn_px[1], view->drawn_size_px[0],
                                      view->drawn_size_px[1]};
    else
        pass->border_px = 1;
}

static void tile_pass(struct gn_frame *frame, const struct gn_pose *pose, uint32_t slot,
                      uint32_t index, const struct gn_frame_opts *opts) {
    struct gn_shadow_view *view = &frame->shadows[slot];
    struct gn_shadow_tile *tile = &view->tiles[index];
    struct gn_pass *pass = begin_pass(frame, slot, index, tile->clip_from_world);
    bound_tile(view, index, pass);
    pass->tile = index;
    pass->content_hash = tile->content_hash;
    struct gn_selection casters = {.casts = frame->memory[slot][index].casts,
                                   .view = view,
                                   .mirrored = tile->mirrored,
                                   .opts = opts};
    if (!tile->empty) gn_frame_draw_items(frame, pose, &casters);
    gn_frame_end_pass(frame);
}

/* ---- a map from pages ---- */

static void page_pass(struct gn_frame *frame, const struct gn_pose *pose, uint32_t slot,
                      uint32_t index, const struct gn_frame_opts *opts) {
    struct gn_shadow_view *view = &frame->shadows[slot];
    struct gn_shadow_page *page = &view->pages[index];
    struct gn_pass *pass = begin_pass(frame, slot, index, page->clip_from_world);
    const size_t used = strlen(pass->label);
    snprintf(pass->label + used, sizeof pass->label - used, " page %u", index);
    pass->target.kind = GN_TARGET_PAGES;
    pass->clear = index == 0;
    pass->discard_depth = false; /* the next page goes on with it */
    pass->rect =
        (struct gn_rect){page->from_px[0], page->from_px[1], page->size_px[0], page->size_px[1]};
    pass->content_hash = view->tiles[0].content_hash;
    struct gn_selection casters = {
        .casts = frame->memory[slot][0].casts, .page = index, .view = view, .opts = opts};
    gn_frame_draw_items(frame, pose, &casters);
    gn_frame_end_pass(frame);
}

static void copy_pass(struct gn_frame *frame, uint32_t slot) {
    struct gn_shadow_view *view = &frame->shadows[slot];
    struct gn_pass *pass = begin_pass(frame, slot, 0, view->pages[0].clip_from_world);
    pass->content_hash = view->tiles[0].content_hash;
    pass->copy_count = view->page_count;
    for (uint32_t i = 0; i < view->page_count; i++) {
        const struct gn_shadow_page *page = &view->pages[i];
        pass->copies[i] = (struct gn_copy){
            .from = {page->from_px[0], page->from_px[1], page->size_px[0], page->size_px[1]},
            .to_x = page->to_px[0],
            .to_y = page->to_px[1]};
    }
    gn_frame_end_pass(frame);
}

static void map_passes(struct gn_frame *frame, const struct gn_pose *pose, uint32_t slot,
                       const struct gn_frame_opts *opts) {
    const struct gn_shadow_view *view = &frame->shadows[slot];
    if (view->encoding == GN_ENCODING_STENCIL) return;
    if (!view->paged) {
        for (uint32_t tile = 0; tile < view->tile_count; tile++)
            tile_pass(frame, pose, slot, tile, opts);
        return;
    }
    for (uint32_t page = 0; page < view->page_count; page++)
        page_pass(frame, pose, slot, page, opts);
    copy_pass(frame, slot);
}

void gn_frame_map_passes(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *opts) {
    for (uint32_t slot = 0; slot < frame->shadow_count; slot++) {
        map_passes(frame, pose, slot, opts);
        gn_frame_filter_passes(frame, slot);
    }
}
