/* Buttons and keys: gestures become actions. */
#include <stdio.h>

#include "kiosk/private.h"

/* The terminal's keys are not read if the display is a window, which has its own. */
bool gn_show_open_input(struct gn_show *s, struct gn_err *err) {
    gn_input_close(s->buttons.input);
    s->buttons.input = NULL;
    if (s->config.options->buttons)
        s->buttons.map = *s->config.options->buttons;
    else
        gn_buttons_defaults(&s->buttons.map);
    const struct gn_input_opts opts = {
        .loop = s->loop,
        .button_count = gn_buttons_opts(&s->buttons.map, s->buttons.opts),
        .buttons = s->buttons.opts,
        .terminal = !s->screen.stage.display.ops->is_window,
        .devices = s->screen.stage.display.ops->is_console,
        .pointers = (enum gn_pointers)s->screen.stage.settings->kiosk.pointer,
        .touch_rotate_deg = (unsigned)s->screen.stage.settings->display.touch_rotate_deg,
        .script = s->screen.stage.settings->run.input_script,
    };
    s->buttons.input = gn_input_open(&opts, gn_loop_now_ns(s->loop), s->warnings, err);
    return s->buttons.input;
}

void gn_show_take_input(struct gn_show *s, const struct gn_pointer *pointer) {
    struct gn_gesture_event event;
    char text[256];
    if (!s->buttons.input) return;
    for (unsigned i = 0; i < pointer->key_count; i++)
        gn_input_key(s->buttons.input, &pointer->keys[i]);
    while (gn_input_next(s->buttons.input, &event)) {
        struct gn_action action = gn_buttons_action(&s->buttons.map, &event);
        if (action.kind == GN_ACTION_NONE) continue;
        action.pressed = true;
        s->counts.presses++;
        const struct gn_kiosk before = s->screen.kiosk, *now = &s->screen.kiosk;
        gn_show_act(&s->screen, &action, event.time_ns);

        /* measures edges that change the picture; drops one that is undone before it was shown */
        if (gn_kiosk_is_dark(now) || (gn_kiosk_waits(&before) && !gn_kiosk_waits(now)))
            gn_latency_drop(&s->buttons.latency);
        else if (before.wanted.mode != now->wanted.mode ||
                 before.wanted.scene != now->wanted.scene || before.camera != now->camera ||
                 before.info != now->info || before.play.clip_plus_1 != now->play.clip_plus_1)
            gn_latency_edge(&s->buttons.latency, event.time_ns);
    }
    const bool prints = s->config.options->buttons ||
                        s->screen.stage.settings->run
                            .verbose; /* not for the default buttons, which few kiosks have */
    while (gn_input_report(s->buttons.input, text, sizeof text))
        if (prints) fprintf(stderr, "gnomon: warning: %s\n", text);
}
