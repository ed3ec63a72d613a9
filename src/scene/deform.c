#include "scene/deform.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "scene/exact.h"
#include "scene/private.h"

/* ---- matrices ------------------------------------------------------------------------------ */

double gn_cofactor(mat4 m, mat3 out) {
    double c[3][3], det = 0;
    for (int k = 0; k < 3; k++) {
        const float *u = m[(k + 1) % 3], *v = m[(k + 2) % 3];
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, l = (i + 2) % 3;
            c[k][i] = (double)u[j] * (double)v[l] - (double)u[l] * (double)v[j];
            out[k][i] = (float)c[k][i];
        }
    }
    for (int i = 0; i < 3; i++) det += (double)m[0][i] * c[0][i];
    return det;
}

/* ---- boxes --------------------------------------------------------------------------------- */

void gn_box_join(struct gn_box *box, const struct gn_box *other) {
    for (int k = 0; k < 3; k++) {
        box->min[k] = fminf(box->min[k], other->min[k]);
        box->max[k] = fmaxf(box->max[k], other->max[k]);
    }
}

struct gn_box gn_box_transform(mat4 m, const struct gn_box *box) {
    struct gn_box out;
    for (int k = 0; k < 3; k++) {
        double low = (double)m[3][k], high = low;
        for (int i = 0; i < 3; i++) {
            double a = (double)m[i][k] * (double)box->min[i],
                   b = (double)m[i][k] * (double)box->max[i];
            low += a < b ? a : b;
            high += a < b ? b : a;
        }
        out.min[k] = (float)low;
        out.max[k] = (float)high;
    }
    return out;
}

/* ---- what moves ---------------------------------------------------------------------------- */

void gn_deformer_init(struct gn_deformer *d, struct gn_pose *pose) {
    const struct gn_scene_deformation *s = &pose->scene->deformation;
    pose->texels = gn_xalloc((size_t)s->width * s->height, sizeof *pose->texels);
    pose->list_counts = gn_xalloc(s->morph_count, sizeof *pose->list_counts);
    d->weights = gn_xalloc(s->weight_count, sizeof *d->weights);
    d->skin_moves = gn_xalloc(s->skin_count, sizeof *d->skin_moves);
    d->morph_moves = gn_xalloc(s->morph_count, sizeof *d->morph_moves);
    d->skins = gn_xalloc(s->skin_count, sizeof *d->skins);
    d->morph_hashes = gn_xalloc(s->morph_count, sizeof *d->morph_hashes);
}

void gn_deformer_finish(struct gn_deformer *d) {
    free(d->weights);
    free(d->skin_moves);
    free(d->morph_moves);
    free(d->skins);
    free(d->morph_hashes);
}

void gn_deformer_rest(struct gn_deformer *d, const struct gn_pose *pose) {
    const struct gn_scene_deformation *s = &pose->scene->deformation;
    for (uint32_t i = 0; i < s->weight_count; i++) d->weights[i] = s->weights[i];
}

void gn_deformer_reset(struct gn_deformer *d, const struct gn_pose *pose) {
    const struct gn_scene_deformation *s = &pose->scene->deformation;
    gn_deformer_rest(d, pose);
    for (uint32_t i = 0; i < s->skin_count; i++) d->skin_moves[i] = false;
    for (uint32_t i = 0; i < s->morph_count; i++) d->morph_moves[i] = false;
}

void gn_deformer_choose(struct gn_deformer *d, const struct gn_pose *pose) {
    const struct gn_scene_deformation *s = &pose->scene->deformation;
    for (uint32_t i = 0; i < s->skin_count; i++) {
        const struct gn_joint *joints = s->joints + s->skins[i].first_joint;
        for (uint32_t k = 0; k < s->skins[i].joint_count; k++)
            d->skin_moves[i] |= joints[k].node >= 0 && pose->node_moves[joints[k].node];
    }
}

bool gn_deformer_moves(const struct gn_deformer *d, const struct gn_item *item) {
    return (item->skin >= 0 && d->skin_moves[item->skin]) ||
           (item->morph >= 0 && d->morph_moves[item->morph]);
}

float *gn_deformer_weights(struct gn_deformer *d, const struct gn_pose *pose,
                           const struct gn_channel *channel) {
    if (channel->path != GN_ANIM_WEIGHTS) return NULL;
    return d->weights + pose->scene->deformation.morphs[channel->morph].first_weight;
}

/* ---- texels -------------------------------------------------------------------------------- */

static vec4 *texels_at(const struct gn_pose *pose, const struct gn_strip *strip, uint32_t row) {
    return pose->texels + (size_t)(strip->y + row) * pose->scene->deformation.width + strip->x;
}

static void write_matrix(vec4 *texels, mat4 m) {
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++) texels[r][c] = m[c][r];
}

static void read_matrix(vec4 *texels, mat4 m) {
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++) m[c][r] = texels[r][c];
    m[0][3] = m[1][3] = m[2][3] = 0;
    m[3][3] = 1;
}

