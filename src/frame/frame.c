/* Building a plan: eye, lights, one pass per shadow map, then the picture. Items are sorted by
 * batch, so a run of them becomes one instanced call (two when some are mirrored); blended items go
 * last, farthest first, one by one. */
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "blocks.glsl"
#include "core/arena.h"
#include "frame/private.h"

void *gn_list_grow(void *at, uint32_t count, uint32_t *room, size_t size) {
    if (count < *room) return at;
    *room = *room ? 2 * *room : 64;
    return gn_xrealloc(at, *room, size);
}

struct gn_frame *gn_frame_create(const struct gn_scene *scene, const struct gn_caps *caps) {
    struct gn_frame *frame = gn_xalloc(1, sizeof *frame);
    frame->scene = scene;
    frame->caps = *caps;
    frame->constants = gn_xalloc(GN_CONSTANTS_COUNT * GN_PASS_SIZE, sizeof *frame->constants);
    return frame;
}

float (*gn_frame_constants(const struct gn_frame *frame, uint32_t which))[4] {
    return frame->constants + (size_t)which * GN_PASS_SIZE;
}

void gn_frame_destroy(struct gn_frame *frame) {
    if (!frame) return;
    free(frame->draws.at);
    free(frame->instances.at);
    free(frame->programs.at);
    free(frame->blended.at);
    free(frame->run.at);
    free(frame->sorted.at);
    free(frame->passes.at);
    free(frame->notes.at);
    for (int i = 0; i < GN_ALL_SHADOWS_MAX; i++)
        for (int tile = 0; tile < GN_SHADOW_TILES_MAX; tile++)
            gn_shadow_memory_finish(&frame->memory[i][tile]);
    free(frame->constants);
    free(frame->sets);
    free(frame);
}

uint32_t gn_frame_program(struct gn_frame *frame, const struct gn_program_key *key) {
    for (uint32_t i = 0; i < frame->programs.count; i++)
        if (memcmp(&frame->programs.at[i], key, sizeof *key) == 0) return i;
    GN_LIST_PUSH(&frame->programs) = *key;
    return frame->programs.count - 1;
}

static void add_instance(struct gn_frame *frame, const struct gn_pose *pose, uint32_t index) {
    const struct gn_item *item = &frame->scene->items[index];
    const struct gn_material *m = &frame->scene->materials[item->material];
    struct gn_instance *instance = &GN_LIST_PUSH(&frame->instances);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++)
            instance->world[r][c] = pose->items[index].world_from_item[c][r];
    memcpy(instance->base_color, m->base_color, sizeof instance->base_color);
    instance->surface[0] = m->roughness;
    instance->surface[1] = m->metalness;
    instance->surface[2] = m->occlusion_strength;
    instance->surface[3] = m->alpha_cutoff;
    memcpy(instance->emissive, m->emissive, sizeof m->emissive);
    instance->emissive[3] = gn_shadow_item_casts(frame->scene, index) ? 1.0f : 0.0f;
}

static bool light_is_outside(const struct gn_box *box, const struct gn_shadow_view *view) {
    if (!view->perspective) return true;
    for (int k = 0; k < 3; k++)
        if (view->light_ws[k] < box->min[k] || view->light_ws[k] > box->max[k]) return true;
    return false;
}

/* Casting from both sides, a solid body needs only the faces that look to a light outside it;
 * `auto` gives it the others (second depth: Wang, Molnar 1994), and what is open both. */
static enum gn_cull caster_cull(const struct gn_scene *scene, const struct gn_pose *pose,
                                uint32_t index, const struct gn_shadow_view *view) {
    const struct gn_item *item = &scene->items[index];
    if (item->cast_faces == GN_CAST_FRONT) return GN_CULL_BACK;
    if (item->cast_faces == GN_CAST_BACK) return GN_CULL_FRONT;
    bool solid = scene->geometries[item->geometry].closed &&
                 scene->materials[item->material].alpha != GN_ALPHA_MASK;
    if (!solid || !light_is_outside(&pose->items[index].box_ws, view)) return GN_CULL_NONE;
    return item->cast_faces == GN_CAST_AUTO ? GN_CULL_FRONT : GN_CULL_BACK;
}

static enum gn_cull eye_cull(const struct gn_frame *frame, const struct gn_item *item) {
    return frame->scene->materials[item->material].double_sided ? GN_CULL_NONE : GN_CULL_BACK;
}

