/* The passes that draw the picture. With more lights than one pass takes, the first pass draws all
 * with the first group of them, and each other group is added to it: the same surfaces at the same
 * depth, in linear light, within the bounds of its lights on the screen. Blended items come last,
 * farthest first, each followed by what is added to it: what lies before it must dim that, too. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "blocks.glsl"
#include "core/srgb.h"
#include "frame/private.h"

/* ---- blended items ---- */

static int by_depth(const void *a, const void *b) {
    const struct gn_placed *x = a, *y = b;
    if (x->depth != y->depth) return x->depth < y->depth ? 1 : -1;
    return x->item < y->item ? -1 : 1;
}

/* What is behind one side of an item, or both, in the colour that it transmits. */
static void tint_item(struct gn_frame *frame, const struct gn_pose *pose, struct gn_selection seen,
                      uint32_t item) {
    bool open = false;
    struct gn_pass *tint = gn_frame_lit_pass(frame, "tint", 0);
    tint->picture.blend = GN_BLEND_TINT;
    tint->depth_write = false;
    seen.tints = true;
    gn_frame_draw_item(frame, pose, &seen, item, &open);
    gn_frame_end_pass(frame);
}

/* One side of an item, or both at once, with the light of all groups. open: whether the last draw
 * is one of the same batch, in a pass that is still open. */
static void blend_item(struct gn_frame *frame, const struct gn_pose *pose,
                       const struct gn_selection *seen, uint32_t item, bool *open) {
    const struct gn_item *what = &frame->scene->items[item];
    const struct gn_material *m = &frame->scene->materials[what->material];
    gn_frame_draw_item(frame, pose, seen, item, open);
    for (uint32_t k = 1; k < frame->group_count; k++) {
        const struct gn_light_group *g = &frame->groups[k];
        if (m->unlit || m->shadow_catcher || !g->seen ||
            !gn_group_touches(g, &pose->items[item].box_ws))
            continue;
        struct gn_selection reached = *seen;
        bool own = false;
        reached.group = g;
        gn_frame_end_pass(frame);
        gn_frame_lit_pass(frame, "blend", k);
        gn_frame_draw_item(frame, pose, &reached, item, &own);
        *open = false;
    }
}

/* Farthest first; of an item that is seen from both sides, and is no plane, its back faces first.
 * Of a watertight body of glass those have no colour: light that passes it enters as often as it
 * leaves, and is tinted once for both. */
