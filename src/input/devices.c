#include "input/devices.h"

#include <dirent.h>
#include <errno.h>
#include <linux/input.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "input/private.h"

void gn_devices_init(struct gn_devices *devices) {
    for (int i = 0; i < GN_DEVICES_MAX; i++) devices->list[i] = (struct gn_device){.fd = -1};
}

static void lose_device(struct gn_devices *devices, struct gn_device *d, int64_t now_ns) {
    gn_loop_remove(&d->watch);
    close(d->fd);
    gn_keys_lose(devices->keys, &d->keys, now_ns);
    *d = (struct gn_device){.fd = -1};
}

/* ---- finding devices ----------------------------------------------------------------------- */

static void on_readable(void *user, int64_t now_ns) {
    struct gn_device *d = user;
    d->readable = true;
    d->all->timer->due_ns = now_ns;
}

/* first: keys that are down were pressed before the device was opened. */
static void read_state(struct gn_devices *devices, struct gn_device *d, bool first,
                       int64_t time_ns) {
    uint8_t bits[GN_KEY_BYTES] = {0};
    struct gn_touch_state touch = {0};
    if (d->touch.opts.kind &&
        devices->ops->touch(devices->context, d->fd, &d->touch.opts, &touch) == 0)
        gn_touch_set(&d->touch, &touch, time_ns);
    if (devices->ops->state(devices->context, d->fd, bits) == 0)
        gn_keys_set_all(devices->keys, &d->keys, bits, first, time_ns);
}

static void add_device(struct gn_devices *devices, const char *path, int64_t now_ns) {
    const struct gn_evdev_wish wish = {.bound = devices->keys->bound,
                                       .pointers = devices->pointers};
    struct gn_evdev_found found = {.fd = -1};
    struct gn_device *d = NULL;
    const int error = devices->ops->open(devices->context, path, &wish, &found);
    devices->denied += error == EACCES || error == EPERM;
    if (error) return;
    for (int i = 0; i < GN_DEVICES_MAX && !d; i++)
        if (devices->list[i].fd < 0) d = &devices->list[i];
    if (!d) {
        close(found.fd);
        if (!devices->full)
            gn_report(devices->reports, "%s and others are not read: at most %d input devices",
                      path, GN_DEVICES_MAX);
        devices->full = true;
        return;
    }
    *d = (struct gn_device){.fd = found.fd, .all = devices};
    snprintf(d->path, sizeof d->path, "%s", path);
    memcpy(d->has, found.has, sizeof d->has);
    d->is_knob = found.is_knob;
    if (found.touch.kind == GN_TOUCH_SCREEN) found.touch.rotate_deg = devices->touch_rotate_deg;
    if (found.touch.kind) gn_touch_init(&d->touch, &found.touch);
    d->watch = (struct gn_watch){.fd = d->fd, .events = EPOLLIN, .call = on_readable, .user = d};
    if (!gn_loop_add(devices->loop, &d->watch)) {
        close(d->fd);
        d->fd = -1;
        return;
    }
    read_state(devices, d, true, now_ns);
}

void gn_devices_search(struct gn_devices *devices, int64_t now_ns) {
    DIR *open = opendir(devices->folder);
    devices->denied = 0;
    for (const struct dirent *entry; open && (entry = readdir(open));) {
        char path[64];
        if (strncmp(entry->d_name, "event", 5) != 0 ||
            snprintf(path, sizeof path, "%s/%s", devices->folder, entry->d_name) >=
                (int)sizeof path)
            continue;
        bool is_open = false;
        for (int i = 0; i < GN_DEVICES_MAX; i++)
            is_open |= devices->list[i].fd >= 0 && strcmp(devices->list[i].path, path) == 0;
        if (!is_open) add_device(devices, path, now_ns);
    }
    if (open) closedir(open);
}

bool gn_devices_have(const struct gn_devices *devices, unsigned key) {
    for (int i = 0; i < GN_DEVICES_MAX; i++)
        if (devices->list[i].fd >= 0 && gn_key_is_down(devices->list[i].has, key)) return true;
    return false;
}

bool gn_devices_are_held(const struct gn_devices *devices, int64_t now_ns) {
    for (int i = 0; i < GN_DEVICES_MAX; i++)
        if (devices->list[i].fd >= 0 && gn_touch_is_held(&devices->list[i].touch, now_ns))
            return true;
    return false;
}

int gn_devices_pointers(const struct gn_devices *devices) {
    int count = 0;
    for (int i = 0; i < GN_DEVICES_MAX; i++)
        count += devices->list[i].fd >= 0 && devices->list[i].touch.opts.kind;
    return count;
}

/* ---- reading devices ----------------------------------------------------------------------- */

