/* An input as a whole: keys of devices that are pipes, of a terminal that is a pseudo-terminal, of
 * the window and of scripts; by a clock of the test, and by the real one. */
#include "input/input.h"

#include "unit/device_help.h"

/* ---- options ------------------------------------------------------------------------------- */

static void assert_usage(const char *says) {
    open_with(NULL);
    assert_null(input);
    assert_int_equal(err.status, GN_EXIT_USAGE);
    if (!strstr(err.text, says)) fail_msg("\"%s\" does not say %s", err.text, says);
}

static void test_what_is_said_wrongly_is_wrong_usage(void **state) {
    (void)state;
    buttons[1].keys = "left spcae";
    assert_usage("button \"prev\": keys: unknown key \"spcae\"");
    buttons[1].keys = "  ";
    assert_usage("button \"prev\": keys: no key given");
    buttons[1].keys = NULL;
    buttons[2].chord = "next nobody";
    assert_usage("button \"both\": chord: unknown button \"nobody\"");
    buttons[2].chord = "next";
    assert_usage("button \"both\": chord: expected two buttons");
    buttons[2].chord = "";
    assert_usage("button \"both\": chord: expected two buttons");
    buttons[2].chord = "next both";
    assert_usage("chord itself");
    buttons[2].chord = "next prev";
    buttons[2].line = "GPIO17";
    assert_usage("a chord cannot have a line");
    buttons[2].line = NULL;
    opts.script = "/nowhere/to/be/found";
    open_with(NULL);
    assert_null(input);
    assert_int_equal(err.status, GN_EXIT_RUNTIME);
}

static void test_without_anything_it_sleeps(void **state) {
    (void)state;
    opts = (struct gn_input_opts){0};
    open_input();
    assert_true(input->timer.due_ns == INT64_MAX);
    assert_false(wakes(0));
    assert_nothing();
}

/* ---- devices ------------------------------------------------------------------------------- */

static void test_a_key_of_a_device_is_its_button(void **state) {
    (void)state;
    plug(0);
    open_input();
    key(0, KEY_SPACE, 1, start_ns + 10 * MS);
    key(0, KEY_SPACE, 2, start_ns + 40 * MS); /* repeated by the kernel */
    key(0, KEY_A, 1, start_ns + 50 * MS);     /* nobody's */
    key(0, KEY_SPACE, 0, start_ns + 60 * MS);
    assert_true(wakes(70 * MS));
    assert_gesture(0, GN_GESTURE_PRESS, 10 * MS);
    assert_gesture(0, GN_GESTURE_CLICK, 60 * MS);
    assert_nothing();
    assert_false(wakes(70 * MS));
}

static void test_a_device_that_comes_later_is_heard(void **state) {
    (void)state;
    open_input(); /* not even the folder is there */
    assert_true(input->timer.due_ns == INT64_MAX);
    plug(3);
    assert_true(wakes(0));
    dispatch(0);
    plug(4);
    dispatch(0);
    key(4, KEY_LEFT, 1, start_ns + MS);
    key(3, KEY_RIGHT, 1, start_ns + 2 * MS);
    dispatch(5 * MS);
    struct gn_gesture_event event;
    int count = 0;
    for (; gn_input_next(input, &event); count++) assert_int_equal(event.gesture, GN_GESTURE_PRESS);
    assert_int_equal(count, 2);
}

static void test_a_device_that_goes_ends_what_it_held(void **state) {
    (void)state;
    plug(0);
    open_input();
    key(0, KEY_SPACE, 1, start_ns + MS);
    dispatch(2 * MS);
    assert_gesture(0, GN_GESTURE_PRESS, MS);
    unplug(0);
    dispatch(3 * MS);
    dispatch(100 * GN_NS_PER_S);
    assert_nothing();
    plug(0);
    dispatch(101 * GN_NS_PER_S);
    key(0, KEY_SPACE, 1, start_ns + 102 * GN_NS_PER_S);
    dispatch(102 * GN_NS_PER_S);
    assert_gesture(0, GN_GESTURE_PRESS, 102 * GN_NS_PER_S);
}

