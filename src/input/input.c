/* Readable descriptors only arm the one timer, which also has the earliest deadline. Its callback
 * reads everything first and advances time afterwards: events with kernel timestamps before now_ns
 * are in the buffers by then. */
#include "input/input.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "input/private.h"

#define NEVER INT64_MAX

static const struct gn_input_source *const sources[] = {
#define X(name) &gn_source_##name,
    GN_SOURCE_TABLE(X)
#undef X
};

/* ---- opening ------------------------------------------------------------------------------- */

/* Watches the device folders with inotify, as far as possible. */
static void watch_folders(struct gn_input *input) {
    const uint32_t events = IN_CREATE | IN_ATTRIB | IN_MOVED_TO | IN_DELETE | IN_ONLYDIR;
    if (input->folder_watch < 0)
        input->folder_watch = inotify_add_watch(input->notify.fd, input->lines.folder, events);
    if (input->devices_watch < 0 && input->opts.devices)
        input->devices_watch = inotify_add_watch(input->notify.fd, input->devices_folder, events);
}

static void on_folder_event(void *user, int64_t now_ns) {
    struct gn_input *input = user;
    input->folders_changed = true;
    input->timer.due_ns = now_ns;
}

/* ---- the timer ----------------------------------------------------------------------------- */

static void set_timer(struct gn_input *input) {
    int64_t due_ns = gn_gestures_deadline(&input->gestures);
    for (size_t i = 0; i < GN_SOURCE_COUNT; i++) {
        const int64_t its_ns = sources[i]->deadline ? sources[i]->deadline(input) : NEVER;
        if (its_ns < due_ns) due_ns = its_ns;
    }
    input->timer.due_ns = due_ns;
}

static void dispatch_input(void *user, int64_t now_ns);

struct gn_input *gn_input_open_in(const struct gn_input_world *world,
                                  const struct gn_input_opts *opts, int64_t now_ns,
                                  struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_input *input = gn_xalloc(1, sizeof *input);
    const char *folder = world->folder ? world->folder : "/dev";
    input->opts = *opts;
    input->lines.ops = world->gpio ? world->gpio : &gn_gpio_library;
    input->lines.context = world->gpio_context;
    input->lines.folder = folder;
    input->devices.ops = world->evdev ? world->evdev : &gn_evdev;
    input->devices.context = world->evdev_context;
    snprintf(input->devices_folder, sizeof input->devices_folder, "%s/input", folder);
    input->devices.folder = input->devices_folder;
    input->notify.fd = input->folder_watch = input->devices_watch = -1;
    input->poll_ns = NEVER;
    gn_devices_init(&input->devices);
    if (!gn_input_set_up(input, now_ns, err)) {
        gn_input_close(input);
        return NULL;
    }
    input->timer = (struct gn_timer){.call = dispatch_input, .user = input};
    gn_loop_add_timer(opts->loop, &input->timer);
    bool watches = opts->devices; /* the folders of devices */
    for (int i = 0; i < input->lines.count; i++)
        watches |= input->lines.lines[i].wanted && input->lines.ops->library;
    if (watches) {
        input->notify = (struct gn_watch){.fd = inotify_init1(IN_CLOEXEC | IN_NONBLOCK),
                                          .events = EPOLLIN,
                                          .call = on_folder_event,
                                          .user = input};
        if (input->notify.fd >= 0 && gn_loop_add(opts->loop, &input->notify)) watch_folders(input);
    }
    for (size_t i = 0; i < GN_SOURCE_COUNT; i++)
        if (sources[i]->open) sources[i]->open(input, world, now_ns, warnings);
    set_timer(input);
    return input;
}

struct gn_input *gn_input_open(const struct gn_input_opts *opts, int64_t now_ns,
                               struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_input_world world = {0};
    return gn_input_open_in(&world, opts, now_ns, warnings, err);
}

void gn_input_close(struct gn_input *input) {
    if (!input) return;
    for (size_t i = GN_SOURCE_COUNT; i-- > 0;)
        if (sources[i]->close) sources[i]->close(input);
    gn_loop_remove(&input->notify);
    gn_loop_remove_timer(&input->timer);
    if (input->notify.fd >= 0) close(input->notify.fd);
    free(input);
}

