/* Fingers and mice: events as kernels send them, to moves and taps. */
#include "input/touch.h"

#include <linux/input-event-codes.h>
#include <math.h>
#include <stdlib.h>

#include "check.h"
#include "core/clock.h"

#define MS INT64_C(1000000)

/* 1280 x 800 on 217 x 136 mm */
static const struct gn_touch_opts panel = {.kind = GN_TOUCH_SCREEN,
                                           .has_slots = true,
                                           .x = {0, 1279, 6},
                                           .y = {0, 799, 6}},
                                  plain = {.kind = GN_TOUCH_SCREEN, /* resistive, one finger */
                                           .x = {100, 4100, 0},
                                           .y = {100, 4100, 0}},
                                  tablet = {.kind = GN_TOUCH_TABLET, /* QEMU's */
                                            .x = {0, 32767, 0},
                                            .y = {0, 32767, 0}},
                                  mouse = {.kind = GN_TOUCH_MOUSE};

static struct gn_touch t;
static int64_t now_ns;
static int taps;

static void begin(const struct gn_touch_opts *opts) {
    gn_touch_init(&t, opts);
    now_ns = 1000 * GN_NS_PER_S;
    taps = 0;
}

static void send(unsigned type, unsigned code, int32_t value) {
    taps += gn_touch_event(&t, type, code, value, now_ns);
}

static void report(int ms) {
    send(EV_SYN, SYN_REPORT, 0);
    now_ns += ms * MS;
}

static void finger(int slot, int id, int x, int y) {
    send(EV_ABS, ABS_MT_SLOT, slot);
    send(EV_ABS, ABS_MT_TRACKING_ID, id);
    if (id < 0) return;
    send(EV_ABS, ABS_MT_POSITION_X, x);
    send(EV_ABS, ABS_MT_POSITION_Y, y);
}

static void slide(int slot, int x, int y) {
    send(EV_ABS, ABS_MT_SLOT, slot);
    send(EV_ABS, ABS_MT_POSITION_X, x);
    send(EV_ABS, ABS_MT_POSITION_Y, y);
}

static void assert_pair(const float value[2], double right, double up) {
    assert_float_equal((double)value[0], right, 1e-5);
    assert_float_equal((double)value[1], up, 1e-5);
}

static void assert_moved(double turn_right, double turn_up, double pan_right, double pan_up,
                         double zoom) {
    assert_pair(t.moves.turn, turn_right, turn_up);
    assert_pair(t.moves.pan, pan_right, pan_up);
    assert_float_equal((double)t.moves.zoom, zoom, 1e-5);
}

static void assert_taps(int expected) {
    assert_int_equal(taps, expected);
    assert_false(gn_touch_is_held(&t, now_ns));
}

/* ---- one finger ---- */

static void test_a_short_touch_that_stays_is_a_tap(void **state) {
    (void)state;
    begin(&panel);
    finger(0, 45, 600, 300);
    send(EV_KEY, BTN_TOUCH, 1);
    report(40);
    assert_true(gn_touch_is_held(&t, now_ns));
    slide(0, 604, 302); /* it rolls */
    report(40);
    assert_int_equal(taps, 0);
    finger(0, -1, 0, 0);
    send(EV_KEY, BTN_TOUCH, 0);
    report(0);
    assert_taps(1);
    assert_moved(0, 0, 0, 0, 0);
    assert_true(t.moves.used);
}

static void test_a_long_touch_is_none(void **state) {
    (void)state;
    begin(&panel);
    finger(0, 45, 600, 300);
    report(501);
    finger(0, -1, 0, 0);
    report(0);
    assert_taps(0);
    assert_moved(0, 0, 0, 0, 0);
}

