/* The draws of a pass. Items are sorted by batch, so a run of them becomes one instanced call (two
 * when some are mirrored), roughly nearest first. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "core/srgb.h"
#include "frame/private.h"

static enum gn_cast_faces faces_of(const struct gn_scene *scene, uint32_t item,
                                   const struct gn_shadow_view *view) {
    return view->faces_given ? view->faces : scene->items[item].cast_faces;
}

/* A closed body, the light outside it: each ray that enters leaves it again. */
static bool has_two_sides(const struct gn_scene *scene, const struct gn_pose *pose, uint32_t index,
                          const struct gn_shadow_view *view) {
    const struct gn_item *item = &scene->items[index];
    const struct gn_box *box = &pose->items[index].box_ws;
    bool outside = !view->perspective;
    for (int k = 0; k < 3; k++)
        outside |= view->light_ws[k] < box->min[k] || view->light_ws[k] > box->max[k];
    return outside && scene->geometries[item->geometry].closed &&
           scene->materials[item->material].alpha != GN_ALPHA_MASK;
}

/* A closed body needs only the faces towards a light outside it, or, with `auto`, only the others
 * (second depth: Wang, Molnar 1994). Open bodies need both. */
static enum gn_cull caster_cull(const struct gn_scene *scene, const struct gn_pose *pose,
                                uint32_t index, const struct gn_shadow_view *view) {
    const enum gn_cast_faces faces = faces_of(scene, index, view);
    if (faces == GN_CAST_FRONT) return GN_CULL_BACK;
    if (faces == GN_CAST_BACK) return GN_CULL_FRONT;
    if (!has_two_sides(scene, pose, index, view)) return GN_CULL_NONE;
    return faces == GN_CAST_AUTO ? GN_CULL_FRONT : GN_CULL_BACK;
}

/* Its middle: that of front and back face as the light sees them. Open bodies have none. */
static bool casts_by_middle(const struct gn_scene *scene, const struct gn_pose *pose, uint32_t item,
                            const struct gn_shadow_view *view) {
    return faces_of(scene, item, view) == GN_CAST_MIDDLE &&
           !gn_techniques[view->technique].on_plane && has_two_sides(scene, pose, item, view);
}

/* How far behind the near plane a box lies: its near side (-1), its middle (0) or its far side. */
static float depth_of(const struct gn_frame *frame, const struct gn_box *box, int side) {
    const float *near_plane = frame->eye.planes[4];
    float depth = near_plane[3];
    for (int k = 0; k < 3; k++) {
        depth += near_plane[k] * 0.5f * (box->min[k] + box->max[k]);
        depth += (float)side * fabsf(near_plane[k]) * 0.5f * (box->max[k] - box->min[k]);
    }
    return depth;
}

static bool takes_item(struct gn_frame *frame, const struct gn_pose *pose,
                       const struct gn_selection *s, uint32_t item) {
    if (s->casts)
        return s->casts[item] >> s->page & 1 &&
               (!s->backs || casts_by_middle(frame->scene, pose, item, s->view));
    if (frame->plane.shown > 1 && gn_key_further_plane(frame, item, s->opts) != s->plane)
        return false;
    if (s->part && gn_key_on_plane(frame, item, s->opts) != (s->part == GN_PART_PLANE))
        return false;
    const struct gn_material *m = &frame->scene->materials[frame->scene->items[item].material];
    const struct gn_box *box = &pose->items[item].box_ws;
    const bool opaque = !gn_material_is_blended(m) || gn_material_has_opaque_texels(m);
    if (s->group) /* of added lights: opaque items in their range */
        return pose->items[item].visible && !m->unlit && opaque && gn_eye_sees(&frame->eye, box) &&
               gn_group_touches(s->group, box);
    if (!pose->items[item].visible || !(s->opts->all_seen || gn_eye_sees(&frame->eye, box))) {
        frame->plan.culled++;
        return false;
    }
    if (!gn_material_is_blended(m)) return true;
    if (m->shadow_catcher && s->opts->debug.aov == GN_AOV_VISIBILITY)
        return !gn_key_is_floor(frame, item);
    /* a shadow catcher is behind all that is blended; what is in a vessel behind its near side */
    if (s->opts->debug.aov == GN_AOV_COLOR)
        GN_LIST_PUSH(&frame->items.blended) =
            (struct gn_placed){m->shadow_catcher ? INFINITY : depth_of(frame, box, -1), item};
    return opaque && s->opts->debug.aov == GN_AOV_COLOR;
}

