#include "stage/stage.h"

#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/embedded.h"
#include "core/srgb.h"
#include "core/stop.h"
#include "stage/detail.h"
#include "stage/environment.h"
#include "stage/import.h"
#include "stage/lights.h"
#include "stage/occlusion.h"
#include "stage/sun.h"
#include "stage/wake.h"

/* "lesson:solids" */
static struct gn_scene *read_lesson(const char *path, const struct gn_scene_limits *limits,
                                    struct gn_warnings *warnings, struct gn_err *err) {
    char name[80];
    snprintf(name, sizeof name, "lessons/%.60s.glb", path + strlen(GN_SCENE_LESSON));
    const struct gn_embedded *file = gn_embedded_find(name);
    if (file) return gn_scene_load_bytes(path, file->data, file->size, limits, warnings, err);
    gn_fail(err, "%.80s: there is no such scene inside; gnomon lesson list prints those there are",
            path);
    return NULL;
}

static struct gn_scene *read_file(const char *path, const struct gn_scene_limits *limits,
                                  struct gn_warnings *warnings, struct gn_err *err) {
    if (gn_import_wants(path)) return gn_import_load(path, limits, warnings, err);
    struct gn_scene *scene = gn_scene_load(path, limits, warnings, err);
    return scene || !gn_import_wants_refused(path, limits)
               ? scene
               : gn_import_load(path, limits, warnings, err);
}

struct gn_scene *gn_stage_read(const char *path, const struct gn_scene_limits *limits,
                               struct gn_warnings *warnings, struct gn_err *err) {
    if (path && strncmp(path, GN_SCENE_LESSON, strlen(GN_SCENE_LESSON)) == 0)
        return read_lesson(path, limits, warnings, err);
    if (path) return read_file(path, limits, warnings, err);
    const struct gn_embedded *sundial = gn_embedded_find("sundial.glb");
    if (!sundial) {
        gn_fail(err, "this build has no built-in scene: name a file");
        return NULL;
    }
    return gn_scene_load_bytes("(default scene)", sundial->data, sundial->size, limits, warnings,
                               err);
}

struct gn_scene_limits gn_stage_limits(const struct gn_settings *settings) {
    const double floor_m = settings->scene.floor_m, texture_px = settings->scene.texture_limit_px;
    struct gn_scene_limits limits = gn_scene_limits_or_default(&settings->render.limits.all);
    limits.floor = (struct gn_scene_floor){.kind = isnan(floor_m)   ? GN_FLOOR_AUTO
                                                   : isinf(floor_m) ? GN_FLOOR_NONE
                                                                    : GN_FLOOR_HEIGHT,
                                           .height_m = isfinite(floor_m) ? floor_m : 0.0};
    limits.texture_px = isfinite(texture_px) ? (uint32_t)texture_px : 0;
    return limits;
}

void gn_stage_name_source(const struct gn_settings *settings, struct gn_err *err) {
    if (settings->scene.path && gn_settings_from(settings, scene.path) != GN_SOURCE_FLAG)
        gn_fail_prefix(err, "%s", gn_settings_label(settings, scene.path));
}

struct gn_scene *gn_stage_scene(const struct gn_settings *settings, struct gn_warnings *warnings,
                                struct gn_err *err) {
    const struct gn_scene_limits limits = gn_stage_limits(settings);
    struct gn_scene *scene = gn_stage_read(settings->scene.path, &limits, warnings, err);
    if (!scene) gn_stage_name_source(settings, err);
    return scene;
}

/* The scene lacks something that a setting names. A kiosk whose file names it continues with a
 * warning; else false, with the source in err. */
static bool do_without(const struct gn_settings *o, size_t offset, struct gn_warnings *warnings,
                       struct gn_err *err) {
    gn_fail_prefix(err, "%s", gn_settings_label_at(o, offset));
    enum gn_source source = gn_settings_source(o, offset);
    if (o->run.command != GN_COMMAND_SHOW || source >= GN_SOURCE_FLAG) return false;
    gn_warn(warnings, "%s (running without it)", err->text);
    *err = (struct gn_err){0};
    return true;
}

