#include "shadow/cascade.h"

#include <cglm/cglm.h>
#include <math.h>

#include "shadow/private.h"
#include "shadow/region.h"

#define NEAR_STEPS    1.0f /* per octave: rounding of the distances that splits are made from */
#define FAR_STEPS     2.0f
#define LEAST_RATIO   1.25f          /* of successive splits: wider apart than they fade */
#define LEAST_ROOM    (1.0f / 64.0f) /* gutters for penumbrae, as a share of a tile's side */
#define MOST_ROOM     (1.0f / 8.0f)
#define TABLE_ROOM    (1.0f / 4.0f) /* GN_TABLE_REACH_PX is less, except in very small maps */
#define UNBOUND       1e9f
#define SPAN_STEPS    2.0f  /* per octave */
#define NEAREST_STEPS 32.0f /* within a span */
#define LEAST_SPAN    (1.0f / 256.0f)

/* Rounds up or down to one of so many steps per octave. */
static float round_to_step(float size, float steps, bool up) {
    const float at = steps * log2f(size);
    return exp2f((up ? ceilf(at) : floorf(at)) / steps);
}

/* ---- tiles ---- */

void gn_cascade_map_size(uint32_t cascades, uint32_t map_px, uint32_t size_px[2]) {
    size_px[0] = 2 * map_px;
    size_px[1] = (cascades > 2 ? 2 : 1) * map_px;
}

static bool reads_table(const struct gn_shadow_view *view) {
    return gn_techniques[view->technique].filter == GN_FILTER_TABLE;
}

/* Gutters as wide as the technique reads beside a place: a soft one at most `room`, as a share of a
 * tile's side. A technique with a table needs no gutter for its reach, because its shader knows
 * where the tile ends (shaders_es/lib/table.glsl); it reads the outermost texels only. */
static void lay_gutters(struct gn_shadow_view *view, float room) {
    const struct gn_technique_row *row = &gn_techniques[view->technique];
    const uint32_t fixed = view->lookup.margin_px + 1,
                   soft = row->soft ? (uint32_t)(room * (float)view->map.tile_px) : 0,
                   reach = soft > fixed ? soft : fixed;
    view->map.gutter_px = (reads_table(view) ? fixed : reach) + 1;
    view->map.inner_px = view->map.tile_px - 2 * view->map.gutter_px;
    view->lookup.reach_px =
        reads_table(view) ? least((float)reach, GN_TABLE_REACH_PX) : (float)reach;
    view->lookup.held_px = 0.5f * (float)view->map.inner_px + view->lookup.reach_px;
}

/* Three cascades get a map for four, so that each tile has neighbours on the same sides. */
void gn_cascades_lay(uint32_t cascades, struct gn_shadow_view *view) {
    uint32_t size_px[2];
    gn_cascade_map_size(cascades, view->map.tile_px, size_px);
    view->map.width_px = size_px[0];
    view->map.height_px = size_px[1];
    view->map.cascade_count = cascades;
    view->map.tile_count = cascades > 2 ? 4 : 2;
    lay_gutters(view, LEAST_ROOM);
    for (uint32_t i = 0; i < view->map.tile_count; i++) {
        view->raster.tiles[i].x_px = i % 2 * view->map.tile_px;
        view->raster.tiles[i].y_px = i / 2 * view->map.tile_px;
        view->raster.tiles[i].empty = i >= cascades;
        if (gn_techniques[view->technique].filter == GN_FILTER_BLUR)
            view->cascades[i].blur_px = GN_BLUR_LEAST_PX; /* for empty tiles */
    }
}

