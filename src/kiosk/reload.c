/* Reload (SIGHUP, ctl, a file that changed): all options are read again, a thread loads the scene,
 * and work ahead puts it on the GPU, while frames go on. Until take_reload() a failure keeps the
 * last good configuration and its picture. A failure in it is the client's answer and ends the
 * kiosk; one of GL after it, when the client was told ok, is shown as a text (screen.c). The first
 * load is one, too, once it takes over a second: until then a black stage is the last good one. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/private.h"

/* The context stays, with the programs that were made in it. Not with a folder of shaders, whose
 * files may have changed, nor when the GPU has no room for two scenes: then the old one is freed
 * first, and the picture stands still until the new one is uploaded. */
static bool keeps_gl(const struct gn_show *s, const struct gn_show_reload *r) {
    const struct gn_settings *now = s->screen.stage.settings, *fresh = r->options->settings;
    return s->screen.stage.gl && !r->alone && !now->render.shaders && !fresh->render.shaders &&
           gn_show_same_screen(now, fresh);
}

/* Replaces the scene by the staged one, and the options; the display stays open if its settings
 * are the same. */
static bool take_reload(struct gn_show *s, const struct gn_show_reload *r, struct gn_err *err) {
    struct gn_options *options = r->options;
    struct gn_show_screen *screen = &s->screen;
    const bool keeps_display = gn_show_same_screen(screen->stage.settings, options->settings);
    if (!keeps_gl(s, r)) {
        gn_show_stop_gl(screen);
        screen->context.generation = 0;
    }
    if (!keeps_display) gn_display_close(&screen->stage.display);
    gn_show_take_staged(screen);
    screen->fade.prepared = false;
    gn_input_close(s->buttons.input); /* it points to names in the options */
    s->buttons.input = NULL;
    gn_changes_destroy(s->config.changes);
    s->config.changes = NULL;
    if (r->cause == GN_RELOAD_FILE || r->cause == GN_RELOAD_DROP) {
        const char *past = s->config.file ? s->config.file : "";
        snprintf(s->config.past, sizeof s->config.past, "%s", past);
        s->config.has_past = true;
    }
    gn_show_drop_options(s->config.options);
    s->config.options = options;
    s->config.file = r->file;
    if (!r->first) s->first.lost[0] = '\0';
    s->config.waits = false;
    screen->stage.settings = options->settings;
    screen->stage.shown.opts.view.orbit = (struct gn_orbit){0};
    const struct gn_kiosk before = screen->kiosk;
    const bool begun = gn_show_begin(s, r->scene, err);
    for (int i = GN_PROBLEM_CONFIG; i <= GN_PROBLEM_SCENE; i++) gn_problem_cure(&s->problems, i);
    if (!begun || (!keeps_display && !gn_show_open_display(screen, err))) return false;
    gn_show_open_captions(screen);
    struct gn_err why = {0};
    if (!gn_show_open_input(s, &why))
        gn_problem_report(&s->problems, GN_PROBLEM_INPUT,
                          why.text); /* not fatal: the kiosk runs without buttons */
    screen->kiosk.blanked = before.blanked;
    screen->kiosk.asleep = before.asleep;
    screen->kiosk.woken = before.woken;
    screen->kiosk.used_ns = before.used_ns;
    gn_parts_reopen(&s->parts);
    if (!screen->stage.settings->run.verbose) return true;
    printf("reloaded, mode %s\n", s->modes.names[screen->kiosk.shown.mode]);
    fflush(stdout);
    return true;
}

/* ---- failure -------------------------------------------------------------------------------- */

void gn_show_drop_reload(struct gn_show *s) {
    gn_show_drop_options(s->reload.options);
    gn_loaded_drop(s->reload.loaded);
    if (gn_show_reload_is_staged(&s->screen)) gn_show_drop_staged(&s->screen);
    if (gn_loader_number(s->scenes.loader) == GN_SHOW_RELOAD) gn_loader_cancel(s->scenes.loader);
    s->reload = (struct gn_show_reload){0};
}

static enum gn_problem kind_of(const struct gn_err *why) {
    return why->status == GN_EXIT_USAGE ? GN_PROBLEM_CONFIG : GN_PROBLEM_FIRST;
}

/* The last good configuration stays. The error is shown on the screen, but one of ctl's file is the
 * client's alone. */
static void keep_old(struct gn_show *s, enum gn_reload_cause cause, const struct gn_err *why) {
    gn_show_drop_reload(s); /* trial.c sees that */
    gn_show_answer_reload(s, why);
    if (cause == GN_RELOAD_FILE) return;
    gn_parts_loaded(&s->parts, GN_PART_LOAD_FAILED);
    if (cause != GN_RELOAD_ASKED) {
        gn_problem_report_again(&s->problems, kind_of(why), why->text);
        gn_show_send(&s->screen, (struct gn_kiosk_event){.kind = GN_KIOSK_NOTE,
                                                         .caption = GN_KIOSK_CAPTION_PROBLEM});
        s->screen.changed = true;
        return;
    }
    snprintf(s->config.error, sizeof s->config.error, "%s", why->text);
    s->config.options->config_error = s->config.error;
    s->config.kind = kind_of(why);
    snprintf(s->config.shown, sizeof s->config.shown, "%s", why->shown);
    s->screen.changed = true;
    char text[sizeof why->text + 32];
    snprintf(text, sizeof text, "%s (not reloaded)", why->text);
    gn_problem_report_again(&s->problems, s->config.kind, text);
}

