/* One epoll holds everything, one timer the earliest of all deadlines. A call of dispatch first
 * takes what there is to read and only then lets time pass: what the kernel has stamped before
 * now_ns is in its buffers by then. */
#include "input/input.h"

#include <errno.h>
#include <linux/kd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "input/private.h"

#define NEVER INT64_MAX

enum kind { TIMER, NOTIFY, LINE, DEVICE, TERMINAL };
enum { READY_MAX = 64 };

static uint64_t tag(enum kind kind) { return (uint64_t)kind << 32; }

/* ---- opening ------------------------------------------------------------------------------- */

static bool add(struct gn_input *input, int fd, enum kind kind) {
    struct epoll_event event = {.events = EPOLLIN, .data.u64 = tag(kind)};
    return fd >= 0 && epoll_ctl(input->epoll, EPOLL_CTL_ADD, fd, &event) == 0;
}

static void fill_world(struct gn_input *input, const struct gn_input_world *world) {
    const char *folder = world->folder ? world->folder : "/dev";
    input->lines.ops = world->gpio ? world->gpio : &gn_gpio_library;
    input->lines.context = world->gpio_context;
    input->lines.folder = folder;
    input->devices.ops = world->evdev ? world->evdev : &gn_evdev;
    input->devices.context = world->evdev_context;
    snprintf(input->devices_folder, sizeof input->devices_folder, "%s/input", folder);
    input->devices.folder = input->devices_folder;
    input->terminal = (struct gn_terminal){.fd = -1, .wake_fd = -1};
    input->epoll = input->timer = input->notify = -1;
    input->folder_watch = input->devices_watch = -1;
    input->armed_ns = input->poll_ns = NEVER;
}

static bool wants_lines(const struct gn_input *input) {
    for (int i = 0; i < input->lines.count; i++)
        if (input->lines.lines[i].wanted && input->lines.ops->library) return true;
    return false;
}

/* For news of devices, as far as there can be any. */
static void watch(struct gn_input *input) {
    const uint32_t news = IN_CREATE | IN_ATTRIB | IN_MOVED_TO | IN_DELETE | IN_ONLYDIR;
    if (input->folder_watch < 0)
        input->folder_watch = inotify_add_watch(input->notify, input->lines.folder, news);
    if (input->devices_watch < 0 && input->opts.devices)
        input->devices_watch = inotify_add_watch(input->notify, input->devices_folder, news);
}

static bool open_descriptors(struct gn_input *input, struct gn_err *err) {
    input->epoll = epoll_create1(EPOLL_CLOEXEC);
    input->timer = timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
    if (input->epoll < 0 || !add(input, input->timer, TIMER))
        return gn_fail(err, "buttons: no descriptor for them: %s", strerror(errno));
    if (!wants_lines(input) && !input->opts.devices) return true;
    input->notify = inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
    if (add(input, input->notify, NOTIFY)) watch(input);
    return true;
}

static void open_sources(struct gn_input *input, const struct gn_input_world *world, int64_t now_ns,
                         struct gn_warnings *warnings) {
    const bool watched = input->folder_watch >= 0;
    input->lines.epoll = input->devices.epoll = input->epoll;
    input->lines.tag = tag(LINE);
    input->devices.tag = tag(DEVICE);
    input->lines.gestures = &input->gestures;
    input->lines.reports = input->devices.reports = &input->reports;
    input->lines.watched = watched;
    input->devices.keys = &input->keys;
    gn_lines_search(&input->lines, now_ns);
    if (input->opts.devices) gn_devices_search(&input->devices, now_ns);
    if (input->opts.devices && !watched) input->poll_ns = now_ns + 2 * GN_NS_PER_S;
    if (input->devices.denied)
        gn_warn(warnings,
                "%d input devices may not be read: keys there are not heard; add the user to group "
                "input (sudo usermod -aG input USER) and log in again",
                input->devices.denied);
    if (input->opts.terminal)
        gn_terminal_open(&input->terminal, world->terminal ? *world->terminal : STDIN_FILENO,
                         input->epoll, tag(TERMINAL));
}

/* ---- the timer ----------------------------------------------------------------------------- */

static int64_t least(int64_t a, int64_t b) { return a < b ? a : b; }

