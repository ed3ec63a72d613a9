#include "scene/pose.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"
#include "scene/deform.h"
#include "scene/exact.h"
#include "scene/fade.h"
#include "scene/private.h"
#include "scene/values.h"

struct memory {              /* pose->memory */
    struct gn_node *local;   /* the scene's nodes with the clips applied */
    uint32_t *nodes, *items; /* animated ones */
    uint32_t node_count, item_count;
    struct gn_box still_ws; /* of the visible items that are not animated */
    struct gn_deformer deformer;
    struct gn_fade fade;
    struct gn_values values;
};

#define LIMIT GN_POSE_LIMIT

/* ---- items ---- */

static void pose_item(struct gn_pose *pose, uint32_t i) {
    const struct gn_scene *scene = pose->scene;
    const struct gn_item *item = &scene->items[i];
    struct gn_pose_item *out = &pose->items[i];
    vec4 *world_from_node = pose->world_from_node[item->node];
    if (pose->exact)
        gn_exact_place(pose, item->node,
                       item->instance < 0 ? NULL : scene->instances[item->instance],
                       scene->geometries[item->geometry].origin, out->world_from_item);
    else if (item->instance < 0)
        glm_mat4_copy(world_from_node, out->world_from_item);
    else
        glm_mat4_mul(world_from_node, scene->instances[item->instance], out->world_from_item);
    out->visible = true;
    out->box = scene->geometries[item->geometry].box;
    if (gn_item_is_deformed(item))
        gn_deform_item(&((struct memory *)pose->memory)->deformer, pose, i);
    for (int k = 0; k < 16; k++) out->visible &= fabsf(out->world_from_item[k / 4][k % 4]) < LIMIT;
    if (out->visible) {
        mat3 cofactor; /* nothing has an area if it is 0 */
        const bool mirrored = gn_cofactor(out->world_from_item, cofactor) < 0;
        if (item->skin < 0) out->mirrored = mirrored;
        out->box_ws = gn_box_transform(out->world_from_item, &out->box);
        float area = 0; /* no squares: those of 1e-23 are 0 */
        for (int k = 0; k < 9; k++) area += fabsf(cofactor[k / 3][k % 3]);
        out->visible = area > 0;
        for (int k = 0; k < 3; k++)
            out->visible &= fabsf(out->box_ws.min[k]) < LIMIT && fabsf(out->box_ws.max[k]) < LIMIT;
    }
    out->visible &= !(item->hidden_in >> (pose->at.variant + 1) & 1);
    out->visible &= !(pose->node_hidden && pose->node_hidden[item->node]);
    if (!out->visible) out->box_ws = GN_BOX_EMPTY;
    out->hash = gn_hash(GN_HASH_INIT, out->world_from_item, sizeof out->world_from_item);
    if (gn_item_is_deformed(item))
        out->hash = gn_deform_hash(&((struct memory *)pose->memory)->deformer, item, out->hash);
    out->hash = gn_values_hash(pose, item, out->hash);
}

static void pose_node(struct gn_pose *pose, uint32_t i) {
    const struct memory *memory = pose->memory;
    const struct gn_node *node = &memory->local[i];
    struct gn_node mixed;
    if (pose->at.fade < 1 && pose->node_moves[i]) {
        mixed = gn_fade_node(&memory->fade, pose, node, i);
        node = &mixed;
    }
    if (pose->exact) {
        gn_exact_step(pose, node, i);
        return;
    }
    mat4 local;
    gn_node_local(node, local);
    if (node->parent < 0)
        glm_mat4_copy(local, pose->world_from_node[i]);
    else
        glm_mat4_mul(pose->world_from_node[node->parent], local, pose->world_from_node[i]);
}

/* ---- clips ---- */

/* A number that no clip has plays none. */
static void list_playing(struct gn_pose *pose) {
    const struct gn_scene_animation *animation = &pose->scene->animation;
    const int clips = pose->at.clips, over = pose->at.over, count = (int)animation->clip_count;
    pose->playing_count = 0;
    for (uint32_t c = 0; clips == GN_POSE_DEFAULT && c < animation->clip_count; c++)
        if (animation->clips[c].on_by_default && (int)c != over)
            pose->playing[pose->playing_count++] = c;
    if (clips >= 0 && clips < count && clips != over)
        pose->playing[pose->playing_count++] = (uint32_t)clips;
    if (over >= 0 && over < count) pose->playing[pose->playing_count++] = (uint32_t)over;
}

