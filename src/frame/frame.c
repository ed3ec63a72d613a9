/* Building a plan: eye, lights, their shadow maps, then the passes. */
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "blocks.glsl"
#include "core/arena.h"
#include "core/turn.h"
#include "frame/private.h"

struct gn_frame *gn_frame_create(const struct gn_scene *scene, const struct gn_caps *caps) {
    struct gn_frame *frame = gn_xalloc(1, sizeof *frame);
    frame->scene = scene;
    frame->caps = *caps;
    for (uint32_t i = 0; i < scene->item_count; i++)
        frame->has_middle |= scene->items[i].cast_faces == GN_CAST_MIDDLE;
    frame->constants = gn_xalloc(GN_CONSTANTS_COUNT * GN_PASS_SIZE, sizeof *frame->constants);
    return frame;
}

void gn_frame_destroy(struct gn_frame *frame) {
    if (!frame) return;
    free(frame->draws.at);
    free(frame->instances.at);
    free(frame->programs.at);
    free(frame->items.blended.at);
    free(frame->items.run.at);
    free(frame->items.sorted.at);
    free(frame->items.merged.at);
    free(frame->items.levels.at);
    free(frame->passes.at);
    free(frame->notes.lights.at);
    for (int i = 0; i < GN_ALL_SHADOWS_MAX; i++)
        for (int tile = 0; tile < GN_SHADOW_TILES_MAX; tile++)
            gn_shadow_memory_finish(&frame->memory[i][tile]);
    for (int i = 0; i < GN_ALL_SHADOWS_MAX; i++) free(frame->gathered[i].points);
    free(frame->constants);
    free(frame->sets);
    free(frame->plane.constants);
    free(frame);
}

static void choose_output(struct gn_frame *frame, const struct gn_frame_opts *opts,
                          struct gn_warnings *warnings) {
    struct gn_plan *plan = &frame->plan;
    plan->aov = opts->debug.aov;
    const bool encodes = frame->caps.has & 1u << GN_CAP_SRGB && !opts->output.unencoded;
    plan->msaa = opts->debug.aov == GN_AOV_COLOR ? opts->output.msaa : 0;
    plan->encode_srgb = false;
    if (opts->debug.aov != GN_AOV_COLOR)
        plan->output = GN_OUTPUT_AOV;
    else if (opts->output.floats && frame->caps.has & 1u << GN_CAP_RGBA16F)
        plan->output = GN_OUTPUT_FLOAT;
    else if (opts->output.linear || opts->output.floats)
        plan->output = GN_OUTPUT_LINEAR8;
    else if (encodes)
        plan->output = GN_OUTPUT_SRGB8;
    else {
        plan->output = GN_OUTPUT_LINEAR8;
        plan->encode_srgb = true;
    }
    if (opts->debug.aov == GN_AOV_COLOR && opts->output.floats && plan->output != GN_OUTPUT_FLOAT &&
        gn_frame_notice(&frame->notes.said, GN_NOTICE_FLOAT, warnings))
        gn_warn(warnings, "this GPU cannot render to half floats: colour is 8 bits, clamped to 1");
    if (plan->msaa && !(frame->caps.has & 1u << GN_CAP_MSAA4)) {
        plan->msaa = 0;
        if (gn_frame_notice(&frame->notes.said, GN_NOTICE_MSAA, warnings))
            gn_warn(warnings, "this GPU has no multisampling; using --msaa 0");
    }
}

static bool keeps_alpha(struct gn_frame *frame, const struct gn_frame_opts *opts,
                        struct gn_warnings *warnings) {
    if (opts->background != GN_BACKGROUND_TRANSPARENT || opts->debug.aov != GN_AOV_COLOR)
        return false;
    const bool floats = frame->caps.has & 1u << GN_CAP_RGBA16F;
    if (opts->output.keeps_alpha && floats && !opts->output.floats) return true;
    if (gn_frame_notice(&frame->notes.said, GN_NOTICE_TRANSPARENT, warnings))
        gn_warn(warnings, "a transparent background is for .png files%s; here it is black",
                floats ? "" : ", drawn by a GPU with rgba16f targets");
    return false;
}

/* Groups are added, and samples averaged, in linear light: then a last pass encodes. The tone is
 * that of the sum of the groups. Alpha is kept in half floats until colours are divided by it. */
static void choose_finish(struct gn_frame *frame, const struct gn_frame_opts *opts,
                          struct gn_warnings *warnings) {
    struct gn_plan *plan = &frame->plan;
    const bool adds = frame->group_count > 1;
    const bool resolves_to_float = plan->msaa > 1 && frame->caps.has & 1u << GN_CAP_RGBA16F;
    plan->finished = plan->output;
    plan->tones_sum = plan->tone != GN_TONE_NONE && adds;
    plan->transparent = keeps_alpha(frame, opts, warnings);
    plan->encode_srgb &= opts->gather.part <= 0.0f; /* a mean is one of linear light */
    plan->finishes =
        (plan->encode_srgb && (adds || resolves_to_float)) || plan->tones_sum || plan->transparent;
    plan->gathers = opts->gather.part > 0.0f && !plan->finishes;
    if (plan->finishes || plan->gathers) plan->output = GN_OUTPUT_FLOAT;
}

