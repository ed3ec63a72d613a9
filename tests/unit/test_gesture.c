/* Debouncing and gestures, case by case; test_gesture_traces.c has them at random. Times are
 * milliseconds. */
#include "check.h"
#include "input/gesture.h"

#define MS INT64_C(1000000)
enum { A, B, C, CHORD, CHORD3, BUTTONS };
#define ALL          63u
#define BIT(gesture) (1u << GN_GESTURE_##gesture)

static struct gn_gestures g;

static void begin(unsigned gestures) {
    const struct gn_gesture_opts opts[BUTTONS] = {
        [A] = {.gestures = gestures}, [B] = {.gestures = gestures}, [C] = {.gestures = gestures}};
    gn_gestures_init(&g, opts, 3, 0);
}

static void begin_chords(unsigned gestures) {
    const struct gn_gesture_opts opts[BUTTONS] = {[A] = {.gestures = gestures},
                                                  [B] = {.gestures = gestures},
                                                  [C] = {.gestures = gestures},
                                                  [CHORD] = {.gestures = gestures, .chord = 3},
                                                  [CHORD3] = {.gestures = gestures, .chord = 7}};
    gn_gestures_init(&g, opts, BUTTONS, 0);
}

static void edge(int button, bool level, int ms) { gn_gestures_edge(&g, button, level, ms * MS); }
static void step(int ms) { gn_gestures_step(&g, ms * MS); }

static void assert_gesture(int button, enum gn_gesture gesture, int ms) {
    struct gn_gesture_event event;
    if (!gn_gestures_next(&g, &event)) fail_msg("no %s", gn_gesture_names[gesture]);
    if (event.button != button || event.gesture != gesture || event.time_ns != ms * MS)
        fail_msg("%d %s at %g, not %d %s at %d", event.button, gn_gesture_names[event.gesture],
                 (double)event.time_ns / 1e6, button, gn_gesture_names[gesture], ms);
}

static void assert_nothing(void) {
    struct gn_gesture_event event;
    if (gn_gestures_next(&g, &event))
        fail_msg("%d %s at %g", event.button, gn_gesture_names[event.gesture],
                 (double)event.time_ns / 1e6);
}

static void assert_note(int button, enum gn_gesture_note_kind kind) {
    struct gn_gesture_note note;
    assert_true(gn_gestures_note(&g, &note));
    assert_int_equal(note.button, button);
    assert_int_equal(note.kind, kind);
}

static void assert_no_note(void) {
    struct gn_gesture_note note;
    assert_false(gn_gestures_note(&g, &note));
}

/* ---- the debouncer ------------------------------------------------------------------------- */

static void test_a_level_counts_after_it_was_stable_with_its_first_edge(void **state) {
    struct gn_debounce d;
    struct gn_debounced out;
    (void)state;
    gn_debounce_init(&d, 20, false);
    assert_true(gn_debounce_deadline(&d) == INT64_MAX);
    gn_debounce_edge(&d, true, 100);
    gn_debounce_edge(&d, false, 103);
    gn_debounce_edge(&d, true, 107);
    assert_int_equal(gn_debounce_deadline(&d), 127);
    assert_false(gn_debounce_step(&d, 126, &out));
    assert_true(gn_debounce_step(&d, 500, &out));
    assert_true(out.level && out.first_ns == 100 && out.time_ns == 127);
    assert_false(gn_debounce_step(&d, 600, &out));
}

static void test_a_spike_is_not_a_level(void **state) {
    struct gn_debounce d;
    struct gn_debounced out;
    (void)state;
    gn_debounce_init(&d, 20, false);
    gn_debounce_edge(&d, true, 100);
    gn_debounce_edge(&d, false, 119);
    assert_false(gn_debounce_step(&d, 138, &out));
    assert_true(d.moving);
    assert_false(gn_debounce_step(&d, 139, &out));
    assert_false(d.moving || d.settled);
}