static void begin_draw(struct gn_frame *frame, uint32_t item, const struct gn_program_key *key,
                       enum gn_cull cull, bool mirrored) {
    uint32_t program = gn_frame_program(frame, key);
    GN_LIST_PUSH(&frame->draws) = (struct gn_draw){
        .program = program,
        .geometry = frame->scene->items[item].geometry,
        .material = frame->scene->items[item].material,
        .first_instance = frame->instances.count,
        .cull = (uint8_t)cull,
        .mirrored = mirrored,
    };
}

static bool is_blended(const struct gn_frame *frame, uint32_t item) {
    return frame->scene->materials[frame->scene->items[item].material].alpha == GN_ALPHA_BLEND;
}

/* How far behind the near plane a box lies: its middle, or its far side. */
static float depth_of(const struct gn_frame *frame, const struct gn_box *box, bool far_side) {
    const float *near_plane = frame->eye.planes[4];
    float depth = near_plane[3];
    for (int k = 0; k < 3; k++) {
        depth += near_plane[k] * 0.5f * (box->min[k] + box->max[k]);
        if (far_side) depth += fabsf(near_plane[k]) * 0.5f * (box->max[k] - box->min[k]);
    }
    return depth;
}

/* Of what the eye sees, opaque: what the lights that are added reach. */
static bool takes_light(const struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_light_group *group, uint32_t item) {
    const struct gn_material *m = &frame->scene->materials[frame->scene->items[item].material];
    const struct gn_pose_item *posed = &pose->items[item];
    return posed->visible && !m->unlit && m->alpha != GN_ALPHA_BLEND &&
           gn_eye_sees(&frame->eye, &posed->box_ws) && gn_group_touches(group, &posed->box_ws);
}

static bool takes(struct gn_frame *frame, const struct gn_pose *pose, const struct gn_selection *s,
                  uint32_t item) {
    if (s->casts) return s->casts[item] >> s->page & 1;
    if (s->part && gn_key_on_plane(frame, item, s->opts) != (s->part == GN_PART_PLANE))
        return false;
    if (s->group) return takes_light(frame, pose, s->group, item);
    const struct gn_box *box = &pose->items[item].box_ws;
    if (!pose->items[item].visible || !(s->opts->all_seen || gn_eye_sees(&frame->eye, box))) {
        frame->plan.culled++;
        return false;
    }
    if (!is_blended(frame, item)) return true;
    if (s->opts->aov == GN_AOV_COLOR)
        GN_LIST_PUSH(&frame->blended) = (struct gn_placed){depth_of(frame, box, false), item};
    return false;
}

static struct gn_program_key key_of(const struct gn_frame *frame, const struct gn_selection *s,
                                    uint32_t item) {
    if (s->casts) return gn_key_caster(frame, item, s->view);
    struct gn_program_key lit = gn_key_lit(frame, item, s->opts);
    return s->group ? gn_key_additive(frame, &lit, s->group, s->opts) : lit;
}

void gn_frame_draw_item(struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_selection *s, uint32_t item, bool *open) {
    bool mirrored = pose->items[item].mirrored != s->mirrored;
    enum gn_cull cull = s->casts ? caster_cull(frame->scene, pose, item, s->view)
                                 : eye_cull(frame, &frame->scene->items[item]);
    if (*open) { /* one more of the last? */
        const struct gn_draw *last = &frame->draws.at[frame->draws.count - 1];
        *open = last->mirrored == mirrored && last->cull == cull;
    }
    if (!*open) {
        struct gn_program_key key = key_of(frame, s, item);
        begin_draw(frame, item, &key, cull, mirrored);
        *open = true;
    }
    add_instance(frame, pose, item);
    struct gn_draw *draw = &frame->draws.at[frame->draws.count - 1];
    float depth_m = s->casts ? 0.0f : depth_of(frame, &pose->items[item].box_ws, true);
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
    uint32_t count = frame->run.count, start[2 * DEPTH_STEPS + 1] = {0};
    float least = INFINITY, most = -INFINITY;
    frame->sorted.count = 0;
    for (uint32_t i = 0; i < count; i++) {
        least = fminf(least, frame->run.at[i].depth);
        most = fmaxf(most, frame->run.at[i].depth);
        GN_LIST_PUSH(&frame->sorted) = frame->run.at[i];
    }
    for (uint32_t i = 0; i < count; i++) start[bin_of(pose, &frame->run.at[i], least, most) + 1]++;
    for (int k = 0; k < 2 * DEPTH_STEPS; k++) start[k + 1] += start[k];
    for (uint32_t i = 0; i < count; i++)
        frame->sorted.at[start[bin_of(pose, &frame->run.at[i], least, most)]++] = frame->run.at[i];
    bool open = false;
    for (uint32_t i = 0; i < count; i++)
        gn_frame_draw_item(frame, pose, s, frame->sorted.at[i].item, &open);
    frame->run.count = 0;
}

