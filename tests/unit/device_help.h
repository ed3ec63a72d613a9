/* An input of devices that are pipes, in a folder of the test's, by a clock of the test's. */
#ifndef GN_TESTS_UNIT_DEVICE_HELP_H
#define GN_TESTS_UNIT_DEVICE_HELP_H

#include <errno.h>
#include <fcntl.h>
#include <linux/input.h>
#include <stdio.h>
#include <stdlib.h>
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
    bool is_knob;
    uint8_t down[GN_KEY_BYTES];
    struct gn_touch_opts glass; /* zeroed: it is a keyboard only */
    struct gn_touch_state fingers;
} keyboards[DEVICES];
static char folder[64];

static inline int number_of(const char *path) {
    return atoi(strrchr(path, '/') + strlen("/event"));
}

static inline int open_keyboard(void *context, const char *path, const struct gn_evdev_wish *wish,
                                struct gn_evdev_found *out) {
    (void)context;
    int ends[2];
    const int i = number_of(path);
    bool any = wish->pointers && keyboards[i].glass.kind;
    for (int k = 0; k < GN_KEY_BYTES; k++) any |= wish->bound[k];
    if (keyboards[i].error) return keyboards[i].error;
    if (!any) return ENOTSUP;
    if (pipe2(ends, O_NONBLOCK | O_CLOEXEC)) return errno;
    keyboards[i].write_fd = ends[1];
    out->fd = ends[0];
    memcpy(out->has, wish->bound, GN_KEY_BYTES);
    out->is_knob = keyboards[i].is_knob;
    if (wish->pointers) out->touch = keyboards[i].glass;
    return 0;
}

static int only_keyboard; /* the state is asked by descriptor: of this one */

static inline int read_state(void *context, int fd, uint8_t *bits) {
    (void)context;
    (void)fd;
    memcpy(bits, keyboards[only_keyboard].down, GN_KEY_BYTES);
    return 0;
}

static inline int read_fingers(void *context, int fd, const struct gn_touch_opts *glass,
                               struct gn_touch_state *out) {
    (void)context;
    (void)fd;
    assert_int_equal(glass->kind, keyboards[only_keyboard].glass.kind);
    *out = keyboards[only_keyboard].fingers;
    return 0;
}
static const struct gn_evdev_ops evdev = {
    .open = open_keyboard, .state = read_state, .touch = read_fingers};

static inline void plug(int i) {
    char path[96];
    snprintf(path, sizeof path, "%s/input", folder);
    mkdir(path, 0700);
    snprintf(path, sizeof path, "%s/input/event%d", folder, i);
    close(open(path, O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
}

static inline void unplug(int i) {
    char path[96];
    snprintf(path, sizeof path, "%s/input/event%d", folder, i);
    unlink(path);
    if (keyboards[i].write_fd >= 0) close(keyboards[i].write_fd);
    keyboards[i].write_fd = -1;
}

static inline void send(int i, int type, int code, int value, int64_t time_ns) {
    struct input_event event = {.type = (uint16_t)type, .code = (uint16_t)code, .value = value};
    event.input_event_sec = time_ns / GN_NS_PER_S;
    event.input_event_usec = time_ns % GN_NS_PER_S / 1000;
    assert_int_equal(write(keyboards[i].write_fd, &event, sizeof event), sizeof event);
}

static inline void key(int i, int code, int value, int64_t time_ns) {
    send(i, EV_KEY, code, value, time_ns);
    send(i, EV_SYN, SYN_REPORT, 0, time_ns);
}

/* ---- the input ----------------------------------------------------------------------------- */

static struct gn_button_opts buttons[3];
static struct gn_input_opts opts;
static struct gn_err err;
static struct gn_warnings warnings;
static int64_t start_ns, clock_ns; /* of the test; the loop's */

static inline int setup(void **state) {
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

static inline int teardown(void **state) {
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

static inline void open_with(const int *terminal) {
    const struct gn_input_world world = {
        .gpio = &fake_gpio_none, .evdev = &evdev, .folder = folder, .terminal = terminal};
    opts.loop = loop;
    input = gn_input_open_in(&world, &opts, start_ns, &warnings, &err);
}

static inline void open_input(void) {
    open_with(NULL);
    if (!input) fail_msg("%s", err.text);
}

static inline void dispatch(int64_t after_ns) {
    clock_ns = start_ns + after_ns;
    gn_loop_step(loop, clock_ns);
}

static inline void assert_gesture(int button, enum gn_gesture gesture, int64_t after_ns) {
    struct gn_gesture_event event;
    if (!gn_input_next(input, &event)) fail_msg("no %s", gn_gesture_names[gesture]);
    if (event.button != button || event.gesture != gesture || event.time_ns != start_ns + after_ns)
        fail_msg("%d %s at %g ms, not %d %s at %g", event.button, gn_gesture_names[event.gesture],
                 (double)(event.time_ns - start_ns) / 1e6, button, gn_gesture_names[gesture],
                 (double)after_ns / 1e6);
}

/* Was there anything to do? */
static inline bool wakes(int64_t after_ns) {
    clock_ns = start_ns + after_ns;
    return gn_loop_step(loop, clock_ns) > 0;
}

#endif
