/* From arguments to the first mode: shared by start and reload. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/stop.h"
#include "kiosk/private.h"
#include "options/args.h"

void gn_show_drop_options(struct gn_options *options) {
    if (options) gn_options_finish(options);
    free(options);
}

struct gn_options *gn_show_read_options(const struct gn_options *like, struct gn_warnings *warnings,
                                        struct gn_err *err) {
    struct gn_options *o = gn_xalloc(1, sizeof *o);
    if (gn_args_parse(o, like->argc, like->argv, warnings, err)) {
        gn_options_run_as(o, GN_COMMAND_SHOW); /* also for the bare command */
        return o;
    }
    gn_show_drop_options(o);
    return NULL;
}

/* With modes in the file one of them is always on. */
bool gn_show_load(struct gn_stage *stage, struct gn_options *o, struct gn_warnings *warnings,
                  struct gn_err *err) {
    if (!o->settings->mode && o->mode_count > 0) o->settings = &o->all[1];
    return gn_stage_load(stage, o->settings, warnings, err);
}

static bool is_same_path(const char *a, const char *b) { return a && strcmp(a, b) == 0; }

/* Puts the built-in scene where the settings name that path. Cameras and clips that they name there
 * are those of the lost scene. */
static void replace_scene(struct gn_options *o, const char *path) {
    for (int i = 0; i < o->all_count; i++) {
        struct gn_scene_settings *scene = &o->all[i].scene;
        if (is_same_path(scene->path, path)) scene->camera = scene->animation = NULL;
        for (int k = 0; k < scene->list.count; k++)
            if (is_same_path(scene->list.paths[k], path)) scene->list.paths[k] = NULL;
    }
}

bool gn_show_load_first(struct gn_show *s, struct gn_err *err) {
    struct gn_options *o = s->config.options;
    if (gn_show_load(&s->stage, o, s->warnings, err)) return true;
    const bool is_scene_bad = !s->stage.scene && o->settings->scene.path;
    if (!is_scene_bad || s->config.place || gn_stop_asked()) return false;
    char why[sizeof err->text];
    snprintf(why, sizeof why, "%.480s (showing the default scene)", err->text);
    *err = (struct gn_err){0};
    gn_stage_close(&s->stage);
    replace_scene(o, o->settings->scene.path);
    if (!gn_show_load(&s->stage, o, s->warnings, err)) return false;
    gn_show_report_error(s, why);
    return true;
}

bool gn_show_begin(struct gn_show *s, struct gn_err *err) {
    gn_show_list_modes(s);
    s->kiosk = (struct gn_kiosk){.shown.mode = s->modes.first, .wanted.mode = s->modes.first};
    s->scenes.shown = gn_kiosk_scene(&s->rules, &s->kiosk.shown);
    if (!gn_show_look(s, s->stage.scene, &s->looks, err)) return false;
    gn_show_enter(s);
    return true;
}
