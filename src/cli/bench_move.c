#include "cli/bench_move.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "core/hash.h"

#define LIGHT_SHARE  .01f /* of the scene's size */
#define LIGHT_RAD    .02f
#define CASTER_SHARE .002f /* of the scene's size */
enum { TURN_FRAMES = 60 };

void gn_bench_move_init(struct gn_bench_move *move, const struct gn_pose *pose) {
    const struct gn_scene *scene = pose->scene;
    if (!move->lights && !move->casters) return;
    move->nodes = gn_xalloc(scene->node_count, sizeof *move->nodes);
    move->items = gn_xalloc(scene->item_count, sizeof *move->items);
    move->boxes = gn_xalloc(scene->item_count, sizeof *move->boxes);
    move->box_ws = pose->box_ws;
    for (uint32_t i = 0; i < scene->node_count; i++)
        glm_mat4_copy(pose->world_from_node[i], move->nodes[i]);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        glm_mat4_copy(pose->items[i].world_from_item, move->items[i]);
        move->boxes[i] = pose->items[i].box_ws;
    }
}

void gn_bench_move_finish(struct gn_bench_move *move) {
    free(move->nodes);
    free(move->items);
    free(move->boxes);
    *move = (struct gn_bench_move){0};
}

static float size_m(const struct gn_pose *pose) {
    return glm_vec3_distance((float *)pose->scene->box.min, (float *)pose->scene->box.max);
}

static void move_light(const struct gn_bench_move *move, struct gn_pose *pose, uint32_t light,
                       float angle_rad) {
    const struct gn_light *l = &pose->lights[light];
    vec4 *world_from_node = pose->world_from_node[l->node];
    if (!pose->node_moves[l->node]) glm_mat4_copy(move->nodes[l->node], world_from_node);
    if (gn_light_types[l->type].has_position) {
        const float radius_m = LIGHT_SHARE * size_m(pose);
        world_from_node[3][0] += radius_m * cosf(angle_rad);
        world_from_node[3][2] += radius_m * sinf(angle_rad);
        return;
    }
    mat4 turned = GLM_MAT4_IDENTITY_INIT;
    glm_rotate_y(turned, LIGHT_RAD * sinf(angle_rad), turned);
    glm_mat4_mul(turned, world_from_node, world_from_node);
}

static void move_item(const struct gn_bench_move *move, struct gn_pose *pose, uint32_t item,
                      float angle_rad) {
    struct gn_pose_item *out = &pose->items[item];
    if (!out->moves) {
        glm_mat4_copy(move->items[item], out->world_from_item);
        out->box_ws = move->boxes[item];
    }
    const float radius_m = CASTER_SHARE * size_m(pose);
    const float step[3] = {radius_m * cosf(angle_rad), 0, radius_m * sinf(angle_rad)};
    for (int k = 0; k < 3; k++) {
        out->world_from_item[3][k] += step[k];
        out->box_ws.min[k] += step[k];
        out->box_ws.max[k] += step[k];
    }
    out->hash = gn_hash(GN_HASH_INIT, out->world_from_item, sizeof out->world_from_item);
}

void gn_bench_move_step(const struct gn_bench_move *move, struct gn_pose *pose, uint32_t frame) {
    const struct gn_scene *scene = pose->scene;
    const float angle_rad = 2.0f * GLM_PIf * (float)(frame % TURN_FRAMES) / TURN_FRAMES;
    for (uint32_t i = 0; move->lights && i < scene->light_count; i++)
        move_light(move, pose, i, angle_rad);
    if (!move->casters) return;
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].casts && !scene->items[i].plane && pose->items[i].visible &&
            !gn_item_is_deformed(&scene->items[i]))
            move_item(move, pose, i, angle_rad);
    if (!pose->animated) pose->box_ws = move->box_ws;
    const float pad_m = CASTER_SHARE * size_m(pose);
    for (int k = 0; k < 3; k++) {
        pose->box_ws.min[k] -= pad_m;
        pose->box_ws.max[k] += pad_m;
    }
}