/* ---- the pose ---- */

/* A node that a clip moves, or whose weights it changes. */
static void mark_channel(struct gn_pose *pose, const struct gn_channel *channel) {
    struct memory *memory = pose->memory;
    if (channel->path == GN_ANIM_RECORD)
        gn_values_mark(&memory->values, pose, channel);
    else if (channel->path == GN_ANIM_WEIGHTS)
        memory->deformer.morph_moves[channel->morph] = true;
    else
        pose->node_moves[channel->node] = true;
    if (channel->path == GN_ANIM_TRANSLATION) glm_vec3_zero(memory->local[channel->node].rest);
}

void gn_pose_init(struct gn_pose *pose, const struct gn_scene *scene, int clips) {
    *pose = (struct gn_pose){
        .scene = scene, .at.clips = clips, .at.variant = GN_POSE_DEFAULT, .at.fade = 1};
    struct memory *memory = pose->memory = gn_xalloc(1, sizeof *memory);
    pose->world_from_node = gn_xalloc(scene->node_count, sizeof *pose->world_from_node);
    pose->node_moves = gn_xalloc(scene->node_count, sizeof *pose->node_moves);
    pose->playing = gn_xalloc(scene->animation.clip_count, sizeof *pose->playing);
    pose->items = gn_xalloc(scene->item_count, sizeof *pose->items);
    if (scene->place.exact) pose->exact = gn_xalloc(scene->node_count, sizeof *pose->exact);
    memory->local = gn_xalloc(scene->node_count, sizeof *memory->local);
    memory->nodes = gn_xalloc(scene->node_count, sizeof *memory->nodes);
    memory->items = gn_xalloc(scene->item_count, sizeof *memory->items);
    gn_deformer_init(&memory->deformer, pose);
    gn_fade_init(&memory->fade, scene);
    gn_values_init(&memory->values, pose);
    gn_pose_choose(pose, clips);
}

static void measure_still(struct gn_pose *pose) {
    struct memory *memory = pose->memory;
    const struct gn_scene *scene = pose->scene;
    memory->still_ws = GN_BOX_EMPTY;
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (!pose->items[i].moves && !scene->materials[scene->items[i].material].shadow_catcher)
            gn_box_join(&memory->still_ws, &pose->items[i].box_ws);
}

/* Of those that are animated, with the others. */
static void measure_moving(struct gn_pose *pose) {
    const struct memory *memory = pose->memory;
    pose->box_ws = memory->still_ws;
    for (uint32_t i = 0; i < memory->item_count; i++)
        gn_box_join(&pose->box_ws, &pose->items[memory->items[i]].box_ws);
}

void gn_pose_choose_variant(struct gn_pose *pose, int variant) {
    const struct gn_scene *scene = pose->scene;
    const int before = pose->at.variant;
    if (before == variant) return;
    pose->at.variant = variant;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const uint64_t hidden_in = scene->items[i].hidden_in;
        if ((hidden_in >> (before + 1) ^ hidden_in >> (variant + 1)) & 1) pose_item(pose, i);
    }
    measure_still(pose);
    measure_moving(pose);
}

