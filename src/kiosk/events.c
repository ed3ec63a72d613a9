/* Actions as events of the machine; problems. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/text.h"
#include "kiosk/private.h"

void gn_show_report_problem(struct gn_show *s, const char *text) {
    if (strcmp(s->text.problem, text) == 0) return;
    snprintf(s->text.problem, sizeof s->text.problem, "%s", text);
    fprintf(stderr, "gnomon: warning: %s\n", text);
}

void gn_show_report_error(struct gn_show *s, const char *text) {
    gn_show_report_problem(s, text);
    if (s->config.options->config_error) return; /* the first one is likely the cause */
    snprintf(s->config.error, sizeof s->config.error, "%s", text);
    s->config.options->config_error = s->config.error;
    s->changed = true;
}

void gn_show_note(struct gn_show *s, const char *format, ...) {
    const struct gn_kiosk_event note = {.kind = GN_KIOSK_NOTE,
                                        .time_ns = gn_loop_now_ns(s->loop),
                                        .caption = GN_KIOSK_CAPTION_NOTE};
    va_list args;
    va_start(args, format);
    gn_text_vformat(s->viewer.note, sizeof s->viewer.note, format, args);
    va_end(args);
    s->kiosk = gn_kiosk_step(&s->rules, &s->kiosk, &note);
    s->changed = true;
}

void gn_show_act(struct gn_show *s, const struct gn_action *action, int64_t time_ns) {
    const struct gn_kiosk_event event = {.kind = GN_KIOSK_ACTION,
                                         .time_ns = time_ns,
                                         .action = action->kind,
                                         .mode = gn_show_find_mode(&s->modes, action->name)};
    if (action->kind == GN_ACTION_MODE && event.mode < 0) {
        char text[100];
        snprintf(text, sizeof text, "there is no mode \"%.60s\"", action->name);
        gn_show_report_problem(s, text);
    }
    s->kiosk = gn_kiosk_step(&s->rules, &s->kiosk, &event);
}
