#include "scene/fade.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

void gn_fade_init(struct gn_fade *fade, const struct gn_scene *scene) {
    fade->nodes = gn_xalloc(scene->node_count, sizeof *fade->nodes);
    fade->weights = gn_xalloc(scene->deformation.weight_count, sizeof *fade->weights);
    fade->morph_moves = gn_xalloc(scene->deformation.morph_count, sizeof *fade->morph_moves);
}

void gn_fade_finish(struct gn_fade *fade) {
    free(fade->nodes);
    free(fade->weights);
    free(fade->morph_moves);
}

/* Along the shorter way; its speed is not uniform, which is not visible between clips. */
static void mix_rotation(const float *from, const float *to, float share, float *out) {
    const float dot = from[0] * to[0] + from[1] * to[1] + from[2] * to[2] + from[3] * to[3];
    float length = 0;
    for (int k = 0; k < 4; k++) {
        out[k] = (dot < 0 ? -from[k] : from[k]) * (1 - share) + to[k] * share;
        length += out[k] * out[k];
    }
    length = sqrtf(length);
    for (int k = 0; k < 4; k++) out[k] = length > 1e-6f ? out[k] / length : to[k];
}

struct gn_node gn_fade_node(const struct gn_fade *fade, const struct gn_pose *pose,
                            const struct gn_node *local, uint32_t i) {
    const struct gn_fade_node *from = &fade->nodes[i];
    struct gn_node out = *local;
    if (pose->at.fade >= 1 || local->has_matrix) return out;
    glm_vec3_lerp((float *)from->translation, (float *)local->translation, pose->at.fade,
                  out.translation);
    glm_vec3_lerp((float *)from->scale, (float *)local->scale, pose->at.fade, out.scale);
    mix_rotation(from->rotation, local->rotation, pose->at.fade, out.rotation);
    return out;
}

/* Of more parts than there is room for the least one goes to the greatest. */
static void keep_parts(struct gn_pose *pose) {
    struct gn_pose_part *const parts = pose->before;
    struct gn_pose_part now = {pose->at.clips, pose->at.over,
                               pose->at.fade < 1 ? pose->at.fade : 1};
    const float rest = 1 - now.share;
    int least = 0, greatest = 0;
    for (int i = 0; i < GN_POSE_PARTS; i++) {
        parts[i].share *= rest;
        if (parts[i].clips == now.clips && parts[i].over == now.over) {
            now.share += parts[i].share;
            parts[i].share = 0;
        }
        if (parts[i].share < parts[least].share) least = i;
        if (parts[i].share > parts[greatest].share) greatest = i;
    }
    if (now.share < parts[least].share) {
        parts[greatest].share += now.share;
        return;
    }
    *(greatest == least ? &now.share : &parts[greatest].share) += parts[least].share;
    parts[least] = now;
}

void gn_fade_keep(struct gn_fade *fade, struct gn_pose *pose, const struct gn_node *local,
                  const struct gn_deformer *deformer) {
    keep_parts(pose);
    const struct gn_scene *scene = pose->scene;
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const bool mixes = pose->node_moves[i] && pose->at.fade < 1;
        const struct gn_node now = mixes ? gn_fade_node(fade, pose, &local[i], i) : local[i];
        struct gn_fade_node *kept = &fade->nodes[i];
        glm_vec3_copy((float *)now.translation, kept->translation);
        glm_vec3_copy((float *)now.scale, kept->scale);
        glm_vec4_copy((float *)now.rotation, kept->rotation);
        kept->moves = pose->node_moves[i];
    }
    for (uint32_t i = 0; i < scene->deformation.weight_count; i++)
        fade->weights[i] = deformer->weights[i];
    for (uint32_t i = 0; i < scene->deformation.morph_count; i++)
        fade->morph_moves[i] = deformer->morph_moves[i];
}

void gn_fade_mark(const struct gn_fade *fade, struct gn_pose *pose, struct gn_deformer *deformer) {
    const struct gn_scene *scene = pose->scene;
    for (uint32_t i = 0; i < scene->node_count; i++) pose->node_moves[i] |= fade->nodes[i].moves;
    for (uint32_t i = 0; i < scene->deformation.morph_count; i++)
        deformer->morph_moves[i] |= fade->morph_moves[i];
    pose->animated = true;
}

void gn_fade_weights(const struct gn_fade *fade, const struct gn_pose *pose,
                     struct gn_deformer *deformer) {
    for (uint32_t i = 0; i < pose->scene->deformation.weight_count; i++)
        deformer->weights[i] += (fade->weights[i] - deformer->weights[i]) * (1 - pose->at.fade);
}