static void add_blend_passes(struct gn_frame *frame, const struct gn_pose *pose,
                             const struct gn_frame_opts *opts) {
    const struct gn_placed *placed = frame->items.blended.at;
    bool in_pass = false, open = false;
    if (frame->items.blended.count == 0) return; /* the list may be NULL */
    qsort(frame->items.blended.at, frame->items.blended.count, sizeof *placed, by_depth);
    for (uint32_t i = 0; i < frame->items.blended.count; i++) {
        const uint32_t item = placed[i].item;
        const struct gn_item *what = &frame->scene->items[item];
        const bool two_sided = frame->scene->materials[what->material].double_sided &&
                               !frame->scene->geometries[what->geometry].flat;
        const bool vessel = two_sided && frame->scene->geometries[what->geometry].watertight;
        open = open && what->batch == frame->scene->items[placed[i - 1].item].batch;
        if (gn_key_is_floor(frame, item)) {
            if (in_pass) gn_frame_end_pass(frame);
            in_pass = open = false;
            gn_frame_draw_floor(frame, pose, opts);
            continue;
        }
        for (int side = 0; side <= two_sided; side++) {
            struct gn_selection seen = {.opts = opts, .blends = true};
            if (two_sided) seen.cull = side ? GN_CULL_BACK : GN_CULL_FRONT;
            seen.colorless = vessel && !side;
            if (gn_key_is_tinted(frame->scene, what)) {
                if (in_pass) gn_frame_end_pass(frame);
                in_pass = open = false;
                tint_item(frame, pose, seen, item);
            }
            if (!in_pass) {
                struct gn_pass *blend = gn_frame_lit_pass(frame, "blend", 0);
                blend->picture.blend = GN_BLEND_ALPHA;
                blend->depth_write = false;
            }
            blend_item(frame, pose, &seen, item, &open);
            in_pass = open;
            if (!in_pass) gn_frame_end_pass(frame);
        }
    }
    if (in_pass) gn_frame_end_pass(frame);
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

/* A grey wall in the light of the environment, on the mean of all sides: a shadow on an unseen
 * floor is seen on it, and so are black and white models. */
static void wall_color(const struct gn_frame_environment_opts *e, vec3 color) {
    const float reflectance = 0.5f;
    const float(*h)[3] = e->of->whole.harmonics;
    for (int k = 0; k < 3; k++)
        color[k] = fmaxf(reflectance * e->strength * (h[0][k] + 0.5f * (h[6][k] + h[8][k])), 0.0f);
}

static void background_of(const struct gn_frame *frame, const struct gn_frame_opts *opts,
                          vec3 color) {
    const struct gn_scene_environment *e = &frame->scene->environment;
    const struct gn_frame_environment_opts *around = &opts->environment;
    switch (opts->background) {
    case GN_BACKGROUND_SCENE:
        if (!e->has_background && around->of && around->lights_key && around->strength > 0.0f)
            wall_color(around, color);
        else
            glm_vec3_copy((float *)e->background, color);
        break;
    case GN_BACKGROUND_SKY: glm_vec3_lerp((float *)e->sky, (float *)e->ground, 0.5f, color); break;
    case GN_BACKGROUND_COLOR: glm_vec3_copy((float *)opts->background_color, color); break;
    case GN_BACKGROUND_TRANSPARENT: glm_vec3_zero(color); break;
    }
}

void gn_frame_add_picture(struct gn_frame *frame, const struct gn_pose *pose,
                          const struct gn_frame_opts *opts) {
    static const float aov_clear[GN_AOV_COUNT] = {
        [GN_AOV_VISIBILITY] = 1.0f, [GN_AOV_DISTANCE] = INFINITY, [GN_AOV_OCCLUSION] = 1.0f};
    const enum gn_aov aov = opts->debug.aov;
    const bool encode = frame->plan.encode_srgb && frame->plan.output == GN_OUTPUT_LINEAR8;
    const struct gn_selection seen = {.part = frame->plan.stencil ? GN_PART_REST : GN_PART_ALL,
                                      .opts = opts};
    gn_frame_bound_groups(frame);
    struct gn_pass *pass = gn_frame_lit_pass(frame, aov == GN_AOV_COLOR ? "opaque" : "aov", 0);
    const uint32_t first = pass->first_draw;
    pass->clear.area = GN_CLEAR_ALL;
    /* else the last pass lays it over the background, which has no tone */
    if (!frame->plan.tones_sum && !frame->plan.transparent) {
        vec3 background;
        background_of(frame, opts, background);
        for (int k = 0; k < 3; k++) {
            const float color = aov == GN_AOV_COLOR ? background[k] : aov_clear[aov];
            pass->clear.color[k] = encode ? gn_srgb_encode(color) : color;
        }
        pass->clear.color[3] = 1.0f;
    }
    frame->items.blended.count = 0;
    gn_frame_draw_items(frame, pose, &seen);
    gn_frame_sort_draws(frame, first);
    gn_frame_end_pass(frame);
    if (aov == GN_AOV_VISIBILITY) gn_frame_draw_floor(frame, pose, opts);
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
}

/* After what is opaque, and the background where that is drawn. */
void gn_frame_add_blended(struct gn_frame *frame, const struct gn_pose *pose,
                          const struct gn_frame_opts *opts) {
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

static bool draws_glass(const struct gn_frame *frame) {
    for (uint32_t i = 0; i < frame->programs.count; i++)
        if (frame->programs.at[i].features & GN_FEATURE(TRANSMISSION)) return true;
    return false;
}

/* Makes a picture of bytes of the linear one: encodes it where no target of the GPU does, maps its
 * tone. */
void gn_frame_add_encode(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_frame_opts *opts) {
    (void)pose;
    if (!frame->plan.finishes) return;
    struct gn_program_key key = gn_key_of(GN_PROGRAM_ENCODE);
    if (frame->plan.tones_sum) key.features |= gn_frame_tone_feature(frame);
    if (frame->plan.transparent) key.features |= GN_FEATURE(TRANSPARENT);
    if (frame->plan.transparent && !frame->plan.tones_sum && draws_glass(frame))
        key.features |= GN_FEATURE(TRANSMISSION);
    if (frame->plan.encode_srgb) key.features |= GN_FEATURE(ENCODE_SRGB);
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PROGRAM + GN_PROGRAM_ENCODE);
    background_of(frame, opts, c[ENCODE_BACKGROUND]);
    struct gn_pass *pass = gn_frame_picture_pass(frame, "encode");
    pass->target.kind = GN_TARGET_ENCODED;
    pass->depth_write = false;
    pass->constants = c;
    pass->constant_count = ENCODE_SIZE;
    gn_frame_draw_bare(frame, &key, 3, 0, 1);
    gn_frame_end_pass(frame);
}
