/* Distances along the view between which a directional light's shadows are seen: the range of the
 * cascades. */
#include <cglm/cglm.h>
#include <math.h>

#include "shadow/private.h"
#include "shadow/region.h"

#define NEAREST_SHARE (1.0f / 400.0f) /* of the farthest: what is nearer counts as this far */

static void add_places(struct gn_distances *d, const vec4 plane, const struct gn_polygon *polygon) {
    for (int i = 0; i < polygon->count; i++) {
        const float depth = glm_vec3_dot((float *)plane, (float *)polygon->at[i]) + plane[3];
        d->near_m = least(d->near_m, depth);
        d->far_m = most(d->far_m, depth);
    }
}

static void clip_by(struct gn_polygon *polygon, const vec4 *planes, int count) {
    for (int i = 0; i < count && polygon->count; i++) gn_polygon_clip(polygon, planes[i]);
}

enum { PLANES = 10, WALKED_TRIANGLES = 10000 };

/* Clips only triangles that may extend the range. world: the planes that enclose what counts. */
static void add_triangles(const struct gn_fitter *f, uint32_t item, const vec4 world[PLANES],
                          const vec4 depth_ws, struct gn_distances *d) {
    const struct gn_scene *scene = f->pose->scene;
    const struct gn_geometry *g = &scene->geometries[scene->items[item].geometry];
    const vec4 *m = (const vec4 *)f->pose->items[item].world_from_item;
    vec4 planes[PLANES], depth;
    for (int c = 0; c < 4; c++) { /* planes are transformed by the transpose */
        depth[c] = glm_vec4_dot((float *)depth_ws, (float *)m[c]);
        for (int i = 0; i < PLANES; i++)
            planes[i][c] = glm_vec4_dot((float *)world[i], (float *)m[c]);
    }
    for (uint32_t i = 0; i < g->index_count; i += 3) {
        struct gn_polygon triangle = {.count = 3};
        float low = INFINITY, high = -INFINITY;
        for (int k = 0; k < 3; k++) {
            const uint32_t vertex = scene->buffers.indices[g->first_index + i + (uint32_t)k];
            glm_vec3_copy(scene->buffers.positions + 3 * (size_t)vertex, triangle.at[k]);
            const float at = glm_vec3_dot(depth, triangle.at[k]) + depth[3];
            low = least(low, at);
            high = most(high, at);
        }
        if (low >= d->near_m && high <= d->far_m) continue;
        bool is_outside = false; /* all of it is behind one plane */
        for (int p = 0; p < PLANES && !is_outside; p++) {
            int behind = 0;
            for (int k = 0; k < 3; k++)
                behind += glm_vec3_dot(planes[p], triangle.at[k]) + planes[p][3] < 0;
            is_outside = behind == 3;
        }
        if (is_outside) continue;
        clip_by(&triangle, planes, PLANES);
        add_places(d, depth, &triangle);
    }
}

/* The hull of the item's box and the frustum: faces of each by the other. */
static void add_box(const struct gn_fitter *f, uint32_t item, const vec4 world[PLANES],
                    const vec4 depth, struct gn_distances *d) {
    struct gn_polygon polygon;
    vec3 corners[8];
    vec4 sides[6];
    gn_box_corners(&f->pose->items[item].box, (vec4 *)f->pose->items[item].world_from_item,
                   corners);
    gn_box_planes(corners, sides);
    for (int i = 0; i < 12; i++) {
        gn_box_face(i < 6 ? corners : (vec3 *)f->eye->corners, i % 6, &polygon);
        clip_by(&polygon, world, PLANES);
        if (i >= 6) clip_by(&polygon, sides, 6);
        add_places(d, depth, &polygon);
    }
}

bool gn_distances_find(const struct gn_fitter *f, struct gn_distances *seen) {
    struct gn_window found;
    struct gn_fitter all = *f;
    if (f->view->map.cascade_count > 0) all.memory = &f->memory[GN_CASCADES_MAX];
    gn_shadow_look(f->view, f->tile->light_from_world);
    gn_fitter_remember(&all);
    if (!gn_window_find(&all, false, &found)) return false;

    /* in world space: the four planes round the window of all that is seen, which bounds every
     * cascade, and the eye's six */
    const struct gn_shadow_region *window = &found.window;
    const vec4 *m = f->tile->light_from_world; /* rigid: rows are the light's axes */
    vec4 planes[PLANES], depth;
    gn_eye_depth_plane(f->eye, depth);
    for (int i = 0; i < 4; i++) {
        const int axis = i / 2;
        const float sign = i % 2 ? -1.0f : 1.0f;
        for (int c = 0; c < 3; c++) planes[i][c] = sign * m[c][axis];
        planes[i][3] = i % 2 ? window->max[axis] - m[3][axis] : m[3][axis] - window->min[axis];
    }
    for (int i = 0; i < 6; i++) glm_vec4_copy((float *)f->eye->planes[i], planes[4 + i]);

    /* the receivers within them */
    const struct gn_scene *scene = f->pose->scene;
    *seen = (struct gn_distances){INFINITY, -INFINITY};
    for (uint32_t i = 0; i < all.memory->item_count; i++) {
        if (!gn_shadow_item_receives(f->pose, i, f->view) || all.memory->seen[i] == GN_SEEN_NOT)
            continue;
        const struct gn_shadow_region *part = gn_fitter_seen(&all, i);
        if (region_is_empty(part) || !regions_meet(part, window)) continue;
        const struct gn_box *box = &f->pose->items[i].box_ws;
        if (gn_box_least(depth, box) >= seen->near_m && gn_box_most(depth, box) <= seen->far_m)
            continue;
        if (scene->geometries[scene->items[i].geometry].index_count <= 3 * WALKED_TRIANGLES &&
            !gn_item_is_deformed(&scene->items[i]))
            add_triangles(f, i, planes, depth, seen);
        else
            add_box(f, i, planes, depth, seen);
    }
    return seen->near_m <= seen->far_m;
}

/* The nearest distance that cascades are fitted to. */
float gn_distances_nearest(const struct gn_distances *seen) {
    return fmaxf(seen->near_m, NEAREST_SHARE * seen->far_m);
}