static void step_skin(struct gn_deformer *d, struct gn_pose *pose, uint32_t index) {
    const struct gn_scene_deformation *s = &pose->scene->deformation;
    const struct gn_skin *skin = &s->skins[index];
    struct gn_deformed_skin *out = &d->skins[index];
    uint32_t mirrored = 0;
    *out = (struct gn_deformed_skin){.hash = GN_HASH_INIT, .finite = true};
    for (uint32_t k = 0; k < skin->joint_count; k++) {
        const struct gn_joint *joint = &s->joints[skin->first_joint + k];
        vec4 *texels = texels_at(pose, &skin->rows, k);
        mat4 m;
        mat3 cofactor;
        if (joint->node >= 0 && pose->exact)
            gn_exact_place(pose, (uint32_t)joint->node, (vec4 *)joint->joint_from_mesh, NULL, m);
        else if (joint->node >= 0)
            glm_mat4_mul(pose->world_from_node[joint->node], (vec4 *)joint->joint_from_mesh, m);
        else
            glm_mat4_identity(m);
        for (int i = 0; i < 16; i++) out->finite &= fabsf(m[i / 4][i % 4]) < GN_POSE_LIMIT;
        mirrored += gn_cofactor(m, cofactor) < 0;
        write_matrix(texels, m);
        out->hash = gn_hash(out->hash, texels, GN_STRIP_WIDTH * sizeof *texels);
    }
    out->mirrored = 2 * mirrored > skin->joint_count;
}

static void step_morph(struct gn_deformer *d, struct gn_pose *pose, uint32_t index) {
    const struct gn_morphed *morph = &pose->scene->deformation.morphs[index];
    uint64_t hash = GN_HASH_INIT;
    uint32_t count = 0;
    for (uint32_t t = 0; t < morph->weight_count; t++) {
        const float weight = d->weights[morph->first_weight + t];
        if (weight == 0 || !(fabsf(weight) < 1e6f)) continue;
        vec4 *texel = texels_at(pose, &morph->list, count++);
        glm_vec4_copy((vec4){weight, (float)t, 0, 0}, *texel);
        hash = gn_hash(hash, texel, sizeof *texel);
    }
    pose->list_counts[index] = count;
    d->morph_hashes[index] = gn_hash(hash, &count, sizeof count);
}

void gn_deformer_step(struct gn_deformer *d, struct gn_pose *pose, bool moving_only) {
    const struct gn_scene_deformation *s = &pose->scene->deformation;
    for (uint32_t i = 0; i < s->skin_count; i++)
        if (!moving_only || d->skin_moves[i]) step_skin(d, pose, i);
    for (uint32_t i = 0; i < s->morph_count; i++)
        if (!moving_only || d->morph_moves[i]) step_morph(d, pose, i);
}

/* ---- items --------------------------------------------------------------------------------- */

/* Grows a box by what the targets may add to its points. */
static void add_targets(const struct gn_pose *pose, const struct gn_item *item,
                        struct gn_box *box) {
    const struct gn_targets *targets = pose->scene->geometries[item->geometry].targets;
    const struct gn_strip *list = &pose->scene->deformation.morphs[item->morph].list;
    for (uint32_t i = 0; i < pose->list_counts[item->morph]; i++) {
        const float *texel = *texels_at(pose, list, i), weight = texel[0];
        const struct gn_box *delta = &targets->boxes[(uint32_t)texel[1]];
        for (int k = 0; k < 3; k++) {
            const float a = weight * delta->min[k], b = weight * delta->max[k];
            box->min[k] += fminf(a, b);
            box->max[k] += fmaxf(a, b);
        }
    }
}

void gn_deform_item(struct gn_deformer *d, struct gn_pose *pose, uint32_t index) {
    const struct gn_item *item = &pose->scene->items[index];
    const struct gn_geometry *geometry = &pose->scene->geometries[item->geometry];
    struct gn_pose_item *out = &pose->items[index];
    if (item->skin < 0) {
        add_targets(pose, item, &out->box);
        vec4 *texels = texels_at(pose, &item->rows, 0);
        write_matrix(texels, out->world_from_item);
        return;
    }
    struct gn_box added = {{0, 0, 0}, {0, 0, 0}};
    if (item->morph >= 0) add_targets(pose, item, &added);
    glm_mat4_identity(out->world_from_item);
    out->mirrored = d->skins[item->skin].mirrored;
    out->visible = d->skins[item->skin].finite;
    out->box = GN_BOX_EMPTY;
    for (uint32_t i = 0; i < geometry->joint_box_count; i++) {
        struct gn_box box = geometry->joint_boxes[i].box;
        mat4 m;
        glm_vec3_add(box.min, added.min, box.min);
        glm_vec3_add(box.max, added.max, box.max);
        read_matrix(texels_at(pose, &item->rows, geometry->joint_boxes[i].joint), m);
        box = gn_box_transform(m, &box);
        gn_box_join(&out->box, &box);
    }
}