/* ---- the steps ------------------------------------------------------------------------------ */

/* Stays in the mode of the same name. */
static void choose_mode(const struct gn_show *s, struct gn_options *options) {
    const char *name = s->modes.names[s->screen.kiosk.wanted.mode];
    if (gn_show_offers(s, options)) {
        if (!options->resumes || strcmp(options->resumes, name) != 0)
            options->resumes = gn_arena_strdup(&options->arena, name);
        return;
    }
    if (s->screen.kiosk.wanted.mode == s->modes.base && options->mode_count == 0) return;
    const int found = gn_options_find_mode(options, name);
    if (found) options->settings = &options->all[found];
}

/* A changed file is shown where it was in the list. */
static int same_scene(const struct gn_show *s, const struct gn_options *options) {
    const struct gn_scene_list *list = &options->all[0].scene.list;
    const int at = s->screen.kiosk.wanted.scene;
    if (at >= list->count || at >= s->scenes.listed) return 0;
    const char *before = s->scenes.paths[at], *now = list->paths[at];
    return before && now && strcmp(before, now) == 0 ? at : 0;
}

/* The mode's own, or that one of the list. */
static const char *scene_path(const struct gn_settings *o, int scene) {
    const bool of_mode = gn_settings_from(o, scene.path) == GN_SOURCE_MODE;
    return scene > 0 && !of_mode ? o->scene.list.paths[scene] : o->scene.path;
}

/* file: as in gn_show_config. */
static void begin_reload(struct gn_show *s, enum gn_reload_cause cause, const char *file) {
    struct gn_err why = {0};
    struct gn_options *options = gn_show_read_options(s->config.options, NULL, &why);
    if (options && !options->config_error) {
        const char *own = file ? gn_show_put_file(options, file) : NULL;
        gn_show_drop_reload(s);
        gn_loader_cancel(s->scenes.loader); /* the list of scenes may change */
        choose_mode(s, options);
        s->reload.options = options;
        s->reload.file = own;
        s->reload.cause = cause;
        if (cause == GN_RELOAD_SEEN && !own) s->reload.scene = same_scene(s, options);
        return;
    }
    if (options) {
        gn_fail_usage(&why, "%s", options->config_error);
        if (options->config_shown)
            snprintf(why.shown, sizeof why.shown, "%s", options->config_shown);
    }
    gn_show_drop_options(options);
    /* what is wrong with kiosk.ini stays on the screen, whoever found it: a change that is seen
     * counts as a reload that was asked for */
    keep_old(s, cause == GN_RELOAD_SEEN ? GN_RELOAD_ASKED : cause, &why);
}

/* The first scene is loaded before any other, since there is nothing to go back to. */
void gn_show_reload(struct gn_show *s) {
    if (!s->wants_reload || s->reload.first) return;
    struct gn_show_wish *wish = &s->wish;
    const char *file = wish->file[0] ? wish->file : NULL;
    s->wants_reload = false;
    begin_reload(s, wish->cause, wish->cause == GN_RELOAD_ASKED ? s->config.file : file);
    wish->cause = GN_RELOAD_ASKED;
}

/* New content also replaces the scene of ctl scene. A reload that was asked for comes first. */
bool gn_show_renew(struct gn_show *s, bool turned) {
    if (s->reload.first || s->wants_reload) return false;
    begin_reload(s, GN_RELOAD_SEEN, turned ? NULL : s->config.file);
    return true;
}

void gn_show_scene_files(const struct gn_show *s, const char *out_paths[3]) {
    const struct gn_show_scenes *scenes = &s->scenes;
    const int failed = s->problems.of[GN_PROBLEM_SCENE][0] ? s->problems.scene : INT_MAX;
    out_paths[0] = scenes->count > 0 ? scenes->paths[s->screen.scene] : NULL;
    out_paths[1] = s->config.asked;
    out_paths[2] = failed < scenes->count ? scenes->paths[failed] : NULL;
}

