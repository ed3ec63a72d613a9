/* Converts options of buttons to gestures, lines and keys, and validates them. */
#include <string.h>

#include "input/private.h"

static bool set_up_button(struct gn_input *input, int i, struct gn_gesture_opts *gesture,
                          struct gn_line_opts *line, struct gn_err *err) {
    const struct gn_button_opts *b = &input->opts.buttons[i];
    *gesture = (struct gn_gesture_opts){
        .gestures = b->gestures,
        .debounce_ns = b->debounce_ns,
        .hold_ns = b->hold_ns,
        .double_ns = b->double_ns,
        .repeat_ns = b->repeat_ns,
        .chord_ns = b->chord_ns,
    };
    *line = (struct gn_line_opts){
        .button = b->name,
        .text = input->play.buttons >> i & 1 ? NULL : b->line,
        .active_high = b->active_high,
        .optional = b->optional,
        .bias = b->bias,
        .debounce_ns = b->debounce_ns,
    };
    if (b->chord && b->line) return gn_fail_usage(err, "a chord cannot have a line");
    if (b->keys && !gn_keys_bind(&input->keys, i, b->keys, err)) return gn_fail_prefix(err, "keys");

    /* the names of a chord's buttons */
    const struct gn_input_opts *opts = &input->opts;
    for (const char *at = b->chord; at && *(at += strspn(at, " \t"));) {
        const size_t length = strcspn(at, " \t");
        int other = 0;
        while (other < opts->button_count && (strncmp(opts->buttons[other].name, at, length) != 0 ||
                                              opts->buttons[other].name[length] != '\0'))
            other++;
        if (other == opts->button_count)
            return gn_fail_usage(err, "chord: unknown button \"%.*s\"",
                                 (int)(length < 60 ? length : 60), at);
        if (other == i || opts->buttons[other].chord)
            return gn_fail_usage(err, "chord: \"%s\" is a chord itself", opts->buttons[other].name);
        gesture->chord |= UINT32_C(1) << other;
        at += length;
    }
    if (b->chord && __builtin_popcount(gesture->chord) < 2)
        return gn_fail_usage(err, "chord: expected two buttons or more, separated by spaces");
    return true;
}

bool gn_input_set_up(struct gn_input *input, int64_t now_ns, struct gn_err *err) {
    const struct gn_input_opts *opts = &input->opts;
    struct gn_gesture_opts gestures[GN_BUTTONS_MAX];
    struct gn_line_opts lines[GN_BUTTONS_MAX];
    const char *names[GN_BUTTONS_MAX];
    if (opts->button_count > GN_BUTTONS_MAX)
        return gn_fail_usage(err, "%d buttons: at most %d", opts->button_count, GN_BUTTONS_MAX);
    for (int i = 0; i < opts->button_count; i++) names[i] = opts->buttons[i].name;
    if (opts->script &&
        !gn_play_load(&input->play, opts->script, names, opts->button_count, now_ns, err))
        return false;
    for (int i = 0; i < opts->button_count; i++)
        if (!set_up_button(input, i, &gestures[i], &lines[i], err))
            return gn_fail_prefix(err, "button \"%s\"", opts->buttons[i].name);
    gn_gestures_init(&input->gestures, gestures, opts->button_count, now_ns);
    input->keys.gestures = &input->gestures;
    return gn_lines_init(&input->lines, lines, opts->button_count, err);
}
