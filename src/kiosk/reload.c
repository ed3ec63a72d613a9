/* Reload (SIGHUP, ctl): all options are read again, and a thread loads the scene while frames go
 * on. If either fails the kiosk keeps the last good configuration and its picture. The first load
 * is one, too, once it takes over a second: until then a black stage is the last good one. */
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/private.h"

/* Replaces stage and options; the display stays open if its settings are the same. */
static bool take_stage(struct gn_show *s, struct gn_stage *fresh, struct gn_options *options,
                       struct gn_err *err) {
    const bool keeps_display = gn_show_same_screen(s->stage.settings, options->settings);
    gn_show_drop_staged(s);
    gn_show_stop_gl(s);
    if (keeps_display) {
        fresh->display = s->stage.display;
        s->stage.display = (struct gn_display){0};
    }
    gn_stage_close(&s->stage);
    gn_input_close(s->buttons.input); /* it points to names in the options */
    s->buttons.input = NULL;
    gn_changes_destroy(s->config.changes);
    s->config.changes = NULL;
    gn_show_drop_options(s->config.options);
    s->stage = *fresh;
    s->config.options = options;
    s->context.generation = 0;
    const bool blanked = s->kiosk.blanked;
    if (!gn_show_begin(s, err) || (!keeps_display && !gn_show_open_display(s, err))) return false;
    gn_show_open_captions(s);
    struct gn_err why = {0};
    if (!gn_show_open_input(s, &why))
        gn_show_report_problem(s, why.text); /* not fatal: the kiosk runs without buttons */
    s->kiosk.blanked = blanked;
    if (!s->stage.settings->run.verbose) return true;
    printf("reloaded, mode %s\n", s->modes.names[s->kiosk.shown.mode]);
    fflush(stdout);
    return true;
}

/* ---- failure -------------------------------------------------------------------------------- */

void gn_show_drop_reload(struct gn_show *s) {
    gn_show_drop_options(s->reload.options);
    gn_loaded_destroy(s->reload.loaded);
    if (gn_loader_number(s->scenes.loader) == GN_SHOW_RELOAD) gn_loader_cancel(s->scenes.loader);
    s->reload = (struct gn_show_reload){0};
}

/* The last good configuration stays, and the screen shows the error. */
static void keep_old(struct gn_show *s, const struct gn_err *why) {
    gn_show_drop_reload(s);
    gn_show_answer_reload(s, why);
    snprintf(s->config.error, sizeof s->config.error, "%s", why->text);
    s->config.options->config_error = s->config.error;
    s->changed = true;
    char text[sizeof why->text + 32];
    snprintf(text, sizeof text, "%s (not reloaded)", why->text);
    gn_show_report_problem(s, text);
}

/* ---- the steps ------------------------------------------------------------------------------ */

/* Stays in the mode of the same name. */
static void choose_mode(const struct gn_show *s, struct gn_options *options) {
    if (s->kiosk.wanted.mode == s->modes.base && options->mode_count == 0) return;
    const int found = gn_options_find_mode(options, s->modes.names[s->kiosk.wanted.mode]);
    if (found) options->settings = &options->all[found];
}

void gn_show_reload(struct gn_show *s) {
    struct gn_err why = {0};
    s->reloads = false;
    if (s->reload.first) return; /* the first load goes on */
    struct gn_options *options = gn_show_read_options(s->config.options, NULL, &why);
    if (options && !options->config_error) {
        gn_show_drop_reload(s);
        gn_loader_cancel(s->scenes.loader); /* the list of scenes may change */
        choose_mode(s, options);
        s->reload.options = options;
        return;
    }
    if (options) gn_fail_usage(&why, "%s", options->config_error);
    gn_show_drop_options(options);
    keep_old(s, &why);
}

/* The mode may have changed while the scene loaded. */
static void choose_mode_again(const struct gn_show *s, struct gn_options *options) {
    const struct gn_settings *before = options->settings;
    const char *loaded = before->scene.path;
    choose_mode(s, options);
    const char *path = options->settings->scene.path;
    if (path != loaded && !(path && loaded && strcmp(path, loaded) == 0))
        options->settings = before;
}

/* The scene that was loaded, with its options in the place of the old ones. */
static bool finish_reload(struct gn_show *s, struct gn_err *err) {
    struct gn_show_reload *r = &s->reload;
    const bool first = r->first;
    struct gn_options *options = r->options;
    struct gn_err why = r->loaded->err;
    struct gn_scene *scene = r->loaded->scene;
    struct gn_stage fresh = {0};
    char missing[GN_SHOW_WHY] = "";
    r->loaded->scene = NULL;
    bool ok;
    if (first) {
        ok = gn_show_take_first(s, &fresh, options, scene, missing, &why);
    } else {
        choose_mode_again(s, options);
        if (!scene) gn_stage_name_source(options->settings, &why);
        ok = gn_stage_take(&fresh, options->settings, scene, s->warnings, &why);
    }
    if (!ok) {
        gn_stage_close(&fresh);
        if (!first) keep_old(s, &why);
        if (first) *err = why;
        return !first;
    }
    r->options = NULL;
    gn_show_drop_reload(s);
    ok = take_stage(s, &fresh, options, err);
    if (ok && first) s->counts.frames = 0;
    if (ok && missing[0]) gn_show_report_error(s, missing);
    gn_show_answer_reload(s, ok ? NULL : err);
    return ok;
}

bool gn_show_step_reload(struct gn_show *s, struct gn_err *err) {
    struct gn_err why = {0};
    if (!s->reload.options) return true;
    if (s->reload.loaded) return finish_reload(s, err);
    if (gn_loader_is_busy(s->scenes.loader)) return true;
    const struct gn_settings *o = s->reload.options->settings;
    if (!gn_show_start_load(s, GN_SHOW_RELOAD, o->scene.path, o, &why)) keep_old(s, &why);
    return true;
}

bool gn_show_load_first(struct gn_show *s, struct gn_err *err) {
    const struct gn_settings *o = s->config.options->settings;
    const int64_t until_ns = gn_loop_now_ns(s->loop) + GN_NS_PER_S;
    if (!gn_show_start_load(s, GN_SHOW_RELOAD, o->scene.path, o, err)) return false;
    while (!s->reload.loaded && !s->ends && gn_loop_now_ns(s->loop) < until_ns)
        gn_loop_step(s->loop, until_ns);
    if (s->ends) return false;
    if (!s->reload.loaded) return gn_show_load_nothing(s, err);
    char missing[GN_SHOW_WHY];
    struct gn_loaded *loaded = s->reload.loaded;
    *err = loaded->err;
    const bool ok =
        gn_show_take_first(s, &s->stage, s->config.options, loaded->scene, missing, err);
    loaded->scene = NULL;
    gn_show_drop_reload(s);
    if (ok && missing[0]) gn_show_report_error(s, missing);
    return ok;
}