static void arm(struct gn_input *input) {
    int64_t due_ns = least(gn_gestures_deadline(&input->gestures), input->poll_ns);
    due_ns = least(due_ns, gn_lines_deadline(&input->lines));
    due_ns = least(due_ns, gn_play_deadline(&input->play));
    due_ns = least(due_ns, gn_terminal_keys_deadline(&input->terminal.keys));
    if (due_ns == input->armed_ns) return;
    input->armed_ns = due_ns;
    struct itimerspec at = {0};
    if (due_ns != NEVER) { /* 0 would stop it */
        at.it_value.tv_sec = due_ns > 0 ? due_ns / GN_NS_PER_S : 0;
        at.it_value.tv_nsec = due_ns > 0 ? due_ns % GN_NS_PER_S : 1;
    }
    timerfd_settime(input->timer, TFD_TIMER_ABSTIME, &at, NULL);
}

struct gn_input *gn_input_open_in(const struct gn_input_world *world,
                                  const struct gn_input_opts *opts, int64_t now_ns,
                                  struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_input *input = gn_xalloc(1, sizeof *input);
    input->opts = *opts;
    fill_world(input, world);
    gn_devices_init(&input->devices);
    if (!gn_input_set_up(input, now_ns, err) || !open_descriptors(input, err)) {
        gn_input_close(input);
        return NULL;
    }
    open_sources(input, world, now_ns, warnings);
    arm(input);
    return input;
}

struct gn_input *gn_input_open(const struct gn_input_opts *opts, int64_t now_ns,
                               struct gn_warnings *warnings, struct gn_err *err) {
    const struct gn_input_world world = {0};
    return gn_input_open_in(&world, opts, now_ns, warnings, err);
}

static void shut(int fd) {
    if (fd >= 0) close(fd);
}

void gn_input_close(struct gn_input *input) {
    if (!input) return;
    gn_terminal_close(&input->terminal);
    if (input->lines.gestures) gn_lines_finish(&input->lines);
    if (input->devices.keys) gn_devices_finish(&input->devices);
    gn_play_finish(&input->play);
    shut(input->notify);
    shut(input->timer);
    shut(input->epoll);
    free(input);
}

int gn_input_fd(const struct gn_input *input) { return input->epoll; }

/* ---- dispatching --------------------------------------------------------------------------- */

struct ready {
    bool timer, notify, terminal, resumed;
    uint32_t lines, hung_up, devices;
};

static void sort_out(struct ready *ready, const struct epoll_event *event) {
    const uint32_t index = (uint32_t)event->data.u64;
    const uint32_t bit = UINT32_C(1) << index % 32;
    switch ((enum kind)(event->data.u64 >> 32)) {
    case TIMER: ready->timer = true; break;
    case NOTIFY: ready->notify = true; break;
    case LINE:
        ready->lines |= bit;
        if (event->events & (EPOLLHUP | EPOLLERR)) ready->hung_up |= bit;
        break;
    case DEVICE: ready->devices |= bit; break;
    case TERMINAL:
        ready->terminal |= index == 0;
        ready->resumed |= index == 1;
        break;
    }
}

/* On a text console a keyboard is heard twice, by the terminal and as a device. */
static bool is_heard_twice(const struct gn_input *input, unsigned key) {
    char type;
    return gn_devices_have(&input->devices, key) &&
           ioctl(input->terminal.fd, KDGKBTYPE, &type) == 0;
}

static void click(struct gn_input *input, unsigned key, int64_t now_ns) {
    if (key != GN_KEY_NONE && !is_heard_twice(input, key)) gn_keys_click(&input->keys, key, now_ns);
}

static void read_terminal(struct gn_input *input, int64_t now_ns) {
    uint8_t bytes[256];
    const int count = gn_terminal_read(&input->terminal, bytes, sizeof bytes);
    for (int i = 0; i < count; i++)
        click(input, gn_terminal_keys_step(&input->terminal.keys, bytes[i], now_ns), now_ns);
}

static void read_devices(struct gn_input *input, uint32_t ready, int64_t now_ns) {
    bool gone = false;
    for (int i = 0; i < GN_DEVICES_MAX; i++)
        if (ready >> i & 1) gone |= gn_devices_read(&input->devices, i, now_ns);
    if (gone) gn_devices_search(&input->devices, now_ns);
}