static void test_a_drag_turns_from_where_it_left_its_place(void **state) {
    (void)state;
    begin(&panel);
    finger(0, 45, 100, 700);
    report(10);
    slide(0, 110, 700); /* 1.7 mm */
    report(10);
    assert_moved(0, 0, 0, 0, 0);
    slide(0, 120, 700); /* 3.3 mm */
    report(10);
    assert_moved(0, 0, 0, 0, 0);
    slide(0, 120 + 1279 / 2, 700 - 400);
    report(10);
    assert_moved(639. / 1279, 400. / 799, 0, 0, 0);
    slide(0, 120, 700);
    report(10);
    finger(0, -1, 0, 0);
    report(0);
    assert_moved(0, 0, 0, 0, 0); /* there and back */
    assert_taps(0);              /* where it began, but it has moved */
}

static void test_a_slot_that_is_used_again_keeps_its_place(void **state) {
    (void)state;
    begin(&panel);
    finger(0, 45, 640, 400);
    report(30);
    finger(0, -1, 0, 0);
    report(30);
    send(EV_ABS, ABS_MT_TRACKING_ID, 46); /* the kernel does not say again where */
    report(30);
    send(EV_ABS, ABS_MT_TRACKING_ID, -1);
    report(0);
    assert_taps(2);
    assert_moved(0, 0, 0, 0, 0);
}

static void test_lifted_and_touched_elsewhere_in_one_report_does_not_jump(void **state) {
    (void)state;
    begin(&panel);
    finger(0, 45, 100, 100);
    report(30);
    finger(0, 46, 1200, 700);
    report(30);
    assert_int_equal(taps, 1);
    finger(0, 47, 100, 100);
    report(600);
    assert_int_equal(taps, 2);
    finger(0, -1, 0, 0);
    report(0);
    assert_taps(2); /* the third was long */
    assert_moved(0, 0, 0, 0, 0);
}

static void test_a_panel_of_one_finger_turns_and_taps(void **state) {
    (void)state;
    begin(&plain);
    send(EV_ABS, ABS_X, 2100);
    send(EV_ABS, ABS_Y, 2100);
    send(EV_KEY, BTN_TOUCH, 1);
    report(50);
    send(EV_KEY, BTN_TOUCH, 0);
    report(50);
    assert_taps(1);
    send(EV_KEY, BTN_TOUCH, 1); /* where it was */
    report(10);
    send(EV_ABS, ABS_X, 2180);
    report(10);
    send(EV_ABS, ABS_X, 3180);
    send(EV_ABS, ABS_Y, 1600);
    report(10);
    send(EV_KEY, BTN_TOUCH, 0);
    report(0);
    assert_moved(.25, .125, 0, 0, 0);
    assert_taps(1);
}

/* ---- two fingers ---- */

static void test_two_fingers_pan_and_zoom_and_do_not_tap(void **state) {
    (void)state;
    begin(&panel);
    finger(0, 1, 500, 400);
    report(20);
    finger(1, 2, 700, 400);
    report(20);
    slide(0, 450, 400);
    slide(1, 750, 400);
    report(20);
    assert_moved(0, 0, 0, 0, log(1.5));
    slide(0, 450, 300); /* one after the other, as panels send them */
    report(20);
    slide(1, 750, 300);
    report(20);
    assert_float_equal((double)t.moves.zoom, log(1.5), 1e-5);
    assert_pair(t.moves.pan, 0, 100. / 799);
    finger(0, -1, 0, 0);
    report(20);
    finger(1, -1, 0, 0);
    report(20);
    assert_taps(0);
    assert_pair(t.moves.turn, 0, 0);
}

static void test_of_two_the_one_that_stays_turns_on(void **state) {
    (void)state;
    begin(&panel);
    finger(0, 1, 500, 400);
    finger(1, 2, 700, 400);
    report(20);
    finger(0, -1, 0, 0);
    report(20);
    slide(1, 700, 480);
    report(20);
    assert_moved(0, -80. / 799, 0, 0, 0);
}

static void test_a_pinch_across_the_panel_is_one_along_it(void **state) {
    (void)state;
    const struct gn_touch_opts square = {.kind = GN_TOUCH_SCREEN,
                                         .has_slots = true,
                                         .x = {0, 4096, 8},   /* 512 mm */
                                         .y = {0, 4096, 16}}; /* 256 mm */
    begin(&square);
    finger(0, 1, 1000, 1000);
    finger(1, 2, 1400, 1000); /* 50 mm apart */
    report(20);
    slide(1, 1000, 1800); /* as far, upright */
    report(20);
    assert_float_equal((double)t.moves.zoom, 0, 1e-5);
}