static void test_an_edge_that_leads_nowhere_starts_the_wait_again(void **state) {
    struct gn_debounce d;
    struct gn_debounced out;
    (void)state;
    gn_debounce_init(&d, 20, false);
    gn_debounce_edge(&d, true, 100);
    gn_debounce_edge(&d, true, 110); /* it was low in between, and nobody told */
    assert_false(gn_debounce_step(&d, 129, &out));
    assert_true(gn_debounce_step(&d, 130, &out));
    gn_debounce_level(&d, true, 140); /* but a level that was read is no news */
    assert_false(d.moving);
}

/* ---- gestures ------------------------------------------------------------------------------ */

static void test_a_press_acts_20_ms_after_its_edge(void **state) {
    (void)state;
    begin(BIT(PRESS));
    edge(A, true, 100);
    assert_int_equal(gn_gestures_deadline(&g), 120 * MS);
    step(119);
    assert_nothing();
    step(120);
    assert_gesture(A, GN_GESTURE_PRESS, 100);
}

static void test_a_click_waits_only_for_a_double_that_is_bound(void **state) {
    (void)state;
    begin(BIT(CLICK));
    edge(A, true, 100);
    edge(A, false, 200);
    step(220);
    assert_gesture(A, GN_GESTURE_CLICK, 200);
    begin(BIT(CLICK) | BIT(DOUBLE));
    edge(A, true, 100);
    edge(A, false, 200);
    step(569);
    assert_nothing();
    step(570);
    assert_gesture(A, GN_GESTURE_CLICK, 200);
}

static void test_a_double_is_no_click(void **state) {
    (void)state;
    begin(ALL);
    edge(A, true, 100);
    edge(A, false, 200);
    edge(A, true, 549); /* 349 ms after the release */
    edge(A, false, 3000);
    step(9000);
    assert_gesture(A, GN_GESTURE_PRESS, 100);
    assert_gesture(A, GN_GESTURE_PRESS, 549);
    assert_gesture(A, GN_GESTURE_DOUBLE, 549);
    assert_nothing();
}

static void test_three_quick_clicks_are_a_double_and_a_click(void **state) {
    (void)state;
    begin(BIT(CLICK) | BIT(DOUBLE));
    for (int i = 0; i < 3; i++) {
        edge(A, true, 100 + 200 * i);
        edge(A, false, 200 + 200 * i);
    }
    step(2000);
    assert_gesture(A, GN_GESTURE_DOUBLE, 300);
    assert_gesture(A, GN_GESTURE_CLICK, 600);
    assert_nothing();
}

static void test_hold_and_repeat_fire_while_held(void **state) {
    (void)state;
    begin(ALL);
    edge(A, true, 100);
    step(920);
    assert_gesture(A, GN_GESTURE_PRESS, 100);
    assert_gesture(A, GN_GESTURE_HOLD, 920);
    assert_gesture(A, GN_GESTURE_REPEAT, 920);
    step(1319);
    assert_gesture(A, GN_GESTURE_REPEAT, 1120);
    assert_nothing();
    edge(A, false, 1319);
    step(1338);
    assert_gesture(A, GN_GESTURE_REPEAT, 1320);
    step(9000);
    assert_nothing(); /* and no click */
}

static void test_without_a_hold_a_long_press_is_a_click(void **state) {
    (void)state;
    begin(BIT(CLICK));
    edge(A, true, 100);
    edge(A, false, 5000);
    step(5020);
    assert_gesture(A, GN_GESTURE_CLICK, 5000);
}

static void test_what_is_not_bound_does_not_happen(void **state) {
    (void)state;
    begin(0);
    edge(A, true, 100);
    edge(A, false, 200);
    step(2000);
    assert_nothing();
}

