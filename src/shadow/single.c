/* One tile, of a directional light or a spot: the map is a window in plane coordinates. */
#include <cglm/cglm.h>
#include <math.h>

#include "shadow/private.h"

#define LEAST_TANGENT 1e-6f /* least side of a spot light's window */

/* The window of what this eye sees, and the one that the map holds. A fixed map has something to
 * hold even where the eye sees none of it. False: it has nothing. */
static bool find_windows(const struct gn_fitter *f, struct gn_window *seen,
                         struct gn_window *held) {
    const bool is_seen = gn_window_find(f, false, seen);
    *held = *seen;
    if (!f->view->fixed || (is_seen && gn_window_is_all(f))) return is_seen;
    if (!gn_window_find(f, true, held)) return false;
    if (!is_seen) *seen = *held;
    return true;
}

bool gn_single_fit(struct gn_fitter *f) {
    struct gn_shadow_view *view = f->view;
    const struct gn_light *light = &f->pose->lights[view->light];
    struct gn_window found, held;
    float near_depth, far_depth;
    gn_shadow_look(view, f->tile->light_from_world);
    if (gn_light_types[light->type].has_cone)
        gn_fitter_set_cone(f, tanf(fminf(light->outer_rad, GN_SPOT_MAX_RAD)));
    gn_fitter_remember(f);
    if (!find_windows(f, &found, &held)) return false;
    gn_fitter_set_depths(f, &found.depths, &near_depth, &far_depth);
    gn_fitter_set_code(f, near_depth, far_depth);
    if (view->perspective) {
        double low[2];
        gn_shadow_snap(view, held.window.min, held.window.max, LEAST_TANGENT, low);
        gn_shadow_set_frustums(view, low, near_depth, far_depth);
    } else {
        gn_pages_fit(f, view->fixed ? &held : &found, near_depth, far_depth);
    }

    mat4 map_from_clip = {{0.5f, 0, 0, 0}, {0, 0.5f, 0, 0}, {0, 0, 0.5f, 0}, {0.5f, 0.5f, 0.5f, 1}};
    const struct gn_shadow_tile *tile = &view->raster.tiles[0];
    glm_mat4_mul(map_from_clip, (vec4 *)tile->clip_from_world, view->lookup.map_from_world);
    if (!view->perspective && !gn_encoding_is_depth(view->encoding))
        for (int c = 0; c < 4; c++) {
            /* z is the code itself; the distance from the near plane is -z_ls - near */
            float depth = -tile->light_from_world[c][2] - (c == 3 ? near_depth : 0.0f);
            view->lookup.map_from_world[c][2] =
                depth * view->code.scale + (c == 3 ? view->code.offset : 0.0f);
        }
    gn_fitter_set_penumbra(f, &found.window, near_depth, far_depth);
    view->penumbra.widest_px =
        view->penumbra.radius * gn_fitter_spread(f, held.window.near, held.window.far);
    gn_fitter_set_blur(f, near_depth, far_depth);
    return true;
}
