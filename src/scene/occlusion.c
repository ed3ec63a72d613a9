/* Where a scene has room for ambient occlusion: what of it stays where it is, and the grid of cubes
 * over that (truth/occlusion.h fills it). */
#include "scene/private.h"

#include <math.h>

#include "scene/deform.h"
#include "scene/poses.h"

enum {
    CELLS = 32,       /* to the power of 3: as many cubes at most */
    AXIS_CELLS = 128, /* along one axis: ES 3.0 promises 256 */
    POSES = 16        /* of clips */
};
/* What moves no farther than this share of all that is there stays, too. */
#define NEAR .125f

/* Marks the nodes that a clip of the file may hide, whichever is shown. */
static bool find_hidden(struct gn_gltf *g, bool **hidden) {
    const struct gn_scene *scene = g->scene;
    const struct gn_scene_animation *animation = &scene->animation;
    bool *played = gn_gltf_alloc(g, &g->memory.step, animation->record_floats + 1, sizeof *played);
    *hidden = gn_gltf_alloc(g, &g->memory.step, scene->node_count + 1, sizeof **hidden);
    if (!played || !*hidden) return false;
    for (uint32_t i = 0; i < animation->channel_count; i++)
        if (animation->channels[i].path == GN_ANIM_RECORD)
            played[animation->channels[i].record] = true;
    for (uint32_t i = 0; i < scene->node_count; i++)
        (*hidden)[i] = scene->nodes[i].record && played[scene->nodes[i].record - 1];
    for (uint32_t i = 0; i < scene->node_count; i++) /* parents stand first */
        if (scene->nodes[i].parent >= 0) (*hidden)[i] |= (*hidden)[scene->nodes[i].parent];
    return true;
}

/* Whatever it moves. */
static bool may_stay(const struct gn_scene *scene, const bool *hidden, const struct gn_item *item) {
    const struct gn_material *material = &scene->materials[item->material];
    return !material->shadow_catcher && !hidden[item->node] &&
           !(material->alpha == GN_ALPHA_MASK && material->moves & GN_MOVES_CUT);
}

static bool stays_near(const struct gn_scene *scene, const struct gn_poses_place *place) {
    bool all = true;
    float most_m = 0;
    for (int k = 0; k < 3; k++)
        most_m = fmaxf(most_m, NEAR * (scene->box.max[k] - scene->box.min[k]));
    for (int k = 0; k < 3; k++)
        all &= gn_poses_stays(place, k) ||
               place->box.max[k] - place->box.min[k] - place->widest_m[k] <= most_m;
    return all;
}

int gn_poses_occlusion(struct gn_pose *pose, struct gn_poses_place *places) {
    const struct gn_scene *scene = pose->scene;
    uint64_t triangles = 0;
    bool any = false;
    for (uint32_t i = 0; i < scene->item_count; i++) any |= pose->items[i].moves;
    gn_poses_find_places(pose, gn_poses_count(pose, any ? scene->node_count : 0, POSES), places);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_item *item = &scene->items[i];
        places[i].stays = item->stays && stays_near(scene, &places[i]);
        any |= places[i].stays && pose->items[i].moves;
        triangles += places[i].stays ? scene->geometries[item->geometry].index_count / 3 : 0;
    }
    return gn_poses_count(pose, any ? triangles : 0, POSES);
}

/* The smallest cubes of which so few enclose the box that their middles do. */
static void lay_grid(const struct gn_box *box, struct gn_scene_occlusion *o) {
    double side[3], low = 0, high = 0;
    for (int k = 0; k < 3; k++) {
        side[k] = (double)box->max[k] - (double)box->min[k];
        high += side[k];
    }
    if (!(high > 0) || !isfinite(high)) return;
    for (int i = 0; i < 40; i++) {
        const double cell = (low + high) / 2;
        double count = 1, longest = 0;
        for (int k = 0; k < 3; k++) {
            const double along = floor(side[k] / cell) + 2;
            count *= along;
            longest = fmax(longest, along);
        }
        *(count > CELLS * CELLS * CELLS || longest > AXIS_CELLS ? &low : &high) = cell;
    }
    o->cell_m = (float)high;
    for (int k = 0; k < 3; k++) {
        o->size[k] = (uint32_t)floor(side[k] / high) + 2;
        o->origin[k] = (float)((double)box->min[k] + side[k] / 2 - (o->size[k] - 1) * high / 2);
    }
}

bool gn_item_is_occluded(const struct gn_scene *scene, const struct gn_item *item) {
    const struct gn_material *m = &scene->materials[item->material];
    int textures = 0;
    for (int slot = 0; slot < GN_TEXTURE_SLOT_COUNT; slot++)
        textures += m->textures[slot].texture >= 0;
    return scene->occlusion.size[0] > 0 && item->stays && !m->unlit &&
           textures < GN_MATERIAL_TEXTURES_MAX;
}

bool gn_scene_lay_occlusion(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    bool *hidden, any = false;
    gn_arena_reset(&g->memory.step);
    struct gn_poses_place *places =
        gn_gltf_alloc(g, &g->memory.step, scene->item_count + 1, sizeof *places);
    if (!places || !find_hidden(g, &hidden)) return false;
    struct gn_pose pose;
    struct gn_box box = GN_BOX_EMPTY;
    for (uint32_t i = 0; i < scene->item_count; i++)
        scene->items[i].stays = may_stay(scene, hidden, &scene->items[i]);
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_poses_occlusion(&pose, places);
    gn_pose_choose(&pose, GN_POSE_NONE);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        scene->items[i].stays = places[i].stays;
        if (!places[i].stays || !pose.items[i].visible) continue;
        gn_box_join(&box, &places[i].box);
        gn_box_join(&box, &pose.items[i].box_ws);
        any = true;
    }
    gn_pose_finish(&pose);
    if (any) lay_grid(&box, &scene->occlusion);
    return true;
}
