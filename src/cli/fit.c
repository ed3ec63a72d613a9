/* gnomon fit: settings with which a board draws a scene so many times a second, chosen by the model
 * of cost/ before anybody has the board, and written for the kiosk. Nothing is drawn. */
#include "cli/fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/fit_report.h"
#include "cli/inspect_time.h"
#include "core/file.h"
#include "options/ini.h"
#include "options/value.h"
#include "stage/lights.h"
#include "stage/sun.h"

/* Given up in this order, the least visible first: by the mean difference that each makes to the
 * pictures of six scenes (src/cost/README.md); errors in penumbrae are those of
 * src/shadow/README.md. Then come shadows of lights, the weakest light first, and at last these:
 * the look that the studio gives to a scene without lights, and what gnomon is for. */
static const struct gn_fit_step first_steps[] = {
    {"taps", "12", NULL, "penumbrae have 12 samples, not 16: a little noise"},
    {"taps", "8", NULL, "penumbrae have 8 samples: more noise, error .06 there, not .04"},
    {"occlusion", "none", NULL, "corners get as much light from all sides as open surfaces"},
    {"map", "512", NULL, "shadow maps have half as many texels a side: fine shadows are lost"},
    {"shadow", "pcf", NULL, "shadows have edges one texel soft: error .23 in penumbrae, not .04"},
    {"shadow", "pcf2", NULL, "the same by one comparison, not four: edges are less smooth"},
    {"msaa", "2", NULL, "edges of things have two samples a pixel, not four"},
    {"msaa", "0", NULL, "edges of things are jagged"},
};
static const struct gn_fit_step last_steps[] = {
    {"environment", "none", NULL, "no light from a studio, and nothing mirrored in metal"},
    {"shadow", "none", NULL, "there are no shadows"},
};
enum {
    FIRST = sizeof first_steps / sizeof *first_steps,
    LAST = sizeof last_steps / sizeof *last_steps,
};
/* The best picture: what a step can take away. */
static const struct gn_fit_step best[] = {
    {.option = "shadow", .value = "cone"},
    {.option = "taps", .value = "16"},
    {.option = "msaa", .value = "4"},
};

struct search {
    struct gn_fitting *of;
    struct gn_stage stage;
    struct gn_settings now;
    struct gn_arena arena;
};

/* ---- settings ---- */

static const struct gn_option_row *row_of(const struct gn_fit_step *step) {
    return gn_option_find(step->option, strlen(step->option));
}

static bool is_given(const struct gn_settings *o, const struct gn_option_row *row) {
    return o->source[row - gn_option_rows] == GN_SOURCE_FLAG;
}

static bool put_step(struct gn_settings *o, const struct gn_fit_step *step, struct gn_arena *arena,
                     struct gn_err *err) {
    const struct gn_option_row *row = row_of(step);
    _Alignas(16) char value[sizeof(struct gn_limits)] = {0};
    if (!gn_value_parse(row, step->value, value, arena, step->option, err)) return false;
    gn_settings_put(o, row, value, GN_SOURCE_FLAG, step->option);
    return true;
}

/* Whether an artist has chosen a technique: that is kept until there is need for a cheaper one. */
static bool names_technique(const struct gn_scene *scene) {
    const uint32_t own = scene->light_count - scene->added.light;
    for (uint32_t i = 0; i < own; i++)
        if (scene->lights[i].technique) return true;
    return false;
}

static bool put_best(struct gn_fitting *f, const struct gn_scene *scene, struct gn_arena *arena,
                     struct gn_err *err) {
    for (size_t i = 0; i < sizeof best / sizeof *best; i++) {
        const bool is_technique = strcmp(best[i].option, "shadow") == 0,
                   is_taps = strcmp(best[i].option, "taps") == 0;
        if (is_given(&f->best, row_of(&best[i])) || (is_technique && names_technique(scene)) ||
            (is_taps && !gn_fit_has_taps(&f->best)))
            continue;
        if (!put_step(&f->best, &best[i], arena, err)) return false;
    }
    return true;
}

void gn_fit_settings(const struct gn_fitting *f, gn_fit_set taken, struct gn_settings *out,
                     struct gn_arena *arena) {
    *out = f->best;
    for (int i = 0; i < f->search.count; i++)
        if (taken >> i & 1 && !f->steps[i].light) put_step(out, &f->steps[i], arena, NULL);
}

/* ---- steps ---- */

static void add_step(struct gn_fitting *f, const struct gn_fit_step *step) {
    const bool is_taps = strcmp(step->option, "taps") == 0;
    if (is_given(f->given, row_of(step)) || (is_taps && !gn_fit_has_taps(&f->best)) ||
        f->search.count == GN_FIT_STEPS_MAX)
        return;
    f->steps[f->search.count++] = *step;
}

/* A name that a section of kiosk.ini can have. */
static bool can_be_section(const char *name) {
    const size_t length = strlen(name);
    bool can = length > 0 && length <= GN_INI_NAME_MAX;
    for (size_t i = 0; i < length; i++)
        can &= (unsigned char)name[i] >= ' ' && name[i] != 0x7f && !strchr("\"]", name[i]);
    return can;
}

static const char *name_of(const struct gn_scene *scene, uint32_t light) {
    const char *node = scene->nodes[scene->lights[light].node].name,
               *own = scene->lights[light].name;
    return can_be_section(node) ? node : can_be_section(own) ? own : NULL;
}

