/* Joints and weights of vertices, and what of a mesh each joint moves. */
#include "scene/private.h"

#include <cglm/cglm.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

enum { SETS = 2, PER_SET = 4, INFLUENCES = SETS * PER_SET };

/* Weights that are 1 together, in units of 1 / 65535. What rounding leaves goes to the largest. A
 * vertex without any is its first joint's. */
static void normalize_weights(const float *weights, int count, uint16_t *out) {
    double sum = 0, clean[INFLUENCES];
    int left = 65535, most = 0;
    for (int i = 0; i < count; i++) {
        clean[i] = weights[i] > 0 && weights[i] < 1e18f ? (double)weights[i] : 0;
        sum += clean[i];
        if (clean[i] > clean[most]) most = i;
    }
    for (int i = 0; i < count; i++) {
        out[i] = sum > 0 ? (uint16_t)lround(clean[i] / sum * 65535) : 0;
        left -= out[i];
    }
    out[most] = (uint16_t)(out[most] + left);
}

static void read_set(struct gn_gltf *g, const int32_t *attribute, int set, const uint32_t *source,
                     uint32_t i, float *joints, float *weights) {
    const struct gn_accessor *j = gn_gltf_accessor(g, attribute[GN_ATTRIBUTE_JOINTS0 + 2 * set]);
    const struct gn_accessor *w = gn_gltf_accessor(g, attribute[GN_ATTRIBUTE_WEIGHTS0 + 2 * set]);
    const uint32_t from = source ? source[i] : i;
    if (!j || !w) return;
    struct gn_accessor normalized = *w;
    normalized.normalized = true; /* of integers, floats are read as they are */
    gn_accessor_gather(j, PER_SET, &from, 1, joints + PER_SET * set);
    gn_accessor_gather(&normalized, PER_SET, &from, 1, weights + PER_SET * set);
}

bool gn_skin_put_vertices(struct gn_gltf *g, const int32_t *attribute, const uint32_t *source,
                          size_t first, size_t count) {
    struct gn_scene_buffers *b = &g->scene->buffers;
    const bool two = attribute[GN_ATTRIBUTE_JOINTS1] >= 0;
    uint16_t *const joints[SETS] = {b->joints0, b->joints1};
    uint16_t *const weights[SETS] = {b->weights0, b->weights1};
    if (attribute[GN_ATTRIBUTE_JOINTS0] < 0) return true;
    for (size_t i = 0; i < count; i++) {
        float joint[INFLUENCES] = {0}, weight[INFLUENCES] = {0};
        uint16_t shares[INFLUENCES];
        read_set(g, attribute, 0, source, (uint32_t)i, joint, weight);
        if (two) read_set(g, attribute, 1, source, (uint32_t)i, joint, weight);
        normalize_weights(weight, two ? INFLUENCES : PER_SET, shares);
        for (int k = 0; k < (two ? INFLUENCES : PER_SET); k++) {
            const size_t at = PER_SET * (first + i) + (size_t)(k % PER_SET);
            const bool right = shares[k] > 0 && joint[k] >= 0 && joint[k] <= 65535;
            joints[k / PER_SET][at] = right ? (uint16_t)joint[k] : 0;
            weights[k / PER_SET][at] = shares[k];
        }
    }
    return !g->failed;
}

bool gn_skin_measure(struct gn_gltf *g, const struct gn_at *at, struct gn_geometry *geometry) {
    const struct gn_scene_buffers *b = &g->scene->buffers;
    const uint32_t *indices = b->indices + geometry->first_index;
    const int sets = gn_geometry_has(geometry, GN_ATTRIBUTE_JOINTS1) ? 2 : 1;
    const uint16_t *const joints[SETS] = {b->joints0, b->joints1};
    const uint16_t *const weights[SETS] = {b->weights0, b->weights1};
    uint32_t count = 0, used = 0;
    for (uint32_t i = 0; i < geometry->index_count; i++)
        for (int k = 0; k < sets * PER_SET; k++) {
            const size_t at = PER_SET * (size_t)indices[i] + (size_t)(k % PER_SET);
            if (joints[k / PER_SET][at] >= count) count = joints[k / PER_SET][at] + 1u;
        }
    if (count > GN_JOINTS_MAX) {
        gn_gltf_warn(g, at,
                     "a vertex is of joint %" PRIu32
                     "; a skin has at most %d joints; shown without it",
                     count - 1, GN_JOINTS_MAX);
        return true;
    }
    struct gn_box *boxes = gn_gltf_alloc(g, &g->memory.step, count, sizeof *boxes);
    if (!boxes) return false;
    for (uint32_t j = 0; j < count; j++) glm_aabb_invalidate((vec3 *)&boxes[j]);
    for (uint32_t i = 0; i < geometry->index_count; i++) {
        float *p = b->positions + 3 * (size_t)indices[i];
        for (int k = 0; k < sets * PER_SET; k++) {
            const size_t at = PER_SET * (size_t)indices[i] + (size_t)(k % PER_SET);
            struct gn_box *box = &boxes[joints[k / PER_SET][at]];
            if (weights[k / PER_SET][at] == 0) continue;
            glm_vec3_minv(box->min, p, box->min);
            glm_vec3_maxv(box->max, p, box->max);
        }
    }
    for (uint32_t j = 0; j < count; j++) used += boxes[j].min[0] <= boxes[j].max[0];
    GN_NEW(g, g->memory.scene, geometry->joint_boxes, used);
    if (g->failed) return false;
    for (uint32_t j = 0; j < count; j++)
        if (boxes[j].min[0] <= boxes[j].max[0])
            geometry->joint_boxes[geometry->joint_box_count++] =
                (struct gn_joint_box){.joint = j, .box = boxes[j]};
    return true;
}
