/* libgpiod 2: the kernel debounces and counts. */
#include <errno.h>
#include <gpiod.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/arena.h"
#include "input/gpio.h"

struct line {
    struct gpiod_line_request *request;
    struct gpiod_edge_event_buffer *events;
    unsigned offset;
};

static int error_of(void) { return errno ? errno : ENODEV; }

static int open_chip(void *context, const char *path, void **chip, struct gn_gpio_chip *out) {
    (void)context;
    errno = 0;
    struct gpiod_chip *opened = gpiod_chip_open(path);
    if (!opened) return error_of();
    struct gpiod_chip_info *info = gpiod_chip_get_info(opened);
    if (!info) {
        const int error = error_of();
        gpiod_chip_close(opened);
        return error;
    }
    snprintf(out->name, sizeof out->name, "%s", gpiod_chip_info_get_name(info));
    snprintf(out->label, sizeof out->label, "%s", gpiod_chip_info_get_label(info));
    out->lines = (unsigned)gpiod_chip_info_get_num_lines(info);
    gpiod_chip_info_free(info);
    *chip = opened;
    return 0;
}

static void close_chip(void *chip) { gpiod_chip_close(chip); }

static int get_line_info(void *chip, unsigned offset, struct gn_gpio_line *out) {
    struct gpiod_line_info *info = gpiod_chip_get_line_info(chip, offset);
    if (!info) return error_of();
    const char *name = gpiod_line_info_get_name(info);
    const char *consumer = gpiod_line_info_get_consumer(info);
    snprintf(out->name, sizeof out->name, "%s", name ? name : "");
    snprintf(out->consumer, sizeof out->consumer, "%s", consumer ? consumer : "");
    out->used = gpiod_line_info_is_used(info);
    gpiod_line_info_free(info);
    return 0;
}

static int request_line(void *chip, const struct gn_gpio_wish *wish, void **line) {
    static const enum gpiod_line_bias biases[] = {[GN_BIAS_PULL_UP] = GPIOD_LINE_BIAS_PULL_UP,
                                                  [GN_BIAS_PULL_DOWN] = GPIOD_LINE_BIAS_PULL_DOWN,
                                                  [GN_BIAS_NONE] = GPIOD_LINE_BIAS_AS_IS};
    /* NULL where allocation failed */
    struct gpiod_line_settings *settings = gpiod_line_settings_new();
    struct gpiod_line_config *lines = gpiod_line_config_new();
    struct gpiod_request_config *request = gpiod_request_config_new();
    struct line made = {.events = gpiod_edge_event_buffer_new(GN_GPIO_EVENTS),
                        .offset = wish->offset};
    errno = 0;
    if (made.events && settings && lines && request) {
        gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT);
        gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_BOTH);
        gpiod_line_settings_set_bias(settings, biases[wish->bias]);
        gpiod_line_settings_set_debounce_period_us(settings,
                                                   (unsigned long)(wish->debounce_ns / 1000));
        gpiod_line_settings_set_event_clock(settings, GPIOD_LINE_CLOCK_MONOTONIC);
        gpiod_request_config_set_consumer(request, "gnomon");
        if (gpiod_line_config_add_line_settings(lines, &wish->offset, 1, settings) == 0)
            made.request = gpiod_chip_request_lines(chip, request, lines);
    }
    const int error = made.request ? 0 : error_of();
    gpiod_request_config_free(request);
    gpiod_line_config_free(lines);
    gpiod_line_settings_free(settings);
    if (error) {
        gpiod_edge_event_buffer_free(made.events);
        return error;
    }
    struct line *kept = gn_xalloc(1, sizeof *kept);
    *kept = made;
    *line = kept;
    return 0;
}

static int line_fd(void *line) { return gpiod_line_request_get_fd(((struct line *)line)->request); }

static int read_events(void *line, struct gn_gpio_event *out) {
    struct line *l = line;
    const int count = gpiod_line_request_read_edge_events(l->request, l->events, GN_GPIO_EVENTS);
    if (count < 0) return errno == EAGAIN || errno == EINTR ? 0 : -errno;
    for (int i = 0; i < count; i++) {
        struct gpiod_edge_event *event =
            gpiod_edge_event_buffer_get_event(l->events, (unsigned long)i);
        out[i] = (struct gn_gpio_event){
            .time_ns = (int64_t)gpiod_edge_event_get_timestamp_ns(event),
            .high = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE,
            .seqno = (uint32_t)gpiod_edge_event_get_line_seqno(event)};
    }
    return count;
}

static int read_level(void *line, bool *high) {
    struct line *l = line;
    const enum gpiod_line_value value = gpiod_line_request_get_value(l->request, l->offset);
    if (value == GPIOD_LINE_VALUE_ERROR) return error_of();
    *high = value == GPIOD_LINE_VALUE_ACTIVE;
    return 0;
}

static void release_line(void *line) {
    struct line *l = line;
    gpiod_line_request_release(l->request);
    gpiod_edge_event_buffer_free(l->events);
    free(l);
}

const struct gn_gpio_ops gn_gpio_library = {
    .library = "libgpiod 2",
    .open = open_chip,
    .look = get_line_info,
    .request = request_line,
    .close = close_chip,
    .fd = line_fd,
    .read = read_events,
    .level = read_level,
    .release = release_line,
};
