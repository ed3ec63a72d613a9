#include "shadow/pages.h"

#include <cglm/cglm.h>
#include <math.h>

#include "shadow/private.h"
#include "shadow/region.h"

/* Along one axis: the part of the window, from texel `first` to `end`, in the page that `first`
 * lies in. */
struct stretch {
    double corner; /* the page's */
    uint32_t from_px, size_px;
};

static struct stretch stretch_at(double anchor, double first, double end, uint32_t map_px) {
    const double corner = anchor + floor((first - anchor) / map_px) * map_px;
    return (struct stretch){corner, (uint32_t)(first - corner),
                            (uint32_t)(fmin(end, corner + map_px) - first)};
}

void gn_pages_lay(const double anchor[2], const double first[2], const double last[2],
                  uint32_t map_px, struct gn_shadow_drawn *drawn) {
    struct stretch along[2][2]; /* 1 or 2 along each axis */
    uint32_t counts[2];
    *drawn = (struct gn_shadow_drawn){.paged = false};
    for (int k = 0; k < 2; k++) {
        const double end = fmin(last[k] + 1, first[k] + map_px - 2);
        const struct stretch s = along[k][0] = stretch_at(anchor[k], first[k], end, map_px);
        counts[k] = 1;
        /* paged, unless one page holds it without touching the page's edge, which stays cleared so
         * that lookups outside are lit */
        if (s.from_px < 1 || s.size_px != (uint32_t)(end - first[k]) ||
            s.from_px + s.size_px >= map_px)
            drawn->paged = true;
        if (first[k] + s.size_px < end) {
            along[k][1] = stretch_at(anchor[k], first[k] + s.size_px, end, map_px);
            counts[k] = 2;
        }
        drawn->size_px[k] = (uint32_t)(end - first[k]);
    }
    for (int k = 0; k < 2; k++) {
        drawn->corner_texels[k] = drawn->paged ? first[k] - 1 : along[k][0].corner;
        drawn->px[k] = (uint32_t)(first[k] - drawn->corner_texels[k]);
    }
    for (uint32_t p = 0; p < counts[0] * counts[1]; p++) {
        struct gn_shadow_page *page = &drawn->pages[drawn->page_count++];
        const struct stretch *s[2] = {&along[0][p % counts[0]], &along[1][p / counts[0]]};
        for (int k = 0; k < 2; k++) {
            page->corner[k] = s[k]->corner;
            page->from_px[k] = s[k]->from_px;
            page->size_px[k] = s[k]->size_px;
            page->to_px[k] = (uint32_t)(s[k]->corner + s[k]->from_px - drawn->corner_texels[k]);
        }
    }
}

/* ---- the view ---- */

/* Texels drawn on each side of what a window must hold: those read, and one for the bias. */
static double border_texels(const struct gn_shadow_view *view) {
    return view->lookup.margin_px + 1;
}

/* The texel with which a region, the texels beside it and the map's edge fit, wherever the region
 * begins. */
static float texel_for(const struct gn_fitter *f, const struct gn_shadow_region *r) {
    const double room = f->view->map.tile_px - 2 * border_texels(f->view) - 4;
    const float span = fmaxf(r->max[0] - r->min[0], r->max[1] - r->min[1]);
    return gn_shadow_step(fmaxf(span, 1e-6f * f->scene_size_m) / (float)fmax(room, 1.0));
}

/* As glm_ortho() of map_px texels from the corner on, but with a scale that does not depend on the
 * corner. */
static void set_clip(const struct gn_shadow_view *view, const double corner[2], float near_depth,
                     float far_depth, mat4 clip_from_world) {
    mat4 clip_from_light = GLM_MAT4_IDENTITY_INIT;
    for (int k = 0; k < 2; k++) {
        clip_from_light[k][k] = (float)(2.0 / ((double)view->lookup.texel * view->map.tile_px));
        clip_from_light[3][k] = (float)(-2.0 * corner[k] / view->map.tile_px - 1.0);
    }
    clip_from_light[2][2] = -2.0f / (far_depth - near_depth);
    clip_from_light[3][2] = -(far_depth + near_depth) / (far_depth - near_depth);
    glm_mat4_mul(clip_from_light, (vec4 *)view->raster.tiles[0].light_from_world, clip_from_world);
}

/* Chooses the texel, and returns the window that the pages begin with; it depends on the texel
 * alone, not on the eye. Where the window of all that any eye sees needs a texel at most one step
 * larger, that window is taken: then the map does not move with the eye. Its upper bound (`most`)
 * is tried first, since it is known already. The window of a fixed map is of all as it is. */
static struct gn_shadow_region choose_texel(const struct gn_fitter *f,
                                            const struct gn_window *found) {
    const float fine = texel_for(f, &found->window), next = 1.001f * gn_shadow_step(1.01f * fine);
    f->view->lookup.texel = fine;
    if (f->view->fixed) return found->window;
    f->view->lookup.texel = texel_for(f, &found->most);
    if (f->view->lookup.texel <= next) return found->most;
    struct gn_window all = *found;
    if (!gn_window_is_all(f)) gn_window_find(f, true, &all);
    f->view->lookup.texel = texel_for(f, &all.window);
    if (f->view->lookup.texel > next) f->view->lookup.texel = fine;
    return all.window;
}

void gn_pages_fit(const struct gn_fitter *f, const struct gn_window *found, float near_depth,
                  float far_depth) {
    struct gn_shadow_view *view = f->view;
    struct gn_shadow_drawn *drawn = &view->raster.drawn;
    double anchor[2], first[2], last[2];
    const struct gn_shadow_region all = choose_texel(f, found), *window = &found->window;
    for (int k = 0; k < 2; k++) { /* by rounding, `all` may end slightly before the window */
        const float low = fmaxf(window->min[k], all.min[k]),
                    high = fminf(window->max[k], all.max[k]);
        anchor[k] = floor((double)all.min[k] / view->lookup.texel) - border_texels(view) - 1;
        first[k] = floor((double)low / view->lookup.texel) - border_texels(view);
        last[k] = fmax(floor((double)high / view->lookup.texel) + border_texels(view), first[k]);
    }
    gn_pages_lay(anchor, first, last, view->map.tile_px, drawn);
    set_clip(view, drawn->corner_texels, near_depth, far_depth,
             view->raster.tiles[0].clip_from_world);
    for (uint32_t p = 0; p < drawn->page_count; p++)
        set_clip(view, drawn->pages[p].corner, near_depth, far_depth,
                 drawn->pages[p].clip_from_world);

    /* Marks the pages that each caster may touch, with a texel more on each side, since rasterisers
     * round. Casters are drawn whether or not this eye needs them: a texel's content does not
     * depend on the eye. */
    struct gn_shadow_region parts[GN_SHADOW_PAGES_MAX];
    for (uint32_t p = 0; p < drawn->page_count; p++) {
        const struct gn_shadow_page *page = &drawn->pages[p];
        parts[p] = nothing;
        for (int k = 0; k < 2; k++) {
            const double from = page->corner[k] + page->from_px[k];
            parts[p].min[k] = (float)((from - 1) * view->lookup.texel);
            parts[p].max[k] = (float)((from + page->size_px[k] + 1) * view->lookup.texel);
        }
    }
    for (uint32_t i = 0; i < f->memory->item_count; i++) {
        if (!f->memory->casts[i]) continue;
        uint32_t pages = 0;
        for (uint32_t p = 0; p < drawn->page_count; p++)
            pages |= (uint32_t)regions_meet(gn_fitter_whole(f, i), &parts[p]) << p;
        f->memory->casts[i] = (uint8_t)pages;
    }
}