static void choose(struct gn_pose *pose, int clips, int over, bool fades) {
    struct memory *memory = pose->memory;
    const struct gn_scene *scene = pose->scene;
    if (fades) gn_fade_keep(&memory->fade, pose, memory->local, &memory->deformer);
    if (fades) gn_values_keep(&memory->values, pose);
    pose->at.fade = fades ? 0 : 1;
    pose->at.clips = clips;
    pose->at.over = over;
    pose->at.over_ns = 0;
    pose->animated = false;
    memory->node_count = memory->item_count = 0;
    if (scene->node_count > 0) {
        memcpy(memory->local, scene->nodes, scene->node_count * sizeof *memory->local);
        memset(pose->node_moves, 0, scene->node_count * sizeof *pose->node_moves);
    }
    gn_deformer_reset(&memory->deformer, pose);
    gn_values_reset(&memory->values, pose, fades);

    /* marks and lists the nodes and items that the clips animate */
    list_playing(pose);
    for (uint32_t c = 0; c < pose->playing_count; c++) {
        const struct gn_clip *clip = &scene->animation.clips[pose->playing[c]];
        if (clip->channel_count > 0) pose->animated = true;
        for (uint32_t i = 0; i < clip->channel_count; i++)
            mark_channel(pose, &scene->animation.channels[clip->first_channel + i]);
    }
    if (fades) gn_fade_mark(&memory->fade, pose, &memory->deformer);
    for (uint32_t i = 0; i < scene->node_count; i++) {
        int32_t parent = scene->nodes[i].parent;
        if (parent >= 0 && pose->node_moves[parent]) pose->node_moves[i] = true;
        if (pose->node_moves[i]) memory->nodes[memory->node_count++] = i;
    }
    gn_deformer_choose(&memory->deformer, pose);
    gn_values_choose(&memory->values, pose);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        pose->items[i].moves = item->skin < 0 && pose->node_moves[item->node];
        if (gn_item_is_deformed(item))
            pose->items[i].moves |= gn_deformer_moves(&memory->deformer, item);
        pose->items[i].moves |= gn_values_move_item(&memory->values, pose, item);
        if (pose->items[i].moves) memory->items[memory->item_count++] = i;
    }

    /* everything is posed once; items that are not animated keep this pose */
    for (uint32_t i = 0; i < scene->node_count; i++) pose_node(pose, i);
    gn_deformer_step(&memory->deformer, pose, false);
    gn_values_apply(&memory->values, pose);
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (!pose->items[i].moves) pose_item(pose, i);
    measure_still(pose);
    pose->box_ws = memory->still_ws;
    if (pose->aimed) gn_pose_aim(pose, pose->aimed_light, pose->aim_ws);
    gn_pose_step(pose, 0);
}

void gn_pose_choose(struct gn_pose *pose, int clips) { choose(pose, clips, -1, false); }

void gn_pose_choose_over(struct gn_pose *pose, int clips, int over) {
    choose(pose, clips, over, false);
}

void gn_pose_choose_fading(struct gn_pose *pose, int clips, int over) {
    choose(pose, clips, over, true);
}

/* How far a clip has gone after that time, at its speed: whole periods less where that is too far
 * for an integer, or the end if it has no period (0). */
static int64_t run_ns(const struct gn_pose_run *run, int64_t period_ns, int64_t time_ns) {
    if (run->speed_less_1 == 0) return time_ns;
    const double there = (double)time_ns * (1 + run->speed_less_1);
    if (fabs(there) < 9e18) return (int64_t)there;
    if (period_ns > 0) return (int64_t)fmod(there, (double)period_ns);
    return there < 0 ? INT64_MIN : INT64_MAX;
}

/* In integers until it is small: exact after years. Other speeds than 1 are so to 2^-53. */
int64_t gn_pose_clip_ns(const struct gn_pose_run *run, int64_t length_ns, int64_t time_ns) {
    if (length_ns <= 0) return 0;
    if (run->turns == GN_POSE_ONCE) {
        const int64_t ns = run_ns(run, 0, time_ns);
        if (ns >= length_ns || ns >= length_ns - run->start_ns) return length_ns;
        return ns + run->start_ns > 0 ? ns + run->start_ns : 0;
    }
    const int64_t period_ns =
        run->turns == GN_POSE_PING_PONG && length_ns < INT64_MAX / 2 ? 2 * length_ns : length_ns;
    const int64_t parts[] = {run_ns(run, period_ns, time_ns) % period_ns,
                             run->start_ns % period_ns};
    uint64_t sum_ns = 0;
    for (int i = 0; i < 2; i++)
        sum_ns += (uint64_t)(parts[i] < 0 ? parts[i] + period_ns : parts[i]);
    const int64_t local_ns = (int64_t)(sum_ns % (uint64_t)period_ns);
    return local_ns > length_ns ? period_ns - local_ns : local_ns;
}

