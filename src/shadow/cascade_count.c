/* How many cascades: whether there can be any, and how sharp a map is with so many. */
#include <cglm/cglm.h>
#include <math.h>

#include "shadow/cascade.h"
#include "shadow/private.h"

bool gn_cascade_can(const struct gn_light *light, const struct gn_eye *eye,
                    const struct gn_shadow_opts *opts) {
    vec4 depth;
    gn_eye_depth_plane(eye, depth);
    return !gn_light_types[light->type].has_position && glm_vec3_norm2(depth) > 0.0f &&
           !gn_techniques[opts->technique].on_plane && opts->map_px >= GN_CASCADE_LEAST_PX;
}

float gn_cascade_tangent(const struct gn_pose *pose, uint32_t light, const struct gn_eye *eye,
                         const struct gn_shadow_opts *opts, struct gn_shadow_memory *memory) {
    struct gn_shadow_view view;
    struct gn_distances seen;
    if (!gn_shadow_fit(pose, light, eye, opts, memory, &view)) return 0.0f;
    if (view.perspective || gn_techniques[view.technique].on_plane) return view.lookup.texel;
    const struct gn_fitter f = {.pose = pose,
                                .eye = eye,
                                .memory = memory,
                                .view = &view,
                                .tile = view.raster.tiles,
                                .scene_size_m = gn_scene_size_m(pose),
                                .light_radius = GN_LIGHT_HAS(&opts->light, radius)
                                                    ? opts->light.radius
                                                    : pose->scene->lights[light].radius,
                                .range_m = INFINITY};
    if (!gn_distances_find(&f, &seen)) return 0.0f;
    if (view.map.cascade_count == 0) return view.lookup.texel / gn_distances_nearest(&seen);
    float tangent = 0.0f;
    for (uint32_t i = 0; i < view.map.cascade_count; i++) {
        const struct gn_shadow_cascade *c = &view.cascades[i];
        if (!view.raster.tiles[i].empty)
            tangent = fmaxf(tangent, c->texel / fmaxf(c->begin_m, gn_distances_nearest(&seen)));
    }
    return tangent;
}
