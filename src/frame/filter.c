/* The passes that make moments of a map (shadow/moments.h): a triangle over the target, or over
 * each tile, per step of the technique's filter. As the map's own passes, they are skipped while
 * the light's texture is up to date. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "blocks.glsl"
#include "core/hash.h"
#include "core/text.h"
#include "frame/private.h"

/* Half the width of the filter's box; 0: none. */
static float blur_of(const struct gn_shadow_view *view, uint32_t tile) {
    if (view->moments == GN_MOMENTS_RGBA16F_MIPS) return 0.5f;
    return view->map.cascade_count > 0 ? view->cascades[tile].blur_px : view->penumbra.blur_px;
}

/* Scale and offset that map the range of moments to 0..1. A cascade without casters contains only
 * the far end: any will do. */
static void code_transform(const struct gn_shadow_view *view, uint32_t tile, float code[2]) {
    code[0] = 1.0f;
    code[1] = 0.0f;
    if (view->map.cascade_count == 0 || view->raster.tiles[tile].empty) return;
    const struct gn_shadow_cascade *c = &view->cascades[tile];
    code[0] = view->penumbra.scale / c->span;
    code[1] = (view->penumbra.bias - c->nearest) / c->span;
}

/* ---- cone maps (shadow/cone.glsl) ---- */

/* Texels of a cone's radius per unit of the map's code. */
static float cone_growth(const struct gn_shadow_view *view, uint32_t tile) {
    const float texel = view->map.cascade_count > 0 && !view->raster.tiles[tile].empty
                            ? view->cascades[tile].texel
                            : 1.0f;
    return view->penumbra.radius * view->penumbra.scale / texel;
}

/* How far the first flooding step reads, so that all together reach as far as the widest penumbra:
 * texels of the cone map. */
static uint32_t first_reach_px(const struct gn_shadow_view *view) {
    const float widest =
        view->lookup.reach_px > 0.0f ? view->lookup.reach_px : view->penumbra.widest_px;
    uint32_t px = 2;
    while (px < 128 && (float)((2 * px - 2) * view->map.cell_px) < widest) px *= 2;
    return px;
}

uint64_t gn_frame_filter_hash(const struct gn_shadow_view *view, uint32_t tile) {
    const uint32_t what[] = {view->technique, view->moments};
    uint64_t h = gn_hash(GN_HASH_INIT, &view->raster.tiles[tile].content_hash, sizeof(uint64_t));
    h = gn_hash(h, what, sizeof what);
    const float blur_px = blur_of(view, tile);
    h = gn_hash(h, &blur_px, sizeof blur_px);
    float code[2];
    code_transform(view, tile, code);
    h = gn_hash(h, code, sizeof code);
    h = gn_hash(h, &view->lookup.reach_px, sizeof view->lookup.reach_px);
    if (view->technique == GN_TECHNIQUE_FLOOR) {
        const uint32_t state[] = {view->lamp.drawn, view->floor.left};
        h = gn_hash(h, state, sizeof state);
        h = gn_hash(h, &view->floor.ambient, 2 * sizeof view->floor.ambient);
    }
    if (gn_techniques[view->technique].filter == GN_FILTER_CONE) {
        const float cone[] = {cone_growth(view, tile), (float)first_reach_px(view),
                              (float)view->map.cell_px};
        h = gn_hash(h, cone, sizeof cone);
    }
    return h ? h : 1;
}

/* In the filter's textures. */
static struct gn_rect tile_rect(const struct gn_shadow_view *view, uint32_t tile) {
    const uint32_t each = view->map.cell_px;
    return (struct gn_rect){view->raster.tiles[tile].x_px / each,
                            view->raster.tiles[tile].y_px / each, view->map.tile_px / each,
                            view->map.tile_px / each};
}

/* ---- sums of blocks: of all tiles side by side, as high as one ---- */

static uint32_t blocks_of(const struct gn_shadow_map *map) {
    return (map->tile_px + TABLE_BLOCK - 1) / TABLE_BLOCK;
}

static bool is_narrow(enum gn_technique technique, uint32_t texture) {
    const uint32_t narrow = gn_filters[gn_techniques[technique].filter].narrow;
    return narrow > 0 && texture == narrow;
}

void gn_frame_filter_size(enum gn_technique technique, const struct gn_shadow_map *map,
                          uint32_t texture, uint32_t size_px[2]) {
    const bool narrow = is_narrow(technique, texture);
    size_px[0] = narrow ? map->tile_count * blocks_of(map) : map->width_px / map->cell_px;
    size_px[1] = narrow ? map->tile_px : map->height_px / map->cell_px;
}