static bool choose_clips(const struct gn_settings *o, const struct gn_scene *scene, int *clips,
                         struct gn_warnings *warnings, struct gn_err *err) {
    const size_t still = offsetof(struct gn_settings, scene.no_animation),
                 clip = offsetof(struct gn_settings, scene.animation);
    /* of --animation and --no-animation the stronger source wins: command line, mode, file; from
     * the same one: check_animation() in options/args.c */
    const bool none =
        (o->scene.animation && strcmp(o->scene.animation, "none") == 0) ||
        (o->scene.no_animation && gn_settings_source(o, still) >= gn_settings_source(o, clip));
    *clips = none ? GN_POSE_NONE : GN_POSE_DEFAULT;
    if (none || !o->scene.animation) return true;
    *clips = gn_scene_find_clip(scene, o->scene.animation, err);
    if (*clips >= 0) return true;
    *clips = GN_POSE_DEFAULT;
    return do_without(o, clip, warnings, err);
}

static bool choose_variant(const struct gn_settings *o, const struct gn_scene *scene, int *variant,
                           struct gn_warnings *warnings, struct gn_err *err) {
    *variant = GN_POSE_DEFAULT;
    if (!o->scene.variant || strcmp(o->scene.variant, "auto") == 0) return true;
    *variant = gn_scene_find_variant(scene, o->scene.variant, err);
    if (*variant >= 0) return true;
    *variant = GN_POSE_DEFAULT;
    return do_without(o, offsetof(struct gn_settings, scene.variant), warnings, err);
}

/* Points of a lamp in a mask while something moves: their error is .04 in penumbrae. */
enum { GATHER_POINTS = 16 };

/* The first camera, or a made one where that sees too little of the model. */
static void choose_automatic_camera(const struct gn_scene *scene, int clips,
                                    struct gn_frame_view_opts *view) {
    struct gn_pose pose;
    bool cuts;
    gn_pose_init(&pose, scene, clips);
    view->camera = 0;
    if (!scene->added.camera && gn_framing_share(&pose, 0, &cuts) < GN_FRAMING_LEAST_SHARE)
        view->framing.made_plus_1 = 1;
    gn_pose_finish(&pose);
}

/* A camera, light:NAME or auto. */
static bool choose_camera(const struct gn_settings *o, const struct gn_scene *scene, int clips,
                          struct gn_frame_view_opts *view, struct gn_err *err) {
    static const char prefix[] = "light:";
    const char *name = o->scene.camera;
    if (name && strcmp(name, "auto") == 0) {
        choose_automatic_camera(scene, clips, view);
        return true;
    }
    const bool of_light = name && strncmp(name, prefix, sizeof prefix - 1) == 0;
    const int camera = gn_scene_find_camera(scene, name, of_light ? NULL : err);
    view->camera = camera >= 0 ? camera : 0;
    if (camera >= 0 || !of_light) return camera >= 0;
    const int light = gn_scene_find_light(scene, name + sizeof prefix - 1, err);
    if (light < 0) return false;
    if (gn_light_types[scene->lights[light].type].shines_around)
        return gn_fail_usage(err,
                             "light '%s' shines in all directions: only a spot or a directional "
                             "light can be looked from",
                             scene->lights[light].name);
    view->light_plus_1 = (uint32_t)light + 1;
    return true;
}

static enum gn_background background_of(int setting) {
    return setting == GN_SHOW_SCENE         ? GN_BACKGROUND_SCENE
           : setting == GN_SHOW_SKY         ? GN_BACKGROUND_SKY
           : setting == GN_SHOW_TRANSPARENT ? GN_BACKGROUND_TRANSPARENT
                                            : GN_BACKGROUND_COLOR;
}