static void test_lost_events_of_a_device_are_healed(void **state) {
    (void)state;
    plug(0);
    open_input();
    key(0, KEY_SPACE, 1, start_ns + MS);
    send(0, EV_SYN, SYN_DROPPED, 0, start_ns + 2 * MS);
    send(0, EV_KEY, KEY_LEFT, 1, start_ns + 3 * MS); /* half of a report */
    send(0, EV_SYN, SYN_REPORT, 0, start_ns + 4 * MS);
    dispatch(5 * MS); /* the device has nothing down any more */
    assert_gesture(0, GN_GESTURE_PRESS, MS);
    assert_gesture(0, GN_GESTURE_CLICK, 4 * MS);
    assert_nothing();
}

static void test_a_keyboard_held_at_the_start_does_nothing(void **state) {
    (void)state;
    plug(0);
    keyboards[0].down[KEY_SPACE / 8] |= 1u << KEY_SPACE % 8;
    open_input();
    dispatch(5 * GN_NS_PER_S);
    assert_nothing();
    dispatch(31 * GN_NS_PER_S);
    assert_report("button \"next\": held for 30 s; ignored until released");
    key(0, KEY_SPACE, 0, start_ns + 32 * GN_NS_PER_S);
    dispatch(32 * GN_NS_PER_S);
    assert_nothing();
    key(0, KEY_SPACE, 1, start_ns + 33 * GN_NS_PER_S);
    dispatch(33 * GN_NS_PER_S);
    assert_gesture(0, GN_GESTURE_PRESS, 33 * GN_NS_PER_S);
}

static void test_devices_that_may_not_be_read_are_a_warning(void **state) {
    (void)state;
    plug(0);
    plug(1);
    keyboards[0].error = keyboards[1].error = EACCES;
    open_input();
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], "2 input devices cannot be read"));
    assert_non_null(strstr(warnings.text[0], "group input"));
    keyboards[0].error = 0; /* udev gives it to the group later */
    char path[96];
    snprintf(path, sizeof path, "%s/input/event0", folder);
    assert_int_equal(chmod(path, 0660), 0);
    dispatch(MS);
    key(0, KEY_SPACE, 1, start_ns + MS);
    dispatch(2 * MS);
    assert_gesture(0, GN_GESTURE_PRESS, MS);
}

static void test_more_devices_than_places_are_said_once(void **state) {
    (void)state;
    for (int i = 0; i < DEVICES; i++) plug(i);
    open_input();
    assert_report("at most 16 input devices");
    char text[GN_REPORT_SIZE];
    assert_false(gn_input_report(input, text, sizeof text));
    for (int i = 0; i < DEVICES; i++) /* those that were opened and closed again */
        if (keyboards[i].write_fd >= 0) close(keyboards[i].write_fd), keyboards[i].write_fd = -1;
}

/* ---- window, script ------------------------------------------------------------------------ */

static void test_keys_of_the_window_count_once_however_often_they_are_told(void **state) {
    (void)state;
    open_input();
    struct gn_key_event event = {.key = GN_KEY_SPACE, .down = true, .time_ns = start_ns + MS};
    gn_input_key(input, &event);
    gn_input_key(input, &event); /* repeated */
    assert_gesture(0, GN_GESTURE_PRESS, MS);
    assert_nothing();
    event.down = false;
    gn_input_key(input, &event);
    gn_input_key(input, &event);
    assert_gesture(0, GN_GESTURE_CLICK, MS);
    assert_nothing();
}

static void test_keys_make_chords_too(void **state) {
    (void)state;
    buttons[2].chord = "next prev";
    open_input();
    struct gn_key_event event = {.key = GN_KEY_SPACE, .down = true, .time_ns = start_ns + MS};
    gn_input_key(input, &event);
    event.key = GN_KEY_LEFT;
    event.time_ns += 30 * MS;
    gn_input_key(input, &event);
    assert_gesture(2, GN_GESTURE_CHORD, 31 * MS);
    assert_gesture(2, GN_GESTURE_PRESS, 31 * MS);
    assert_nothing();
}

static void write_script(const char *text) {
    static char path[96];
    snprintf(path, sizeof path, "%s/script", folder);
    FILE *file = fopen(path, "w");
    fputs(text, file);
    fclose(file);
    opts.script = path;
}