static void test_held_at_the_start_for_a_minute_is_one_report(void **state) {
    (void)state;
    begin(ALL);
    gn_gestures_start(&g, A, true, 0);
    step(29999);
    assert_no_note();
    step(60000);
    assert_note(A, GN_NOTE_STUCK);
    assert_no_note();
    edge(A, false, 60000);
    step(61000);
    assert_nothing();
    edge(A, true, 62000);
    step(62020);
    assert_gesture(A, GN_GESTURE_PRESS, 62000);
}

static void test_a_stuck_button_is_ignored_until_released(void **state) {
    (void)state;
    begin(BIT(PRESS) | BIT(REPEAT) | BIT(CLICK));
    edge(A, true, 0);
    for (int ms = 0; ms <= 120000; ms += 100) {
        struct gn_gesture_event event;
        step(ms);
        while (gn_gestures_next(&g, &event)) assert_true(event.time_ns <= 30020 * MS);
    }
    assert_note(A, GN_NOTE_STUCK);
    assert_no_note();
    edge(A, false, 120000);
    step(121000);
    assert_nothing();
}

static void test_a_line_that_never_rests_is_reported_once(void **state) {
    (void)state;
    begin(ALL);
    for (int ms = 0; ms < 70000; ms += 10) edge(A, ms / 10 % 2 == 0, ms);
    assert_nothing();
    assert_note(A, GN_NOTE_NOISY);
    assert_no_note();
}

static void test_a_burst_of_240_edges_ends_in_the_right_state(void **state) {
    (void)state;
    for (int last = 0; last < 2; last++) {
        begin(BIT(PRESS) | BIT(CLICK));
        int64_t at_ns = 100 * MS;
        for (int i = 0; i < 240; i++, at_ns += 833333)
            gn_gestures_edge(&g, A, (i + last) % 2 == 0, at_ns);
        step(1000);
        assert_int_equal(g.buttons[A].line.settled, last);
        if (last) assert_gesture(A, GN_GESTURE_PRESS, 100);
        assert_nothing();
    }
}

static void test_lost_edges_are_healed_by_the_level(void **state) {
    (void)state;
    begin(BIT(PRESS) | BIT(CLICK) | BIT(HOLD));
    edge(A, true, 100);
    step(500);
    gn_gestures_level(&g, A, false, 500 * MS); /* its edge was lost */
    step(2000);
    assert_gesture(A, GN_GESTURE_PRESS, 100);
    assert_gesture(A, GN_GESTURE_CLICK, 500);
    assert_nothing();
    assert_true(gn_gestures_at_rest(&g, A));
}

static void test_what_is_lost_ends_without_a_gesture(void **state) {
    (void)state;
    begin(ALL);
    edge(A, true, 100);
    step(300);
    assert_gesture(A, GN_GESTURE_PRESS, 100);
    gn_gestures_lose(&g, A, 300 * MS);
    step(60000);
    assert_nothing();
    assert_no_note();
    assert_true(gn_gestures_deadline(&g) == INT64_MAX);
}

static void test_no_more_than_20_a_second(void **state) {
    (void)state;
    begin(BIT(PRESS) | BIT(CLICK));
    for (int ms = 0; ms < 3000; ms += 25) { /* 40 keys a second: no bounce to wait for */
        gn_gestures_key(&g, A, true, ms * MS);
        gn_gestures_key(&g, A, false, (ms + 10) * MS);
    }
    struct gn_gesture_event event;
    int count = 0;
    for (; gn_gestures_next(&g, &event); count++) {
    }
    assert_int_equal(count, 60);
    assert_note(A, GN_NOTE_FAST);
    assert_no_note();
}

static void test_a_full_queue_drops_the_newest(void **state) {
    (void)state;
    begin(BIT(PRESS));
    for (int i = 0; i < GN_GESTURE_QUEUE + 5; i++) {
        gn_gestures_key(&g, A, true, 100 * i * MS);
        gn_gestures_key(&g, A, false, (100 * i + 50) * MS);
    }
    assert_int_equal(g.dropped, 5);
    for (int i = 0; i < GN_GESTURE_QUEUE; i++) assert_gesture(A, GN_GESTURE_PRESS, 100 * i);
    assert_nothing();
}