static void test_more_fingers_than_are_followed_do_nothing(void **state) {
    (void)state;
    begin(&panel);
    finger(GN_TOUCH_SLOTS, 1, 500, 400);
    finger(1000, 2, 500, 400);
    finger(-5, 3, 500, 400);
    report(20);
    assert_false(gn_touch_is_held(&t, now_ns));
    assert_moved(0, 0, 0, 0, 0);
}

/* ---- what goes wrong ---- */

static void test_after_lost_events_nothing_jumps_and_nothing_sticks(void **state) {
    (void)state;
    struct gn_touch_state now = {.slot = 1};
    for (int i = 0; i < GN_TOUCH_SLOTS; i++) now.id[i] = -1;
    begin(&panel);
    finger(0, 1, 100, 100);
    report(20);
    now.id[1] = 7; /* another one meanwhile, elsewhere */
    now.x[1] = 1200;
    now.y[1] = 700;
    gn_touch_set(&t, &now, now_ns);
    report(20);
    assert_true(gn_touch_is_held(&t, now_ns));
    assert_moved(0, 0, 0, 0, 0);
    send(EV_ABS, ABS_MT_POSITION_X, 1200 - 128); /* of slot 1: no slot is named */
    report(20);
    assert_moved(-128. / 1279, 0, 0, 0, 0);
    now.id[1] = -1; /* lifted while events were lost: no tap */
    gn_touch_set(&t, &now, now_ns);
    report(20);
    assert_taps(0);
    assert_moved(-128. / 1279, 0, 0, 0, 0);
}

static void test_a_finger_that_stays_for_half_a_minute_is_a_fault_of_the_glass(void **state) {
    (void)state;
    begin(&panel);
    finger(0, 1, 100, 100);
    report(29999);
    assert_true(gn_touch_is_held(&t, now_ns));
    now_ns += 2 * MS;
    assert_false(gn_touch_is_held(&t, now_ns));
    slide(0, 200, 200);
    report(10);
    assert_true(gn_touch_is_held(&t, now_ns));
}

static void test_glass_without_a_range_moves_nothing(void **state) {
    (void)state;
    const struct gn_touch_opts bad = {
        .kind = GN_TOUCH_SCREEN, .has_slots = true, .x = {5, 5, 0}, .y = {7, -7, -1}};
    begin(&bad);
    finger(0, 1, 5, 5);
    report(10);
    slide(0, 500, -500);
    report(10);
    slide(0, INT32_MAX, INT32_MIN);
    report(10);
    assert_moved(0, 0, 0, 0, 0);
}

/* ---- glass that is mounted otherwise ---- */

static void test_turned_glass_moves_as_the_panel_lies(void **state) {
    (void)state;
    static const struct {
        unsigned rotate_deg;
        int x, y; /* of a drag to the right of the panel, by half of it */
    } drags[] = {{0, 1, 0}, {90, 0, -1}, {180, -1, 0}, {270, 0, 1}};
    for (size_t i = 0; i < sizeof drags / sizeof drags[0]; i++) {
        struct gn_touch_opts opts = {.kind = GN_TOUCH_SCREEN,
                                     .has_slots = true,
                                     .x = {0, 1000, 0},
                                     .y = {0, 1000, 0},
                                     .rotate_deg = drags[i].rotate_deg};
        begin(&opts);
        finger(0, 1, 500 - 250 * drags[i].x, 500 - 250 * drags[i].y);
        report(10);
        slide(0, 500 - 230 * drags[i].x, 500 - 230 * drags[i].y); /* leaves its place */
        report(10);
        slide(0, 500 + 270 * drags[i].x, 500 + 270 * drags[i].y);
        report(10);
        assert_moved(.5, 0, 0, 0, 0);
    }
}

/* ---- mice ---- */