/* The part of the eye's frustum between two distances; false: none. */
static bool cut_frustum(const struct gn_eye *eye, const struct gn_shadow_cascade *c,
                        struct gn_eye *part) {
    vec4 depth;
    float ends[2];
    *part = *eye;
    gn_eye_depth_plane(eye, depth);
    for (int k = 0; k < 2; k++)
        ends[k] = glm_vec3_dot(depth, (float *)eye->corners[4 * k]) + depth[3];
    const float at[2] = {fmaxf(c->begin_m, ends[0]), fminf(c->end_m, ends[1])};
    if (!(at[0] < at[1])) return false;
    for (int k = 0; k < 2; k++) {
        const float sign = k ? -1.0f : 1.0f, share = (at[k] - ends[0]) / (ends[1] - ends[0]);
        if (at[k] == ends[k]) continue;
        for (int i = 0; i < 4; i++) /* the corners move along the frustum's four edges */
            glm_vec3_lerp((float *)eye->corners[i], (float *)eye->corners[i + 4], share,
                          part->corners[i + 4 * k]);
        glm_vec4_scale(depth, sign, part->planes[4 + k]);
        part->planes[4 + k][3] -= sign * at[k];
    }
    return true;
}

/* ---- fitting ---- */

static void copy_tile(struct gn_shadow_view *view, uint32_t index,
                      const struct gn_shadow_view *tile) {
    struct gn_shadow_cascade *c = &view->cascades[index];
    c->texel = tile->lookup.texel;
    c->blur_px = tile->penumbra.blur_px;

    /* Moments need not span all that casts anywhere, of which a near tile shows little: they begin
     * at the nearest caster and end at the farthest place in shadow that is seen. By steps, so that
     * they stay while the eye moves little. */
    const float wanted = most(1.01f * (tile->penumbra.farthest - tile->penumbra.nearest),
                              LEAST_SPAN * tile->code.far_m) *
                         NEAREST_STEPS / (NEAREST_STEPS - 1.0f);
    c->span = least(round_to_step(wanted, SPAN_STEPS, true), tile->code.far_m);
    const float part = c->span / NEAREST_STEPS;
    c->nearest = least(floorf(tile->penumbra.nearest / part) * part, tile->code.far_m - c->span);
    if (!gn_technique_replaces_map(tile->technique)) c->nearest = tile->penumbra.nearest;

    c->drawn = tile->raster.drawn;
    glm_mat4_copy((vec4 *)tile->raster.tiles[0].light_from_world,
                  view->raster.tiles[index].light_from_world);
    glm_mat4_copy((vec4 *)tile->raster.tiles[0].clip_from_world,
                  view->raster.tiles[index].clip_from_world);
}

/* Fits tile `index` as a map of its own; false: it is empty. */
static bool fit_tile(const struct gn_fitter *f, uint32_t index, float blur_most_m,
                     struct gn_shadow_view *tile) {
    struct gn_eye eye;
    if (!cut_frustum(f->eye, &f->view->cascades[index], &eye)) return false;
    *tile = *f->view;
    tile->map.tile_px = tile->map.width_px = tile->map.height_px = f->view->map.inner_px;
    tile->map.tile_count = 1;
    tile->map.cascade_count = 0;
    tile->raster.tiles[0].empty = false; /* tile 0 of the view may be */
    struct gn_fitter own = *f;
    own.is_cascade = true;
    own.blur_most_m = blur_most_m;
    own.eye = &eye;
    own.memory = &f->memory[index];
    own.view = tile;
    own.tile = tile->raster.tiles;
    if (!gn_single_fit(&own)) return false;
    tile->raster.tiles[0].content_hash =
        gn_shadow_hash(f->pose, tile, tile->raster.tiles, own.memory->casts);
    return true;
}

