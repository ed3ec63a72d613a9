/* The passes that draw the shadow maps: one per map, or per tile. Of a directional light's map that
 * follows the camera one per page, and one that copies the pages (shadow/pages.h); so, too, of each
 * cascade. */
#include <cglm/cglm.h>
#include <stdio.h>

#include "core/text.h"
#include "frame/private.h"

/* Bytes of a light's name in a label; in that of a page " page 3" follows. */
enum { NAME_LENGTH = 36, PAGE_LENGTH = sizeof " page 3" - 1 };

/* What all passes of a map have in common. page: 0 unless it draws one. */
static struct gn_pass *begin_pass(struct gn_frame *frame, enum gn_pass_kind kind, uint32_t slot,
                                  uint32_t tile, uint32_t page, mat4 clip_from_world) {
    static const char *const sides[GN_SHADOW_TILES_MAX] = {"+x", "-x", "+y", "-y", "+z", "-z"};
    static const char *const cascades[GN_CASCADES_MAX] = {"1", "2", "3", "4"};
    const struct gn_shadow_view *view = &frame->shadows[slot];
    const char *side = view->map.cascade_count > 0 ? cascades[tile] : sides[tile];
    const bool tiles = view->map.tile_count > 1,
               in_pages = view->raster.drawn.paged || view->map.cascade_count > 0;
    struct gn_pass *pass = gn_frame_begin_pass(frame, kind);
    snprintf(pass->label, sizeof pass->label, "shadow %u %s%s%.*s", slot, tiles ? side : "",
             tiles ? " " : "", in_pages ? NAME_LENGTH - PAGE_LENGTH : NAME_LENGTH,
             frame->scene->lights[view->light].name);
    pass->target = (struct gn_target){.kind = GN_TARGET_SHADOW,
                                      .slot = slot,
                                      .width_px = view->map.width_px,
                                      .height_px = view->map.height_px,
                                      .encoding = view->encoding};
    pass->clear.area = GN_CLEAR_ALL;
    pass->clear.color[0] = view->code.clear;
    pass->depth_write = view->encoding != GN_ENCODING_MASK && view->encoding != GN_ENCODING_SCREEN;
    pass->discard_depth = pass->depth_write && !gn_encoding_is_depth(view->encoding);
    pass->content = (struct gn_content){
        .tile = tile, .hash = view->raster.tiles[tile].content_hash, .completes = true};
    float(*constants)[4] = gn_frame_constants(frame, GN_CONSTANTS_SHADOW + slot * GN_SLOT_SETS +
                                                         tile * GN_SHADOW_PAGES_MAX + page);
    pass->constants = constants;
    gn_frame_shadow_constants(view, clip_from_world, constants);
    return pass;
}

bool gn_frame_has_middle(const struct gn_frame *frame, enum gn_technique technique, int faces) {
    return !gn_techniques[technique].on_plane &&
           (faces > 0 ? faces == 1 + GN_CAST_MIDDLE : frame->has_middle);
}

/* Draws the casters of the pass that was begun last, and ends it. Those that cast by their middle
 * read the far sides, which a pass before it draws beside the map (midpoint shadow maps: Woo, "The
 * Shadow Depth Map Revisited", Graphics Gems III, 1992). */
static void draw_casters(struct gn_frame *frame, const struct gn_pose *pose,
                         struct gn_selection *casters) {
    const struct gn_shadow_view *view = casters->view;
    if (gn_frame_has_middle(frame, view->technique, view->faces_given ? 1 + (int)view->faces : 0)) {
        struct gn_pass *backs = &frame->passes.at[frame->passes.count - 1];
        struct gn_pass map = *backs;
        gn_text_add(backs->label, sizeof backs->label, " far");
        backs->target.kind = GN_TARGET_BACKS;
        backs->clear.area = GN_CLEAR_ALL;
        backs->clear.color[0] = view->code.far_end;
        backs->content.completes = false;
        backs->discard_depth = !gn_encoding_is_depth(backs->target.encoding);
        casters->backs = true;
        gn_frame_draw_items(frame, pose, casters);
        gn_frame_end_pass(frame);
        casters->backs = false;
        map.first_draw = frame->draws.count;
        map.map.reads_backs = true;
        GN_LIST_PUSH(&frame->passes) = map;
    }
    gn_frame_draw_items(frame, pose, casters);
    gn_frame_end_pass(frame);
}

/* ---- a map, or a tile of one ---- */

static void bound_tile(const struct gn_shadow_view *view, uint32_t index, struct gn_pass *pass) {
    const struct gn_shadow_tile *tile = &view->raster.tiles[index];
    pass->clear.area = GN_CLEAR_RECT;
    pass->rect = pass->viewport =
        (struct gn_rect){tile->x_px, tile->y_px, view->map.tile_px, view->map.tile_px};
}