static void test_a_mouse_turns_with_its_left_button_and_pans_with_others(void **state) {
    (void)state;
    static const unsigned buttons[] = {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE};
    for (int i = 0; i < 3; i++) {
        begin(&mouse);
        send(EV_REL, REL_X, 300); /* nothing is held */
        report(10);
        assert_false(t.moves.used);
        send(EV_KEY, buttons[i], 1);
        report(10);
        send(EV_REL, REL_X, 5);
        report(10);
        send(EV_REL, REL_X, 250);
        send(EV_REL, REL_Y, 500);
        send(EV_KEY, buttons[(i + 1) % 3], 1); /* another one, meanwhile */
        report(10);
        send(EV_KEY, buttons[(i + 1) % 3], 0);
        report(10);
        assert_true(gn_touch_is_held(&t, now_ns));
        send(EV_KEY, buttons[i], 0);
        report(10);
        send(EV_REL, REL_X, 300);
        report(10);
        /* only the left one may click, and has a place to leave */
        assert_pair(i ? t.moves.pan : t.moves.turn, i ? .255 : .25, -.5);
        assert_pair(i ? t.moves.turn : t.moves.pan, 0, 0);
        assert_taps(0);
    }
}

static void test_a_click_in_place_is_a_tap_and_the_wheel_zooms(void **state) {
    (void)state;
    begin(&mouse);
    send(EV_KEY, BTN_LEFT, 1);
    report(60);
    send(EV_REL, REL_X, 1);
    report(60);
    send(EV_KEY, BTN_LEFT, 0);
    report(60);
    assert_taps(1);
    send(EV_KEY, BTN_RIGHT, 1);
    report(60);
    send(EV_KEY, BTN_RIGHT, 0);
    report(60);
    assert_taps(1);
    send(EV_REL, REL_WHEEL, -2);
    report(60);
    send(EV_REL, REL_WHEEL, 5);
    report(60);
    assert_float_equal((double)t.moves.wheel, 3, 0);
    assert_moved(0, 0, 0, 0, 0);
}

static void test_a_tablet_turns_by_where_it_is(void **state) {
    (void)state;
    begin(&tablet);
    send(EV_ABS, ABS_X, 8000); /* hovers */
    send(EV_ABS, ABS_Y, 8000);
    report(10);
    send(EV_KEY, BTN_LEFT, 1);
    report(10);
    send(EV_ABS, ABS_X, 10000);
    report(10);
    send(EV_ABS, ABS_X, 20000);
    report(10);
    send(EV_KEY, BTN_LEFT, 0);
    report(10);
    assert_moved(10000. / 32767, 0, 0, 0, 0);
    assert_taps(0);
    send(EV_KEY, BTN_LEFT, 1);
    report(10);
    send(EV_KEY, BTN_LEFT, 0);
    report(10);
    assert_taps(1);
}

/* ---- anything ---- */

static void send_anything(unsigned *seed) {
    static const unsigned abs[] =
        {ABS_X, ABS_Y, ABS_MT_SLOT, ABS_MT_TRACKING_ID, ABS_MT_POSITION_X, ABS_MT_POSITION_Y},
                          keys[] = {BTN_TOUCH, BTN_LEFT, BTN_RIGHT, BTN_MIDDLE, KEY_A},
                          rel[] = {REL_X, REL_Y, REL_WHEEL, REL_HWHEEL};
    const int kind = rand_r(seed) % 16;
    int32_t value = rand_r(seed) % 1500 - 20;
    if (rand_r(seed) % 50 == 0) value = rand_r(seed) % 2 ? INT32_MAX : INT32_MIN;
    if (kind < 4)
        report(rand_r(seed) % 300);
    else if (kind < 11) {
        const unsigned code = abs[rand_r(seed) % 6];
        const bool rare = code == ABS_MT_SLOT || code == ABS_MT_TRACKING_ID;
        send(EV_ABS, code, rare && rand_r(seed) % 4 ? value % 4 - 1 : value);
    } else if (kind < 14)
        send(EV_KEY, keys[rand_r(seed) % 5], rand_r(seed) % 2);
    else
        send(EV_REL, rel[rand_r(seed) % 4], value);
}

