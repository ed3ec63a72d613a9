/* gnomon inspect: loads a scene, and prints what is in it, what it costs and what is wrong with it.
 */
#include "cli/inspect.h"

#include "cli/commands.h"
#include "stage/stage.h"

bool gn_cli_inspect(const struct gn_options *options, struct gn_warnings *warnings,
                    struct gn_err *err) {
    struct gn_scene *scene = gn_stage_scene(options->settings, warnings, err);
    if (!scene) return false;
    struct gn_inspection in;
    bool ok = true;
    const char *path = options->settings->scene.path;
    gn_inspect_build(&in, path ? path : "(default scene)", scene, warnings);
    if (options->settings->run.json)
        ok = gn_inspect_print_json(&in, stdout, err);
    else
        gn_inspect_print(&in, stdout);
    *warnings = (struct gn_warnings){0}; /* they are in the report */
    gn_scene_destroy(scene);
    return ok;
}