/* Fits every tile with the present gutters; false: all are empty. */
static bool fit_tiles(const struct gn_fitter *f, float widest_m[GN_CASCADES_MAX]) {
    struct gn_shadow_view *view = f->view, tile;
    float blur_most_m = 0.0f;
    bool found = false;
    for (uint32_t i = 0; i < view->map.cascade_count; i++) {
        view->raster.tiles[i].empty = !fit_tile(f, i, blur_most_m, &tile);
        widest_m[i] = 0.0f;
        if (view->raster.tiles[i].empty) continue;
        copy_tile(view, i, &tile);
        widest_m[i] = f->light_radius * (tile.penumbra.farthest - tile.penumbra.nearest);
        view->raster.tiles[i].content_hash = tile.raster.tiles[0].content_hash;
        if (found) continue;
        found = true;

        /* the same for all tiles: from the first that holds anything */
        view->code = tile.code;
        view->lookup.texel = tile.lookup.texel;
        view->penumbra.scale = tile.penumbra.scale;
        view->penumbra.bias = tile.penumbra.bias;
        view->penumbra.radius = tile.penumbra.radius * tile.lookup.texel;
        blur_most_m = GN_BLUR_MOST_PX * tile.lookup.texel;
        for (int c = 0; c < 4; c++) {
            vec4 column = {tile.raster.tiles[0].light_from_world[c][0],
                           tile.raster.tiles[0].light_from_world[c][1],
                           tile.lookup.map_from_world[c][2], c == 3};
            glm_vec4_copy(column, view->lookup.map_from_world[c]);
        }
    }
    return found;
}

static bool has_room(const struct gn_shadow_view *view, const float widest_m[GN_CASCADES_MAX]) {
    for (uint32_t i = 0; i < view->map.cascade_count; i++)
        if (widest_m[i] > view->lookup.reach_px * view->cascades[i].texel) return false;
    return true;
}

/* Gutters are doubled until they have room for all penumbrae that can be seen. The penumbrae's
 * width does not depend on the gutters; the texel's does, since wider gutters leave less of the
 * tile. */
bool gn_cascades_fit(const struct gn_fitter *f) {
    struct gn_shadow_view *view = f->view;
    struct gn_distances seen;
    float widest_m[GN_CASCADES_MAX], room = LEAST_ROOM;
    const float most_room = reads_table(view) ? TABLE_ROOM : MOST_ROOM;
    if (!gn_distances_find(f, &seen)) return false;

    /* the splits: each cascade is as many times as long as the one before */
    const uint32_t n = view->map.cascade_count;
    float far_m = round_to_step(fmaxf(seen.far_m, 1e-6f), FAR_STEPS, true);
    const float near_m =
        round_to_step(fmaxf(gn_distances_nearest(&seen), 1e-6f), NEAR_STEPS, false);
    far_m = fmaxf(far_m, near_m * powf(LEAST_RATIO, (float)n));
    for (uint32_t i = 0; i < n; i++) {
        struct gn_shadow_cascade *c = &view->cascades[i];
        c->end_m = i + 1 < n ? near_m * powf(far_m / near_m, (float)(i + 1) / (float)n) : INFINITY;
        c->begin_m = i > 0 ? (1.0f - GN_CASCADE_FADE) * view->cascades[i - 1].end_m : 0.0f;
    }

    if (!fit_tiles(f, widest_m)) return false;
    while (gn_techniques[view->technique].soft && room < most_room && !has_room(view, widest_m)) {
        const uint32_t fitted_px = view->map.inner_px;
        do {
            const uint32_t inner_px = view->map.inner_px;
            lay_gutters(view, room *= 2.0f);
            for (uint32_t i = 0; i < view->map.cascade_count; i++)
                view->cascades[i].texel *= (float)inner_px / (float)view->map.inner_px;
        } while (room < most_room && !has_room(view, widest_m));
        if (view->map.inner_px != fitted_px) fit_tiles(f, widest_m);
    }

    /* Where a tile has no room for its widest penumbra, penumbrae are limited in proportion to the
     * distance from the eye: a limit per tile would be visible at each split. */
    view->penumbra.growth = UNBOUND;
    for (uint32_t i = 0; i < view->map.cascade_count; i++) {
        const bool last = i + 1 == view->map.cascade_count;
        const float room_m = view->lookup.reach_px * view->cascades[i].texel,
                    to_m = view->cascades[last ? i - 1 : i].end_m;
        if (widest_m[i] > room_m)
            view->penumbra.growth = fminf(view->penumbra.growth, room_m / (to_m * f->light_radius));
    }
    for (uint32_t i = 0; i < view->map.tile_count; i++)
        if (view->raster.tiles[i].empty)
            view->raster.tiles[i].content_hash =
                gn_shadow_hash(f->pose, view, &view->raster.tiles[i], NULL);
    return true;
}
