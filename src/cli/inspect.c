/* gnomon inspect: loads a scene, and prints what is in it, what it costs and what is wrong with it.
 */
#include "cli/inspect.h"

#include "cli/commands.h"
#include "core/terminal.h"
#include "stage/environment.h"
#include "stage/lights.h"
#include "stage/stage.h"

/* What is drawn, of which an inspection without --for takes no notice. */
static bool check_flags(const struct gn_settings *o, struct gn_err *err) {
    static const size_t fields[] = {
        offsetof(struct gn_settings, render.size),
        offsetof(struct gn_settings, render.shadow),
        offsetof(struct gn_settings, render.map_px),
        offsetof(struct gn_settings, render.taps),
        offsetof(struct gn_settings, render.msaa),
        offsetof(struct gn_settings, render.planar),
        offsetof(struct gn_settings, render.tone),
        offsetof(struct gn_settings, scene.camera),
        offsetof(struct gn_settings, scene.animation),
        offsetof(struct gn_settings, scene.no_animation),
        offsetof(struct gn_settings, render.occlusion),
        offsetof(struct gn_settings, scene.turntable_deg_s),
    };
    for (size_t i = 0; !o->run.on_gpu && i < sizeof fields / sizeof *fields; i++)
        if (gn_settings_source(o, fields[i]) == GN_SOURCE_FLAG)
            return gn_fail_usage(err, "%s: inspect needs --for GPU with it",
                                 gn_settings_label_at(o, fields[i]));
    return true;
}

static void build(struct gn_inspection *in, const struct gn_settings *o,
                  const struct gn_scene *scene, struct gn_warnings *warnings) {
    const struct gn_scene_limits limits = gn_stage_limits(o);
    const char *path = o->scene.path;
    struct gn_frame_opts look = {0};
    struct gn_err dark = {0};
    if (!gn_stage_set_environment(&look, o, scene, &dark)) gn_warn(warnings, "%s", dark.text);
    gn_stage_set_lights(&look.shadow, o, scene, warnings);
    look.shadow.triangles = limits.triangles_per_frame;
    gn_inspect_build(in, path ? path : "(default scene)", scene, &look.shadow, warnings);
    gn_scene_limits_print(&limits, in->limits, sizeof in->limits);
    in->settings = o;
    if (in->cost.map_bytes > limits.maps_mb << 20)
        gn_problem_add(&in->advice, "lower gnomon_map_px, or give fewer lights a shadow",
                       "shadow maps of %llu MB exceed the limit maps_mb=%llu: they are reduced",
                       (unsigned long long)(in->cost.map_bytes + 1048575) >> 20,
                       (unsigned long long)limits.maps_mb);
    gn_inspect_advise_bake(in, path, &limits);
}

static bool print(const struct gn_inspection *in, struct gn_warnings *warnings,
                  struct gn_err *err) {
    bool ok = true;
    struct gn_terminal terminal;
    if (in->settings->run.json) {
        ok = gn_inspect_print_json(in, stdout, err);
    } else {
        gn_inspect_print(in, gn_terminal_begin(&terminal, stdout));
        gn_terminal_end(&terminal);
    }
    *warnings = (struct gn_warnings){0}; /* they are in the report */
    return ok;
}

/* The same with the time on a board; takes the scene. */
static bool print_with_time(struct gn_inspection *in, struct gn_scene *scene,
                            struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_stage stage;
    struct gn_inspect_time time = {0};
    const struct gn_cost_gpu *gpu = &gn_cost_gpus[in->settings->run.on_gpu - 1];
    const bool ok = gn_stage_take(&stage, in->settings, scene, NULL, err) &&
                    gn_inspect_time_build(&time, &stage, gpu, NULL, err);
    in->time = &time;
    const bool printed = ok && print(in, warnings, err);
    in->time = NULL;
    gn_inspect_time_finish(&time);
    gn_stage_close(&stage);
    return printed;
}

bool gn_cli_inspect(const struct gn_options *options, struct gn_warnings *warnings,
                    struct gn_err *err) {
    const struct gn_settings *o = options->settings;
    struct gn_inspection in;
    if (!check_flags(o, err)) return false;
    struct gn_scene *scene = gn_stage_scene(o, warnings, err);
    if (!scene) return false;
    build(&in, o, scene, warnings);
    if (o->run.on_gpu) return print_with_time(&in, scene, warnings, err);
    const bool ok = print(&in, warnings, err);
    gn_scene_destroy(scene);
    return ok;
}
