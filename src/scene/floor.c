/* The shadow catcher: an unseen floor under a model that has none. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <math.h>

#include "scene/exact.h"
#include "scene/pose.h"

enum {
    CELLS = 32,     /* of the model's footprint, to each side */
    WORK = 1 << 24, /* triangles and cells that they are over; no more are looked at */
};
/* A floor covers this share of the footprint, this near the model's lowest point, and this share of
 * all of it where what faces down, of both sides, is the underside of what lies above. */
static const float LEAST_COVERED = .6f, LOWEST = .1f, LEAST_OF_ALL = .2f;
/* Half its side, in half diagonals of the model: the shadow of a sun 7 degrees high is on it. */
static const float REACH = 8;
/* Below the model, in diagonals of it: a flat underside is not drawn into. */
static const float BELOW = 2e-4f;

struct footprint {
    const struct gn_box *box;
    float highest; /* what lies above is no floor, but a roof */
    int64_t work_left;
    struct cells {
        bool ground[CELLS][CELLS], underside[CELLS][CELLS], roofed[CELLS][CELLS];
    } all, own;            /* of the item that is looked at: */
    int first[2], last[2]; /* what it has marked lies between these; x and z */
};

/* Marks the cells whose middle a triangle covers that is seen from above, or that is a roof. */
static void mark_triangle(struct footprint *f, vec3 corner[3], bool mirrored, bool both_sides) {
    float at[3][2];
    bool is_roof = false;
    for (int i = 0; i < 3; i++) {
        is_roof |= corner[i][1] > f->highest;
        for (int k = 0; k < 2; k++)
            at[i][k] = (corner[i][2 * k] - f->box->min[2 * k]) /
                       (f->box->max[2 * k] - f->box->min[2 * k]) * (float)CELLS;
    }
    /* twice the area seen from above, clockwise in (x, z) when it faces up */
    float area = (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]) -
                 (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]);
    if (mirrored) area = -area;
    if (area == 0 || (area < 0 && !both_sides && !is_roof)) return;
    bool(*marks)[CELLS] = is_roof ? f->own.roofed : area < 0 ? f->own.underside : f->own.ground;
    int first[2], last[2];
    for (int k = 0; k < 2; k++) {
        first[k] = (int)glm_clamp(floorf(fminf(fminf(at[0][k], at[1][k]), at[2][k])), 0, CELLS - 1);
        last[k] = (int)glm_clamp(ceilf(fmaxf(fmaxf(at[0][k], at[1][k]), at[2][k])), 0, CELLS - 1);
    }
    f->work_left -= (int64_t)(last[0] - first[0] + 1) * (last[1] - first[1] + 1);
    for (int k = 0; k < 2; k++) {
        if (first[k] < f->first[k]) f->first[k] = first[k];
        if (last[k] > f->last[k]) f->last[k] = last[k];
    }
    for (int z = first[1]; z <= last[1]; z++)
        for (int x = first[0]; x <= last[0]; x++) {
            const float p[2] = {(float)x + .5f, (float)z + .5f};
            int sides = 0; /* the middle lies on the same side of all edges */
            for (int i = 0; i < 3; i++) {
                const float *a = at[i], *b = at[(i + 1) % 3];
                sides +=
                    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) >= 0 ? 1 : -1;
            }
            if (sides == 3 || sides == -3) marks[z][x] = true;
        }
}

/* What faces up inside a body, under a roof of its own, is no ground. Returns whether the item has
 * an underside. */
static bool add_item(struct footprint *f) {
    bool has_underside = false;
    for (int z = f->first[1]; z <= f->last[1]; z++)
        for (int x = f->first[0]; x <= f->last[0]; x++) {
            f->all.ground[z][x] |= f->own.ground[z][x] && !f->own.roofed[z][x];
            f->all.underside[z][x] |= f->own.underside[z][x];
            f->all.roofed[z][x] |= f->own.roofed[z][x];
            has_underside |= f->own.underside[z][x];
            f->own.ground[z][x] = f->own.underside[z][x] = f->own.roofed[z][x] = false;
        }
    for (int k = 0; k < 2; k++) f->first[k] = CELLS, f->last[k] = -1;
    return has_underside;
}

/* Marks the cells of items that reach down to where a floor is, or of those that do not. Returns
 * whether one has an underside. */
static bool mark_items(struct footprint *f, const struct gn_scene *scene,
                       const struct gn_pose *pose, bool low) {
    bool has_underside = false;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_pose_item *posed = &pose->items[i];
        const struct gn_item *item = &scene->items[i];
        const struct gn_geometry *geometry = &scene->geometries[item->geometry];
        if (!posed->visible || !item->receives) continue;
        if ((posed->box_ws.min[1] <= f->highest) != low) continue;
        const uint32_t *index = scene->buffers.indices + geometry->first_index;
        for (uint32_t t = 0; t + 2 < geometry->index_count && --f->work_left > 0; t += 3) {
            vec3 corner[3];
            for (int k = 0; k < 3; k++) gn_pose_corner(pose, i, index[t + (uint32_t)k], corner[k]);
            mark_triangle(f, corner, posed->mirrored,
                          scene->materials[item->material].double_sided);
        }
        has_underside |= add_item(f);
    }
    return has_underside;
}

