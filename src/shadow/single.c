/* One tile, of a directional light or a spot: the map is a window in plane coordinates. */
#include <math.h>

#include "shadow/private.h"

#define LEAST_TANGENT 1e-6f /* side of a spot's window; a sun's: as much of the scene's size */

static void set_lookup(struct gn_shadow_view *view, float near_depth) {
    mat4 map_from_clip = {{0.5f, 0, 0, 0}, {0, 0.5f, 0, 0}, {0, 0, 0.5f, 0}, {0.5f, 0.5f, 0.5f, 1}};
    glm_mat4_mul(map_from_clip, view->raster.tiles[0].clip_from_world, view->lookup.map_from_world);
    if (view->perspective || view->encoding == GN_ENCODING_DEPTH) return;
    for (int c = 0; c < 4;
         c++) { /* z is the code itself: distance from the near plane is -z_ls - near */
        float depth = -view->raster.tiles[0].light_from_world[c][2] - (c == 3 ? near_depth : 0.0f);
        view->lookup.map_from_world[c][2] =
            depth * view->code.scale + (c == 3 ? view->code.offset : 0.0f);
    }
}

static void lay_window(const struct gn_fitter *f, const struct gn_window *found, float near_depth,
                       float far_depth) {
    const struct gn_shadow_region *window = &found->window;
    double low[2];
    if (!f->view->perspective) {
        gn_pages_fit(f, found, near_depth, far_depth);
        return;
    }
    gn_shadow_snap(f->view, window->min, window->max, LEAST_TANGENT, low);
    gn_shadow_set_frustums(f->view, low, near_depth, far_depth);
}

bool gn_single_fit(struct gn_fitter *f) {
    const struct gn_light *light = &f->pose->scene->lights[f->view->light];
    struct gn_window found;
    float near_depth, far_depth;
    gn_shadow_look(f->view, f->tile->light_from_world);
    if (gn_light_types[light->type].has_cone)
        gn_fitter_set_cone(f, tanf(fminf(light->outer_rad, GN_SPOT_MAX_RAD)));
    gn_fitter_remember(f);
    if (!gn_window_find(f, false, &found)) return false;
    gn_fitter_set_depths(f, &found.depths, &near_depth, &far_depth);
    gn_fitter_set_code(f, near_depth, far_depth);
    lay_window(f, &found, near_depth, far_depth);
    set_lookup(f->view, near_depth);
    gn_fitter_set_penumbra(f, &found.window, near_depth, far_depth);
    gn_fitter_set_blur(f, near_depth, far_depth);
    return true;
}
