/* The regions that items cover in a light's plane, and the parts of them that the eye sees. Both
 * are kept from frame to frame, so that what stands still is measured once. gn_fitter_within()
 * measures anew each time; it is called for casters that reach beyond what is seen. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "shadow/private.h"
#include "shadow/region.h"

#define NEAREST_TRIANGLES                                                                          \
    10000 /* of an item round the light: with more the nearest is not searched for */

void gn_shadow_memory_init(struct gn_shadow_memory *memory, uint32_t item_count) {
    memory->item_count = item_count;
    memory->casts = gn_xalloc(item_count, sizeof *memory->casts);
    memory->seen = gn_xalloc(item_count, sizeof *memory->seen);
    memory->whole = gn_xalloc(item_count, sizeof *memory->whole);
    memory->part = gn_xalloc(item_count, sizeof *memory->part);
    memory->pose_hash = gn_xalloc(item_count, sizeof *memory->pose_hash);
    memory->light_hash = memory->eye_hash = 0;
}

void gn_shadow_memory_finish(struct gn_shadow_memory *memory) {
    free(memory->casts);
    free(memory->seen);
    free(memory->whole);
    free(memory->part);
    free(memory->pose_hash);
    *memory = (struct gn_shadow_memory){0};
}

void gn_fitter_set_cone(struct gn_fitter *f, float tan_cone) {
    f->tan_cone = tan_cone;
    f->near_m = gn_shadow_step(1e-4f * f->scene_size_m);
    vec4 planes[6] = {{1, 0, -tan_cone, 0},  {-1, 0, -tan_cone, 0},  {0, 1, -tan_cone, 0},
                      {0, -1, -tan_cone, 0}, {0, 0, -1, -f->near_m}, {0, 0, 1, f->range_m}};
    f->cone_count = isfinite(f->range_m) ? 6 : 5;
    for (int i = 0; i < f->cone_count; i++) /* planes are transformed by the transpose */
        for (int c = 0; c < 4; c++)
            f->cone[i][c] = glm_vec4_dot(planes[i], f->tile->light_from_world[c]);
}

static void add_point(const struct gn_fitter *f, struct gn_shadow_region *r, vec3 p_ws) {
    vec3 p;
    glm_mat4_mulv3(f->tile->light_from_world, p_ws, 1.0f, p);
    float depth = -p[2];
    float scale = f->view->perspective ? 1.0f / most(depth, f->near_m) : 1.0f;
    struct gn_shadow_region point = {
        {p[0] * scale, p[1] * scale}, {p[0] * scale, p[1] * scale}, depth, depth, glm_vec3_norm(p)};
    unite(r, &point);
}

static void add_polygon(const struct gn_fitter *f, struct gn_shadow_region *r,
                        struct gn_polygon *polygon, bool seen_only) {
    if (seen_only)
        for (int i = 0; i < 6 && polygon->count; i++) gn_polygon_clip(polygon, f->eye->planes[i]);
    for (int i = 0; i < f->cone_count && polygon->count; i++) gn_polygon_clip(polygon, f->cone[i]);
    for (int i = 0; i < polygon->count; i++) add_point(f, r, polygon->at[i]);
}

/* The light is in the item's box: the item may come nearer than the box's faces. */
static void add_nearest(const struct gn_fitter *f, struct gn_shadow_region *r, uint32_t item) {
    const struct gn_scene *scene = f->pose->scene;
    const struct gn_geometry *g = &scene->geometries[scene->items[item].geometry];
    const struct gn_box *box = &f->pose->items[item].box_ws;
    for (int k = 0; k < 3; k++)
        if (f->view->light_ws[k] < box->min[k] || f->view->light_ws[k] > box->max[k]) return;
    if (g->index_count > 3 * NEAREST_TRIANGLES) {
        r->near = f->near_m;
        return;
    }
    mat4 light_from_item;
    const bool deformed = gn_item_is_deformed(&scene->items[item]);
    glm_mat4_mul((vec4 *)f->tile->light_from_world, (vec4 *)f->pose->items[item].world_from_item,
                 light_from_item);
    for (uint32_t i = 0; i < g->index_count; i += 3) {
        const uint32_t *indices = scene->buffers.indices + g->first_index + i;
        vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
        for (int k = 0; k < 3; k++) {
            vec3 p;
            if (deformed) {
                gn_pose_corner(f->pose, item, indices[k], p);
                glm_mat4_mulv3((vec4 *)f->tile->light_from_world, p, 1.0f, p);
            } else
                glm_mat4_mulv3(light_from_item, scene->buffers.positions + 3 * (size_t)indices[k],
                               1.0f, p);
            glm_vec3_minv(low, p, low);
            glm_vec3_maxv(high, p, high);
        }
        /* the nearest point of the triangle's box, by its largest coordinate */
        float from = 0.0f;
        for (int k = 0; k < 3; k++) from = most(from, most(low[k], -high[k]));
        r->near = least(r->near, most(from / most(f->tan_cone, 1.0f), f->near_m));
    }
}

