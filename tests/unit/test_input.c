/* An input as a whole: keys of devices that are pipes, of a terminal that is a pseudo-terminal, of
 * the window and of scripts; by a clock of the test, and by the real one. */
#include "input/input.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/input.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/clock.h"
#include "unit/gpio_fake.h"
#include "unit/input_help.h"

#define MS INT64_C(1000000)
enum { DEVICES = 20 };

/* ---- keyboards that are pipes -------------------------------------------------------------- */

static struct {
    int write_fd;
    int error; /* of open */
    uint8_t down[GN_KEY_BYTES];
    struct gn_touch_opts glass; /* zeroed: it is a keyboard only */
    struct gn_touch_state fingers;
} keyboards[DEVICES];
static char folder[64];

static int number_of(const char *path) { return atoi(strrchr(path, '/') + strlen("/event")); }

static int open_keyboard(void *context, const char *path, const struct gn_evdev_wish *wish,
                         struct gn_evdev_found *out) {
    (void)context;
    int ends[2];
    const int i = number_of(path);
    if (keyboards[i].error) return keyboards[i].error;
    if (pipe2(ends, O_NONBLOCK | O_CLOEXEC)) return errno;
    keyboards[i].write_fd = ends[1];
    out->fd = ends[0];
    memcpy(out->has, wish->bound, GN_KEY_BYTES);
    if (wish->pointers) out->touch = keyboards[i].glass;
    return 0;
}

static int only_keyboard; /* the state is asked by descriptor: of this one */

static int read_state(void *context, int fd, uint8_t *bits) {
    (void)context;
    (void)fd;
    memcpy(bits, keyboards[only_keyboard].down, GN_KEY_BYTES);
    return 0;
}

static int read_fingers(void *context, int fd, const struct gn_touch_opts *glass,
                        struct gn_touch_state *out) {
    (void)context;
    (void)fd;
    assert_int_equal(glass->kind, keyboards[only_keyboard].glass.kind);
    *out = keyboards[only_keyboard].fingers;
    return 0;
}
static const struct gn_evdev_ops evdev = {
    .open = open_keyboard, .state = read_state, .touch = read_fingers};

static void plug(int i) {
    char path[96];
    snprintf(path, sizeof path, "%s/input", folder);
    mkdir(path, 0700);
    snprintf(path, sizeof path, "%s/input/event%d", folder, i);
    close(open(path, O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
}

static void unplug(int i) {
    char path[96];
    snprintf(path, sizeof path, "%s/input/event%d", folder, i);
    unlink(path);
    if (keyboards[i].write_fd >= 0) close(keyboards[i].write_fd);
    keyboards[i].write_fd = -1;
}

static void send(int i, int type, int code, int value, int64_t time_ns) {
    struct input_event event = {.type = (uint16_t)type, .code = (uint16_t)code, .value = value};
    event.input_event_sec = time_ns / GN_NS_PER_S;
    event.input_event_usec = time_ns % GN_NS_PER_S / 1000;
    assert_int_equal(write(keyboards[i].write_fd, &event, sizeof event), sizeof event);
}

static void key(int i, int code, int value, int64_t time_ns) {
    send(i, EV_KEY, code, value, time_ns);
    send(i, EV_SYN, SYN_REPORT, 0, time_ns);
}

/* ---- the input ----------------------------------------------------------------------------- */

static struct gn_button_opts buttons[3];
static struct gn_input_opts opts;
static struct gn_err err;
static struct gn_warnings warnings;
static int64_t start_ns, clock_ns; /* of the test; the loop's */

static int setup(void **state) {
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/gnomon-XXXXXX");
    assert_non_null(mkdtemp(folder));
    memset(keyboards, 0, sizeof keyboards);
    for (int i = 0; i < DEVICES; i++) keyboards[i].write_fd = -1;
    only_keyboard = 0;
    const unsigned gestures = 1u << GN_GESTURE_PRESS | 1u << GN_GESTURE_CLICK |
                              1u << GN_GESTURE_HOLD | 1u << GN_GESTURE_CHORD;
    buttons[0] =
        (struct gn_button_opts){.name = "next", .keys = "space Right", .gestures = gestures};
    buttons[1] = (struct gn_button_opts){.name = "prev", .keys = "left esc", .gestures = gestures};
    buttons[2] = (struct gn_button_opts){.name = "both", .gestures = gestures};
    opts = (struct gn_input_opts){.buttons = buttons, .button_count = 3, .devices = true};
    memset(&err, 0, sizeof err);
    memset(&warnings, 0, sizeof warnings);
    start_ns = clock_ns = 1000 * GN_NS_PER_S;
    loop = gn_loop_open(&err);
    gn_loop_fake_clock(loop, &clock_ns);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    char path[96];
    gn_input_close(input);
    input = NULL;
    gn_loop_close(loop);
    for (int i = 0; i < DEVICES; i++) unplug(i);
    snprintf(path, sizeof path, "%s/input", folder);
    rmdir(path);
    snprintf(path, sizeof path, "%s/script", folder);
    unlink(path);
    return rmdir(folder);
}

static void open_with(const int *terminal) {
    const struct gn_input_world world = {
        .gpio = &fake_gpio_none, .evdev = &evdev, .folder = folder, .terminal = terminal};
    opts.loop = loop;
    input = gn_input_open_in(&world, &opts, start_ns, &warnings, &err);
}

static void open_input(void) {
    open_with(NULL);
    if (!input) fail_msg("%s", err.text);
}

static void dispatch(int64_t after_ns) {
    clock_ns = start_ns + after_ns;
    gn_loop_step(loop, clock_ns);
}

static void assert_gesture(int button, enum gn_gesture gesture, int64_t after_ns) {
    struct gn_gesture_event event;
    if (!gn_input_next(input, &event)) fail_msg("no %s", gn_gesture_names[gesture]);
    if (event.button != button || event.gesture != gesture || event.time_ns != start_ns + after_ns)
        fail_msg("%d %s at %g ms, not %d %s at %g", event.button, gn_gesture_names[event.gesture],
                 (double)(event.time_ns - start_ns) / 1e6, button, gn_gesture_names[gesture],
                 (double)after_ns / 1e6);
}

/* Was there anything to do? */
static bool wakes(int64_t after_ns) {
    clock_ns = start_ns + after_ns;
    return gn_loop_step(loop, clock_ns) > 0;
}

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

/* ---- touch screens -------------------------------------------------------------------------- */

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
        TEST(test_a_tap_is_a_key_and_a_drag_is_a_move),
        TEST(test_glass_that_is_pulled_out_holds_nothing),
        TEST(test_a_finger_from_before_and_lost_events_do_not_tap),
        TEST(test_touches_that_are_not_wanted_are_not_read),
        TEST(test_a_key_of_a_device_is_its_button),
        TEST(test_a_device_that_comes_later_is_heard),
        TEST(test_a_device_that_goes_ends_what_it_held),
        TEST(test_lost_events_of_a_device_are_healed),
        TEST(test_a_keyboard_held_at_the_start_does_nothing),
        TEST(test_devices_that_may_not_be_read_are_a_warning),
        TEST(test_more_devices_than_places_are_said_once),
        TEST(test_keys_of_the_window_count_once_however_often_they_are_told),
        TEST(test_keys_make_chords_too),
        TEST(test_a_script_presses_buttons_and_keys),
        TEST(test_a_script_knows_only_what_there_is),
        TEST(test_the_loop_wakes_up_for_timers),
    };
    return RUN(tests);
}
