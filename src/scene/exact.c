#include "scene/exact.h"

#include <cglm/cglm.h>

void gn_node_local(const struct gn_node *node, mat4 parent_from_node) {
    if (node->has_matrix) {
        glm_mat4_copy((vec4 *)node->matrix, parent_from_node);
        return;
    }
    glm_quat_mat4((float *)node->rotation, parent_from_node);
    for (int k = 0; k < 3; k++)
        glm_vec3_scale(parent_from_node[k], node->scale[k], parent_from_node[k]);
    glm_vec3_copy((float *)node->translation, parent_from_node[3]);
}

struct gn_exact gn_exact_from(mat4 m) {
    struct gn_exact out;
    for (int i = 0; i < 16; i++) out.m[i / 4][i % 4] = (double)m[i / 4][i % 4];
    return out;
}

struct gn_exact gn_exact_of(const struct gn_node *node) {
    mat4 local;
    gn_node_local(node, local);
    struct gn_exact out = gn_exact_from(local);
    for (int k = 0; k < 3; k++) out.m[3][k] += (double)node->rest[k];
    return out;
}

struct gn_exact gn_exact_mul(const struct gn_exact *a, const struct gn_exact *b) {
    struct gn_exact out;
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) {
            out.m[c][r] = 0.0;
            for (int k = 0; k < 4; k++) out.m[c][r] += a->m[k][r] * b->m[c][k];
        }
    return out;
}

void gn_exact_step(struct gn_pose *pose, const struct gn_node *node, uint32_t i) {
    const struct gn_exact local = gn_exact_of(node);
    pose->exact[i] = node->parent < 0 ? local : gn_exact_mul(&pose->exact[node->parent], &local);
    gn_exact_place(pose, i, NULL, NULL, pose->world_from_node[i]);
}

void gn_exact_place(const struct gn_pose *pose, uint32_t node, vec4 *node_from_x,
                    const double *x_origin, mat4 world_from_x) {
    const double *origin = pose->scene->place.origin;
    struct gn_exact all = pose->exact[node];
    if (node_from_x) {
        const struct gn_exact x = gn_exact_from(node_from_x);
        all = gn_exact_mul(&all, &x);
    }
    for (int k = 0; k < 3; k++) {
        for (int i = 0; x_origin && i < 3; i++) all.m[3][k] += all.m[i][k] * x_origin[i];
        all.m[3][k] -= origin[k];
    }
    for (int i = 0; i < 16; i++) world_from_x[i / 4][i % 4] = (float)all.m[i / 4][i % 4];
}

void gn_exact_put(const struct gn_scene_place *place, const float *position_ws, vec3 translation,
                  vec3 rest) {
    for (int k = 0; k < 3; k++) {
        const double whole = (double)position_ws[k] + place->origin[k];
        translation[k] = (float)whole;
        rest[k] = (float)(whole - (double)translation[k]);
    }
}