/* Whether most of the model stands on something that faces up and is drawn. */
static bool has_floor(const struct gn_scene *scene, const struct gn_pose *pose) {
    const struct gn_box *box = &scene->box;
    struct footprint f = {.box = box,
                          .work_left = WORK,
                          .highest = glm_lerp(box->min[1], box->max[1], LOWEST),
                          .first = {CELLS, CELLS},
                          .last = {-1, -1}};
    if (!(box->max[0] > box->min[0]) || !(box->max[2] > box->min[2])) return false;
    if (mark_items(&f, scene, pose, true)) mark_items(&f, scene, pose, false);
    int open = 0, covered = 0;
    for (int z = 0; z < CELLS; z++)
        for (int x = 0; x < CELLS; x++) {
            const bool roofed = f.all.roofed[z][x];
            const bool is_ground = f.all.ground[z][x] || (f.all.underside[z][x] && !roofed);
            open += is_ground || !roofed;
            covered += is_ground;
        }
    return (float)covered >= fmaxf(LEAST_COVERED * (float)open, LEAST_OF_ALL * CELLS * CELLS);
}

/* A square of side 2 in the plane y = 0 of its node; returns its geometry. */
static uint32_t add_square(struct gn_scene *scene) {
    static const float corners[4][2] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}};
    static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
    struct gn_scene_buffers *buffers = &scene->buffers;
    struct gn_geometry *geometry = &scene->geometries[scene->geometry_count];
    *geometry = (struct gn_geometry){
        .first_vertex = buffers->vertex_count,
        .vertex_count = 4,
        .first_index = buffers->index_count,
        .index_count = 6,
        .box = {{-1, 0, -1}, {1, 0, 1}},
        .layers = {0, 1, 0},
        .attributes = 1u << GN_ATTRIBUTE_POSITION | 1u << GN_ATTRIBUTE_NORMAL,
        .flat = true,
        .plane = {0, 1, 0, 0},
    };
    for (uint32_t i = 0; i < 4; i++) {
        const size_t at = 3 * (size_t)(buffers->vertex_count + i);
        glm_vec3_copy((vec3){corners[i][0], 0, corners[i][1]}, buffers->positions + at);
        glm_vec3_copy((vec3){0, 1, 0}, buffers->normals + at);
    }
    for (int i = 0; i < 6; i++)
        buffers->indices[buffers->index_count + (uint32_t)i] = buffers->vertex_count + order[i];
    buffers->vertex_count += 4;
    buffers->index_count += 6;
    return scene->geometry_count++;
}

/* The lowest point of the model, at rest and over the clips that play by default. */
static float lowest_point(const struct gn_scene *scene) {
    const struct gn_extent *extent = &scene->extents[GN_POSE_DEFAULT - GN_POSE_NONE];
    float lowest = scene->box.min[1];
    for (uint32_t i = 0; i < extent->count; i++) lowest = fminf(lowest, extent->points[i][1]);
    return lowest;
}

void gn_scene_add_floor(struct gn_gltf *g, struct gn_pose *pose) {
    struct gn_scene *scene = g->scene;
    const struct gn_scene_floor *floor = &g->limits.floor;
    if (floor->kind == GN_FLOOR_NONE) return;
    gn_pose_choose(pose, GN_POSE_NONE);
    if (floor->kind == GN_FLOOR_AUTO && has_floor(scene, pose)) return;
    const struct gn_box *box = &scene->box;
    const float size = fmaxf(glm_vec3_distance((float *)box->min, (float *)box->max), 1e-9f);
    const float half_m = REACH * size / 2;
    vec3 middle;
    glm_vec3_center((float *)box->min, (float *)box->max, middle);
    middle[1] = floor->kind == GN_FLOOR_HEIGHT ? (float)(floor->height_m - scene->place.origin[1])
                                               : lowest_point(scene) - BELOW * size;
    gn_pose_choose(pose, GN_POSE_DEFAULT);
    const int32_t occlusion = gn_floor_occlusion(g, pose, middle, half_m * GN_FLOOR_OCCLUDED);
    if (g->failed) return;

    const uint32_t node = scene->node_count++, material = scene->material_count++;
    g->placed[node].mesh = -1;
    g->placed[node].morph = -1;
    scene->nodes[node] = (struct gn_node){
        .name = gn_gltf_strdup(g, "floor"),
        .parent = -1,
        .rotation = {0, 0, 0, 1},
        .scale = {half_m, 1, half_m},
    };
    gn_exact_put(&scene->place, middle, scene->nodes[node].translation, scene->nodes[node].rest);
    struct gn_material *m = &scene->materials[material];
    gn_material_init(m);
    m->name = scene->nodes[node].name;
    m->metalness = 0;
    m->alpha = GN_ALPHA_BLEND;
    m->shadow_catcher = true;
    m->textures[GN_TEXTURE_OCCLUSION].texture = occlusion;
    /* The plane of planar shadows, unless the file names one. */
    bool named = false;
    for (uint32_t i = 0; i < node; i++) named |= g->placed[i].plane == GN_YES;
    for (uint32_t i = 0; i < scene->item_count && !named; i++) scene->items[i].plane = 0;
    scene->added.floor = true;
    scene->triangle_count += 2;
    scene->items[scene->item_count++] = (struct gn_item){
        .node = node,
        .geometry = add_square(scene),
        .material = material,
        .instance = -1,
        .skin = -1,
        .morph = -1,
        .receives = true,
        .plane = !named,
        .cast_faces = GN_CAST_BOTH,
    };
}
