/* Moves by hand, of a window or of touch screens and mice, to the view. The turntable rests
 * meanwhile, and the idle timeout begins anew. */
#include "kiosk/pointer.h"
#include "kiosk/private.h"

static int64_t rest_ns(const struct gn_show_screen *s) {
    return s->stage.settings->scene.turntable_rest_ns;
}

void gn_show_take_moves(struct gn_show_screen *s, struct gn_pointer *pointer) {
    const int64_t now_ns = gn_loop_now_ns(s->show->loop);
    struct gn_show_hand *hand = &s->hand;
    struct gn_input_moves moves = {0};
    if (s->show->buttons.input) moves = gn_input_take_moves(s->show->buttons.input, now_ns);
    const bool used = moves.glass.used || moves.mouse.used, dark = gn_kiosk_is_dark(&s->kiosk);
    hand->wakes = used && dark;
    if (!dark) gn_show_pointer_add(&s->stage.display.screen, &moves, pointer);
    if (pointer->pressed) hand->holds = true;
    if (pointer->released) hand->holds = false;
    const bool turned = gn_show_pointer_turn(&s->stage, pointer);
    s->changed |= turned;
    if (dark || !(turned || used || moves.held || hand->holds)) return;
    gn_turntable_use(&hand->turntable, now_ns);
    s->kiosk.used_ns = now_ns;
}

/* A touch of a dark screen lights it, and does nothing else. */
void gn_show_wake_by_hand(struct gn_show_screen *s) {
    const struct gn_action wake = {.kind = GN_ACTION_BLANK, .turn = GN_TURN_OFF};
    if (s->hand.wakes && gn_kiosk_is_dark(&s->kiosk))
        gn_show_act(s, &wake, gn_loop_now_ns(s->show->loop));
    s->hand.wakes = false;
}

/* That touch is no tap either. */
void gn_show_suppress_taps(struct gn_show_screen *s) {
    if (s->show->buttons.input)
        gn_input_suppress_taps(s->show->buttons.input, gn_kiosk_is_dark(&s->kiosk));
}

void gn_show_turn_home(struct gn_show_screen *s) {
    struct gn_orbit *orbit = &s->stage.shown.opts.view.orbit;
    s->changed |= !gn_orbit_is_zero(orbit);
    *orbit = (struct gn_orbit){0};
}

bool gn_show_turntable_moves(const struct gn_show_screen *s) {
    return s->stage.settings->scene.turntable_deg_s != 0.0 &&
           !gn_turntable_rests(&s->hand.turntable, rest_ns(s), gn_loop_now_ns(s->show->loop));
}

int64_t gn_show_turntable_due_ns(const struct gn_show_screen *s) {
    if (s->stage.settings->scene.turntable_deg_s == 0.0) return INT64_MAX;
    return gn_turntable_due_ns(&s->hand.turntable, rest_ns(s), gn_loop_now_ns(s->show->loop));
}

void gn_show_step_turntable(struct gn_show_screen *s, int64_t seen_ns, int64_t scene_ns) {
    struct gn_turntable *turntable = &s->hand.turntable;
    s->stage.shown.rested_ns = gn_turntable_step(turntable, rest_ns(s), seen_ns, scene_ns);
    /* by a button it is switched on where the camera stands; modes of a file turn meanwhile */
    turntable->off = s->show->modes.offered && s->stage.settings->scene.turntable_deg_s == 0.0;
}