uint64_t gn_deform_hash(const struct gn_deformer *d, const struct gn_item *item, uint64_t hash) {
    if (item->skin >= 0) hash = gn_hash(hash, &d->skins[item->skin].hash, sizeof hash);
    if (item->morph >= 0) hash = gn_hash(hash, &d->morph_hashes[item->morph], sizeof hash);
    return hash;
}

/* ---- vertices ------------------------------------------------------------------------------ */

/* part 0: of positions, 1: of normals. */
static void add_deltas(const struct gn_pose *pose, const struct gn_item *item, uint32_t part,
                       uint32_t vertex, double p[3]) {
    const struct gn_geometry *geometry = &pose->scene->geometries[item->geometry];
    const struct gn_targets *targets = geometry->targets;
    const struct gn_strip *list = &pose->scene->deformation.morphs[item->morph].list;
    for (uint32_t i = 0; i < pose->list_counts[item->morph] && part < targets->parts; i++) {
        const float *texel = *texels_at(pose, list, i);
        const size_t row = (size_t)texel[1] * targets->parts + part;
        const float *delta =
            targets->deltas[row * geometry->vertex_count + vertex - geometry->first_vertex];
        for (int k = 0; k < 3; k++) p[k] += (double)texel[0] * (double)delta[k];
    }
}

/* Adds the weighted rows of one set of four joints. */
static void add_joints(const struct gn_pose *pose, const struct gn_item *item,
                       const uint16_t *joints, const uint16_t *weights, double rows[3][4]) {
    for (int i = 0; i < 4; i++) {
        if (weights[i] == 0) continue;
        vec4 *texels = texels_at(pose, &item->rows, joints[i]);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++) rows[r][c] += weights[i] / 65535.0 * (double)texels[r][c];
    }
}

static void add_rows(const struct gn_pose *pose, uint32_t index, uint32_t vertex,
                     double rows[3][4]) {
    const struct gn_scene_buffers *b = &pose->scene->buffers;
    const struct gn_item *item = &pose->scene->items[index];
    if (item->skin >= 0) {
        const size_t at = 4 * (size_t)vertex;
        const struct gn_geometry *geometry = &pose->scene->geometries[item->geometry];
        add_joints(pose, item, b->joints0 + at, b->weights0 + at, rows);
        if (gn_geometry_has(geometry, GN_ATTRIBUTE_JOINTS1))
            add_joints(pose, item, b->joints1 + at, b->weights1 + at, rows);
    } else
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++)
                rows[r][c] = (double)pose->items[index].world_from_item[c][r];
}

/* By the rows of the cofactor matrix, as normal_ws() of shaders_es/lib/vertex.glsl. */
static void turn_normal(double rows[3][4], const double n[3], double out[3]) {
    for (int r = 0; r < 3; r++) {
        const double *u = rows[(r + 1) % 3], *v = rows[(r + 2) % 3];
        out[r] = 0;
        for (int k = 0; k < 3; k++)
            out[r] += n[k] * (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    }
}

void gn_pose_vertex(const struct gn_pose *pose, uint32_t index, uint32_t vertex, double out[3],
                    double normal[3]) {
    const struct gn_item *item = &pose->scene->items[index];
    const struct gn_scene_buffers *b = &pose->scene->buffers;
    double p[3], n[3], rows[3][4] = {{0}};
    for (int k = 0; k < 3; k++) {
        p[k] = (double)b->positions[3 * (size_t)vertex + k];
        n[k] = (double)b->normals[3 * (size_t)vertex + k];
    }
    if (item->morph >= 0) add_deltas(pose, item, 0, vertex, p);
    if (item->morph >= 0 && normal) add_deltas(pose, item, 1, vertex, n);
    add_rows(pose, index, vertex, rows);
    for (int r = 0; r < 3; r++)
        out[r] = rows[r][0] * p[0] + rows[r][1] * p[1] + rows[r][2] * p[2] + rows[r][3];
    if (normal) turn_normal(rows, n, normal);
}

void gn_pose_corner(const struct gn_pose *pose, uint32_t index, uint32_t vertex, vec3 out) {
    if (!gn_item_is_deformed(&pose->scene->items[index])) {
        glm_mat4_mulv3(pose->items[index].world_from_item,
                       pose->scene->buffers.positions + 3 * (size_t)vertex, 1.0f, out);
        return;
    }
    double p[3];
    gn_pose_vertex(pose, index, vertex, p, NULL);
    for (int k = 0; k < 3; k++) out[k] = (float)p[k];
}

struct gn_box gn_pose_tight_box(const struct gn_pose *pose, uint32_t index) {
    const struct gn_scene *scene = pose->scene;
    const struct gn_geometry *g = &scene->geometries[scene->items[index].geometry];
    struct gn_box box = GN_BOX_EMPTY;
    if (!gn_item_is_deformed(&scene->items[index])) return pose->items[index].box_ws;
    for (uint32_t i = 0; i < g->index_count && pose->items[index].visible; i++) {
        struct gn_box point;
        gn_pose_corner(pose, index, scene->buffers.indices[g->first_index + i], point.min);
        glm_vec3_copy(point.min, point.max);
        gn_box_join(&box, &point);
    }
    return box;
}