static void set_frame_opts(struct gn_frame_opts *f, const struct gn_settings *o) {
    const bool continuous = o->run.command == GN_COMMAND_SHOW || o->run.command == GN_COMMAND_AUTO;
    *f = (struct gn_frame_opts){
        .output.width_px = (uint32_t)o->render.size.width_px,
        .output.height_px = (uint32_t)o->render.size.height_px,
        .view.framing.turns = o->scene.turntable_deg_s != 0.0,
        .debug.aov = o->render.aov >= GN_AOV_COUNT ? GN_AOV_VISIBILITY /* this light alone */
                                                   : (enum gn_aov)o->render.aov,
        .debug.light = o->render.light,
        .output.linear = o->render.output == GN_PICTURE_LINEAR,
        .exposure_given = !isnan(o->render.exposure_ev),
        .exposure_ev = isnan(o->render.exposure_ev) ? 0.0f : (float)o->render.exposure_ev,
        .shadow.planar_in_stencil = o->render.planar == GN_PLANAR_STENCIL,
        .shadow.planar_points =
            o->render.planar == GN_PLANAR_SOFT ? (uint32_t)o->render.planar_points : 0,
        .shadow.gather_points =
            continuous || o->run.command == GN_COMMAND_BENCH ? GATHER_POINTS : 0,
        .shadow.clears_near = o->render.map_clears_near,
        .shadow.taps_fixed = o->render.taps_fixed,
        .shadow.filter_texels = continuous ? (uint64_t)(o->render.filter_budget * 1e6) : 0,
        .background = background_of(o->render.background),
        .tone = (enum gn_tone)o->render.tone,
        .output.msaa = o->render.msaa == GN_MSAA_AUTO ? 0 : (uint32_t)o->render.msaa,
        .debug.show_lights = o->render.show_lights,
        .debug.show_maps = o->render.show_maps,
    };
    for (int k = 0; k < 3 && f->background == GN_BACKGROUND_COLOR; k++)
        f->background_color[k] =
            gn_srgb_decode((float)((unsigned)o->render.background >> (16 - 8 * k) & 255) / 255.0f);
}

static bool casts_rays(const struct gn_frame_shadow_opts *shadow) {
    bool any = shadow->any.technique == GN_TECHNIQUE_TRUTH;
    for (uint32_t i = 0; i < shadow->light_count; i++)
        any |= shadow->lights[i].technique == GN_TECHNIQUE_TRUTH;
    return any;
}

/* Only what an environment lights diffusely: the light of a scene with lamps of its own, which is
 * as it was made, has none of it, and its start takes no time for it. */
static bool occludes(const struct gn_settings *o, const struct gn_scene *scene,
                     const struct gn_frame_environment_opts *e) {
    const uint64_t most = gn_stage_limits(o).memory_mb << 20;
    if (o->render.occlusion != GN_OCCLUSION_AUTO || scene->occlusion.size[0] == 0) return false;
    if (gn_raycast_bytes(scene) > most / 4) return false;
    return o->render.aov == GN_AOV_OCCLUSION || e->is_sky || (e->of && !e->reflected_only);
}

/* [camera]: what is not given stays as the camera has it. */
static void set_framing(struct gn_framing_opts *framing, const struct gn_camera_settings *s,
                        const double origin[3]) {
    const double values[] = {s->theta_deg, s->phi_deg, s->distance_m, s->target_m[0], s->fov_deg};
    for (int i = 0; i < 5; i++) framing->given |= isnan(values[i]) ? 0 : 1u << i;
    framing->theta_rad = glm_rad((float)s->theta_deg);
    framing->phi_rad = glm_rad((float)s->phi_deg);
    framing->distance_m = (float)s->distance_m;
    for (int k = 0; k < 3; k++) framing->target_ws[k] = (float)(s->target_m[k] - origin[k]);
    framing->yfov_rad = glm_rad((float)s->fov_deg);
    framing->phi_min_rad = glm_rad((float)s->phi_min_deg);
    framing->phi_max_rad = glm_rad((float)s->phi_max_deg);
    framing->distance_min_m = isnan(s->distance_min_m) ? 0.0f : (float)s->distance_min_m;
    framing->distance_max_m = isnan(s->distance_max_m) ? 0.0f : (float)s->distance_max_m;
}