/* What the news is about. */
struct news {
    bool chips, devices;
};

static void take_news(struct gn_input *input, const struct inotify_event *event,
                      struct news *news) {
    const char *name = event->len ? event->name : "";
    if (event->mask & IN_Q_OVERFLOW) news->chips = news->devices = true;
    if (event->wd == input->devices_watch) {
        if (event->mask & IN_IGNORED) input->devices_watch = -1;
        news->devices |= strncmp(name, "event", 5) == 0 && !(event->mask & IN_DELETE);
    } else if (event->wd == input->folder_watch) {
        news->chips |= strncmp(name, "gpiochip", 8) == 0;
        news->devices |= strcmp(name, "input") == 0;
    }
}

static void read_news(struct gn_input *input, int64_t now_ns) {
    _Alignas(struct inotify_event) char buffer[4096];
    struct news news = {0};
    for (ssize_t size; (size = read(input->notify, buffer, sizeof buffer)) > 0;)
        for (ssize_t at = 0; at < size;) {
            const struct inotify_event *event = (const struct inotify_event *)(buffer + at);
            take_news(input, event, &news);
            at += (ssize_t)(sizeof *event + event->len);
        }
    if (news.chips) gn_lines_changed(&input->lines, now_ns);
    if (!news.devices || !input->opts.devices) return;
    watch(input);
    gn_devices_search(&input->devices, now_ns);
}

static void report_notes(struct gn_input *input) {
    static const char *const texts[] = {
        [GN_NOTE_STUCK] = "held for 30 s; ignored until it is released",
        [GN_NOTE_NOISY] = "its line does not come to rest; without a resistor, or a wire too long?",
        [GN_NOTE_FAST] = "more than 20 times in a second; the rest is ignored",
    };
    struct gn_gesture_note note;
    while (gn_gestures_note(&input->gestures, &note))
        gn_report(&input->reports, "button \"%s\": %s", input->opts.buttons[note.button].name,
                  texts[note.kind]);
    const unsigned dropped = input->gestures.dropped - input->said_dropped;
    if (dropped && input->gestures.queue_begin == input->gestures.queue_end) {
        gn_report(&input->reports, "buttons: %u gestures were dropped: too many at once", dropped);
        input->said_dropped += dropped;
    }
}

/* Everything that is due by then, in the order of its time where that matters. */
static void pass_time(struct gn_input *input, int64_t now_ns) {
    gn_play_step(&input->play, &input->keys, now_ns);
    click(input, gn_terminal_keys_wait(&input->terminal.keys, now_ns), now_ns);
    if (input->poll_ns <= now_ns) {
        input->poll_ns = now_ns + 2 * GN_NS_PER_S;
        gn_devices_search(&input->devices, now_ns);
    }
    gn_gestures_step(&input->gestures, now_ns);
    gn_lines_step(&input->lines, now_ns);
    report_notes(input);
    arm(input);
}

void gn_input_dispatch(struct gn_input *input, int64_t now_ns) {
    struct epoll_event events[READY_MAX];
    struct ready ready = {0};
    uint64_t expirations;
    const int count = epoll_wait(input->epoll, events, READY_MAX, 0);
    for (int i = 0; i < count; i++) sort_out(&ready, &events[i]);
    if (ready.timer && read(input->timer, &expirations, sizeof expirations) > 0)
        input->armed_ns = NEVER;
    if (ready.lines) gn_lines_read(&input->lines, ready.lines, ready.hung_up, now_ns);
    if (ready.devices) read_devices(input, ready.devices, now_ns);
    if (ready.resumed) gn_terminal_resume(&input->terminal);
    if (ready.terminal) read_terminal(input, now_ns);
    if (ready.notify) read_news(input, now_ns);
    pass_time(input, now_ns);
}

void gn_input_key(struct gn_input *input, const struct gn_key_event *event) {
    gn_keys_set(&input->keys, &input->window, event->key, event->down, event->time_ns);
    arm(input);
}

bool gn_input_next(struct gn_input *input, struct gn_gesture_event *out) {
    return gn_gestures_next(&input->gestures, out);
}

bool gn_input_report(struct gn_input *input, char *out, size_t size) {
    report_notes(input);
    return gn_report_next(&input->reports, out, size);
}
