#include "cli/stage.h"

#include <math.h>
#include <string.h>

#include "cli/import.h"
#include "core/embedded.h"

struct gn_scene *gn_stage_scene(const struct gn_options *options, struct gn_warnings *warnings,
                                struct gn_err *err) {
    struct gn_scene_limits limits = {0};
    for (int i = 0; i < options->limits.count; i++)
        if (!gn_scene_limits_set(&limits, options->limits.items[i].name,
                                 (uint64_t)options->limits.items[i].value, err))
            return NULL;
    if (options->scene && gn_import_wants(options->scene))
        return gn_import_load(options->scene, &limits, warnings, err);
    if (options->scene) return gn_scene_load(options->scene, &limits, warnings, err);
    const struct gn_embedded *sundial = gn_embedded_find("sundial.glb");
    if (!sundial) {
        gn_fail(err, "this build has no scene inside: name one");
        return NULL;
    }
    return gn_scene_load_bytes("(default scene)", sundial->data, sundial->size, &limits, warnings,
                               err);
}

/* The clip selection of --animation and --no-animation. */
static bool choose_clips(const struct gn_stage *stage, int *clips, struct gn_err *err) {
    const struct gn_options *o = stage->options;
    *clips = GN_POSE_DEFAULT;
    if (o->no_animation || (o->animation && strcmp(o->animation, "none") == 0))
        *clips = GN_POSE_NONE;
    else if (o->animation)
        *clips = gn_scene_find_clip(stage->scene, o->animation, err);
    return !o->animation || *clips != -1 || *clips == GN_POSE_NONE;
}

static bool check_light(const struct gn_stage *stage, struct gn_err *err) {
    const struct gn_options *o = stage->options;
    if (o->aov == GN_AOV_COLOR || o->aov == GN_AOV_DISTANCE || o->aov == GN_AOV_NORMAL) return true;
    if (o->light >= 0 && (uint32_t)o->light < stage->scene->light_count) return true;
    return gn_fail_usage(err, "--light %d: the scene has %u light%s, counted from 0", o->light,
                         stage->scene->light_count, stage->scene->light_count == 1 ? "" : "s");
}

static bool choose_frame(struct gn_stage *stage, struct gn_err *err) {
    const struct gn_options *o = stage->options;
    struct gn_frame_opts *f = &stage->frame_opts;
    *f = (struct gn_frame_opts){
        .width_px = (uint32_t)o->size.width_px,
        .height_px = (uint32_t)o->size.height_px,
        .aov =
            o->aov == GN_AOV_COUNT ? GN_AOV_VISIBILITY /* this light alone */ : (enum gn_aov)o->aov,
        .light = o->light,
        .output_linear = o->output == GN_PICTURE_LINEAR,
        .exposure_given = !isnan(o->exposure_ev),
        .exposure_ev = isnan(o->exposure_ev) ? 0.0f : (float)o->exposure_ev,
        .map_px = gn_options_given(o, map_px) ? (uint32_t)o->map_px : 0,
        .taps = (unsigned)o->taps,
        .taps_fixed = o->taps_fixed,
        .strength_given = gn_options_given(o, shadow_strength),
        .strength = (float)o->shadow_strength,
        .msaa = (uint32_t)o->msaa,
        .show_lights = o->show_lights,
        .show_maps = o->show_maps,
    };
    f->technique_given = gn_options_given(o, shadow) && o->shadow;
    f->camera = gn_scene_find_camera(stage->scene, o->camera, err);
    return f->camera >= 0 && gn_encoding_find(o->map_format, &f->encoding, err) &&
           (!f->technique_given || strchr(o->shadow, ',') ||
            gn_technique_find(o->shadow, &f->technique, err));
}

bool gn_stage_load(struct gn_stage *stage, const struct gn_options *options,
                   struct gn_warnings *warnings, struct gn_err *err) {
    *stage = (struct gn_stage){.options = options};
    stage->scene = gn_stage_scene(options, warnings, err);
    if (!stage->scene) return false;
    int clips;
    if (!choose_clips(stage, &clips, err) || !check_light(stage, err) || !choose_frame(stage, err))
        return false;
    gn_pose_init(&stage->pose, stage->scene, clips);
    gn_pose_step(&stage->pose, options->time_ns);
    return true;
}

bool gn_stage_open(struct gn_stage *stage, struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_options *o = stage->options;
    if (!gn_display_open(&stage->display, o->backend, warnings, err)) return false;
    struct gn_gl_opts opts = {
        .get_proc = gn_display_get_proc,
        .display = &stage->display,
        .shaders = o->shaders,
        .without = o->without,
        .desktop = stage->display.ops->desktop,
        .prove_later = true,
        .debug = o->verbose,
    };
    stage->gl = gn_gl_create(&opts, warnings, err);
    if (!stage->gl || !gn_gl_load(stage->gl, stage->scene, err)) return false;
    const struct gn_caps *caps = gn_gl_caps(stage->gl);
    int most = caps->max_texture_px;
    if (o->size.width_px > most || o->size.height_px > most)
        return gn_fail(err, "--size %dx%d: %s draws at most %dx%d", o->size.width_px,
                       o->size.height_px, caps->renderer, most, most);
    stage->frame = gn_frame_create(stage->scene, caps);
    return true;
}

const struct gn_plan *gn_stage_plan(struct gn_stage *stage, struct gn_warnings *warnings,
                                    struct gn_err *err) {
    const struct gn_plan *plan =
        gn_frame_build(stage->frame, &stage->pose, &stage->frame_opts, warnings);
    while (!gn_gl_prove(stage->gl, plan)) {
        gn_frame_destroy(stage->frame);
        stage->frame = gn_frame_create(stage->scene, gn_gl_caps(stage->gl));
        plan = gn_frame_build(stage->frame, &stage->pose, &stage->frame_opts, warnings);
    }
    return gn_gl_prepare(stage->gl, plan, err) ? plan : NULL;
}

void gn_stage_pose(struct gn_stage *stage, int64_t time_ns) {
    gn_pose_step(&stage->pose, time_ns);
    double turned_deg = fmod(stage->options->turntable_deg_s * ((double)time_ns * 1e-9), 360.0);
    stage->frame_opts.turntable_rad = glm_rad((float)turned_deg);
}

const struct gn_plan *gn_stage_draw(struct gn_stage *stage, int64_t time_ns,
                                    struct gn_warnings *warnings, struct gn_err *err) {
    gn_stage_pose(stage, time_ns);
    const struct gn_plan *plan = gn_stage_plan(stage, warnings, err);
    return plan && gn_gl_run(stage->gl, plan, NULL, err) ? plan : NULL;
}

void gn_stage_close(struct gn_stage *stage) {
    gn_frame_destroy(stage->frame);
    gn_gl_destroy(stage->gl);
    gn_display_close(&stage->display);
    gn_pose_finish(&stage->pose);
    gn_scene_destroy(stage->scene);
    *stage = (struct gn_stage){0};
}