/* Before programs are chosen: what of the environment is drawn. */
static void choose_environment(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    const struct gn_frame_environment_opts *e = &opts->environment;
    const bool is_drawn = e->of && e->strength > 0.0f && opts->debug.aov == GN_AOV_COLOR;
    frame->environment.shows_key = false;
    if (!is_drawn) return;
    frame->environment.shows_key = e->lights_key && e->shows_key;
    frame->plan.environment.light = !e->lights_key ? &e->of->whole
                                    : e->shows_key ? &e->of->shown
                                                   : &e->of->rest;
    frame->plan.environment.id = e->id + (e->lights_key ? 1 + e->shows_key : 0);
    frame->environment.reflected_only = e->reflected_only;
    frame->environment.turned = e->turn_rad != 0.0f;
}

/* After the environment. */
static void choose_occlusion(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    const bool is_lit = frame->plan.environment.light && !frame->environment.reflected_only;
    if (!opts->occlusion.on || frame->scene->occlusion.size[0] == 0) return;
    if (!is_lit && opts->debug.aov != GN_AOV_OCCLUSION) return;
    frame->plan.occlusion = (struct gn_plan_occlusion){
        .on = true, .texels = opts->occlusion.texels, .id = opts->occlusion.id};
}

static void set_occlusion_constants(const struct gn_frame *frame, float (*c)[4]) {
    const struct gn_scene_occlusion *grid = &frame->scene->occlusion;
    for (int k = 0; frame->plan.occlusion.on && k < 3; k++) {
        const float scale = 1.0f / (grid->cell_m * (float)grid->size[k]);
        c[OCCLUSION_SCALE][k] = scale;
        c[OCCLUSION_ADD][k] = 0.5f / (float)grid->size[k] - grid->origin[k] * scale;
    }
}

static void set_environment_constants(struct gn_frame *frame, const struct gn_frame_opts *opts,
                                      float (*c)[4]) {
    const struct gn_environment_light *light = frame->plan.environment.light;
    c[PASS_SKY][3] = 0.0f;
    if (!light) return;
    c[PASS_SKY][3] = opts->environment.strength * c[PASS_EXPOSURE][0];
    frame->environment.scaled = c[PASS_SKY][3] != 1.0f;
    for (int i = 0; i < GN_ENVIRONMENT_HARMONICS; i++)
        memcpy(c[PASS_ENVIRONMENT + i], light->harmonics[i], sizeof light->harmonics[i]);
    c[PASS_ENVIRONMENT + ENVIRONMENT_TURN][0] = cosf(opts->environment.turn_rad);
    c[PASS_ENVIRONMENT + ENVIRONMENT_TURN][1] = sinf(opts->environment.turn_rad);
}

static void set_picture_constants(struct gn_frame *frame, const struct gn_pose *pose,
                                  const struct gn_frame_opts *opts) {
    float(*c)[4] = gn_frame_constants(frame, GN_CONSTANTS_PICTURE);
    memcpy(c[PASS_SKY], frame->scene->environment.sky, sizeof(vec3));
    memcpy(c[PASS_GROUND], frame->scene->environment.ground, sizeof(vec3));
    /* Emission and the hemisphere are specified as displayed: an automatic exposure for lux would
     * make them black. */
    c[PASS_EXPOSURE][0] = opts->exposure_given ? frame->plan.exposure : 1.0f;
    set_environment_constants(frame, opts, c);
    set_occlusion_constants(frame, c + PASS_ENVIRONMENT);
    for (uint32_t i = 0; i < frame->group_count; i++) {
        float(*of_group)[4] = gn_frame_constants(frame, GN_CONSTANTS_PICTURE + i);
        if (i > 0) memcpy(of_group, c, PASS_LIGHTS * sizeof *c);
        gn_frame_light_constants(frame, pose, &frame->groups[i], of_group);
        gn_frame_slide_constants(frame, pose, &frame->groups[i], of_group);
    }
}

static void choose_size(struct gn_plan *plan, const struct gn_frame_opts *opts) {
    const float scale = opts->output.scale;
    plan->width_px = plan->shown_width_px = opts->output.width_px ? opts->output.width_px : 1280;
    plan->height_px = plan->shown_height_px = opts->output.height_px ? opts->output.height_px : 720;
    if (scale <= 0.0f || scale >= 1.0f || opts->debug.aov != GN_AOV_COLOR) return;
    plan->width_px = gn_frame_scaled_px(plan->width_px, scale);
    plan->height_px = gn_frame_scaled_px(plan->height_px, scale);
    /* a mean is scaled by whoever shows it */
    if (opts->gather.part <= 0.0f && !opts->output.scaled_later) return;
    plan->shown_width_px = plan->width_px;
    plan->shown_height_px = plan->height_px;
}

