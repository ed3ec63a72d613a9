#include "scene/values.h"

#include <cglm/cglm.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "scene/private.h"
#include "scene/property.h"

/* ---- once ---- */

void gn_values_init(struct gn_values *v, struct gn_pose *pose) {
    const struct gn_scene *scene = pose->scene;
    const uint32_t floats = scene->animation.record_floats;
    *v = (struct gn_values){0};
    pose->lights = scene->lights;
    pose->cameras = scene->cameras;
    pose->materials = scene->materials;
    if (scene->animation.has_hidden) {
        pose->node_hidden = gn_xalloc(scene->node_count, sizeof *pose->node_hidden);
        v->flickers = gn_xalloc(scene->node_count, sizeof *v->flickers);
        pose->lights = v->lights = gn_xalloc(scene->light_count, sizeof *v->lights);
    }
    if (floats == 0) return;
    v->now = gn_xalloc(floats, sizeof *v->now);
    v->shown = gn_xalloc(floats, sizeof *v->shown);
    v->kept = gn_xalloc(floats, sizeof *v->kept);
    memcpy(v->shown, scene->animation.records, floats * sizeof *v->shown);
    if (!v->lights && scene->animation.names[GN_THING_LIGHT])
        pose->lights = v->lights = gn_xalloc(scene->light_count, sizeof *v->lights);
    if (scene->animation.names[GN_THING_CAMERA])
        pose->cameras = v->cameras = gn_xalloc(scene->camera_count, sizeof *v->cameras);
    if (!scene->animation.names[GN_THING_MATERIAL]) return;
    pose->materials = v->materials = gn_xalloc(scene->material_count, sizeof *v->materials);
    memcpy(v->materials, scene->materials, scene->material_count * sizeof *v->materials);
}

void gn_values_finish(struct gn_values *v, struct gn_pose *pose) {
    free(v->now);
    free(v->shown);
    free(v->kept);
    free(v->lights);
    free(v->cameras);
    free(v->materials);
    free(v->flickers);
    free(pose->node_hidden);
}

/* ---- choosing ---- */

static size_t bytes_of(const struct gn_pose *pose) {
    return pose->scene->animation.record_floats * sizeof(float);
}

void gn_values_keep(struct gn_values *v, const struct gn_pose *pose) {
    if (v->now) memcpy(v->kept, v->shown, bytes_of(pose));
}

void gn_values_reset(struct gn_values *v, const struct gn_pose *pose, bool fades) {
    v->moves &= fades;
    if (v->now) memcpy(v->now, pose->scene->animation.records, bytes_of(pose));
    if (v->flickers) memset(v->flickers, 0, pose->scene->node_count * sizeof *v->flickers);
}

void gn_values_mark(struct gn_values *v, const struct gn_pose *pose,
                    const struct gn_channel *channel) {
    v->moves = true;
    if (v->flickers && gn_channel_hides(pose->scene, channel)) v->flickers[channel->node] = true;
}

void gn_values_choose(struct gn_values *v, const struct gn_pose *pose) {
    for (uint32_t i = 0; v->flickers && i < pose->scene->node_count; i++) {
        const int32_t parent = pose->scene->nodes[i].parent;
        if (parent >= 0) v->flickers[i] |= v->flickers[parent];
    }
}

/* Holes, or an alpha that casts; what is transmitted depends on how much of it is metal. */
static bool has_cut(const struct gn_material *m) {
    if (gn_material_is_transmissive(m)) return m->moves & (GN_MOVES_CUT | GN_MOVES_METAL);
    return m->moves & GN_MOVES_CUT && (m->alpha == GN_ALPHA_MASK || gn_material_is_blended(m));
}

bool gn_values_move_item(const struct gn_values *v, const struct gn_pose *pose,
                         const struct gn_item *item) {
    if (v->flickers && v->flickers[item->node]) return true;
    return v->moves && has_cut(&pose->scene->materials[item->material]);
}

/* ---- a time ---- */

static void mix(struct gn_values *v, const struct gn_pose *pose) {
    const uint32_t floats = pose->scene->animation.record_floats;
    for (uint32_t i = 0; i < floats; i++)
        v->shown[i] =
            pose->at.fade < 1 ? v->kept[i] + (v->now[i] - v->kept[i]) * pose->at.fade : v->now[i];
}

/* A node is shown or not: between clips, as the newer one has it. */
static void hide_nodes(const struct gn_values *v, struct gn_pose *pose) {
    for (uint32_t i = 0; pose->node_hidden && i < pose->scene->node_count; i++) {
        const struct gn_node *node = &pose->scene->nodes[i];
        const float *record = node->record ? v->now + node->record - 1 : NULL;
        pose->node_hidden[i] =
            (record ? ((const struct gn_node_record *)record)->visible == 0 : node->hidden) ||
            (node->parent >= 0 && pose->node_hidden[node->parent]);
    }
}

static void make_lights(const struct gn_values *v, const struct gn_pose *pose) {
    for (uint32_t i = 0; v->lights && i < pose->scene->light_count; i++) {
        struct gn_light *light = &v->lights[i];
        *light = pose->scene->lights[i];
        if (light->record) gn_light_make((const void *)(v->shown + light->record - 1), light);
        if (pose->node_hidden && pose->node_hidden[light->node]) glm_vec3_zero(light->color);
    }
}

void gn_values_apply(struct gn_values *v, struct gn_pose *pose) {
    const struct gn_scene *scene = pose->scene;
    if (v->now) mix(v, pose);
    hide_nodes(v, pose);
    make_lights(v, pose);
    for (uint32_t i = 0; v->cameras && i < scene->camera_count; i++) {
        v->cameras[i] = scene->cameras[i];
        const uint32_t record = v->cameras[i].record;
        if (record) gn_camera_make((const void *)(v->shown + record - 1), &v->cameras[i]);
    }
    for (uint32_t i = 0; v->materials && i < scene->material_count; i++) {
        struct gn_material *m = &v->materials[i];
        if (m->record) gn_material_make((const void *)(v->shown + m->record - 1), m->moves, m);
    }
}

uint64_t gn_values_hash(const struct gn_pose *pose, const struct gn_item *item, uint64_t hash) {
    const struct gn_material *m = &pose->materials[item->material];
    if (!has_cut(m)) return hash;
    hash = gn_hash(hash, m->base_color, sizeof m->base_color);
    hash = gn_hash(hash, &m->alpha_cutoff, sizeof m->alpha_cutoff);
    hash = gn_hash(hash, &m->factors[GN_FACTOR_TRANSMISSION], sizeof(float));
    hash = gn_hash(hash, &m->metalness, sizeof m->metalness);
    static const int slots[] = {GN_TEXTURE_BASE, GN_TEXTURE_TRANSMISSION};
    for (int i = 0; i < 2; i++)
        hash = gn_hash(hash, m->textures[slots[i]].uv_from_uv,
                       sizeof m->textures[slots[i]].uv_from_uv);
    return hash;
}
