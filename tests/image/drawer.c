#include "image/drawer.h"

#include <stdlib.h>

#include "core/arena.h"
#include "options/args.h"
#include "stage/stage.h"

struct gn_drawer {
    const char *scene;
    int64_t time_ns;
    struct gn_stage stage;
    struct gn_options options; /* of the last picture; zeroed: none yet */
};

struct gn_drawer *gn_drawer_create(const char *scene) {
    struct gn_drawer *drawer = gn_xalloc(1, sizeof *drawer);
    *drawer = (struct gn_drawer){.scene = scene};
    return drawer;
}

void gn_drawer_set_time(struct gn_drawer *drawer, int64_t time_ns) { drawer->time_ns = time_ns; }

const struct gn_pose *gn_drawer_pose(const struct gn_drawer *drawer) { return &drawer->stage.pose; }

static bool look(struct gn_drawer *drawer, const struct gn_settings *settings, struct gn_err *err) {
    struct gn_stage_look look;
    if (!drawer->stage.gl) {
        const bool ok = gn_stage_load(&drawer->stage, settings, NULL, err) &&
                        gn_stage_open(&drawer->stage, NULL, err);
        if (!ok) gn_stage_close(&drawer->stage);
        return ok;
    }
    if (!gn_stage_look_build(&look, settings, drawer->stage.scene, NULL, err)) return false;
    drawer->stage.shown.opts = look.frame_opts;
    return true;
}

bool gn_drawer_draw(struct gn_drawer *drawer, const char *const args[], float *rgba,
                    struct gn_err *err) {
    const char *argv[40] = {"gnomon", "render", drawer->scene, "-o", "none.pfm"};
    struct gn_options options;
    int argc = 5;
    while (*args && argc < 38) argv[argc++] = *args++;
    argv[argc++] = "--environment"; /* as in gn_shot() */
    argv[argc++] = "none";
    bool ok = gn_args_parse(&options, argc, (char *const *)(uintptr_t)argv, NULL, err);
    ok = ok && look(drawer, options.settings, err);
    drawer->stage.settings = options.settings;
    gn_options_finish(&drawer->options);
    drawer->options = options;
    return ok && gn_view_draw(&drawer->stage.shown, &drawer->stage, drawer->time_ns, NULL, err) &&
           gn_gl_read_f32(drawer->stage.gl, rgba, err);
}

void gn_drawer_destroy(struct gn_drawer *drawer) {
    gn_stage_close(&drawer->stage);
    gn_options_finish(&drawer->options);
    free(drawer);
}