void gn_show_load_file(struct gn_show *s, const char *path) {
    s->wants_reload = true;
    s->wish.cause = GN_RELOAD_DROP;
    snprintf(s->wish.file, sizeof s->wish.file, "%s", path);
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

/* How the scene is drawn in the mode that it will be shown in. */
static bool look_at_loaded(struct gn_show *s, struct gn_stage_look *look, struct gn_err *why) {
    struct gn_show_reload *r = &s->reload;
    if (r->first) return gn_show_look_at_first(s, r->options, r->loaded, look, r->why, why);
    choose_mode_again(s, r->options);
    if (r->loaded->scene)
        return gn_stage_look_build(look, r->options->settings, r->loaded->scene, s->warnings, why);
    *why = r->loaded->err;
    gn_stage_name_source(r->options->settings, why);
    return false;
}

/* The mode may change while the scene is uploaded, too. */
static bool look_again(struct gn_show *s, struct gn_err *why) {
    struct gn_options *options = s->reload.options;
    const struct gn_settings *before = options->settings;
    struct gn_stage_look look;
    if (s->reload.first) return true;
    choose_mode_again(s, options);
    if (options->settings == before) return true;
    if (!gn_stage_look_build(&look, options->settings, s->screen.staged.loaded->scene, s->warnings,
                             why))
        return false;
    gn_show_stage_reload(&s->screen, &look);
    return true;
}

/* Shows the staged scene once it is complete, with its options in the place of the old ones. */
static bool finish_reload(struct gn_show *s, struct gn_err *err) {
    struct gn_show_reload *r = &s->reload;
    struct gn_err why = {0};
    if (!look_again(s, &why)) {
        keep_old(s, r->cause, &why);
        return true;
    }
    if (keeps_gl(s, r) && !gn_show_reload_is_ready(&s->screen)) return true;
    const struct gn_show_reload taken = *r;
    *r = (struct gn_show_reload){0};
    const bool ok = take_reload(s, &taken, err);
    if (ok && taken.first) s->counts.frames = 0;
    if (ok && taken.why[0]) gn_show_report_error(s, GN_PROBLEM_FIRST, taken.why);
    gn_show_answer_reload(s, ok ? NULL : err);
    gn_parts_loaded(&s->parts, GN_PART_LOAD_OPTIONS);
    return ok;
}

bool gn_show_step_reload(struct gn_show *s, struct gn_err *err) {
    struct gn_show_reload *r = &s->reload;
    struct gn_stage_look look;
    struct gn_err why = {0};
    if (!r->options) return true;
    if (r->first && r->loaded && gn_show_try_other(s, &r->options, r->loaded)) {
        gn_loaded_drop(r->loaded);
        r->loaded = NULL;
        r->file = s->config.file;
        r->scene = s->first.scene;
    }
    if (r->loaded) {
        if (look_at_loaded(s, &look, &why)) {
            gn_show_stage_reload(&s->screen, &look);
        } else if (r->first) {
            *err = why;
            return false;
        } else {
            keep_old(s, r->cause, &why);
            return true;
        }
    }
    if (gn_show_reload_is_staged(&s->screen)) return finish_reload(s, err);
    if (gn_loader_is_busy(s->scenes.loader)) return true;
    const char *path = scene_path(r->options->settings, r->scene);
    if (r->cause != GN_RELOAD_FILE && r->cause != GN_RELOAD_DROP && !(r->first && s->first.lost[0]))
        snprintf(s->config.asked, sizeof s->config.asked, "%s", path ? path : "");
    gn_show_start_load(s, GN_SHOW_RELOAD, path, r->options->settings);
    return true;
}

/* A window is on the screen within a fifth of a second. */
static const int64_t WINDOW_NS = 30 * GN_NS_PER_S / 1000;

bool gn_show_load_first(struct gn_show *s, struct gn_err *err) {
    const struct gn_settings *o = s->config.options->settings;
    const char *backend = s->config.place ? s->config.place->backend : o->display.backend;
    const int64_t until_ns =
        gn_loop_now_ns(s->loop) + (strcmp(backend, "window") == 0 ? WINDOW_NS : GN_NS_PER_S);
    snprintf(s->config.asked, sizeof s->config.asked, "%s", o->scene.path ? o->scene.path : "");
    gn_parts_loaded(&s->parts, GN_PART_LOAD_OPTIONS);
    do {
        gn_loaded_drop(s->reload.loaded);
        s->reload.loaded = NULL;
        o = s->config.options->settings;
        gn_show_start_load(s, GN_SHOW_RELOAD, scene_path(o, s->first.scene), o);
        while (!s->reload.loaded && !s->ends && gn_loop_now_ns(s->loop) < until_ns)
            gn_loop_step(s->loop, until_ns);
        if (s->ends) return false;
        if (!s->reload.loaded) return gn_show_load_nothing(s, err);
    } while (gn_show_try_other(s, &s->config.options, s->reload.loaded));
    struct gn_loaded *loaded = s->reload.loaded;
    struct gn_stage_look look;
    char missing[GN_SHOW_WHY];
    const bool ok = gn_show_look_at_first(s, s->config.options, loaded, &look, missing, err);
    s->screen.stage = (struct gn_stage){.settings = s->config.options->settings,
                                        .scene = loaded->scene,
                                        .pose = loaded->pose,
                                        .occluder = loaded->occluder,
                                        .detailer = loaded->detailer,
                                        .shown.pose = &s->screen.stage.pose};
    loaded->scene = NULL;
    loaded->pose = (struct gn_pose){0};
    loaded->occluder = NULL;
    loaded->detailer = NULL;
    gn_show_drop_reload(s);
    if (ok && missing[0]) gn_show_report_error(s, GN_PROBLEM_FIRST, missing);
    return ok;
}