bool gn_stage_look_build(struct gn_stage_look *look, const struct gn_settings *o,
                         const struct gn_scene *scene, struct gn_warnings *warnings,
                         struct gn_err *err) {
    const bool of_light = o->render.aov == GN_AOV_VISIBILITY || o->render.aov == GN_AOV_MAP;
    if (!choose_clips(o, scene, &look->clips, warnings, err) ||
        !choose_variant(o, scene, &look->variant, warnings, err))
        return false;
    look->run = (struct gn_pose_run){(enum gn_pose_turns)o->scene.animation_turns,
                                     o->scene.animation_speed - 1, o->scene.animation_start_ns};
    if (of_light && (o->render.light < 0 || (uint32_t)o->render.light >= scene->light_count))
        return gn_fail_usage(err, "%s %d: the scene has %u light%s, counted from 0",
                             gn_settings_label(o, render.light), o->render.light,
                             scene->light_count, scene->light_count == 1 ? "" : "s");
    set_frame_opts(&look->frame_opts, o);
    set_framing(&look->frame_opts.view.framing, &o->camera, scene->place.origin);
    /* before the lights, whose settings replace what its key gives the made one */
    if (!gn_stage_set_environment(&look->frame_opts, o, scene, err) &&
        !do_without(o, offsetof(struct gn_settings, render.environment), warnings, err))
        return false;
    if (!gn_stage_sun_start(&look->frame_opts, o, scene, warnings, err) &&
        !do_without(o, offsetof(struct gn_settings, sun.time_zone), warnings, err))
        return false;
    look->frame_opts.occlusion.on = occludes(o, scene, &look->frame_opts.environment);
    gn_stage_set_lights(&look->frame_opts.shadow, o, scene, warnings);
    struct gn_frame_environment_opts *e = &look->frame_opts.environment;
    e->shows_key = e->of && e->lights_key && gn_stage_keeps_key(&look->frame_opts.shadow, o, scene);
    if (look->frame_opts.output.msaa > 1 && casts_rays(&look->frame_opts.shadow))
        return gn_fail_usage(err, "%s %u: truth has one visibility for each pixel; use 0",
                             gn_settings_label(o, render.msaa), look->frame_opts.output.msaa);
    const struct gn_scene_limits limits = gn_stage_limits(o);
    look->frame_opts.shadow.maps_bytes = limits.maps_mb << 20;
    look->frame_opts.shadow.triangles = limits.triangles_per_frame;
    look->frame_opts.overdraw = limits.overdraw;
    if (choose_camera(o, scene, look->clips, &look->frame_opts.view, err)) return true;
    return do_without(o, offsetof(struct gn_settings, scene.camera), warnings, err);
}

bool gn_stage_take(struct gn_stage *stage, const struct gn_settings *settings,
                   struct gn_scene *scene, struct gn_warnings *warnings, struct gn_err *err) {
    *stage = (struct gn_stage){.settings = settings, .scene = scene};
    struct gn_stage_look look;
    if (!scene || !gn_stage_look_build(&look, settings, scene, warnings, err)) return false;
    stage->shown = (struct gn_view){.opts = look.frame_opts, .pose = &stage->pose};
    gn_pose_init(&stage->pose, scene, look.clips);
    gn_pose_choose_variant(&stage->pose, look.variant);
    stage->pose.at.run = look.run;
    gn_pose_step(&stage->pose, settings->scene.time_ns);
    gn_stage_aim_lights(&stage->pose, &stage->shown.opts, settings);
    return true;
}

bool gn_stage_load(struct gn_stage *stage, const struct gn_settings *settings,
                   struct gn_warnings *warnings, struct gn_err *err) {
    return gn_stage_take(stage, settings, gn_stage_scene(settings, warnings, err), warnings, err);
}