/* The shadows of lights but the strongest, from the weakest on. */
static void add_lights(struct gn_fitting *f, const struct gn_pose *pose,
                       const struct gn_plan *plan) {
    double after = -1;
    for (;;) {
        double lux = INFINITY, strongest = 0;
        const char *name = NULL;
        for (uint32_t i = 0; i < plan->shadow_count; i++) {
            const uint32_t light = plan->shadows[i].light;
            const double its =
                (double)gn_frame_illuminance(pose, light, pose->scene->lights[light].color);
            strongest = fmax(strongest, its);
            if (its <= after || its >= lux) continue;
            lux = its;
            name = name_of(pose->scene, light);
        }
        if (lux >= strongest) return;
        after = lux;
        bool twice = false;
        for (int i = 0; name && i < f->search.count; i++)
            twice |= f->steps[i].light && strcmp(f->steps[i].light, name) == 0;
        if (name && !twice && f->search.count < GN_FIT_STEPS_MAX - LAST)
            add_step(f, &(struct gn_fit_step){"shadow", "none", name, "it casts no shadow"});
    }
}

/* ---- weighing ---- */

static void leave_out_shadows(const struct gn_fitting *f, gn_fit_set taken,
                              const struct gn_scene *scene, struct gn_frame_shadow_opts *opts) {
    for (int i = 0; i < f->search.count; i++) {
        const struct gn_named_section section = {.name = f->steps[i].light};
        for (uint32_t k = 0; section.name && taken >> i & 1 && k < scene->light_count; k++) {
            struct gn_light_opts *entry =
                gn_light_section_is_of(&section, scene, k) ? gn_stage_light_entry(opts, k) : NULL;
            if (entry) GN_LIGHT_SET(entry, technique, GN_TECHNIQUE_NONE);
        }
    }
}

static bool build_time(struct search *s, gn_fit_set taken, struct gn_inspect_time *time,
                       struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_stage_look look;
    struct gn_stage *stage = &s->stage;
    gn_fit_settings(s->of, taken, &s->now, &s->arena);
    stage->settings = &s->now;
    if (!gn_stage_look_build(&look, &s->now, stage->scene, warnings, err)) return false;
    stage->shown.opts = look.frame_opts;
    leave_out_shadows(s->of, taken, stage->scene, &stage->shown.opts.shadow);
    gn_stage_aim_lights(&stage->pose, &stage->shown.opts, &s->now);
    return gn_inspect_time_build(time, stage, s->of->gpu, warnings, err);
}

/* Also while the camera moves: fingers may turn the model. */
static bool measure(void *user, gn_fit_set taken, double *ms, struct gn_err *err) {
    struct gn_inspect_time time = {0};
    const bool ok = build_time(user, taken, &time, NULL, err);
    if (ok) *ms = time.frame.cost.ms[GN_COST_EACH_FRAME] + time.frame.cost.ms[GN_COST_CAMERA_MOVES];
    gn_inspect_time_finish(&time);
    return ok;
}

static bool choose(struct search *s, struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_fitting *f = s->of;
    struct gn_inspect_time time = {0};
    const bool ok =
        put_best(f, s->stage.scene, &s->arena, err) && build_time(s, 0, &time, warnings, err);
    for (int i = 0; ok && i < FIRST; i++) add_step(f, &first_steps[i]);
    if (ok) add_lights(f, &s->stage.pose, time.frame.cost.plan);
    for (int i = 0; ok && i < LAST; i++) add_step(f, &last_steps[i]);
    gn_inspect_time_finish(&time);
    f->search.measure = measure;
    f->search.user = s;
    return ok && gn_fit_search(&f->search, err);
}

/* ---- the command ---- */

static bool fail_goal(const struct gn_fitting *f, struct gn_err *err) {
    const struct gn_size *px = &f->given->render.size;
    const double share = sqrt(f->search.goal_ms / f->search.ms);
    const int width_px = (int)(share * px->width_px), height_px = (int)(share * px->height_px);
    return gn_fail(err,
                   "%s reaches at most %.0f of %g frames a second at %dx%d, whatever is given up: "
                   "try --size %dx%d, a lower --fps, or gnomon bake --simplify",
                   f->gpu->name, floor(1000 / f->search.ms), f->given->run.fps, px->width_px,
                   px->height_px, width_px > 0 ? width_px : 1, height_px > 0 ? height_px : 1);
}

static bool fit(struct search *s, struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_fitting *f = s->of;
    const struct gn_settings *o = f->given;
    if (!gn_stage_load(&s->stage, o, warnings, err) || !choose(s, warnings, err)) return false;
    gn_fit_settings(f, f->search.taken, &s->now, &s->arena);
    char *ini = gn_fit_write(f, &s->now, err);
    const bool ok = ini && gn_fit_print(f, ini, stdout, err) &&
                    (f->search.is_met || fail_goal(f, err)) &&
                    (!o->run.out || gn_file_write(o->run.out, ini, strlen(ini), err));
    free(ini);
    return ok;
}

bool gn_cli_fit(const struct gn_options *options, struct gn_warnings *warnings,
                struct gn_err *err) {
    const struct gn_settings *o = options->settings;
    if (!o->run.on_gpu)
        return gn_fail_usage(err, "fit needs --for GPU: gnomon help fit lists them");
    if (!gn_fit_may_write(o->run.out, err)) return false;
    struct gn_fitting f = {.given = o, .best = *o, .gpu = &gn_cost_gpus[o->run.on_gpu - 1]};
    struct search s = {.of = &f};
    f.search.goal_ms = 1000 / o->run.fps;
    const bool ok = fit(&s, warnings, err);
    gn_stage_close(&s.stage);
    gn_arena_finish(&s.arena);
    return ok;
}
