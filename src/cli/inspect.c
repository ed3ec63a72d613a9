/* gnomon inspect: loads a scene, and prints what is in it, what it costs and what is wrong with it.
 */
#include "cli/inspect.h"

#include "cli/commands.h"
#include "stage/environment.h"
#include "stage/lights.h"
#include "stage/stage.h"

bool gn_cli_inspect(const struct gn_options *options, struct gn_warnings *warnings,
                    struct gn_err *err) {
    struct gn_scene *scene = gn_stage_scene(options->settings, warnings, err);
    if (!scene) return false;
    const struct gn_scene_limits limits = gn_stage_limits(options->settings);
    struct gn_inspection in;
    struct gn_frame_opts look = {0};
    struct gn_err dark = {0};
    if (!gn_stage_set_environment(&look, options->settings, scene, &dark))
        gn_warn(warnings, "%s", dark.text);
    gn_stage_set_lights(&look.shadow, options->settings, scene, warnings);
    look.shadow.triangles = limits.triangles_per_frame;
    bool ok = true;
    const char *path = options->settings->scene.path;
    gn_inspect_build(&in, path ? path : "(default scene)", scene, &look.shadow, warnings);
    gn_scene_limits_print(&limits, in.limits, sizeof in.limits);
    in.settings = options->settings;
    if (in.cost.map_bytes > limits.maps_mb << 20)
        gn_problem_add(&in.advice, "lower gnomon_map_px, or give fewer lights a shadow",
                       "shadow maps of %llu MB exceed the limit maps_mb=%llu: they are reduced",
                       (unsigned long long)(in.cost.map_bytes + 1048575) >> 20,
                       (unsigned long long)limits.maps_mb);
    gn_inspect_advise_bake(&in, path, &limits);
    if (options->settings->run.json)
        ok = gn_inspect_print_json(&in, stdout, err);
    else
        gn_inspect_print(&in, stdout);
    *warnings = (struct gn_warnings){0}; /* they are in the report */
    gn_scene_destroy(scene);
    return ok;
}