/* Clicks of a knob at once, of a high-resolution one none: those come as clicks, too. */
static void turn_knob(struct gn_devices *devices, unsigned axis, int32_t clicks, int64_t time_ns) {
    enum { MOST = 64 };
    const unsigned key = clicks < 0 ? GN_KEY_KNOB_LEFT : GN_KEY_KNOB_RIGHT;
    if (axis == REL_WHEEL_HI_RES || axis == REL_HWHEEL_HI_RES) return;
    const int64_t count = clicks < 0 ? -(int64_t)clicks : clicks;
    for (int64_t i = 0; i < count && i < MOST; i++) gn_keys_click(devices->keys, key, time_ns);
}

static void take_event(struct gn_devices *devices, struct gn_device *d, const struct input_event *e,
                       int64_t time_ns) {
    if (e->type == EV_SYN && e->code == SYN_DROPPED) d->dropped = true;
    if (e->type == EV_SYN && e->code == SYN_REPORT && d->dropped) {
        d->dropped = false; /* events were lost: reads the state of all keys and fingers */
        read_state(devices, d, false, time_ns);
        return;
    }
    const bool repeats = e->type == EV_KEY && (e->value < 0 || e->value > 1); /* autorepeat */
    if (d->dropped || repeats) return;
    if (e->type == EV_KEY) gn_keys_set(devices->keys, &d->keys, e->code, e->value, time_ns);
    if (e->type == EV_REL && d->is_knob) turn_knob(devices, e->code, e->value, time_ns);
    if (!d->touch.opts.kind) return;
    const bool taps = gn_touch_event(&d->touch, e->type, e->code, e->value, time_ns);
    if (devices->suppresses_taps)
        d->touch.is_tap = false;
    else if (taps)
        gn_keys_click(devices->keys, GN_KEY_TAP, time_ns);
}

/* Reads all pending events. Returns true if the device is gone. */
static bool read_device(struct gn_devices *devices, struct gn_device *d, int64_t now_ns) {
    struct input_event events[64];
    d->readable = false;
    for (int round = 0; round < 8; round++) {
        const ssize_t size = read(d->fd, events, sizeof events);
        if (size < 0 && (errno == EAGAIN || errno == EINTR)) return false;
        if (size <= 0) {
            lose_device(devices, d, now_ns);
            return true;
        }
        const size_t count = (size_t)size / sizeof *events;
        for (size_t i = 0; i < count; i++) {
            const struct input_event *e = &events[i];
            const int64_t time_ns = gn_gesture_sane_time_ns(
                (int64_t)e->input_event_sec * GN_NS_PER_S + (int64_t)e->input_event_usec * 1000,
                now_ns);
            take_event(devices, d, e, time_ns);
        }
    }
    return false;
}

/* ---- the source ---- */

static void open_devices(struct gn_input *input, const struct gn_input_world *world, int64_t now_ns,
                         struct gn_warnings *warnings) {
    (void)world;
    input->devices.loop = input->opts.loop;
    input->devices.timer = &input->timer;
    input->devices.reports = &input->reports;
    input->devices.keys = &input->keys;
    input->devices.pointers = input->opts.pointers;
    input->devices.touch_rotate_deg = input->opts.touch_rotate_deg;
    if (!input->opts.devices) return;
    gn_devices_search(&input->devices, now_ns);
    if (input->folder_watch < 0) input->poll_ns = now_ns + 2 * GN_NS_PER_S;
    if (input->devices.denied)
        gn_warn(warnings,
                "%d input devices cannot be read, permission denied; add the user to group "
                "input (sudo usermod -aG input USER) and log in again",
                input->devices.denied);
}

static void read_devices(struct gn_input *input, int64_t now_ns) {
    struct gn_devices *devices = &input->devices;
    bool gone = false;
    for (int i = 0; i < GN_DEVICES_MAX; i++) {
        struct gn_device *d = &devices->list[i];
        if (!d->readable) continue;
        gone |= read_device(devices, d, now_ns);
        const bool is_mouse = d->touch.opts.kind == GN_TOUCH_MOUSE;
        gn_touch_add(is_mouse ? &devices->mouse : &devices->glass, &d->touch.moves);
        d->touch.moves = (struct gn_touch_moves){0};
    }
    if (gone) gn_devices_search(devices, now_ns);
}

static void step_devices(struct gn_input *input, int64_t now_ns) {
    if (input->poll_ns > now_ns) return;
    input->poll_ns = now_ns + 2 * GN_NS_PER_S;
    gn_devices_search(&input->devices, now_ns);
}

static int64_t devices_deadline(const struct gn_input *input) { return input->poll_ns; }

static void close_devices(struct gn_input *input) {
    struct gn_devices *devices = &input->devices;
    for (int i = 0; devices->keys && i < GN_DEVICES_MAX; i++)
        if (devices->list[i].fd >= 0)
            lose_device(devices, &devices->list[i], devices->keys->gestures->now_ns);
}

const struct gn_input_source gn_source_devices = {
    .open = open_devices,
    .read = read_devices,
    .step = step_devices,
    .deadline = devices_deadline,
    .close = close_devices,
};
