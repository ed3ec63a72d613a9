/* libgpiod 1: no kernel debounce, no sequence numbers, one descriptor a line. */
#include <errno.h>
#include <gpiod.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/arena.h"
#include "core/clock.h"
#include "input/gpio.h"

struct line {
    struct gpiod_chip *chip; /* owned: a line cannot outlive its chip */
    struct gpiod_line *line;
};

static int open_chip(void *context, const char *path, void **chip, struct gn_gpio_chip *out) {
    (void)context;
    errno = 0;
    struct gpiod_chip *opened = gpiod_chip_open(path);
    if (!opened) return errno ? errno : ENODEV;
    snprintf(out->name, sizeof out->name, "%s", gpiod_chip_name(opened));
    snprintf(out->label, sizeof out->label, "%s", gpiod_chip_label(opened));
    out->lines = gpiod_chip_num_lines(opened);
    *chip = opened;
    return 0;
}

static void close_chip(void *chip) { gpiod_chip_close(chip); }

static int get_line_info(void *chip, unsigned offset, struct gn_gpio_line *out) {
    struct gpiod_line *line = gpiod_chip_get_line(chip, offset);
    if (!line) return errno;
    const char *name = gpiod_line_name(line), *consumer = gpiod_line_consumer(line);
    snprintf(out->name, sizeof out->name, "%s", name ? name : "");
    snprintf(out->consumer, sizeof out->consumer, "%s", consumer ? consumer : "");
    out->used = gpiod_line_is_used(line);
    return 0;
}

static int request_line(void *chip, const struct gn_gpio_wish *wish, void **line) {
    static const int flags[] = {[GN_BIAS_PULL_UP] = GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP,
                                [GN_BIAS_PULL_DOWN] = GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN};
    const int bias = wish->bias == GN_BIAS_NONE ? 0 : flags[wish->bias];
    char path[64];
    snprintf(path, sizeof path, "/dev/%s", gpiod_chip_name(chip));
    struct line made = {.chip = gpiod_chip_open(path)}; /* a second time, for the line to own */
    if (!made.chip) return errno;
    made.line = gpiod_chip_get_line(made.chip, wish->offset);
    if (!made.line || gpiod_line_request_both_edges_events_flags(made.line, "gnomon", bias)) {
        const int why = errno;
        gpiod_chip_close(made.chip);
        return why;
    }
    struct line *kept = gn_xalloc(1, sizeof *kept);
    *kept = made;
    *line = kept;
    return 0;
}

static int line_fd(void *line) { return gpiod_line_event_get_fd(((struct line *)line)->line); }

static int read_events(void *line, struct gn_gpio_event *out) {
    struct gpiod_line_event events[GN_GPIO_EVENTS];
    const int count = gpiod_line_event_read_fd_multiple(line_fd(line), events, GN_GPIO_EVENTS);
    if (count < 0) return errno == EAGAIN || errno == EINTR ? 0 : -errno;
    for (int i = 0; i < count; i++)
        out[i] = (struct gn_gpio_event){
            .time_ns = events[i].ts.tv_sec * GN_NS_PER_S + events[i].ts.tv_nsec,
            .high = events[i].event_type == GPIOD_LINE_EVENT_RISING_EDGE};
    return count;
}

static int read_level(void *line, bool *high) {
    const int value = gpiod_line_get_value(((struct line *)line)->line);
    if (value < 0) return errno;
    *high = value;
    return 0;
}

static void release_line(void *line) {
    struct line *kept = line;
    gpiod_line_release(kept->line);
    gpiod_chip_close(kept->chip);
    free(kept);
}

const struct gn_gpio_ops gn_gpio_library = {
    .library = "libgpiod 1",
    .open = open_chip,
    .look = get_line_info,
    .request = request_line,
    .close = close_chip,
    .fd = line_fd,
    .read = read_events,
    .level = read_level,
    .release = release_line,
};
