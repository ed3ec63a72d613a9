/* linux/input.h, Documentation/input/input.rst, event-codes.rst and multi-touch-protocol.rst. */
#include <errno.h>
#include <fcntl.h>
#include <linux/input.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "input/devices.h"
#include "input/touch_kind.h"

_Static_assert(KEY_CNT == GN_KEY_COUNT, "keys are numbered as the kernel does");

static void put(uint8_t *bits, unsigned code) { bits[code / 8] |= (uint8_t)(1u << code % 8); }

/* ---- what a device is ---- */

static void read_axis(int fd, unsigned code, struct gn_touch_axis *out) {
    struct input_absinfo info = {0};
    if (ioctl(fd, EVIOCGABS(code), &info) < 0) return;
    *out = (struct gn_touch_axis){info.minimum, info.maximum, info.resolution};
}

static int read_abilities(int fd, struct gn_touch_abilities *out) {
    if (ioctl(fd, EVIOCGBIT(EV_KEY, sizeof out->keys), out->keys) < 0) return errno;
    (void)ioctl(fd, EVIOCGBIT(EV_ABS, sizeof out->abs), out->abs);
    (void)ioctl(fd, EVIOCGBIT(EV_REL, sizeof out->rel), out->rel);
    (void)ioctl(fd, EVIOCGPROP(sizeof out->props), out->props);
    return 0;
}

static void find_touch(int fd, const struct gn_touch_abilities *a, enum gn_pointers wanted,
                       struct gn_touch_opts *out) {
    const enum gn_touch_kind kind = gn_touch_kind(a);
    *out = (struct gn_touch_opts){0};
    if (wanted == GN_POINTERS_NONE || (wanted == GN_POINTERS_TOUCH && kind != GN_TOUCH_SCREEN))
        return;
    out->kind = kind;
    out->has_slots = kind == GN_TOUCH_SCREEN && gn_touch_has_slots(a);
    if (kind != GN_TOUCH_SCREEN && kind != GN_TOUCH_TABLET) return;
    read_axis(fd, out->has_slots ? ABS_MT_POSITION_X : ABS_X, &out->x);
    read_axis(fd, out->has_slots ? ABS_MT_POSITION_Y : ABS_Y, &out->y);
}

/* ---- opening ---- */

static void set_mask(int fd, uint32_t type, const uint8_t *bits, uint32_t size) {
    const struct input_mask mask = {.type = type, .codes_size = size, .codes_ptr = (uintptr_t)bits};
    (void)ioctl(fd, EVIOCSMASK, &mask); /* kernels before 4.4 lack it */
}

/* Only what is wanted wakes us: not typing, a pressure, or a pointer that is not wanted. */
static void set_masks(int fd, const uint8_t *bound, const struct gn_evdev_found *found) {
    const struct gn_touch_opts *touch = &found->touch;
    struct gn_touch_abilities want = {0};
    uint8_t types[EV_CNT / 8] = {0};
    const enum gn_touch_kind kind = touch->kind;
    memcpy(want.keys, bound, sizeof want.keys);
    if (kind == GN_TOUCH_SCREEN) put(want.keys, BTN_TOUCH);
    if (kind == GN_TOUCH_TABLET || kind == GN_TOUCH_MOUSE) {
        put(want.keys, BTN_LEFT);
        put(want.keys, BTN_RIGHT);
        put(want.keys, BTN_MIDDLE);
        put(want.rel, REL_WHEEL);
    }
    if (kind == GN_TOUCH_MOUSE) {
        put(want.rel, REL_X);
        put(want.rel, REL_Y);
    } else if (touch->has_slots) {
        put(want.abs, ABS_MT_SLOT);
        put(want.abs, ABS_MT_TRACKING_ID);
        put(want.abs, ABS_MT_POSITION_X);
        put(want.abs, ABS_MT_POSITION_Y);
    } else if (kind) {
        put(want.abs, ABS_X);
        put(want.abs, ABS_Y);
    }
    if (found->is_knob) memset(want.rel, 0xff, sizeof want.rel);
    put(types, EV_SYN);
    put(types, EV_KEY);
    if (kind) put(types, EV_ABS);
    if (kind || found->is_knob) put(types, EV_REL);
    set_mask(fd, EV_KEY, want.keys, sizeof want.keys);
    set_mask(fd, EV_ABS, want.abs, sizeof want.abs);
    set_mask(fd, EV_REL, want.rel, sizeof want.rel);
    set_mask(fd, EV_SYN, types, sizeof types);
}

