/* The machine's screen off: by hand, by timers that say on or off, by the hours of a schedule. */
#include "unit/check.h"

#include "unit/kiosk_help.h"

static struct gn_kiosk turn(struct gn_kiosk s, enum gn_action_kind action, enum gn_turn turn,
                            bool pressed) {
    return gn_kiosk_step(&three, &s,
                         &(struct gn_kiosk_event){.kind = GN_KIOSK_ACTION,
                                                  .time_ns = S,
                                                  .action = action,
                                                  .turn = turn,
                                                  .pressed = pressed});
}

static void on_and_off_are_the_same_twice(void **state) {
    (void)state;
    for (int twice = 1; twice <= 2; twice++) {
        struct gn_kiosk s = {0};
        for (int i = 0; i < twice; i++) s = turn(s, GN_ACTION_PAUSE, GN_TURN_ON, i);
        for (int i = 0; i < twice; i++) s = turn(s, GN_ACTION_INFO, GN_TURN_ON, i);
        for (int i = 0; i < twice; i++) s = turn(s, GN_ACTION_BLANK, GN_TURN_ON, i);
        assert_true(s.paused && s.info && s.blanked);
        for (int i = 0; i < twice; i++) s = turn(s, GN_ACTION_PAUSE, GN_TURN_OFF, false);
        assert_true(!s.paused && s.info && s.blanked); /* a timer does not light the screen, */
        s = turn(s, GN_ACTION_INFO, GN_TURN_OFF, true);
        assert_true(s.info && !s.blanked); /* a press does that alone */
        for (int i = 0; i < twice; i++) s = turn(s, GN_ACTION_INFO, GN_TURN_OFF, false);
        for (int i = 0; i < twice; i++) s = turn(s, GN_ACTION_BLANK, GN_TURN_OFF, i);
        assert_true(!s.paused && !s.info && !s.blanked);
    }
}

static struct gn_kiosk hours(const struct gn_kiosk_rules *r, struct gn_kiosk s, int64_t at,
                             bool ended) {
    return gn_kiosk_step(
        r, &s, &(struct gn_kiosk_event){.kind = GN_KIOSK_HOURS, .time_ns = at, .by = ended});
}

static void a_press_wakes_the_screen_for_a_while(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    r.wake_ns = 60 * S;
    struct gn_kiosk s = hours(&r, (struct gn_kiosk){0}, S, true);
    assert_true(gn_kiosk_is_dark(&s) && gn_kiosk_view(&r, &s, S).dark);
    const struct gn_kiosk_event press = {
        .kind = GN_KIOSK_ACTION, .time_ns = 10 * S, .action = GN_ACTION_NEXT, .pressed = true};
    s = gn_kiosk_step(&r, &s, &press);
    assert_false(gn_kiosk_is_dark(&s));
    assert_int_equal(s.wanted.mode, 0); /* that alone */
    s = hours(&r, s, 20 * S, true);
    assert_false(gn_kiosk_is_dark(&s));
    assert_int_equal(gn_kiosk_deadline(&r, &s), 70 * S);
    s = on(&r, on(&r, s, GN_KIOSK_TICK, 69 * S), GN_KIOSK_FRAME, 69 * S);
    assert_false(gn_kiosk_is_dark(&s));
    s = on(&r, s, GN_KIOSK_TICK, 70 * S);
    assert_true(gn_kiosk_is_dark(&s));
    s = turn(s, GN_ACTION_PAUSE, GN_TURN_ON, false); /* a timer does not wake it */
    assert_true(s.paused && gn_kiosk_is_dark(&s));
    s = turn(s, GN_ACTION_BLANK, GN_TURN_OFF, false);
    assert_false(gn_kiosk_is_dark(&s));
    s = turn(s, GN_ACTION_BLANK, GN_TURN_ON, false);
    assert_true(gn_kiosk_is_dark(&s));
    s = hours(&r, s, 80 * S, false); /* the morning */
    assert_false(gn_kiosk_is_dark(&s));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(on_and_off_are_the_same_twice),
        cmocka_unit_test(a_press_wakes_the_screen_for_a_while),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