bool gn_pose_stands(const struct gn_pose *pose) {
    const struct gn_pose_run *run = &pose->at.run;
    if (pose->at.fade < 1 || pose->at.over >= 0) return false;
    for (uint32_t c = 0; c < pose->playing_count; c++) {
        const int64_t ns = pose->scene->animation.clips[pose->playing[c]].duration_ns;
        if (run->speed_less_1 != -1 && ns > 0 &&
            (run->turns != GN_POSE_ONCE ||
             gn_pose_clip_ns(run, ns, pose->at.time_ns - pose->at.begun_ns) < ns))
            return false;
    }
    return true;
}

static void step_clip(struct gn_pose *pose, const struct gn_clip *clip, int64_t local_ns) {
    struct memory *memory = pose->memory;
    double time_s = (double)local_ns * 1e-9;
    for (uint32_t i = 0; i < clip->channel_count; i++) {
        const struct gn_channel *channel =
            &pose->scene->animation.channels[clip->first_channel + i];
        if (channel->path == GN_ANIM_RECORD) {
            gn_channel_sample(channel, time_s, memory->values.now + channel->record);
            continue;
        }
        struct gn_node *node = &memory->local[channel->node];
        float *const target[] = {[GN_ANIM_TRANSLATION] = node->translation,
                                 [GN_ANIM_ROTATION] = node->rotation,
                                 [GN_ANIM_SCALE] = node->scale,
                                 [GN_ANIM_WEIGHTS] =
                                     gn_deformer_weights(&memory->deformer, pose, channel)};
        gn_channel_sample(channel, time_s, target[channel->path]);
    }
}

void gn_pose_step(struct gn_pose *pose, int64_t time_ns) {
    struct memory *memory = pose->memory;
    pose->at.time_ns = time_ns;
    if (!pose->animated) return;
    const struct gn_scene_animation *animation = &pose->scene->animation;
    if (pose->at.fade < 1) gn_deformer_rest(&memory->deformer, pose);
    static const struct gn_pose_run loop = {0};
    for (uint32_t c = 0; c < pose->playing_count; c++) {
        const struct gn_clip *clip = &animation->clips[pose->playing[c]];
        const bool over = (int)pose->playing[c] == pose->at.over;
        step_clip(
            pose, clip,
            over ? gn_pose_clip_ns(&loop, clip->duration_ns, pose->at.over_ns)
                 : gn_pose_clip_ns(&pose->at.run, clip->duration_ns, time_ns - pose->at.begun_ns));
    }
    if (pose->at.fade < 1) gn_fade_weights(&memory->fade, pose, &memory->deformer);
    if (memory->values.moves) gn_values_apply(&memory->values, pose);
    for (uint32_t i = 0; i < memory->node_count; i++) pose_node(pose, memory->nodes[i]);
    gn_deformer_step(&memory->deformer, pose, true);
    for (uint32_t i = 0; i < memory->item_count; i++) pose_item(pose, memory->items[i]);
    measure_moving(pose);
}

void gn_pose_finish(struct gn_pose *pose) {
    struct memory *memory = pose->memory;
    if (memory) {
        free(memory->local);
        free(memory->nodes);
        free(memory->items);
        gn_deformer_finish(&memory->deformer);
        gn_fade_finish(&memory->fade);
        gn_values_finish(&memory->values, pose);
        free(memory);
    }
    free(pose->world_from_node);
    free(pose->exact);
    free(pose->node_moves);
    free(pose->playing);
    free(pose->items);
    free(pose->texels);
    free(pose->list_counts);
    *pose = (struct gn_pose){0};
}

/* ---- cameras and lights ---- */

/* The unit vector along v, or the fallback if it has no length. */
static void unit_or(const float *v, const float *fallback, vec3 out) {
    double length = sqrt((double)v[0] * (double)v[0] + (double)v[1] * (double)v[1] +
                         (double)v[2] * (double)v[2]);
    bool right = length > 1e-30 && isfinite(length);
    for (int k = 0; k < 3; k++) out[k] = right ? (float)((double)v[k] / length) : fallback[k];
}

static void position_of(vec4 *world_from_node, vec3 out) {
    for (int k = 0; k < 3; k++) {
        float x = world_from_node[3][k];
        out[k] = fabsf(x) < LIMIT ? x : 0;
    }
}