void gn_frame_draw_items(struct gn_frame *frame, const struct gn_pose *pose,
                         const struct gn_selection *s) {
    uint32_t batch = UINT32_MAX;
    frame->run.count = 0;
    for (uint32_t i = 0; i < frame->scene->item_count; i++) {
        if (!takes(frame, pose, s, i)) continue;
        if (frame->scene->items[i].batch != batch) draw_run(frame, pose, s);
        batch = frame->scene->items[i].batch;
        float depth = s->casts ? 0.0f : depth_of(frame, &pose->items[i].box_ws, false);
        GN_LIST_PUSH(&frame->run) = (struct gn_placed){depth, i};
    }
    draw_run(frame, pose, s);
}

/* Opaque before masked (a discard costs early depth), then nearest first, by the far side: a ground
 * goes last. */
static float draw_order(const struct gn_frame *frame, const struct gn_draw *draw) {
    bool masked = frame->programs.at[draw->program].features & GN_FEATURE(ALPHA_MASK);
    return draw->depth_m + (masked ? 1e9f : 0.0f);
}

/* Few draws, nearly sorted from frame to frame: insertion. */
void gn_frame_sort_draws(struct gn_frame *frame, uint32_t first) {
    struct gn_draw *draws = frame->draws.at;
    for (uint32_t i = first + 1; i < frame->draws.count; i++) {
        struct gn_draw draw = draws[i];
        float order = draw_order(frame, &draw);
        uint32_t at = i;
        for (; at > first && draw_order(frame, &draws[at - 1]) > order; at--)
            draws[at] = draws[at - 1];
        draws[at] = draw;
    }
}

struct gn_pass *gn_frame_begin_pass(struct gn_frame *frame, enum gn_pass_kind kind) {
    struct gn_pass *pass = &GN_LIST_PUSH(&frame->passes);
    *pass = (struct gn_pass){.kind = kind,
                             .first_draw = frame->draws.count,
                             .depth_write = true,
                             .constant_count = PASS_SLIDES};
    return pass;
}

void gn_frame_end_pass(struct gn_frame *frame) {
    struct gn_pass *pass = &frame->passes.at[frame->passes.count - 1];
    pass->draw_count = frame->draws.count - pass->first_draw;
}

static void choose_output(struct gn_frame *frame, const struct gn_frame_opts *opts,
                          struct gn_warnings *warnings) {
    struct gn_plan *plan = &frame->plan;
    plan->aov = opts->aov;
    const bool encodes = frame->caps.has & 1u << GN_CAP_SRGB && !opts->unencoded;
    plan->msaa = opts->aov == GN_AOV_COLOR ? opts->msaa : 0;
    plan->encode_srgb = false;
    if (opts->aov != GN_AOV_COLOR)
        plan->output = GN_OUTPUT_AOV;
    else if (opts->output_float && frame->caps.has & 1u << GN_CAP_RGBA16F)
        plan->output = GN_OUTPUT_FLOAT;
    else if (opts->output_linear || opts->output_float)
        plan->output = GN_OUTPUT_LINEAR8;
    else if (encodes)
        plan->output = GN_OUTPUT_SRGB8;
    else {
        plan->output = GN_OUTPUT_LINEAR8;
        plan->encode_srgb = true;
    }
    if (opts->aov == GN_AOV_COLOR && opts->output_float && plan->output != GN_OUTPUT_FLOAT &&
        gn_frame_notice(&frame->said, GN_NOTICE_FLOAT, warnings))
        gn_warn(warnings, "this GPU cannot draw to half floats: colour has 8 bits and ends at 1");
    if (plan->msaa && !(frame->caps.has & 1u << GN_CAP_MSAA4)) {
        plan->msaa = 0;
        if (gn_frame_notice(&frame->said, GN_NOTICE_MSAA, warnings))
            gn_warn(warnings, "this GPU cannot antialias by multisampling: --msaa 0 is used");
    }
}

