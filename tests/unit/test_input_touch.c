/* Touch screens of an input as a whole: devices that are pipes. */
#include "unit/device_help.h"

static void finger(int i, int id, int x, int64_t time_ns) {
    send(i, EV_ABS, ABS_MT_TRACKING_ID, id, time_ns);
    if (id >= 0) send(i, EV_ABS, ABS_MT_POSITION_X, x, time_ns);
    send(i, EV_SYN, SYN_REPORT, 0, time_ns);
}

static void plug_glass(int i) {
    keyboards[i].glass = (struct gn_touch_opts){
        .kind = GN_TOUCH_SCREEN, .has_slots = true, .x = {0, 1000, 0}, .y = {0, 1000, 0}};
    for (int k = 0; k < GN_TOUCH_SLOTS; k++) keyboards[i].fingers.id[k] = -1;
    plug(i);
}

static void open_for_touches(void) {
    buttons[0].keys = "space tap";
    opts.pointers = GN_POINTERS_TOUCH;
    open_input();
}

static void assert_turned(double right, bool held, int64_t after_ns) {
    const struct gn_input_moves moves = gn_input_take_moves(input, start_ns + after_ns);
    assert_float_equal((double)moves.glass.turn[0], right, 1e-6);
    assert_int_equal(moves.held, held);
}

static void test_a_tap_is_a_key_and_a_drag_is_a_move(void **state) {
    (void)state;
    plug_glass(0);
    open_for_touches();
    assert_int_equal(gn_input_pointers(input), 1);
    finger(0, 1, 500, start_ns + 10 * MS);
    assert_true(wakes(20 * MS));
    assert_turned(0, true, 20 * MS);
    finger(0, -1, 0, start_ns + 60 * MS);
    dispatch(70 * MS);
    assert_gesture(0, GN_GESTURE_PRESS, 60 * MS);
    assert_gesture(0, GN_GESTURE_CLICK, 60 * MS);
    finger(0, 2, 500, start_ns + 110 * MS);
    finger(0, 2, 550, start_ns + 120 * MS);
    finger(0, 2, 750, start_ns + 130 * MS);
    dispatch(140 * MS);
    assert_turned(.2, true, 140 * MS);
    assert_turned(0, true, 140 * MS); /* taken */
    finger(0, -1, 0, start_ns + 150 * MS);
    dispatch(160 * MS);
    assert_turned(0, false, 160 * MS);
    assert_nothing();
    assert_false(wakes(10 * GN_NS_PER_S));
}

static void test_what_begins_while_it_is_deaf_is_no_tap(void **state) {
    (void)state;
    plug_glass(0);
    open_for_touches();
    gn_input_suppress_taps(input, true);
    finger(0, 1, 500, start_ns + 10 * MS);
    dispatch(20 * MS);
    gn_input_suppress_taps(input, false);
    finger(0, -1, 0, start_ns + 60 * MS);
    dispatch(70 * MS);
    gn_input_suppress_taps(input, true);
    finger(0, 2, 500, start_ns + 110 * MS); /* both in one step */
    finger(0, -1, 0, start_ns + 120 * MS);
    dispatch(130 * MS);
    assert_nothing();
    gn_input_suppress_taps(input, false);
    finger(0, 3, 500, start_ns + 210 * MS);
    finger(0, -1, 0, start_ns + 220 * MS);
    dispatch(230 * MS);
    assert_gesture(0, GN_GESTURE_PRESS, 220 * MS);
}

static void test_glass_that_is_pulled_out_holds_nothing(void **state) {
    (void)state;
    plug_glass(0);
    open_for_touches();
    finger(0, 1, 500, start_ns + 10 * MS);
    dispatch(20 * MS);
    assert_turned(0, true, 20 * MS);
    unplug(0);
    dispatch(30 * MS);
    assert_turned(0, false, 30 * MS);
    assert_int_equal(gn_input_pointers(input), 0);
    assert_nothing();
    plug_glass(0);
    dispatch(40 * MS);
    finger(0, 1, 500, start_ns + 50 * MS);
    finger(0, -1, 500, start_ns + 60 * MS);
    dispatch(70 * MS);
    assert_gesture(0, GN_GESTURE_PRESS, 60 * MS);
}

static void test_a_finger_from_before_and_lost_events_do_not_tap(void **state) {
    (void)state;
    plug_glass(0);
    keyboards[0].fingers.id[0] = 9; /* down already */
    keyboards[0].fingers.x[0] = 100;
    open_for_touches();
    assert_turned(0, true, 0);
    finger(0, -1, 0, start_ns + 10 * MS);
    dispatch(20 * MS);
    finger(0, 10, 300, start_ns + 30 * MS);
    dispatch(40 * MS);
    keyboards[0].fingers.id[0] = -1; /* lifted, and the kernel's queue was full */
    send(0, EV_SYN, SYN_DROPPED, 0, start_ns + 50 * MS);
    finger(0, 11, 900, start_ns + 60 * MS);
    dispatch(70 * MS);
    assert_turned(0, false, 70 * MS);
    assert_nothing();
}

static void test_touches_that_are_not_wanted_are_not_read(void **state) {
    (void)state;
    plug_glass(0);
    open_input(); /* for its keys alone */
    assert_int_equal(gn_input_pointers(input), 0);
    finger(0, 1, 500, start_ns + 10 * MS);
    dispatch(20 * MS);
    assert_turned(0, false, 20 * MS);
}

static void test_doctor_lists_them(void **state) {
    (void)state;
    static struct gn_input_list list;
    const struct gn_input_world world = {
        .gpio = &fake_gpio_none, .evdev = &evdev, .folder = folder};
    plug(1); /* a keyboard */
    plug_glass(3);
    gn_input_list_in(&world, &list);
    assert_int_equal(list.devices, 2);
    assert_int_equal(list.pointer_count, 1);
    assert_non_null(strstr(list.pointers[0].path, "/input/event3"));
    assert_int_equal(list.pointers[0].kind, GN_TOUCH_SCREEN);
    gn_input_list_finish(&list);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_a_tap_is_a_key_and_a_drag_is_a_move),
        TEST(test_what_begins_while_it_is_deaf_is_no_tap),
        TEST(test_glass_that_is_pulled_out_holds_nothing),
        TEST(test_a_finger_from_before_and_lost_events_do_not_tap),
        TEST(test_doctor_lists_them),
        TEST(test_touches_that_are_not_wanted_are_not_read),
    };
    return RUN(tests);
}