void gn_view_filtered_size(const struct gn_shadow_view *view, uint32_t size_px[2]) {
    gn_frame_filter_size(view->technique, &view->map, 0, size_px);
}

static void floor_constants(const struct gn_shadow_view *view, float (*c)[4]) {
    const struct gn_shadow_square *square = &view->square;
    const float side = view->lookup.texel * (float)view->map.tile_px;
    mat4 world_from_plane;
    vec3 corner;
    glm_mat4_inv((vec4 *)view->raster.tiles[0].light_from_world, world_from_plane);
    glm_mat4_mulv3(world_from_plane, (vec3){view->lamp.corner[0], view->lamp.corner[1], 0}, 1.0f,
                   corner);
    c[FILTER_FLOOR][0] = view->floor.ambient;
    c[FILTER_FLOOR][1] = view->floor.key;
    c[FILTER_FLOOR][2] = view->floor.weight;
    for (int k = 0; k < 2; k++) {
        float *to = c[FILTER_FLOOR_X + k];
        for (int i = 0; i < 2; i++) to[i] = world_from_plane[i][2 * k] * side / square->half_m;
        to[2] = (corner[2 * k] - square->middle[k]) / square->half_m;
    }
    c[FILTER_FLOOR_X][3] = view->penumbra.scale;
    c[FILTER_FLOOR_Z][3] = view->penumbra.bias;
}

static void filter_constants(const struct gn_shadow_view *view, uint32_t tile,
                             const struct gn_filter_stage *stage, float (*c)[4]) {
    const struct gn_rect r = tile_rect(view, tile);
    const float size[2] = {(float)view->map.width_px, (float)view->map.height_px};
    memset(c, 0, FILTER_CONSTANTS * sizeof *c);
    c[FILTER_RECT][0] = (float)r.x;
    c[FILTER_RECT][1] = (float)r.y;
    c[FILTER_RECT][2] = (float)(r.x + r.width - 1);
    c[FILTER_RECT][3] = (float)(r.y + r.height - 1);
    const float blur_px = blur_of(view, tile);
    c[FILTER_BLUR][0] = blur_px;
    c[FILTER_BLUR][1] = ceilf(blur_px - 0.5f);
    c[FILTER_BLUR][2] = blur_px > 0.0f ? 0.5f / blur_px : 1.0f;
    c[FILTER_TABLE][0] = view->lookup.reach_px;
    c[FILTER_TABLE][1] = (float)(tile * blocks_of(&view->map));
    code_transform(view, tile, c[FILTER_CODE]);
    c[FILTER_CONE][0] = cone_growth(view, tile);
    c[FILTER_CONE][1] = (float)stage->reach_px;
    c[FILTER_CONE][2] = (float)(stage->reach_px * view->map.cell_px);
    if (view->technique == GN_TECHNIQUE_FLOOR) floor_constants(view, c);
    for (int k = 0; k < 2; k++) {
        c[FILTER_SIZE][k] = size[k];
        c[FILTER_SIZE][k + 2] = 1.0f / size[k];
    }
}

/* After those of the casters of the same tile, which use only the start of their set; a part for
 * each stage. */
enum { CONSTANTS_AT = 8 };
_Static_assert(PASS_CODE_ADD < CONSTANTS_AT &&
                   CONSTANTS_AT + GN_FILTER_STAGES_MAX * FILTER_CONSTANTS <= GN_PASS_SIZE,
               "room for the constants of a filter");

/* A stage as this view runs it. Flooding alternates between two textures and ends in the light's
 * own one: after an odd number of steps the stages before them have to change places. */
static struct gn_filter_stage stage_of(const struct gn_shadow_view *view, uint32_t index) {
    const struct gn_filter_row *filter = gn_technique_filter(view->technique, view->moments);
    struct gn_filter_stage stage = filter->stages[index];
    if (stage.step == GN_STEP_CONE_SEEDS && view->map.cell_px > 2)
        stage.step = view->map.cell_px > 4 ? GN_STEP_CONE_SEEDS_8 : GN_STEP_CONE_SEEDS_4;
    bool odd = false;
    for (uint32_t i = 0; i < filter->count; i++)
        odd ^= filter->stages[i].reach_px > 0 && filter->stages[i].reach_px <= first_reach_px(view);
    if (odd && stage.reach_px == 0) {
        stage.to ^= 1;
        if (stage.from[0] >= 0) stage.from[0] ^= 1;
    }
    return stage;
}

