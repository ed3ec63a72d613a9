/* What the buttons of this machine do, a line each: for boards, and for tests on a real kernel.
 *
 *   tool_buttons SECONDS NAME=LINE[,high][,none|down][,optional] .. [NAME:KEYS ..]
 *
 * prints "ready", then reports as "# TEXT" and gestures as "GESTURE NAME TIME_NS LATENCY_MS" (from
 * the edge's timestamp to here), and at the end "wakes N": how often anything woke it. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "input/input.h"

static void parse(char *text, struct gn_button_opts *out) {
    char *at = text + strcspn(text, "=:");
    const bool line = *at == '=';
    *out = (struct gn_button_opts){.name = text, .gestures = (1u << GN_GESTURE_COUNT) - 1};
    if (*at) *at++ = '\0';
    if (!line) {
        out->keys = at;
        return;
    }
    out->line = strsep(&at, ",");
    for (const char *word; (word = strsep(&at, ","));) {
        out->active_high |= strcmp(word, "high") == 0;
        out->optional |= strcmp(word, "optional") == 0;
        if (strcmp(word, "none") == 0) out->bias = GN_BIAS_NONE;
        if (strcmp(word, "down") == 0) out->bias = GN_BIAS_PULL_DOWN;
    }
}

static void print_all(struct gn_input *input, const struct gn_button_opts *buttons) {
    struct gn_gesture_event event;
    char text[512];
    while (gn_input_report(input, text, sizeof text)) printf("# %s\n", text);
    while (gn_input_next(input, &event))
        printf("%s %s %" PRId64 " %.1f\n", gn_gesture_names[event.gesture],
               buttons[event.button].name, event.time_ns,
               (double)(gn_clock_monotonic_ns() - event.time_ns) / 1e6);
    fflush(stdout);
}

int main(int argc, char **argv) {
    struct gn_button_opts buttons[GN_BUTTONS_MAX];
    struct gn_warnings warnings = {0};
    struct gn_err err = {0};
    int count = 0, wakes = 0;
    for (int i = 2; i < argc && count < GN_BUTTONS_MAX; i++) parse(argv[i], &buttons[count++]);
    if (count == 0) {
        fprintf(stderr, "usage: tool_buttons SECONDS NAME=LINE|NAME:KEYS ..\n");
        return 2;
    }
    const int64_t end_ns = gn_clock_monotonic_ns() + (int64_t)(atof(argv[1]) * 1e9);
    struct gn_loop *loop = gn_loop_open(&err);
    if (!loop) {
        fprintf(stderr, "%s\n", err.text);
        return err.status;
    }
    const struct gn_input_opts opts = {
        .loop = loop, .buttons = buttons, .button_count = count, .devices = true, .terminal = true};
    struct gn_input *input = gn_input_open(&opts, gn_clock_monotonic_ns(), &warnings, &err);
    if (!input) {
        fprintf(stderr, "%s\n", err.text);
        return err.status;
    }
    for (int i = 0; i < warnings.count; i++) printf("# %s\n", warnings.text[i]);
    print_all(input, buttons);
    printf("ready\n");
    fflush(stdout);
    while (gn_clock_monotonic_ns() < end_ns) {
        if (gn_loop_step(loop, end_ns) == 0) continue;
        wakes++;
        print_all(input, buttons);
    }
    gn_input_close(input);
    gn_loop_close(loop);
    printf("wakes %d\n", wakes);
    return 0;
}
