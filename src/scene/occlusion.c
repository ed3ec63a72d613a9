/* Where a scene has room for ambient occlusion: what of it stands still, and the grid of cubes over
 * that (truth/occlusion.h fills it). */
#include "scene/private.h"

#include <math.h>

#include "scene/deform.h"
#include "scene/pose.h"

enum {
    CELLS = 32,      /* to the power of 3: as many cubes at most */
    AXIS_CELLS = 128 /* along one axis: ES 3.0 promises 256 */
};

/* What some clip of the file moves, whichever is shown. */
struct movers {
    bool *nodes, *morphs;
};

static void mark_record(const struct gn_scene *scene, uint32_t record, struct movers *m) {
    for (uint32_t i = 0; i < scene->node_count; i++)
        if (scene->nodes[i].record == record + 1) m->nodes[i] = true; /* it may be hidden */
}

static bool find_movers(struct gn_gltf *g, struct movers *m) {
    const struct gn_scene *scene = g->scene;
    m->nodes = gn_gltf_alloc(g, &g->memory.step, scene->node_count + 1, sizeof *m->nodes);
    m->morphs =
        gn_gltf_alloc(g, &g->memory.step, scene->deformation.morph_count + 1, sizeof *m->morphs);
    if (!m->nodes || !m->morphs) return false;
    for (uint32_t i = 0; i < scene->animation.channel_count; i++) {
        const struct gn_channel *channel = &scene->animation.channels[i];
        if (channel->path == GN_ANIM_WEIGHTS)
            m->morphs[channel->morph] = true;
        else if (channel->path != GN_ANIM_RECORD)
            m->nodes[channel->node] = true;
        else if (scene->animation.names[GN_THING_NODE])
            mark_record(scene, channel->record, m);
    }
    for (uint32_t i = 0; i < scene->node_count; i++) /* parents stand first */
        if (scene->nodes[i].parent >= 0 && m->nodes[scene->nodes[i].parent]) m->nodes[i] = true;
    return true;
}

static bool skin_moves(const struct gn_scene *scene, const struct movers *m, int32_t skin) {
    const struct gn_skin *s = &scene->deformation.skins[skin];
    const struct gn_joint *joints = scene->deformation.joints + s->first_joint;
    for (uint32_t k = 0; k < s->joint_count; k++)
        if (joints[k].node >= 0 && m->nodes[joints[k].node]) return true;
    return false;
}

static bool is_still(const struct gn_scene *scene, const struct movers *m,
                     const struct gn_item *item) {
    const struct gn_material *material = &scene->materials[item->material];
    if (material->shadow_catcher) return false;
    if (material->alpha == GN_ALPHA_MASK && material->moves & GN_MOVES_CUT) return false;
    if (item->morph >= 0 && m->morphs[item->morph]) return false;
    return item->skin >= 0 ? !skin_moves(scene, m, item->skin) : !m->nodes[item->node];
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
    return scene->occlusion.size[0] > 0 && item->still && !m->unlit &&
           textures < GN_MATERIAL_TEXTURES_MAX;
}

bool gn_scene_lay_occlusion(struct gn_gltf *g) {
    struct gn_scene *scene = g->scene;
    struct movers movers;
    gn_arena_reset(&g->memory.step);
    if (!find_movers(g, &movers)) return false;
    struct gn_pose pose;
    struct gn_box box = GN_BOX_EMPTY;
    bool any = false;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        struct gn_item *item = &scene->items[i];
        item->still = is_still(scene, &movers, item);
        if (!item->still || !pose.items[i].visible) continue;
        gn_box_join(&box, &pose.items[i].box_ws);
        any = true;
    }
    gn_pose_finish(&pose);
    if (any) lay_grid(&box, &scene->occlusion);
    return true;
}