/* ---- dispatching --------------------------------------------------------------------------- */

static void read_folder_events(struct gn_input *input, int64_t now_ns) {
    _Alignas(struct inotify_event) char buffer[4096];
    bool chips = false, devices = false; /* changed */
    input->folders_changed = false;
    for (ssize_t size; (size = read(input->notify.fd, buffer, sizeof buffer)) > 0;)
        for (ssize_t at = 0; at < size;) {
            const struct inotify_event *event = (const struct inotify_event *)(buffer + at);
            const char *name = event->len ? event->name : "";
            at += (ssize_t)(sizeof *event + event->len);
            if (event->mask & IN_Q_OVERFLOW) chips = devices = true;
            if (event->wd == input->devices_watch) {
                if (event->mask & IN_IGNORED) input->devices_watch = -1;
                devices |= strncmp(name, "event", 5) == 0 && !(event->mask & IN_DELETE);
            } else if (event->wd == input->folder_watch) {
                chips |= strncmp(name, "gpiochip", 8) == 0;
                devices |= strcmp(name, "input") == 0;
            }
        }
    if (chips) gn_lines_changed(&input->lines, now_ns);
    if (!devices || !input->opts.devices) return;
    watch_folders(input);
    gn_devices_search(&input->devices, now_ns);
}

static void report_notes(struct gn_input *input) {
    static const char *const texts[] = {
        [GN_NOTE_STUCK] = "held for 30 s; ignored until released",
        [GN_NOTE_NOISY] = "its line does not settle; check its pull resistor and wire length",
        [GN_NOTE_FAST] = "more than 20 gestures in a second; the rest is ignored",
    };
    struct gn_gesture_note note;
    while (gn_gestures_note(&input->gestures, &note))
        gn_report(&input->reports, "button \"%s\": %s", input->opts.buttons[note.button].name,
                  texts[note.kind]);
    const unsigned dropped = input->gestures.dropped - input->reported_dropped;
    if (dropped && input->gestures.queue_begin == input->gestures.queue_end) {
        gn_report(&input->reports, "buttons: %u gestures dropped, queue full", dropped);
        input->reported_dropped += dropped;
    }
}

static void dispatch_input(void *user, int64_t now_ns) {
    struct gn_input *input = user;
    for (size_t i = 0; i < GN_SOURCE_COUNT; i++)
        if (sources[i]->read) sources[i]->read(input, now_ns);
    if (input->folders_changed) read_folder_events(input, now_ns);
    for (size_t i = 0; i < GN_SOURCE_COUNT; i++)
        if (sources[i]->step) sources[i]->step(input, now_ns);
    gn_gestures_step(&input->gestures, now_ns);
    for (size_t i = 0; i < GN_SOURCE_COUNT; i++)
        if (sources[i]->check) sources[i]->check(input, now_ns);
    report_notes(input);
    set_timer(input);
}

void gn_input_key(struct gn_input *input, const struct gn_key_event *event) {
    gn_keys_set(&input->keys, &input->window, event->key, event->down, event->time_ns);
    set_timer(input);
}

bool gn_input_next(struct gn_input *input, struct gn_gesture_event *out) {
    return gn_gestures_next(&input->gestures, out);
}

struct gn_input_moves gn_input_take_moves(struct gn_input *input, int64_t now_ns) {
    struct gn_devices *devices = &input->devices;
    const struct gn_input_moves moves = {.glass = devices->glass,
                                         .mouse = devices->mouse,
                                         .held = gn_devices_are_held(devices, now_ns)};
    devices->glass = devices->mouse = (struct gn_touch_moves){0};
    return moves;
}

void gn_input_suppress_taps(struct gn_input *input, bool suppress) {
    input->devices.suppresses_taps = suppress;
}

int gn_input_pointers(const struct gn_input *input) { return gn_devices_pointers(&input->devices); }

bool gn_input_report(struct gn_input *input, char *out, size_t size) {
    report_notes(input);
    return gn_report_next(&input->reports, out, size);
}
