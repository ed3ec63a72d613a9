/* Buttons and keys of all sources: GPIO lines, input devices, the window, the terminal, a script.
 * Callbacks of the event loop read them into one queue of gestures. Missing devices are not an
 * error: they are reported once and waited for. */
#ifndef GN_INPUT_INPUT_H
#define GN_INPUT_INPUT_H

#include <stddef.h>

#include "core/arena.h"
#include "core/err.h"
#include "core/key.h"
#include "core/loop.h"
#include "core/warn.h"
#include "input/gesture.h"
#include "input/gpio.h"
#include "input/touch.h"

enum gn_pointers { GN_POINTERS_NONE, GN_POINTERS_TOUCH /* touch screens */, GN_POINTERS_ALL };

struct gn_button_opts { /* zero means the default written beside; texts outlive the input */
    const char *name;   /* as in [button "NAME"] */
    const char *line;   /* "GPIO17" or "label:pinctrl-rp1/17"; NULL: not a line */
    const char *keys;   /* names of keys, separated by spaces: "space right"; NULL: none */
    const char *chord;  /* names of other buttons, separated by spaces; NULL: not a chord */
    bool active_high;   /* pressed is high; otherwise low, with a pull-up */
    enum gn_bias bias;
    bool optional;       /* set by default: no report if its line is missing or in use */
    unsigned gestures;   /* bits 1 << gn_gesture that are bound */
    int64_t debounce_ns; /* 20 ms */
    int64_t hold_ns;     /* 800 ms */
    int64_t double_ns;   /* 350 ms */
    int64_t repeat_ns;   /* 200 ms */
    int64_t chord_ns;    /* 80 ms */
};
struct gn_input_opts {
    struct gn_loop *loop;                 /* not NULL, outlives the input */
    const struct gn_button_opts *buttons; /* outlive the input */
    int button_count;                     /* at most GN_BUTTONS_MAX */
    bool terminal; /* read keys from stdin if it is a terminal; on a text console, except those that
                      an input device has */
    bool devices;  /* read input devices (evdev) */
    enum gn_pointers pointers; /* of them, beside keys: none */
    unsigned touch_rotate_deg; /* how touch screens are mounted; as in gn_touch_opts */
    const char *script; /* file of "TIME_S down|up|click KEY-OR-BUTTON" lines (script.h), times
                           since opening; NULL: none. Buttons named in it have no other line */
};

struct gn_input;

/* Fails with a usage error that names the button for bad options (duplicate line, unknown key, bad
 * chord); not for missing devices. */
struct gn_input *gn_input_open(const struct gn_input_opts *opts, int64_t now_ns,
                               struct gn_warnings *warnings, struct gn_err *err);
void gn_input_close(struct gn_input *input); /* restores the terminal; NULL is legal */
/* A key event from elsewhere: the window's. */
void gn_input_key(struct gn_input *input, const struct gn_key_event *event);
/* Returns the next gesture in order, or false. Call after each step of the loop and after
 * gn_input_key until it returns false. At most 20 a second per button. */
bool gn_input_next(struct gn_input *input, struct gn_gesture_event *out);
struct gn_input_moves { /* by hand, since they were taken */
    struct gn_touch_moves glass, mouse;
    bool held; /* a finger or a button of a mouse is down */
};
/* Call after each step of the loop. Taps are presses of the key "tap". */
struct gn_input_moves gn_input_take_moves(struct gn_input *input, int64_t now_ns);
/* While taps are suppressed, a touch or click that begins never becomes a tap. */
void gn_input_suppress_taps(struct gn_input *input, bool suppress);
int gn_input_pointers(const struct gn_input *input); /* number of open touch screens and mice */
/* The next unread line for the log ("button \"next\": held for 30 s; ignored until released"), or
 * false. Each is reported once until it changes. */
bool gn_input_report(struct gn_input *input, char *out, size_t size);

/* ---- for doctor ---------------------------------------------------------------------------- */

struct gn_input_line {
    char name[48]; /* "": unnamed */
    bool used;
    char consumer[48]; /* current user of the line; "": unknown */
};
struct gn_input_chip {
    char path[64], name[32], label[48];
    int error; /* errno value if the chip could not be opened; no other field is set then */
    int line_count;
    const struct gn_input_line *lines;
};
struct gn_input_pointer { /* a touch screen or a mouse */
    char path[64], name[80];
    enum gn_touch_kind kind;
};
enum { GN_INPUT_CHIPS_MAX = 32, GN_INPUT_POINTERS_MAX = 16 };
struct gn_input_list {
    const char *library; /* "libgpiod 1"; NULL: built without, chips are not listed */
    struct gn_input_chip chips[GN_INPUT_CHIPS_MAX];
    int chip_count;
    int devices, devices_denied; /* number of input devices; those without read permission */
    struct gn_input_pointer pointers[GN_INPUT_POINTERS_MAX]; /* of those with it */
    int pointer_count;
    struct gn_arena arena; /* owns the lines */
};
/* Lists GPIO lines and input devices. Changes nothing. */
void gn_input_list_lines(struct gn_input_list *out);
void gn_input_list_finish(struct gn_input_list *list);

#endif
