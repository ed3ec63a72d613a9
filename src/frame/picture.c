/* The passes that draw the picture. With more lights than one pass takes, the first pass draws all
 * with the first group of them, and each other group is added to it: the same surfaces at the same
 * depth, in linear light, within the bounds of its lights on the screen. Blended items come last,
 * farthest first, each followed by what is added to it: what lies before it must dim that, too. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/private.h"

static float srgb_from_linear(float c) {
    c = glm_clamp_zo(c);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1.0f / 2.4f) - 0.055f;
}

/* ---- blended items ---- */

static int by_depth(const void *a, const void *b) {
    const struct gn_placed *x = a, *y = b;
    if (x->depth != y->depth) return x->depth < y->depth ? 1 : -1;
    return x->item < y->item ? -1 : 1;
}

static void add_blend_passes(struct gn_frame *frame, const struct gn_pose *pose,
                             const struct gn_frame_opts *opts) {
    const struct gn_selection seen = {.opts = opts};
    const struct gn_placed *placed = frame->items.blended.at;
    struct gn_pass *blend = NULL; /* of the first group, while it is open */
    bool open = false;
    if (frame->items.blended.count == 0) return; /* the list may be NULL */
    qsort(frame->items.blended.at, frame->items.blended.count, sizeof *placed, by_depth);
    for (uint32_t i = 0; i < frame->items.blended.count; i++) {
        const uint32_t item = placed[i].item;
        const struct gn_item *what = &frame->scene->items[item];
        open = blend && what->batch == frame->scene->items[placed[i - 1].item].batch;
        if (!blend) {
            blend = gn_frame_lit_pass(frame, "blend", 0);
            blend->picture.blend = GN_BLEND_ALPHA;
            blend->depth_write = false;
        }
        gn_frame_draw_item(frame, pose, &seen, item, &open);

        /* the other groups' light; the pass ends where there is any */
        for (uint32_t k = 1; k < frame->group_count; k++) {
            const struct gn_light_group *g = &frame->groups[k];
            if (frame->scene->materials[what->material].unlit || !g->seen ||
                !gn_group_touches(g, &pose->items[item].box_ws))
                continue;
            struct gn_selection reached = {.group = g, .opts = opts};
            bool own = false;
            if (blend) gn_frame_end_pass(frame);
            blend = NULL;
            gn_frame_lit_pass(frame, "blend", k);
            gn_frame_draw_item(frame, pose, &reached, item, &own);
            gn_frame_end_pass(frame);
        }
    }
    if (blend) gn_frame_end_pass(frame);
}

/* ---- further planes ---- */

/* Opaque items on each of them: the same programs, with the planar shadows on that plane. */
static void add_further_planes(struct gn_frame *frame, const struct gn_pose *pose,
                               const struct gn_frame_opts *opts, uint32_t group) {
    for (uint32_t plane = 2; plane <= frame->plane.shown; plane++) {
        const struct gn_selection seen = {
            .group = group > 0 ? &frame->groups[group] : NULL, .plane = plane, .opts = opts};
        char label[16];
        snprintf(label, sizeof label, "plane %u", plane);
        struct gn_pass *pass = gn_frame_lit_pass(frame, label, group);
        const uint32_t first = pass->first_draw;
        gn_frame_set_plane(frame, pass, group, plane);
        gn_frame_draw_items(frame, pose, &seen);
        gn_frame_sort_draws(frame, first);
        gn_frame_end_pass(frame);
        if (frame->passes.at[frame->passes.count - 1].draw_count == 0) frame->passes.count--;
    }
}

/* ---- all of them ---- */

void gn_frame_add_picture(struct gn_frame *frame, const struct gn_pose *pose,
                          const struct gn_frame_opts *opts) {
    static const float aov_clear[GN_AOV_COUNT] = {
        [GN_AOV_VISIBILITY] = 1.0f, [GN_AOV_DISTANCE] = INFINITY};
    const enum gn_aov aov = opts->debug.aov;
    const bool encode = frame->plan.encode_srgb && frame->plan.output == GN_OUTPUT_LINEAR8;
    const struct gn_selection seen = {.part = frame->plan.stencil ? GN_PART_REST : GN_PART_ALL,
                                      .opts = opts};
    gn_frame_bound_groups(frame);
    struct gn_pass *pass = gn_frame_lit_pass(frame, aov == GN_AOV_COLOR ? "opaque" : "aov", 0);
    const uint32_t first = pass->first_draw;
    pass->clear.area = GN_CLEAR_ALL;
    for (int k = 0; k < 3; k++) {
        const float color =
            aov == GN_AOV_COLOR ? frame->scene->environment.background[k] : aov_clear[aov];
        pass->clear.color[k] = encode ? srgb_from_linear(color) : color;
    }
    pass->clear.color[3] = 1.0f;
    frame->items.blended.count = 0;
    gn_frame_draw_items(frame, pose, &seen);
    gn_frame_sort_draws(frame, first);
    gn_frame_end_pass(frame);
    add_further_planes(frame, pose, opts, 0);
    if (frame->plan.stencil) gn_frame_plane_passes(frame, pose, opts, 0);
    for (uint32_t i = 1; i < frame->group_count; i++) {
        if (!frame->groups[i].seen) continue;
        const bool marks = gn_frame_marks_plane(frame, i);
        struct gn_selection reached = {
            .group = &frame->groups[i], .part = marks ? GN_PART_REST : GN_PART_ALL, .opts = opts};
        gn_frame_lit_pass(frame, "", i);
        gn_frame_draw_items(frame, pose, &reached);
        gn_frame_end_pass(frame);
        if (frame->passes.at[frame->passes.count - 1].draw_count == 0) frame->passes.count--;
        add_further_planes(frame, pose, opts, i);
        if (marks) gn_frame_plane_passes(frame, pose, opts, i);
    }
    add_blend_passes(frame, pose, opts);

    /* Programs are made before they are needed: a light that comes near needs no new one. */
    const uint32_t count = frame->programs.count;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t g = 1; g < frame->group_count; g++) {
            const struct gn_program_key lit = frame->programs.at[i];
            if (lit.kind != GN_PROGRAM_LIT) continue;
            if (lit.features & (GN_FEATURE(UNLIT) | GN_FEATURE(ADDITIVE))) continue;
            struct gn_program_key key = gn_key_additive(frame, &lit, &frame->groups[g], opts);
            gn_frame_program(frame, &key);
        }
}

/* Encodes the linear picture where no target of the GPU does. */
void gn_frame_add_encode(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *opts) {
    (void)pose, (void)opts;
    if (!gn_frame_encodes_last(frame)) return;
    struct gn_program_key key;
    memset(&key, 0, sizeof key);
    key.kind = GN_PROGRAM_ENCODE;
    struct gn_pass *pass = gn_frame_picture_pass(frame, "encode");
    pass->target.kind = GN_TARGET_ENCODED;
    pass->depth_write = false;
    pass->constants = gn_frame_constants(frame, GN_CONSTANTS_PICTURE);
    gn_frame_draw_bare(frame, &key, 3, 0, 1);
    gn_frame_end_pass(frame);
}
