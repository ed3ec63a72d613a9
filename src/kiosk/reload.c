/* Reload (SIGHUP, ctl): all options are read again. If that or the scene fails the kiosk keeps the
 * last good configuration and its picture. */
#include <stdio.h>
#include <string.h>

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
    if (!gn_show_open_loader(s, err) || !gn_show_begin(s, err) ||
        (!keeps_display && !gn_show_open_display(s, err)))
        return false;
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

bool gn_show_reload(struct gn_show *s, struct gn_err *err) {
    struct gn_err why = {0};
    struct gn_stage fresh = {0};
    s->reloads = false;

    /* read the options; an error in the file is one of the reload */
    struct gn_options *options = gn_show_read_options(s->config.options, NULL, &why);
    if (options && options->config_error) {
        gn_fail_usage(&why, "%s", options->config_error);
        gn_show_drop_options(options);
        options = NULL;
    }

    /* stay in the mode of the same name */
    if (options && (s->kiosk.wanted.mode != s->modes.base || options->mode_count > 0)) {
        const int found = gn_options_find_mode(options, s->modes.names[s->kiosk.wanted.mode]);
        if (found) options->settings = &options->all[found];
    }
    if (options && gn_show_load(&fresh, options, s->warnings, &why)) {
        const bool ok = take_stage(s, &fresh, options, err);
        gn_show_answer_reload(s, ok ? NULL : err);
        return ok;
    }

    /* it failed: the last good configuration stays, and the screen shows the error */
    gn_show_answer_reload(s, &why);
    snprintf(s->config.error, sizeof s->config.error, "%s", why.text);
    s->config.options->config_error = s->config.error;
    s->changed = true;
    char text[sizeof why.text + 32];
    snprintf(text, sizeof text, "%s (not reloaded)", why.text);
    gn_show_report_problem(s, text);
    gn_stage_close(&fresh);
    gn_show_drop_options(options);
    return true;
}