/* Of a caster: the part of the light that it lets through is taken from its alpha; if a texture
 * says where, by the shader, from surface.z. */
static void set_transmitted(const struct gn_material *m, struct gn_instance *instance) {
    if (!gn_material_is_transmissive(m)) return;
    const float through = m->factors[GN_FACTOR_TRANSMISSION] * (1.0f - m->metalness) *
                          glm_clamp_zo(gn_luminance(m->base_color));
    if (m->alpha == GN_ALPHA_OPAQUE) instance->base_color[3] = 1.0f;
    if (m->textures[GN_TEXTURE_TRANSMISSION].texture >= 0)
        instance->surface[2] = through;
    else
        instance->base_color[3] *= 1.0f - through;
}

/* In place of a matrix: where its vertices find what poses them (lib/deform.glsl), and in the last
 * row, for overdraw.c, the item. */
static void place_deformed(const struct gn_scene *scene, const struct gn_pose *pose, uint32_t index,
                           struct gn_instance *instance) {
    const struct gn_item *item = &scene->items[index];
    const struct gn_geometry *geometry = &scene->geometries[item->geometry];
    memset(instance->world, 0, sizeof instance->world);
    instance->world[0][0] = item->rows.x;
    instance->world[0][1] = item->rows.y;
    memcpy(&instance->world[2][0], &index, sizeof index);
    if (item->morph < 0) return;
    const struct gn_targets *targets = geometry->targets;
    const struct gn_strip *list = &scene->deformation.morphs[item->morph].list;
    instance->world[0][2] = list->x;
    instance->world[0][3] = list->y;
    instance->world[1][0] = (float)pose->list_counts[item->morph];
    instance->world[1][1] = (float)targets->first_texel - (float)geometry->first_vertex;
    instance->world[1][2] = (float)geometry->vertex_count;
    instance->world[1][3] = (float)targets->parts;
}

static void set_instance(const struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_selection *s, uint32_t item,
                         struct gn_instance *instance) {
    const struct gn_item *what = &frame->scene->items[item];
    const struct gn_material *m = &pose->materials[what->material];
    const bool in_parts = !s->casts && gn_material_has_opaque_texels(m);
    if (gn_item_is_deformed(what))
        place_deformed(frame->scene, pose, item, instance);
    else
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++)
                instance->world[r][c] = pose->items[item].world_from_item[c][r];
    memcpy(instance->base_color, m->base_color, sizeof instance->base_color);
    instance->surface[0] = m->roughness;
    instance->surface[1] = m->metalness;
    instance->surface[2] = m->occlusion_strength;
    instance->surface[3] = in_parts ? GN_OPAQUE_ALPHA : gn_material_least_alpha(m);
    if (s->casts) set_transmitted(m, instance);
    if (m->shadow_catcher) { /* centre of its square, 1 / half its side, 1 / side of the occluded
                                part */
        vec4 *world = pose->items[item].world_from_item;
        memcpy(instance->surface,
               (float[4]){world[3][0], world[3][2], 1.0f / world[0][0],
                          1.0f / (GN_FLOOR_OCCLUDED * world[0][0])},
               sizeof instance->surface);
    }
    for (int k = 0; k < 3; k++)
        instance->emissive[k] = !s->tints ? m->emissive[k] : s->colorless ? 1.0f : 0.0f;
    instance->emissive[3] = gn_shadow_item_casts(frame->scene, item) ? 1.0f : 0.0f;
}

