/* Six tiles, of a point light. */
#include <cglm/cglm.h>
#include <math.h>

#include "shadow/private.h"
#include "shadow/region.h"

#define SHARED_TEXELS 1.0f  /* drawn by both tiles on each side of their common edge */
#define EDGE_TEXELS   0.25f /* from the gutter's begin to that edge */

/* Aims and measures all tiles: the depths of the casters in any of them. False: all are empty. */
static bool find_tiles(struct gn_fitter *f, struct gn_shadow_region *depths) {
    struct gn_shadow_view *view = f->view;
    struct gn_shadow_memory *memories = f->memory;
    bool found = false;
    *depths = nothing;
    for (uint32_t i = 0; i < view->map.tile_count; i++) {
        struct gn_shadow_tile *tile = f->tile = &view->raster.tiles[i];
        const uint32_t axis = i / 2, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
        const float side = i % 2 ? -1.0f : 1.0f;
        vec4 *m = tile->light_from_world;
        glm_mat4_zero(m);
        m[u][0] = m[v][1] = m[3][3] = 1.0f;
        m[axis][2] = -side;
        m[3][0] = -view->light_ws[u];
        m[3][1] = -view->light_ws[v];
        m[3][2] = side * view->light_ws[axis];
        tile->mirrored = (axis == 1) == (side < 0.0f);
        tile->x_px = axis * view->map.tile_px;
        tile->y_px = i % 2 * view->map.tile_px;
        f->memory = &memories[i];
        gn_fitter_set_cone(f, 0.5f * view->lookup.texel * (float)view->map.tile_px);

        struct gn_window own;
        gn_fitter_remember(f);
        tile->empty = !gn_window_find(f, view->fixed, &own);
        found |= !tile->empty;
        unite(depths, &own.depths);
    }
    f->memory = memories;
    return found;
}

bool gn_cube_fit(struct gn_fitter *f) {
    struct gn_shadow_view *view = f->view;
    struct gn_shadow_region depths;

    /* Where tiles share their edges, places beyond an edge are looked up too, and the normal offset
     * moves them further by up to sqrt(2) offsets, since tangents grow that much faster at 45
     * degrees. The edge lies neither in the middle of a texel nor between two, where two opposite
     * taps would change texels at once. */
    const struct gn_technique_row *row = &gn_techniques[view->technique];
    const bool shared = gn_technique_shades(view->technique);
    const float beyond =
        EDGE_TEXELS + (shared ? SHARED_TEXELS + 1.4142136f * view->lookup.bias_texels : 0.0f);
    const uint32_t wanted = (uint32_t)ceilf((float)view->lookup.margin_px + 1.0f + beyond);
    view->map.gutter_px =
        row->soft && wanted < view->map.tile_px / 8 ? view->map.tile_px / 8 : wanted;
    if (view->map.gutter_px > view->map.tile_px / 4) view->map.gutter_px = view->map.tile_px / 4;
    view->lookup.reach_px = (float)view->map.gutter_px - 1.0f - beyond;
    if (row->filter == GN_FILTER_TABLE)
        view->lookup.reach_px = least(view->lookup.reach_px, GN_TABLE_REACH_PX);
    view->lookup.texel =
        2.0f / ((float)(view->map.tile_px - 2 * view->map.gutter_px) + 2.0f * EDGE_TEXELS);
    view->lookup.shared = SHARED_TEXELS * view->lookup.texel;

    if (!find_tiles(f, &depths)) return false;
    float near_depth, far_depth;
    double edge = -0.5 * (double)view->lookup.texel * view->map.tile_px;
    /* near and far are common to all tiles: they change in steps, so that what moves redraws only
     * the tiles that it is in */
    depths.near = exp2f(floorf(4.0f * log2f(depths.near)) / 4.0f);
    depths.far = exp2f(ceilf(4.0f * log2f(depths.far)) / 4.0f);
    depths.far_radial = exp2f(ceilf(4.0f * log2f(depths.far_radial)) / 4.0f);
    gn_fitter_set_depths(f, &depths, &near_depth, &far_depth);
    gn_fitter_set_code(f, near_depth, far_depth);
    gn_shadow_set_frustums(view, (double[2]){edge, edge}, near_depth, far_depth);
    gn_fitter_set_penumbra(f, &depths, near_depth, far_depth);
    gn_fitter_set_blur(f, near_depth, far_depth);
    view->lookup.tangent_uv[0] = 1.0f / (view->lookup.texel * (float)view->map.width_px);
    view->lookup.tangent_uv[1] = 1.0f / (view->lookup.texel * (float)view->map.height_px);
    return true;
}