/* Drops the scale of the node and makes its axes right-handed. */
static void rigid_inverse(vec4 *world, mat4 out) {
    vec3 axes[3], origin, side;
    unit_or(world[2], (vec3){0, 0, 1}, axes[2]);
    unit_or(world[1], (vec3){0, 1, 0}, side);
    glm_vec3_cross(side, axes[2], side);
    if (glm_vec3_norm(side) < 1e-6f) glm_vec3_ortho(axes[2], side);
    unit_or(side, (vec3){1, 0, 0}, axes[0]);
    glm_vec3_cross(axes[2], axes[0], axes[1]);
    position_of(world, origin);
    glm_mat4_identity(out);
    for (int row = 0; row < 3; row++) {
        for (int k = 0; k < 3; k++) out[k][row] = axes[row][k];
        out[3][row] = -glm_vec3_dot(axes[row], origin);
    }
}

void gn_pose_view(const struct gn_pose *pose, uint32_t camera, mat4 view_from_world, vec3 eye_ws) {
    vec4 *world = pose->world_from_node[pose->scene->cameras[camera].node];
    rigid_inverse(world, view_from_world);
    if (eye_ws) position_of(world, eye_ws);
}

void gn_pose_light_view(const struct gn_pose *pose, uint32_t light, mat4 light_from_world) {
    rigid_inverse(pose->world_from_node[pose->scene->lights[light].node], light_from_world);
}

void gn_pose_light(const struct gn_pose *pose, uint32_t light, vec3 position_ws,
                   vec3 direction_ws) {
    vec4 *world = pose->world_from_node[pose->scene->lights[light].node];
    unit_or(world[2], (vec3){0, 0, 1}, direction_ws);
    glm_vec3_negate(direction_ws);
    position_of(world, position_ws);
    if (!pose->lights_aside) return;
    const float *aside = pose->lights_aside[light];
    if (gn_light_types[pose->scene->lights[light].type].has_position) {
        glm_vec3_add(position_ws, (float *)aside, position_ws);
        return;
    }
    vec3 x, y;
    glm_vec3_ortho(direction_ws, x);
    gn_unit(x);
    glm_vec3_cross(direction_ws, x, y);
    glm_vec3_muladds(x, aside[0], direction_ws);
    glm_vec3_muladds(y, aside[1], direction_ws);
    gn_unit(direction_ws);
}

void gn_pose_aim(struct gn_pose *pose, uint32_t light, const float *aim_ws) {
    if (pose->aimed && pose->aimed_light != light)
        pose_node(pose, pose->scene->lights[pose->aimed_light].node);
    const uint32_t node = pose->scene->lights[light].node;
    vec4 *world = pose->world_from_node[node];
    pose->aimed = aim_ws;
    pose->aimed_light = light;
    pose_node(pose, node);
    if (!aim_ws) return;
    glm_vec3_copy((float *)aim_ws, pose->aim_ws);
    glm_vec3_negate_to(pose->aim_ws, world[2]);
    glm_vec3_ortho(world[2], world[0]);
    if (fabsf(world[2][1]) < .9999f) glm_vec3_crossn(GLM_YUP, world[2], world[0]);
    gn_unit(world[0]);
    glm_vec3_cross(world[2], world[0], world[1]);
}

void gn_unit(vec3 v) {
    const double n = sqrt((double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]);
    for (int k = 0; k < 3 && n > 0.0; k++) v[k] = (float)(v[k] / n);
}

void gn_pose_plane(const struct gn_pose *pose, uint32_t item, vec4 plane_ws) {
    const struct gn_geometry *g = &pose->scene->geometries[pose->scene->items[item].geometry];
    vec4 *world_from_item = pose->items[item].world_from_item;
    mat3 cofactor;
    vec3 p = {0, 0, 0};
    glm_vec3_muladds((float *)g->plane, -g->plane[3], p);
    glm_mat4_mulv3(world_from_item, p, 1, p);
    gn_cofactor(world_from_item, cofactor);
    glm_mat3_mulv(cofactor, (float *)g->plane, plane_ws);
    if (pose->items[item].mirrored) glm_vec3_negate(plane_ws);
    gn_unit(plane_ws);
    plane_ws[3] = -glm_vec3_dot(plane_ws, p);
}