/* The region of an item within the light's cone; seen_only: and within the eye's frustum. */
static struct gn_shadow_region measure_item(const struct gn_fitter *f, uint32_t item,
                                            bool seen_only) {
    struct gn_shadow_region r = nothing;
    const struct gn_pose_item *posed = &f->pose->items[item];
    const struct gn_geometry *g = &f->pose->scene->geometries[f->pose->scene->items[item].geometry];
    if (gn_planes_miss(f->cone, f->cone_count, &posed->box_ws)) return r;
    if (f->view->perspective && !gn_box_is_near(&posed->box_ws, f->view->light_ws, f->range_m))
        return r;
    vec3 corners[8];
    gn_box_corners(&posed->box, (vec4 *)posed->world_from_item, corners);
    if (!seen_only && gn_planes_hold(f->cone, f->cone_count, &posed->box_ws))
        for (int i = 0; i < 8; i++) add_point(f, &r, corners[i]);
    else if (g->index_count <= 3 * GN_EXACT_TRIANGLES)
        for (uint32_t i = 0; i < g->index_count; i += 3) {
            struct gn_polygon triangle;
            gn_item_triangle(f->pose, item, i, &triangle);
            add_polygon(f, &r, &triangle, seen_only);
        }
    else { /* the intersection of box and frustum: faces of each clipped by the other */
        struct gn_polygon face;
        for (int i = 0; i < 6; i++) {
            gn_box_face(corners, i, &face);
            add_polygon(f, &r, &face, seen_only);
        }
        vec4 planes[6] = {0};
        if (seen_only) gn_box_planes(corners, planes);
        for (int i = 0; seen_only && i < 6; i++) {
            gn_box_face((vec3 *)f->eye->corners, i, &face);
            for (int k = 0; k < 6 && face.count; k++) gn_polygon_clip(&face, planes[k]);
            add_polygon(f, &r, &face, false);
        }
    }
    if (f->view->perspective && g->index_count > 3 * GN_EXACT_TRIANGLES && !seen_only)
        add_nearest(f, &r, item);
    return r;
}

const struct gn_shadow_region *gn_fitter_whole(const struct gn_fitter *f, uint32_t item) {
    return &f->memory->whole[item];
}

const struct gn_shadow_region *gn_fitter_seen(const struct gn_fitter *f, uint32_t item) {
    return f->memory->seen[item] == GN_SEEN_WHOLE ? gn_fitter_whole(f, item)
                                                  : &f->memory->part[item];
}

struct gn_shadow_region gn_fitter_within(const struct gn_fitter *f, uint32_t item,
                                         const vec4 *planes, int count) {
    struct gn_fitter own = *f;
    memcpy(own.cone, planes, (size_t)count * sizeof *planes);
    own.cone_count = count;
    return measure_item(&own, item, false);
}

void gn_fitter_remember(const struct gn_fitter *f) {
    struct gn_shadow_memory *m = f->memory;
    uint64_t light =
        gn_hash(GN_HASH_INIT, f->tile->light_from_world, sizeof f->tile->light_from_world);
    const float cone[3] = {f->tan_cone, f->near_m, f->range_m};
    light = gn_hash(light, cone, sizeof cone);
    uint64_t eye = gn_hash(GN_HASH_INIT, f->eye->planes, sizeof f->eye->planes);
    for (uint32_t i = 0; i < m->item_count; i++) {
        const struct gn_pose_item *posed = &f->pose->items[i];
        if (!posed->visible) {
            m->seen[i] = GN_SEEN_NOT;
            m->pose_hash[i] = 0;
            continue;
        }
        bool same = m->light_hash == light && m->pose_hash[i] == posed->hash;
        if (!same) m->whole[i] = measure_item(f, i, false);
        m->pose_hash[i] = posed->hash;
        if (same && m->eye_hash == eye) continue;
        if (region_is_empty(&m->whole[i])) {
            m->seen[i] = GN_SEEN_NOT;
            continue;
        }
        m->seen[i] = !gn_eye_sees(f->eye, &posed->box_ws)                ? GN_SEEN_NOT
                     : gn_planes_hold(f->eye->planes, 6, &posed->box_ws) ? GN_SEEN_WHOLE
                                                                         : GN_SEEN_PARTLY;
        if (m->seen[i] == GN_SEEN_PARTLY) m->part[i] = measure_item(f, i, true);
    }
    m->light_hash = light;
    m->eye_hash = eye;
}