static void picture_constants(struct gn_frame *frame, const struct gn_pose *pose,
                              const struct gn_frame_opts *opts) {
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PICTURE);
    memcpy(c[PASS_SKY], frame->scene->sky, sizeof(vec3));
    memcpy(c[PASS_GROUND], frame->scene->ground, sizeof(vec3));
    /* What glows is given as it shall look, as the hemisphere is: an automatic exposure for lux
     * would put it out. */
    c[PASS_EXPOSURE][0] = opts->exposure_given ? frame->plan.exposure : 1.0f;
    for (uint32_t i = 0; i < frame->group_count; i++) {
        float(*of_group)[4] = gn_frame_constants(frame, GN_CONSTANTS_PICTURE + i);
        if (i > 0) memcpy(of_group, c, PASS_LIGHTS * sizeof *c);
        gn_frame_light_constants(frame, pose, &frame->groups[i], of_group);
        gn_frame_slide_constants(frame, pose, &frame->groups[i], of_group);
    }
}

static void turn(struct gn_frame *frame, unsigned deg) {
    static const float turns[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const bool on_side = deg / 90 % 2;
    frame->picture_width_px = on_side ? frame->plan.height_px : frame->plan.width_px;
    frame->picture_height_px = on_side ? frame->plan.width_px : frame->plan.height_px;
    memcpy(frame->turn, turns[deg / 90 % 4], sizeof frame->turn);
}

static void reset(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    frame->draws.count = frame->instances.count = frame->programs.count = frame->passes.count = 0;
    frame->plan = (struct gn_plan){.scene = frame->scene};
    frame->plan.width_px = opts->width_px ? opts->width_px : 1280;
    frame->plan.height_px = opts->height_px ? opts->height_px : 720;
    frame->camera = (uint32_t)opts->camera;
    turn(frame, opts->turn_deg);
}

static void publish(struct gn_frame *frame) {
    struct gn_plan *plan = &frame->plan;
    plan->passes = frame->passes.at;
    plan->draws = frame->draws.at;
    plan->instances = frame->instances.at;
    plan->programs = frame->programs.at;
    plan->shadows = frame->shadows;
    plan->lights = frame->scene_lights;
    plan->pass_count = frame->passes.count;
    plan->draw_count = frame->draws.count;
    plan->instance_count = frame->instances.count;
    plan->program_count = frame->programs.count;
    plan->shadow_count = frame->shadow_count;
    plan->light_count = frame->light_count;
}

/* Samples, which are to be averaged as light, before they are encoded. */
static bool averages(const struct gn_frame *frame) {
    return frame->plan.msaa > 1 && frame->caps.has & 1u << GN_CAP_RGBA16F;
}

const struct gn_plan *gn_frame_build(struct gn_frame *frame, const struct gn_pose *pose,
                                     const struct gn_frame_opts *opts,
                                     struct gn_warnings *warnings) {
    struct gn_plan *plan = &frame->plan;
    reset(frame, opts);
    gn_frame_take_note(frame, opts);
    choose_output(frame, opts, warnings);
    gn_frame_eye(frame, pose, opts, gn_frame_constants(frame, GN_CONSTANTS_PICTURE));
    plan->exposure = gn_frame_exposure(frame, pose, opts);
    gn_frame_choose_lights(frame, pose, opts, warnings);
    if (plan->encode_srgb && (frame->group_count > 1 || averages(frame)))
        plan->output = GN_OUTPUT_FLOAT;
    gn_frame_fit_shadows(frame, pose, opts, warnings);
    gn_frame_hold_maps(frame, opts);
    gn_frame_map_passes(frame, pose, opts);
    picture_constants(frame, pose, opts);
    gn_frame_picture_passes(frame, pose, opts);
    gn_frame_overlay_passes(frame, pose, opts);
    if (!gn_frame_is_encoded(frame)) gn_frame_caption_pass(frame, opts);
    gn_frame_finish_picture(frame);
    if (gn_frame_is_encoded(frame)) gn_frame_caption_pass(frame, opts);
    publish(frame);
    assert(gn_plan_check(plan) == NULL);
    return plan;
}