bool gn_stage_start_gl(struct gn_stage *stage, struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_settings *o = stage->settings;
    struct gn_gl_opts opts = {
        .get_proc = gn_display_get_proc,
        .display = &stage->display,
        .shaders = o->render.shaders,
        .without = o->render.without,
        .desktop = stage->display.ops->desktop,
        .stop = o->run.command == GN_COMMAND_SHOW ? gn_stop_asked : NULL,
        .prove_later = true,
        .debug = o->run.verbose,
    };
    stage->gl = gn_gl_create(&opts, warnings, err);
    return stage->gl && gn_gl_load(stage->gl, stage->scene, err);
}

void gn_stage_stop_gl(struct gn_stage *stage) {
    gn_frame_destroy(stage->shown.builder);
    gn_gl_destroy(stage->gl);
    stage->shown.builder = NULL;
    stage->gl = NULL;
}

bool gn_stage_open(struct gn_stage *stage, struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_settings *o = stage->settings;
    if (!gn_wake_display(&stage->display, o, warnings, err)) return false;
    if (!gn_stage_start_gl(stage, warnings, err)) return false;
    const struct gn_caps *caps = gn_gl_caps(stage->gl);
    int most = caps->max_texture_px;
    if (o->render.size.width_px > most || o->render.size.height_px > most)
        return gn_fail(err, "%s %dx%d: %s draws at most %dx%d", gn_settings_label(o, render.size),
                       o->render.size.width_px, o->render.size.height_px, caps->renderer, most,
                       most);
    return true;
}

/* 256 MB of samples, with colour and depth of 4 bytes each: a picture of 3840 x 2160. */
enum { MSAA_MOST_PIXELS = 8 << 20 };

uint32_t gn_stage_msaa(const struct gn_stage *stage, uint32_t width_px, uint32_t height_px,
                       bool to_file) {
    const struct gn_settings *o = stage->settings;
    const struct gn_frame_opts *f = &stage->shown.opts;
    const struct gn_caps *caps = gn_gl_caps(stage->gl);
    if (o->render.msaa != GN_MSAA_AUTO) return (uint32_t)o->render.msaa;
    const bool measured = f->output.linear || f->output.floats || casts_rays(&f->shadow);
    if (measured || !(caps->has & 1u << GN_CAP_MSAA4) || (caps->software && !to_file)) return 0;
    return (uint64_t)width_px * height_px <= MSAA_MOST_PIXELS ? 4 : 0;
}

void gn_stage_occlude(struct gn_stage *stage, struct gn_view *view) {
    const int command = stage->settings->run.command;
    if (!view->opts.occlusion.on) return;
    if (!stage->occluder)
        stage->occluder = gn_occluder_create(stage->scene); /* the kiosk's loader
                                                         made none */
    gn_occluder_give(stage->occluder, view->pose, &view->opts,
                     command != GN_COMMAND_SHOW && command != GN_COMMAND_AUTO);
}

void gn_stage_refine(struct gn_stage *stage, struct gn_view *view) {
    const int command = stage->settings->run.command;
    const double px = stage->settings->render.detail_px;
    view->opts.detail = (struct gn_frame_detail_opts){.px = isnan(px) ? 0.0f : (float)px};
    if (px == 0 || casts_rays(&view->opts.shadow)) return;
    if (!stage->detailer) stage->detailer = gn_detailer_create(stage->scene);
    view->opts.detail.of =
        gn_detailer_take(stage->detailer, command != GN_COMMAND_SHOW && command != GN_COMMAND_AUTO);
}

void gn_stage_close(struct gn_stage *stage) {
    gn_stage_stop_gl(stage);
    gn_detailer_destroy(stage->detailer);
    gn_occluder_destroy(stage->occluder);
    gn_display_close(&stage->display);
    gn_pose_finish(&stage->pose);
    gn_scene_destroy(stage->scene);
    free(stage->truth.visibility);
    *stage = (struct gn_stage){0};
}