static void add_stage_pass(struct gn_frame *frame, uint32_t slot, uint32_t tile, uint32_t index) {
    const struct gn_shadow_view *view = &frame->shadows[slot];
    const struct gn_filter_row *filter = gn_technique_filter(view->technique, view->moments);
    const struct gn_filter_stage its = stage_of(view, index), *stage = &its;
    struct gn_program_key key = gn_key_of(GN_PROGRAM_FILTER);
    key.step = (uint8_t)stage->step;
    key.moments = (uint8_t)gn_moments_of_programs(view->moments);
    if (gn_filter_steps[stage->step].reads_map) {
        key.encoding = (uint8_t)gn_encoding_of_programs(view->encoding);
        key.technique = (uint8_t)view->technique;
    }
    float(*constants)[4] = gn_frame_constants(frame, GN_CONSTANTS_SHADOW + slot * GN_SLOT_SETS +
                                                         tile * GN_SHADOW_PAGES_MAX) +
                           CONSTANTS_AT + index * FILTER_CONSTANTS;
    struct gn_pass *pass = gn_frame_begin_pass(frame, GN_PASS_FILTER);
    uint32_t size_px[2];
    gn_frame_filter_size(view->technique, &view->map, stage->to, size_px);
    snprintf(pass->label, sizeof pass->label, "shadow %u %.26s %s", slot,
             frame->scene->lights[view->light].name, gn_filter_steps[stage->step].name);
    if (stage->reach_px > 0) gn_text_add(pass->label, sizeof pass->label, " %u", stage->reach_px);
    pass->target = (struct gn_target){.kind = GN_TARGET_MOMENTS,
                                      .slot = slot,
                                      .width_px = size_px[0],
                                      .height_px = size_px[1],
                                      .moments = view->moments,
                                      .index = stage->to,
                                      .mipmaps = stage->to == 0 && gn_view_has_mipmaps(view)};
    if (view->map.tile_count > 1 && is_narrow(view->technique, stage->to))
        pass->rect = pass->viewport = (struct gn_rect){tile * blocks_of(&view->map), 0,
                                                       blocks_of(&view->map), view->map.tile_px};
    else if (view->map.tile_count > 1)
        pass->rect = pass->viewport = tile_rect(view, tile);
    pass->content = (struct gn_content){.tile = tile,
                                        .hash = gn_frame_filter_hash(view, tile),
                                        .completes = index + 1 == filter->count};
    pass->depth_write = false;
    for (int i = 0; i < GN_FILTER_FROM_MAX; i++) {
        const int8_t from = stage->from[i];
        struct gn_read *read = &pass->filter.reads[i];
        *read = (struct gn_read){.kind = GN_READ_NOTHING};
        if (from == GN_FROM_NOTHING) continue;
        *read = (struct gn_read){.kind = GN_READ_MAP};
        if (from == GN_FROM_MAP) continue;
        gn_frame_filter_size(view->technique, &view->map, (uint32_t)from, size_px);
        *read = (struct gn_read){GN_READ_MOMENTS, (uint32_t)from, size_px[0], size_px[1]};
    }
    filter_constants(view, tile, stage, constants);
    pass->constants = constants;
    pass->constant_count = FILTER_CONSTANTS;
    if (view->technique == GN_TECHNIQUE_FLOOR) {
        const uint32_t material = frame->scene->items[frame->floor.item].material;
        pass->filter.blends = view->floor.weight < 1.0f;
        key.features |= gn_key_texture(&frame->scene->materials[material], GN_TEXTURE_OCCLUSION);
        gn_frame_draw_bare(frame, &key, 3, 0, 1);
        frame->draws.at[frame->draws.count - 1].material = material;
    } else {
        gn_frame_draw_bare(frame, &key, 3, 0, 1);
    }
    gn_frame_end_pass(frame);
}

void gn_frame_filter_passes(struct gn_frame *frame, uint32_t slot) {
    const struct gn_shadow_view *view = &frame->shadows[slot];
    const struct gn_filter_row *filter = gn_technique_filter(view->technique, view->moments);
    for (uint32_t i = 0; i < filter->count; i++) {
        if (filter->stages[i].reach_px > first_reach_px(view)) continue;
        for (uint32_t tile = 0; tile < view->map.tile_count; tile++)
            add_stage_pass(frame, slot, tile, i);
    }
}