/* Each click is a press, by either of its keys; of a device that is no knob none is. */
static void test_a_knob_clicks(void **state) {
    (void)state;
    buttons[0].keys = "knob_right";
    buttons[1].keys = "knob_left";
    buttons[0].gestures = buttons[1].gestures = 1u << GN_GESTURE_PRESS;
    keyboards[0].is_knob = true;
    plug(0);
    plug(1);
    open_input();
    send(0, EV_REL, REL_DIAL, 1, start_ns + 10 * MS);
    send(0, EV_REL, REL_WHEEL_HI_RES, 120, start_ns + 10 * MS);
    send(0, EV_SYN, SYN_REPORT, 0, start_ns + 10 * MS);
    send(1, EV_REL, REL_DIAL, 1, start_ns + 10 * MS);
    send(1, EV_SYN, SYN_REPORT, 0, start_ns + 10 * MS);
    dispatch(20 * MS);
    assert_gesture(0, GN_GESTURE_PRESS, 10 * MS);
    assert_nothing();
    send(0, EV_REL, REL_X, -3, start_ns + 30 * MS);
    send(0, EV_SYN, SYN_REPORT, 0, start_ns + 30 * MS);
    dispatch(40 * MS);
    for (int i = 0; i < 3; i++) assert_gesture(1, GN_GESTURE_PRESS, 30 * MS);
    assert_nothing();
    send(0, EV_REL, REL_X, INT32_MIN, start_ns + 5000 * MS); /* a broken one */
    dispatch(5010 * MS);
    for (int i = 0; i < GN_GESTURE_RATE; i++) assert_gesture(1, GN_GESTURE_PRESS, 5000 * MS);
    assert_nothing();
    assert_false(wakes(10 * GN_NS_PER_S));
}

static void test_a_script_presses_buttons_and_keys(void **state) {
    (void)state;
    write_script("0.1 click next\n0.12 click left\n0.2 down next\n0.205 up next\n1 down next\n");
    open_input();
    assert_true(input->timer.due_ns == start_ns + 100 * MS);
    dispatch(10 * GN_NS_PER_S);
    assert_gesture(0, GN_GESTURE_PRESS, 100 * MS);
    assert_gesture(1, GN_GESTURE_PRESS, 120 * MS);
    assert_gesture(1, GN_GESTURE_CLICK, 120 * MS);
    assert_gesture(0, GN_GESTURE_CLICK, 160 * MS);
    assert_gesture(0, GN_GESTURE_PRESS, 1000 * MS); /* 5 ms were a spike */
    assert_gesture(0, GN_GESTURE_HOLD, 1820 * MS);
    assert_nothing();
}

static void test_a_script_knows_only_what_there_is(void **state) {
    (void)state;
    write_script("0.1 click next\n0.2 click nobody\n");
    assert_usage("script:2: unknown button or key \"nobody\"");
}

static void test_the_loop_wakes_up_for_timers(void **state) {
    (void)state;
    write_script("0.05 click next\n");
    start_ns = gn_clock_monotonic_ns();
    gn_loop_fake_clock(loop, NULL);
    open_input();
    assert_int_equal(gn_loop_step(loop, 0), 0);
    struct gn_gesture_event event;
    int steps = 0;
    bool clicked = false;
    while (!clicked && gn_loop_step(loop, start_ns + 5 * GN_NS_PER_S) > 0 && ++steps < 100) {
        while (gn_input_next(input, &event)) clicked |= event.gesture == GN_GESTURE_CLICK;
    }
    assert_true(clicked);
    assert_in_range(steps, 2, 8); /* down, pressed, up, clicked: it does not spin */
    assert_true(gn_clock_monotonic_ns() - start_ns >= 130 * MS);
    assert_int_equal(gn_loop_step(loop, 0), 0);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(test_what_is_said_wrongly_is_wrong_usage),
        TEST(test_without_anything_it_sleeps),
        TEST(test_a_key_of_a_device_is_its_button),
        TEST(test_a_device_that_comes_later_is_heard),
        TEST(test_a_device_that_goes_ends_what_it_held),
        TEST(test_lost_events_of_a_device_are_healed),
        TEST(test_a_keyboard_held_at_the_start_does_nothing),
        TEST(test_devices_that_may_not_be_read_are_a_warning),
        TEST(test_more_devices_than_places_are_said_once),
        TEST(test_keys_of_the_window_count_once_however_often_they_are_told),
        TEST(test_keys_make_chords_too),
        TEST(test_a_knob_clicks),
        TEST(test_a_script_presses_buttons_and_keys),
        TEST(test_a_script_knows_only_what_there_is),
        TEST(test_the_loop_wakes_up_for_timers),
    };
    return RUN(tests);
}