static void test_time_that_goes_back_stands_still(void **state) {
    (void)state;
    begin(BIT(PRESS));
    step(1000);
    edge(A, true, 400);
    assert_int_equal(gn_gestures_deadline(&g), 1020 * MS);
    step(1020);
    assert_gesture(A, GN_GESTURE_PRESS, 1000);
}

static void test_times_of_another_clock_are_now(void **state) {
    (void)state;
    const int64_t now_ns = 5000 * MS, since_1970_ns = INT64_C(1700000000) * 1000 * MS;
    assert_true(gn_gesture_sane_time_ns(4990 * MS, now_ns) == 4990 * MS);
    assert_true(gn_gesture_sane_time_ns(5001 * MS, now_ns) == 5001 * MS);
    assert_true(gn_gesture_sane_time_ns(since_1970_ns, now_ns) == now_ns);
    assert_true(gn_gesture_sane_time_ns(4990 * MS, since_1970_ns) == since_1970_ns);
}

/* ---- several sources, several buttons ------------------------------------------------------ */

static void test_a_line_and_a_key_are_one_button(void **state) {
    (void)state;
    begin(BIT(PRESS) | BIT(CLICK));
    edge(A, true, 100);
    step(200);
    gn_gestures_key(&g, A, true, 300 * MS);
    edge(A, false, 400);
    step(500);
    assert_gesture(A, GN_GESTURE_PRESS, 100);
    assert_nothing();
    gn_gestures_key(&g, A, false, 600 * MS);
    assert_gesture(A, GN_GESTURE_CLICK, 600);
}

static void test_a_key_held_at_the_start_does_nothing(void **state) {
    (void)state;
    begin(ALL);
    gn_gestures_key_held(&g, A, 0);
    step(31000);
    assert_note(A, GN_NOTE_STUCK);
    gn_gestures_key(&g, A, false, 32000 * MS);
    step(40000);
    assert_nothing();
}

static void test_a_keyboard_that_is_pulled_out_clicks_nothing(void **state) {
    (void)state;
    begin(BIT(CLICK) | BIT(HOLD));
    gn_gestures_key(&g, A, true, 100 * MS);
    gn_gestures_key_gone(&g, A, 200 * MS);
    step(5000);
    assert_nothing();
}

static void test_a_chord_takes_its_buttons(void **state) {
    (void)state;
    begin_chords(ALL);
    gn_gestures_start(&g, C, true, 0); /* the chord of three cannot come about */
    edge(A, true, 100);
    edge(B, true, 179);
    step(199);
    assert_gesture(CHORD, GN_GESTURE_CHORD, 179);
    assert_gesture(CHORD, GN_GESTURE_PRESS, 179);
    edge(B, false, 400);
    edge(A, false, 500);
    step(3000);
    assert_gesture(CHORD, GN_GESTURE_CLICK, 400);
    assert_nothing();
}

static void test_too_late_for_a_chord_each_is_alone(void **state) {
    (void)state;
    begin_chords(BIT(PRESS) | BIT(CHORD));
    edge(A, true, 100);
    edge(B, true, 181);
    step(199);
    assert_nothing();
    step(200);
    assert_gesture(A, GN_GESTURE_PRESS, 100);
    step(281);
    assert_gesture(B, GN_GESTURE_PRESS, 181);
    assert_nothing();
}

static void test_one_of_a_chord_alone_clicks_at_once(void **state) {
    (void)state;
    begin_chords(BIT(PRESS) | BIT(CLICK) | BIT(CHORD));
    edge(A, true, 100);
    edge(A, false, 130);
    step(150);
    assert_gesture(A, GN_GESTURE_PRESS, 100);
    assert_gesture(A, GN_GESTURE_CLICK, 130);
}

