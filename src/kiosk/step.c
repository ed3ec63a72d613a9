/* A step of a screen: its events, its machine, then a frame or a piece of work ahead. */
#include "core/clock.h"
#include "kiosk/private.h"
#include "stage/occlusion.h"

static const int64_t POLL_NS = GN_NS_PER_S / 10;

int64_t gn_show_screen_due_ns(const struct gn_show_screen *s) {
    if (gn_show_wants_frame(s) || gn_show_is_stale(s) || gn_show_can_advance(s)) return 0;
    const int64_t now_ns = gn_loop_now_ns(s->show->loop);
    int64_t at_ns = gn_kiosk_deadline(&s->rules, &s->kiosk);
    const int64_t others_ns[] = {gn_show_has_work(s) ? s->ahead.due_ns : gn_still_due_ns(s),
                                 gn_show_bar_due_ns(s),
                                 gn_viewer_due_ns(s),
                                 gn_truth_due_ns(s),
                                 gn_show_turntable_due_ns(s),
                                 gn_occluder_works(s->stage.occluder) ? now_ns + POLL_NS
                                                                      : INT64_MAX};
    for (int i = 0; i < 6; i++)
        if (others_ns[i] < at_ns) at_ns = others_ns[i];
    const int64_t text_ns = gn_show_captions_due_ns(s); /* an overdue text waits for the screen */
    if (s->stage.display.screen.lit && text_ns > now_ns && text_ns < at_ns) at_ns = text_ns;
    return at_ns;
}

bool gn_show_take_events(struct gn_show_screen *s, struct gn_err *err) {
    struct gn_display *display = &s->stage.display;
    if (!gn_display_dispatch(display, gn_loop_now_ns(s->show->loop), err)) return false;
    struct gn_pointer pointer = display->screen.pointer;
    display->screen.pointer = (struct gn_pointer){0};
    s->show->ends |= pointer.quit;
    if (pointer.file) gn_show_load_file(s->show, pointer.file);
    if (display->ops->is_window) {
        gn_split_take_pointer(s, &pointer);
        gn_viewer_take_keys(s, &pointer);
        gn_viewer_set_title(s);
        gn_viewer_hint(s);
    }
    gn_show_take_moves(s, &pointer);
    gn_show_take_input(s->show, &pointer);
    gn_show_wake_by_hand(s);
    return true;
}

/* Timeouts; then what follows from the state for the display. */
bool gn_show_step_machine(struct gn_show_screen *s, struct gn_err *err) {
    const int64_t now_ns = gn_loop_now_ns(s->show->loop);
    const uint32_t idled = s->kiosk.idled;
    gn_show_send(s, (struct gn_kiosk_event){.kind = GN_KIOSK_TICK, .time_ns = now_ns});
    if (s->kiosk.idled != idled) gn_show_turn_home(s);
    gn_show_suppress_taps(s);
    const bool off = s->kiosk.blanked || (gn_kiosk_is_dark(&s->kiosk) && !s->rules.sleeps_black);
    if (off != s->stage.display.screen.blank) gn_display_blank(&s->stage.display, off, now_ns);
    return gn_show_keep_context(s, err);
}

/* A frame, if one is due, does a piece of work ahead itself. With a slow scene frames and pieces
 * take turns, so that input is read between them. */
bool gn_show_step_picture(struct gn_show_screen *s, struct gn_err *err) {
    struct gn_show_ahead *ahead = &s->ahead;
    gn_show_advance(s);
    gn_show_enter_set(s);
    gn_truth_step(s);
    gn_occluder_step(s->stage.occluder, gn_loop_now_ns(s->show->loop));
    const bool waits = s->staged.loaded || gn_kiosk_waits(&s->kiosk);
    ahead->has_turn =
        ahead->alone && gn_show_has_work(s) &&
        (!ahead->has_turn || (waits && gn_loop_now_ns(s->show->loop) < ahead->until_ns));
    if (gn_show_wants_frame(s) && !ahead->has_turn) {
        if (!gn_show_frame(s, err)) return false;
    } else if (ahead->has_turn ||
               (gn_show_has_work(s) && gn_loop_now_ns(s->show->loop) >= ahead->due_ns)) {
        gn_gl_set_window(s->stage.gl, NULL); /* not drawn to outside of begin and present */
        gn_show_work(s);
        /* no frame to miss: what is waited for is not spread over frames */
        if ((s->staged.loaded || gn_kiosk_waits(&s->kiosk)) && s->stage.display.screen.may_draw)
            ahead->due_ns = gn_loop_now_ns(s->show->loop);
    } else if (!gn_show_has_work(s)) {
        gn_still_step(s);
    }
    gn_show_advance(s); /* that piece, or the picture kept for a fade, may be what it waited for */
    gn_show_enter_set(s);
    return true;
}