static int open_device(void *context, const char *path, const struct gn_evdev_wish *wish,
                       struct gn_evdev_found *out) {
    (void)context;
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return errno;
    int clock = CLOCK_MONOTONIC;
    bool any = false;
    struct gn_touch_abilities a = {0};
    int error = read_abilities(fd, &a);
    if (gn_touch_is_knob(&a)) {
        put(a.keys, GN_KEY_KNOB_LEFT);
        put(a.keys, GN_KEY_KNOB_RIGHT);
    }
    memcpy(out->has, a.keys, sizeof out->has);
    out->is_knob = gn_touch_is_knob(&a) && (gn_key_is_down(wish->bound, GN_KEY_KNOB_LEFT) ||
                                            gn_key_is_down(wish->bound, GN_KEY_KNOB_RIGHT));
    for (int i = 0; i < GN_KEY_BYTES; i++) any |= a.keys[i] & wish->bound[i];
    find_touch(fd, &a, wish->pointers, &out->touch);
    if (!error && !any && !out->touch.kind) error = ENOTSUP;
    if (!error && ioctl(fd, EVIOCSCLOCKID, &clock)) error = errno;
    if (error) {
        close(fd);
        return error;
    }
    if (ioctl(fd, EVIOCGNAME(sizeof out->name - 1), out->name) < 0) out->name[0] = '\0';
    set_masks(fd, wish->bound, out);
    out->fd = fd;
    return 0;
}

/* ---- states ---- */

static int read_state(void *context, int fd, uint8_t *bits) {
    (void)context;
    return ioctl(fd, EVIOCGKEY(GN_KEY_BYTES), bits) < 0 ? errno : 0;
}

static int32_t read_value(int fd, unsigned code) {
    struct input_absinfo info = {0};
    return ioctl(fd, EVIOCGABS(code), &info) < 0 ? 0 : info.value;
}

static int read_slots(int fd, unsigned code, int32_t *out) {
    struct {
        uint32_t code;
        int32_t values[GN_TOUCH_SLOTS];
    } request = {.code = code};
    if (ioctl(fd, EVIOCGMTSLOTS(sizeof request), &request) < 0) return errno;
    memcpy(out, request.values, sizeof request.values);
    return 0;
}

static int read_touch(void *context, int fd, const struct gn_touch_opts *opts,
                      struct gn_touch_state *out) {
    uint8_t keys[GN_KEY_BYTES] = {0};
    struct input_absinfo slots = {0};
    *out = (struct gn_touch_state){0};
    if (opts->has_slots) {
        int error = read_slots(fd, ABS_MT_TRACKING_ID, out->id);
        if (!error) error = read_slots(fd, ABS_MT_POSITION_X, out->x);
        if (!error) error = read_slots(fd, ABS_MT_POSITION_Y, out->y);
        if (!error && ioctl(fd, EVIOCGABS(ABS_MT_SLOT), &slots) < 0) error = errno;
        out->slot = slots.value;
        /* the kernel leaves those untouched that the device does not have */
        for (int i = 0; i < GN_TOUCH_SLOTS; i++)
            if (i > slots.maximum) out->id[i] = -1;
        return error;
    }
    const int error = read_state(context, fd, keys);
    const bool screen = opts->kind == GN_TOUCH_SCREEN;
    out->x[0] = read_value(fd, ABS_X);
    out->y[0] = read_value(fd, ABS_Y);
    out->buttons[0] = gn_key_is_down(keys, screen ? BTN_TOUCH : BTN_LEFT);
    out->buttons[1] = !screen && gn_key_is_down(keys, BTN_RIGHT);
    out->buttons[2] = !screen && gn_key_is_down(keys, BTN_MIDDLE);
    return error;
}

const struct gn_evdev_ops gn_evdev = {
    .open = open_device, .state = read_state, .touch = read_touch};
