/* How far faces turn from the normals of their vertices when a mesh is posed: joints turn the
 * corners of a face, and their normals, by different angles. Without it the bias of shadow maps
 * would be that of the mesh as it is bound, and faces that lie askew in a pose would show acne. */
#include "scene/private.h"

#include <math.h>

#include "scene/pose.h"

enum {
    POSES = 16,           /* of a clip, at most */
    VERTICES = 1 << 18,   /* for all clips together; but each clip has one pose, */
    MOST_POSED = 1 << 22, /* unless more nodes, items and vertices would be posed: evenly chosen */
};

struct posed { /* a vertex */
    double p[3], normal[3];
};

static void add_face(struct gn_scene *scene, const struct posed *posed, uint32_t first,
                     const uint32_t corners[3]) {
    const struct posed *at[3];
    double face[3];
    for (int c = 0; c < 3; c++) at[c] = &posed[corners[c] - first];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        face[k] = (at[1]->p[i] - at[0]->p[i]) * (at[2]->p[j] - at[0]->p[j]) -
                  (at[1]->p[j] - at[0]->p[j]) * (at[2]->p[i] - at[0]->p[i]);
    }
    for (int c = 0; c < 3; c++) gn_geometry_add_spread(scene, corners[c], face, at[c]->normal);
}

static void add_pose(struct gn_scene *scene, const struct gn_pose *pose, struct posed *posed) {
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_geometry *g = &scene->geometries[scene->items[i].geometry];
        if (!gn_item_is_deformed(&scene->items[i]) || !pose->items[i].visible) continue;
        for (uint32_t k = 0; k < g->vertex_count; k++)
            gn_pose_vertex(pose, i, g->first_vertex + k, posed[k].p, posed[k].normal);
        for (uint32_t k = 0; k + 2 < g->index_count; k += 3)
            add_face(scene, posed, g->first_vertex, scene->buffers.indices + g->first_index + k);
    }
}

/* Of all items that deform; *most: of the largest. */
static uint64_t count_vertices(const struct gn_scene *scene, uint32_t *most) {
    uint64_t count = 0;
    *most = 0;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const uint32_t of = scene->geometries[scene->items[i].geometry].vertex_count;
        if (!gn_item_is_deformed(&scene->items[i])) continue;
        count += of;
        if (of > *most) *most = of;
    }
    return count;
}

bool gn_scene_add_posed_spreads(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    const struct gn_scene_animation *animation = &scene->animation;
    uint32_t most;
    const uint64_t vertices = count_vertices(scene, &most);
    if (vertices == 0 || most > gn_gltf_room(g) / sizeof(struct posed)) return true;
    struct posed *posed = gn_gltf_alloc(g, &g->memory.step, most, sizeof *posed);
    if (!posed) return false;
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    add_pose(scene, &pose, posed);
    const uint64_t room = VERTICES / vertices / (animation->clip_count + 1);
    const int poses = room < 1 ? 1 : room < POSES ? (int)room : POSES;
    const uint64_t posed_per_clip = scene->node_count + scene->item_count + vertices,
                   clips_most = 1 + MOST_POSED / posed_per_clip,
                   step = 1 + animation->clip_count / clips_most;
    for (uint64_t clip = 0; clip < animation->clip_count && gn_gltf_check_time(g); clip += step) {
        gn_pose_choose(&pose, (int)clip);
        for (int i = 0; i < poses; i++) {
            gn_pose_step(&pose, animation->clips[clip].duration_ns / (2 * poses) * (2 * i + 1));
            add_pose(scene, &pose, posed);
        }
    }
    gn_pose_finish(&pose);
    gn_arena_reset(&g->memory.step);
    return !g->failed;
}
