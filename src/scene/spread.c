/* How far faces turn from the normals of their vertices when a mesh is posed: joints turn the
 * corners of a face, and their normals, by different angles. Without it the bias of shadow maps
 * would be that of the mesh as it is bound, and faces that lie askew in a pose would show acne. */
#include "scene/private.h"

#include <math.h>

#include "scene/pose.h"

enum {
    POSES = 16,        /* of a clip, at most */
    CORNERS = 1 << 20, /* of triangles, for all clips together; but each clip has one pose */
};

static void add_face(struct gn_scene *scene, const struct gn_pose *pose, uint32_t item,
                     const uint32_t corners[3]) {
    double p[3][3], n[3][3], face[3];
    for (int c = 0; c < 3; c++) {
        gn_pose_vertex(pose, item, corners[c], p[c]);
        gn_pose_normal(pose, item, corners[c], n[c]);
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        face[k] =
            (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
    }
    for (int c = 0; c < 3; c++) gn_geometry_add_spread(scene, corners[c], face, n[c]);
}

static void add_pose(struct gn_scene *scene, const struct gn_pose *pose) {
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_geometry *g = &scene->geometries[scene->items[i].geometry];
        if (!gn_item_is_deformed(&scene->items[i]) || !pose->items[i].visible) continue;
        for (uint32_t k = 0; k + 2 < g->index_count; k += 3)
            add_face(scene, pose, i, scene->buffers.indices + g->first_index + k);
    }
}

static uint64_t count_corners(const struct gn_scene *scene) {
    uint64_t count = 0;
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (gn_item_is_deformed(&scene->items[i]))
            count += scene->geometries[scene->items[i].geometry].index_count;
    return count;
}

bool gn_scene_add_posed_spreads(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    const struct gn_scene_animation *animation = &scene->animation;
    const uint64_t corners = count_corners(scene);
    if (corners == 0) return true;
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    add_pose(scene, &pose);
    const uint64_t room = CORNERS / corners / (animation->clip_count + 1);
    const int poses = room < 1 ? 1 : room < POSES ? (int)room : POSES;
    for (uint32_t clip = 0; clip < animation->clip_count && gn_gltf_check_time(g); clip++) {
        gn_pose_choose(&pose, (int)clip);
        for (int i = 0; i < poses; i++) {
            gn_pose_step(&pose, animation->clips[clip].duration_ns / (2 * poses) * (2 * i + 1));
            add_pose(scene, &pose);
        }
    }
    gn_pose_finish(&pose);
    return !g->failed;
}