static void add_tile_pass(struct gn_frame *frame, const struct gn_pose *pose, uint32_t slot,
                          uint32_t index, const struct gn_frame_opts *opts) {
    struct gn_shadow_view *view = &frame->shadows[slot];
    struct gn_shadow_tile *tile = &view->raster.tiles[index];
    struct gn_pass *pass = begin_pass(frame, GN_PASS_MAP, slot, index, 0, tile->clip_from_world);
    if (view->map.tile_count > 1)
        bound_tile(view, index, pass);
    else if (view->raster.drawn.page_count > 0) /* one page, the whole map: not copied (fit.h) */
        pass->rect = (struct gn_rect){view->raster.drawn.px[0], view->raster.drawn.px[1],
                                      view->raster.drawn.size_px[0], view->raster.drawn.size_px[1]};
    else
        pass->map.border_px = 1;
    struct gn_selection casters = {.casts = frame->memory[slot][index].casts,
                                   .view = view,
                                   .mirrored = tile->mirrored,
                                   .opts = opts};
    gn_frame_set_points(frame, slot, pass);
    if (tile->empty)
        gn_frame_end_pass(frame);
    else
        draw_casters(frame, pose, &casters);
}

/* ---- a map, or a cascade, from pages ---- */

struct paged {
    uint32_t slot, tile, page_px, page_count, to_px[2];
    struct gn_shadow_page *pages;
};

static struct gn_target pages_target(const struct gn_frame *frame, const struct paged *map) {
    const struct gn_shadow_view *view = &frame->shadows[map->slot];
    return (struct gn_target){.kind = GN_TARGET_PAGES,
                              .slot = map->slot,
                              .width_px = view->map.tile_px,
                              .height_px = view->map.tile_px,
                              .encoding = view->encoding};
}

static void add_paged_passes(struct gn_frame *frame, const struct gn_pose *pose,
                             const struct paged *map, const struct gn_frame_opts *opts) {
    for (uint32_t i = 0; i < map->page_count; i++) {
        struct gn_shadow_page *page = &map->pages[i];
        struct gn_pass *part =
            begin_pass(frame, GN_PASS_MAP, map->slot, map->tile, i, page->clip_from_world);
        gn_text_add(part->label, sizeof part->label, " page %u", i);
        part->target = pages_target(frame, map);
        part->viewport = (struct gn_rect){0, 0, map->page_px, map->page_px};
        part->clear.area = i == 0 ? GN_CLEAR_ALL : GN_CLEAR_NOTHING;
        part->content.completes = false;
        part->discard_depth = false; /* the next page needs it */
        part->rect = (struct gn_rect){page->from_px[0], page->from_px[1], page->size_px[0],
                                      page->size_px[1]};
        struct gn_selection casters = {.casts = frame->memory[map->slot][map->tile].casts,
                                       .page = i,
                                       .view = &frame->shadows[map->slot],
                                       .opts = opts};
        draw_casters(frame, pose, &casters);
    }

    struct gn_pass *pass =
        begin_pass(frame, GN_PASS_COPY, map->slot, map->tile, 0, map->pages[0].clip_from_world);
    if (frame->shadows[map->slot].map.tile_count > 1)
        bound_tile(&frame->shadows[map->slot], map->tile, pass);
    pass->copy.from = pages_target(frame, map);
    pass->copy.count = map->page_count;
    for (uint32_t i = 0; i < map->page_count; i++) {
        const struct gn_shadow_page *page = &map->pages[i];
        pass->copy.copies[i] = (struct gn_copy){
            .from = {page->from_px[0], page->from_px[1], page->size_px[0], page->size_px[1]},
            .to_x = map->to_px[0] + page->to_px[0],
            .to_y = map->to_px[1] + page->to_px[1]};
    }
    gn_frame_end_pass(frame);
}

void gn_frame_add_maps(struct gn_frame *frame, const struct gn_pose *pose,
                       const struct gn_frame_opts *opts) {
    for (uint32_t slot = 0; slot < frame->view_count; slot++) {
        struct gn_shadow_view *view = &frame->shadows[slot];
        const bool in_stencil = view->encoding == GN_ENCODING_STENCIL,
                   paged = view->raster.drawn.paged;
        if (view->encoding == GN_ENCODING_SCREEN) { /* no map, but what the caller has computed */
            mat4 nowhere = GLM_MAT4_IDENTITY_INIT;
            begin_pass(frame, GN_PASS_GIVEN, slot, 0, 0, nowhere);
            gn_frame_end_pass(frame);
            continue;
        }
        if (paged && !in_stencil) {
            const struct paged map = {.slot = slot,
                                      .page_px = view->map.tile_px,
                                      .page_count = view->raster.drawn.page_count,
                                      .pages = view->raster.drawn.pages};
            add_paged_passes(frame, pose, &map, opts);
        }
        for (uint32_t tile = 0; !paged && !in_stencil && tile < view->map.tile_count; tile++) {
            if (view->map.cascade_count == 0 || view->raster.tiles[tile].empty) {
                add_tile_pass(frame, pose, slot, tile, opts);
                continue;
            }
            const struct paged map = {
                .slot = slot,
                .tile = tile,
                .page_px = view->map.inner_px,
                .page_count = view->cascades[tile].drawn.page_count,
                .to_px = {view->raster.tiles[tile].x_px + view->map.gutter_px,
                          view->raster.tiles[tile].y_px + view->map.gutter_px},
                .pages = view->cascades[tile].drawn.pages};
            add_paged_passes(frame, pose, &map, opts);
        }
        gn_frame_filter_passes(frame, slot);
    }
}