void gn_frame_draw_item(struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_selection *s, uint32_t item, bool *open) {
    const struct gn_item *what = &frame->scene->items[item];
    bool mirrored = pose->items[item].mirrored != s->mirrored;
    const struct gn_material *m = &pose->materials[what->material];
    const bool in_parts = !s->casts && gn_material_has_opaque_texels(m);
    enum gn_cull cull = m->double_sided ? s->cull : GN_CULL_BACK;
    if (s->casts) cull = s->backs ? GN_CULL_FRONT : caster_cull(frame->scene, pose, item, s->view);
    const bool occluded = frame->plan.occlusion.on && gn_item_is_occluded(frame->scene, what);
    if (*open) { /* an instance of the last draw? */
        const struct gn_draw *last = &frame->draws.at[frame->draws.count - 1];
        *open = last->mirrored == mirrored && last->cull == cull &&
                (s->casts || frame->items.occluded == occluded) &&
                (s->casts || gn_material_has_opaque_texels(
                                 &frame->scene->materials[last->material]) == in_parts);
    }
    if (!*open) {
        struct gn_program_key key =
            s->casts ? gn_key_caster(frame, item, s->view) : gn_key_lit(frame, item, s->opts);
        if (s->casts && !s->backs && casts_by_middle(frame->scene, pose, item, s->view))
            gn_key_add_middle(s->view, &key);
        if (in_parts) gn_key_take_part(s->blends, &key);
        if (s->tints) key = gn_key_tint(&key);
        if (s->group) key = gn_key_additive(frame, &key, s->group, s->opts);
        uint32_t program = gn_frame_program(frame, &key);
        GN_LIST_PUSH(&frame->draws) = (struct gn_draw){.program = program,
                                                       .geometry = what->geometry,
                                                       .material = what->material,
                                                       .first_instance = frame->instances.count,
                                                       .cull = (uint8_t)cull,
                                                       .mirrored = mirrored};
        frame->items.occluded = occluded;
        *open = true;
    }
    set_instance(frame, pose, s, item, &GN_LIST_PUSH(&frame->instances));
    struct gn_draw *draw = &frame->draws.at[frame->draws.count - 1];
    float depth_m = s->casts ? 0.0f : depth_of(frame, &pose->items[item].box_ws, 1);
    draw->depth_m += (depth_m - draw->depth_m) / (float)++draw->instance_count;
}

enum { DEPTH_STEPS = 64 };

/* Which of 2 x DEPTH_STEPS bins an item of a run falls in: by depth, mirrored ones after all
 * others. */
static uint32_t bin_of(const struct gn_pose *pose, const struct gn_placed *placed, float least,
                       float most) {
    float share = most > least ? (placed->depth - least) / (most - least) : 0.0f;
    return (uint32_t)((DEPTH_STEPS - 1) * share) +
           (pose->items[placed->item].mirrored ? DEPTH_STEPS : 0);
}

/* Draws the gathered run of items of one batch roughly nearest first (a counting sort, so that
 * thousands cost little). */
static void draw_run(struct gn_frame *frame, const struct gn_pose *pose,
                     const struct gn_selection *s) {
    uint32_t count = frame->items.run.count, start[2 * DEPTH_STEPS + 1] = {0};
    float least = INFINITY, most = -INFINITY;
    frame->items.sorted.count = 0;
    for (uint32_t i = 0; i < count; i++) {
        least = fminf(least, frame->items.run.at[i].depth);
        most = fmaxf(most, frame->items.run.at[i].depth);
        GN_LIST_PUSH(&frame->items.sorted) = frame->items.run.at[i];
    }
    for (uint32_t i = 0; i < count; i++)
        start[bin_of(pose, &frame->items.run.at[i], least, most) + 1]++;
    for (int k = 0; k < 2 * DEPTH_STEPS; k++) start[k + 1] += start[k];
    for (uint32_t i = 0; i < count; i++)
        frame->items.sorted.at[start[bin_of(pose, &frame->items.run.at[i], least, most)]++] =
            frame->items.run.at[i];
    bool open = false;
    for (uint32_t i = 0; i < count; i++)
        gn_frame_draw_item(frame, pose, s, frame->items.sorted.at[i].item, &open);
    frame->items.run.count = 0;
}