static void test_the_larger_chord_wins_while_it_can(void **state) {
    (void)state;
    begin_chords(BIT(PRESS) | BIT(CHORD));
    edge(A, true, 100);
    edge(B, true, 120);
    edge(C, true, 150);
    step(1000);
    assert_gesture(CHORD3, GN_GESTURE_CHORD, 150);
    assert_gesture(CHORD3, GN_GESTURE_PRESS, 150);
    assert_nothing();
    begin_chords(BIT(PRESS) | BIT(CHORD));
    edge(A, true, 100);
    edge(B, true, 120);
    step(199);
    assert_nothing();
    step(200);
    assert_gesture(CHORD, GN_GESTURE_CHORD, 120);
    assert_gesture(CHORD, GN_GESTURE_PRESS, 120);
    edge(C, true, 230);
    step(1000);
    assert_gesture(C, GN_GESTURE_PRESS, 230);
    assert_nothing();
}

static void test_a_chord_is_held_like_a_button(void **state) {
    (void)state;
    begin_chords(BIT(PRESS) | BIT(HOLD) | BIT(CLICK));
    gn_gestures_start(&g, C, true, 0);
    edge(A, true, 100);
    edge(B, true, 100);
    step(920);
    assert_gesture(CHORD, GN_GESTURE_PRESS, 100);
    assert_gesture(CHORD, GN_GESTURE_HOLD, 920);
    assert_nothing();
    step(40000);
    assert_note(C, GN_NOTE_STUCK);
    assert_note(A, GN_NOTE_STUCK);
    assert_note(B, GN_NOTE_STUCK);
    assert_no_note();
    edge(A, false, 41000);
    edge(B, false, 41000);
    step(42000);
    assert_nothing();
    assert_true(gn_gestures_deadline(&g) == INT64_MAX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_level_counts_after_it_was_stable_with_its_first_edge),
        cmocka_unit_test(test_a_spike_is_not_a_level),
        cmocka_unit_test(test_an_edge_that_leads_nowhere_starts_the_wait_again),
        cmocka_unit_test(test_a_press_acts_20_ms_after_its_edge),
        cmocka_unit_test(test_a_click_waits_only_for_a_double_that_is_bound),
        cmocka_unit_test(test_a_double_is_no_click),
        cmocka_unit_test(test_three_quick_clicks_are_a_double_and_a_click),
        cmocka_unit_test(test_hold_and_repeat_fire_while_held),
        cmocka_unit_test(test_without_a_hold_a_long_press_is_a_click),
        cmocka_unit_test(test_what_is_not_bound_does_not_happen),
        cmocka_unit_test(test_held_at_the_start_for_a_minute_is_one_report),
        cmocka_unit_test(test_a_stuck_button_is_ignored_until_released),
        cmocka_unit_test(test_a_line_that_never_rests_is_reported_once),
        cmocka_unit_test(test_a_burst_of_240_edges_ends_in_the_right_state),
        cmocka_unit_test(test_lost_edges_are_healed_by_the_level),
        cmocka_unit_test(test_what_is_lost_ends_without_a_gesture),
        cmocka_unit_test(test_no_more_than_20_a_second),
        cmocka_unit_test(test_a_full_queue_drops_the_newest),
        cmocka_unit_test(test_time_that_goes_back_stands_still),
        cmocka_unit_test(test_times_of_another_clock_are_now),
        cmocka_unit_test(test_a_line_and_a_key_are_one_button),
        cmocka_unit_test(test_a_key_held_at_the_start_does_nothing),
        cmocka_unit_test(test_a_keyboard_that_is_pulled_out_clicks_nothing),
        cmocka_unit_test(test_a_chord_takes_its_buttons),
        cmocka_unit_test(test_too_late_for_a_chord_each_is_alone),
        cmocka_unit_test(test_one_of_a_chord_alone_clicks_at_once),
        cmocka_unit_test(test_the_larger_chord_wins_while_it_can),
        cmocka_unit_test(test_a_chord_is_held_like_a_button),
    };
    return RUN(tests);
}
