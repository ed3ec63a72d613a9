/* Actions as events of the machine. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/text.h"
#include "kiosk/private.h"
#include "stage/sun.h"

void gn_show_report_error(struct gn_show *s, enum gn_problem kind, const char *text) {
    gn_problem_report(&s->problems, kind, text);
    if (s->config.options->config_error) return; /* the first one is likely the cause */
    snprintf(s->config.error, sizeof s->config.error, "%s", text);
    s->config.options->config_error = s->config.error;
    s->config.kind = kind;
    s->config.shown[0] = '\0';
    s->screen.changed = true;
}

void gn_show_cure_error(struct gn_show *s, enum gn_problem kind) {
    const char *shown = s->config.options->config_error;
    if (shown && strcmp(shown, s->problems.of[kind]) == 0) s->config.options->config_error = NULL;
    gn_problem_cure(&s->problems, kind);
    s->screen.changed = true;
}

void gn_show_send(struct gn_show_screen *s, struct gn_kiosk_event event) {
    if (event.time_ns == 0) event.time_ns = gn_loop_now_ns(s->show->loop);
    s->kiosk = gn_kiosk_step(&s->rules, &s->kiosk, &event);
}

void gn_show_note(struct gn_show_screen *s, const char *format, ...) {
    va_list args;
    va_start(args, format);
    gn_text_vformat(s->viewer.note, sizeof s->viewer.note, format, args);
    va_end(args);
    s->viewer.note_ns = 0;
    gn_show_send(s,
                 (struct gn_kiosk_event){.kind = GN_KIOSK_NOTE, .caption = GN_KIOSK_CAPTION_NOTE});
    s->changed = true;
}

/* Of play: the clip in the scene that is shown; -1: none of that name. */
static int find_clip(const struct gn_show_screen *s, const struct gn_action *action) {
    struct gn_err err = {0};
    return action->kind == GN_ACTION_PLAY && s->stage.scene
               ? gn_scene_find_clip(s->stage.scene, action->name, &err)
               : -1;
}

bool gn_show_check_action(const struct gn_show_screen *s, const struct gn_action *action,
                          struct gn_err *err) {
    if (action->kind == GN_ACTION_PLAY && s->stage.scene)
        return gn_scene_find_clip(s->stage.scene, action->name, err) >= 0;
    int64_t step_s;
    if (action->kind == GN_ACTION_SUN)
        return gn_sun_step_parse(action->name, &step_s, err) &&
               (gn_stage_sun_moves(s->stage.settings) ||
                gn_fail(err, "there is no sun whose time could be moved: [sun] has no latitude and "
                             "longitude, or the clock is not set"));
    if (action->kind != GN_ACTION_MODE || gn_show_find_mode(&s->show->modes, action->name) >= 0)
        return true;
    char names[400] = "";
    for (int i = 0; i < s->show->modes.count; i++)
        gn_text_add(names, sizeof names, "%s \"%s\"", i ? "," : "", s->show->modes.names[i]);
    return gn_fail_usage(err, "no mode \"%.60s\"; expected%s", action->name, names);
}

void gn_show_act(struct gn_show_screen *s, const struct gn_action *action, int64_t time_ns) {
    const int clip = find_clip(s, action);
    struct gn_err err = {0};
    int64_t sun_s = 0;
    if (action->kind == GN_ACTION_SUN) gn_sun_step_parse(action->name, &sun_s, &err);
    const struct gn_kiosk_event event = {
        .kind = GN_KIOSK_ACTION,
        .time_ns = time_ns,
        .action = action->kind,
        .turn = action->turn,
        .pressed = action->pressed,
        .mode = gn_show_find_mode(&s->show->modes, action->name),
        .clip = clip,
        .sun_s = sun_s,
        .clip_ns = clip < 0 ? 0 : s->stage.scene->animation.clips[clip].duration_ns};
    if (!gn_show_check_action(s, action, &err))
        gn_problem_report(&s->show->problems, GN_PROBLEM_ACTION, err.text);
    else if (action->name)
        gn_problem_cure(&s->show->problems, GN_PROBLEM_ACTION);
    gn_show_send(s, event);
}