/* The picture as it is seen, upright: the plan's sizes are those of a screen that may be on its
 * side. */
static void turn_picture(struct gn_frame *frame, const struct gn_frame_opts *opts) {
    static const float turns[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const struct gn_plan *plan = &frame->plan;
    const unsigned deg = opts->output.turn_deg;
    const struct gn_turned_size size = gn_turned_upright(deg, plan->width_px, plan->height_px),
                                shown = gn_turned_upright(deg, plan->shown_width_px,
                                                          plan->shown_height_px);
    frame->picture.width_px = size.width_px;
    frame->picture.height_px = size.height_px;
    frame->picture.scale = (float)plan->width_px /
                           (float)(opts->output.width_px ? opts->output.width_px : plan->width_px);
    frame->picture.shown_width_px = shown.width_px;
    frame->picture.shown_height_px = shown.height_px;
    frame->picture.turn_deg = deg % 360;
    memcpy(frame->picture.turn, turns[deg / 90 % 4], sizeof frame->picture.turn);
}

/* Whatever is drawn after it is as large as the picture that is shown. */
void gn_frame_add_scale(struct gn_frame *frame, const struct gn_pose *pose,
                        const struct gn_frame_opts *opts) {
    (void)pose, (void)opts;
    if (!gn_plan_scales(&frame->plan)) return;
    struct gn_pass *pass = gn_frame_picture_pass(frame, "scale");
    gn_frame_to_shown(frame, pass);
    pass->constants = gn_frame_constants(frame, GN_CONSTANTS_PICTURE);
    pass->picture.scales = true;
    pass->depth_write = false;
    gn_frame_end_pass(frame);
}

const struct gn_plan *gn_frame_build(struct gn_frame *frame, const struct gn_pose *pose,
                                     const struct gn_frame_opts *opts,
                                     struct gn_warnings *warnings) {
    struct gn_plan *plan = &frame->plan;
    frame->draws.count = frame->instances.count = frame->programs.count = frame->passes.count = 0;
    *plan = (struct gn_plan){.scene = frame->scene,
                             .view = opts->number,
                             .detail = opts->detail.of,
                             .maps_bytes = opts->shadow.maps_bytes};
    choose_size(plan, opts);
    turn_picture(frame, opts);
    frame->camera = opts->view.light_plus_1
                        ? frame->scene->camera_count + opts->view.light_plus_1 - 1
                        : (uint32_t)opts->view.camera;
    gn_frame_learn_scene(frame);
    gn_frame_renew_notices(frame, opts);
    choose_output(frame, opts, warnings);
    choose_environment(frame, opts);
    choose_occlusion(frame, opts);
    gn_frame_eye(frame, pose, opts, gn_frame_constants(frame, GN_CONSTANTS_PICTURE));
    plan->exposure = gn_frame_exposure(frame, pose, opts);
    gn_frame_choose_lights(frame, pose, opts, warnings);
    gn_frame_choose_tone(frame, opts, warnings);
    choose_finish(frame, opts, warnings);
    gn_frame_fit_shadows(frame, pose, opts, warnings);
    gn_frame_hold_maps(frame, opts);
    gn_frame_gather_points(frame, opts);
    gn_frame_choose_levels(frame, pose, opts);
    set_picture_constants(frame, pose, opts);
    gn_frame_light_floor(frame, pose);
#define X(name) gn_frame_add_##name(frame, pose, opts);
    GN_FRAME_STEPS(X)
#undef X
    gn_frame_bound_overdraw(frame, pose, opts->overdraw, warnings);
    /* After the last pass to the output its samples are resolved, and nothing reads its depth. */
    struct gn_pass *last = &frame->passes.at[frame->passes.count - 1];
    while (last->target.kind != GN_TARGET_OUTPUT) last--;
    last->discard_depth = true;
    last->picture.resolves = true;

    plan->passes = frame->passes.at;
    plan->draws = frame->draws.at;
    plan->instances = frame->instances.at;
    plan->programs = frame->programs.at;
    plan->shadows = frame->shadows;
    plan->lights = frame->scene_lights;
    plan->materials = pose->materials;
    plan->pose_texels = (const float(*)[4])pose->texels;
    plan->pass_count = frame->passes.count;
    plan->draw_count = frame->draws.count;
    plan->instance_count = frame->instances.count;
    plan->program_count = frame->programs.count;
    plan->shadow_count = frame->view_count;
    plan->light_count = frame->light_count;
    assert(gn_plan_check(plan) == NULL);
    return plan;
}