void gn_frame_draw_items(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_selection *s) {
    uint64_t run = UINT64_MAX;
    frame->items.run.count = 0;
    for (uint32_t i = 0; i < frame->scene->item_count; i++) {
        if (!takes_item(frame, pose, s, i)) continue;
        const struct gn_item *item = &frame->scene->items[i];
        const uint64_t its = 2 * (uint64_t)item->batch + (frame->plan.occlusion.on && item->stays);
        if (its != run) draw_run(frame, pose, s);
        run = its;
        float depth = s->casts ? 0.0f : depth_of(frame, &pose->items[i].box_ws, 0);
        GN_LIST_PUSH(&frame->items.run) = (struct gn_placed){depth, i};
    }
    draw_run(frame, pose, s);
}

/* Opaque before masked (a discard disables early depth tests), then nearest first, by the far side:
 * the ground comes last. */
static float draw_order(const struct gn_frame *frame, const struct gn_draw *draw) {
    bool masked = frame->programs.at[draw->program].features & GN_FEATURE(ALPHA_MASK);
    return draw->depth_m + (masked ? 1e9f : 0.0f);
}

/* Insertion sort: most passes have few draws, nearly sorted from frame to frame. */
static void insert_draws(const struct gn_frame *frame, struct gn_draw *draws, uint32_t count) {
    for (uint32_t i = 1; i < count; i++) {
        struct gn_draw draw = draws[i];
        float order = draw_order(frame, &draw);
        uint32_t at = i;
        for (; at > 0 && draw_order(frame, &draws[at - 1]) > order; at--) draws[at] = draws[at - 1];
        draws[at] = draw;
    }
}

/* Two sorted runs that adjoin, into out. */
static void merge_draws(const struct gn_frame *frame, const struct gn_draw *draws, uint32_t middle,
                        uint32_t count, struct gn_draw *out) {
    uint32_t left = 0, right = middle;
    for (uint32_t i = 0; i < count; i++) {
        const bool takes_right =
            left == middle ||
            (right < count && draw_order(frame, &draws[left]) > draw_order(frame, &draws[right]));
        out[i] = draws[takes_right ? right++ : left++];
    }
}

/* Merge sort of runs, since thousands of draws come in the order of batches; stable, too. */
void gn_frame_sort_draws(struct gn_frame *frame, uint32_t first) {
    enum { RUN = 32 };
    const uint32_t count = frame->draws.count - first;
    struct gn_draw *draws = frame->draws.at + first;
    for (uint32_t i = 0; i < count; i += RUN)
        insert_draws(frame, draws + i, count - i < RUN ? count - i : RUN);
    frame->items.merged.count = 0;
    while (count > RUN && frame->items.merged.count < count)
        GN_LIST_PUSH(&frame->items.merged) = (struct gn_draw){0};
    for (uint64_t width = RUN; width < count; width *= 2) {
        struct gn_draw *out = frame->items.merged.at;
        for (uint64_t i = 0; i < count; i += 2 * width) {
            const uint32_t left = (uint32_t)i, most = (uint32_t)(count - i);
            merge_draws(frame, draws + left, width < most ? (uint32_t)width : most,
                        2 * width < most ? (uint32_t)(2 * width) : most, out + left);
        }
        memcpy(draws, out, count * sizeof *draws);
    }
}