/* Whatever came before, once all is lifted nothing is held and the next tap is one. */
static void test_after_anything_a_tap_is_a_tap(void **state) {
    (void)state;
    const struct gn_touch_opts *const all[] = {&panel, &plain, &tablet, &mouse};
    unsigned seed = 20261125;
    for (int round = 0; round < 4000; round++) {
        begin(all[round % 4]);
        for (int i = 0; i < 60; i++) send_anything(&seed);
        for (int k = 0; k < 2; k++)
            if (!isfinite(t.moves.turn[k]) || !isfinite(t.moves.pan[k]) || !isfinite(t.moves.zoom))
                fail_msg("round %d: a move is not finite", round);
        for (int i = 0; i < GN_TOUCH_SLOTS && t.opts.has_slots; i++) finger(i, -1, 0, 0);
        send(EV_KEY, BTN_TOUCH, 0);
        send(EV_KEY, BTN_LEFT, 0);
        send(EV_KEY, BTN_RIGHT, 0);
        send(EV_KEY, BTN_MIDDLE, 0);
        report(10);
        if (gn_touch_is_held(&t, now_ns)) fail_msg("round %d: it sticks", round);
        taps = 0;
        t.moves = (struct gn_touch_moves){0};
        if (t.opts.has_slots) finger(0, 5000, 300, 300);
        send(EV_KEY, t.opts.kind == GN_TOUCH_SCREEN ? BTN_TOUCH : BTN_LEFT, 1);
        report(50);
        if (t.opts.has_slots) finger(0, -1, 0, 0);
        send(EV_KEY, t.opts.kind == GN_TOUCH_SCREEN ? BTN_TOUCH : BTN_LEFT, 0);
        report(50);
        if (taps != 1) fail_msg("round %d: %d taps", round, taps);
        assert_moved(0, 0, 0, 0, 0);
    }
}

static void test_moves_are_added(void **state) {
    (void)state;
    struct gn_touch_moves sum = {.turn = {1, 2}, .zoom = .5f};
    const struct gn_touch_moves more = {
        .turn = {.5f, -1}, .pan = {3, 4}, .zoom = .25f, .wheel = 2, .used = true};
    gn_touch_add(&sum, &more);
    assert_pair(sum.turn, 1.5, 1);
    assert_pair(sum.pan, 3, 4);
    assert_float_equal((double)sum.zoom, .75, 0);
    assert_float_equal((double)sum.wheel, 2, 0);
    assert_true(sum.used);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_short_touch_that_stays_is_a_tap),
        cmocka_unit_test(test_a_long_touch_is_none),
        cmocka_unit_test(test_a_drag_turns_from_where_it_left_its_place),
        cmocka_unit_test(test_a_slot_that_is_used_again_keeps_its_place),
        cmocka_unit_test(test_lifted_and_touched_elsewhere_in_one_report_does_not_jump),
        cmocka_unit_test(test_a_panel_of_one_finger_turns_and_taps),
        cmocka_unit_test(test_two_fingers_pan_and_zoom_and_do_not_tap),
        cmocka_unit_test(test_of_two_the_one_that_stays_turns_on),
        cmocka_unit_test(test_a_pinch_across_the_panel_is_one_along_it),
        cmocka_unit_test(test_more_fingers_than_are_followed_do_nothing),
        cmocka_unit_test(test_after_lost_events_nothing_jumps_and_nothing_sticks),
        cmocka_unit_test(test_a_finger_that_stays_for_half_a_minute_is_a_fault_of_the_glass),
        cmocka_unit_test(test_glass_without_a_range_moves_nothing),
        cmocka_unit_test(test_turned_glass_moves_as_the_panel_lies),
        cmocka_unit_test(test_a_mouse_turns_with_its_left_button_and_pans_with_others),
        cmocka_unit_test(test_a_click_in_place_is_a_tap_and_the_wheel_zooms),
        cmocka_unit_test(test_a_tablet_turns_by_where_it_is),
        cmocka_unit_test(test_after_anything_a_tap_is_a_tap),
        cmocka_unit_test(test_moves_are_added),
    };
    return RUN(tests);
}
