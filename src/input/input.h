/* Buttons and keys, wherever they are: lines of GPIO chips, input devices, the window, the
 * terminal, a script. They are read by callbacks of the event loop, into one queue of gestures.
 * Nothing here ends the program: what is not there yet is waited for, and said once. */
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

struct gn_button_opts { /* zero means the default written beside; texts outlive the input */
    const char *name;   /* as in [button "NAME"] */
    const char *line;   /* "GPIO17" or "label:pinctrl-rp1/17"; NULL: not a line */
    const char *keys;   /* names of keys, a space between two: "space right"; NULL: none */
    const char *chord;  /* names of other buttons, a space between two; NULL: not a chord */
    bool active_high;   /* pressed is high; else low, with a pull-up */
    enum gn_bias bias;
    bool optional;       /* a default: if the line is not there or not free, that is no fault */
    unsigned gestures;   /* bits 1 << gn_gesture that are bound to something */
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
    bool terminal;                        /* read keys from stdin where it is a terminal; on a
                                             text console not those that an input device has, too */
    bool devices;                         /* read input devices (evdev) */
    const char *script; /* a file of "TIME_S down|up|click KEY-OR-BUTTON" lines (script.h), whose
                           times count from the opening; NULL: none. Buttons that it names have no
                           line but the script's */
};

struct gn_input;

/* Fails on what the options say wrongly (a line twice, an unknown key, a chord of nothing) as usage
 * errors that name the button; not on what the world lacks. */
struct gn_input *gn_input_open(const struct gn_input_opts *opts, int64_t now_ns,
                               struct gn_warnings *warnings, struct gn_err *err);
void gn_input_close(struct gn_input *input); /* NULL is fine; the terminal is as it was */
/* A key that somebody else heard: the window's. */
void gn_input_key(struct gn_input *input, const struct gn_key_event *event);
/* After each step of the loop and after key, until it is false: the next gesture, in order; false:
 * there is none. At most 20 a second for each button. */
bool gn_input_next(struct gn_input *input, struct gn_gesture_event *out);
/* The next line for the log that has not been read ("button \"next\": held for 30 s; ignored until
 * it is released"), or false. Each is said once until it changes. */
bool gn_input_report(struct gn_input *input, char *out, size_t size);

/* ---- for doctor ---------------------------------------------------------------------------- */

struct gn_input_line {
    char name[48]; /* "" : it has none */
    bool used;
    char consumer[48]; /* who uses it; "": not known */
};
struct gn_input_chip {
    char path[64], name[32], label[48];
    int error; /* an errno value: why it could not be opened, and there is nothing else; 0: it was
                */
    int line_count;
    const struct gn_input_line *lines;
};
enum { GN_INPUT_CHIPS_MAX = 32 };
struct gn_input_list {
    const char
        *library; /* "libgpiod 1"; NULL: this build has none, and chips are not looked into */
    struct gn_input_chip chips[GN_INPUT_CHIPS_MAX];
    int chip_count;
    int devices, devices_denied; /* input devices; those of them that may not be read */
    struct gn_arena arena;       /* holds the lines */
};
/* Lines of GPIO chips, and the rest that can be listened to. Changes nothing. */
void gn_input_list_lines(struct gn_input_list *out);
void gn_input_list_finish(struct gn_input_list *list);

#endif
