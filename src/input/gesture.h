/* What a button means by going down and up: pure, and the same for every kind of button. Time comes
 * with the events; nobody asks a clock. */
#ifndef GN_INPUT_GESTURE_H
#define GN_INPUT_GESTURE_H

#include <stdbool.h>
#include <stdint.h>

#define GN_BUTTONS_MAX 32

enum gn_gesture {
    GN_GESTURE_PRESS,  /* on the debounced edge, at once */
    GN_GESTURE_CLICK,  /* on release before a hold; waits for a second one only where a double is
                          bound to this button */
    GN_GESTURE_DOUBLE, /* the second click's press within double_ns of the first's release */
    GN_GESTURE_HOLD,   /* held for hold_ns, fires while held; no click follows */
    GN_GESTURE_REPEAT, /* at hold_ns, and every repeat_ns from then on while held */
    GN_GESTURE_CHORD,  /* all of a chord's buttons went down within chord_ns; their own gestures do
                          not happen */
    GN_GESTURE_COUNT,
};
extern const char *const gn_gesture_names[GN_GESTURE_COUNT]; /* "press"; also keys of the INI */

/* What happened, in the order in which it did. */
struct gn_gesture_event {
    int button; /* index into gn_input_opts.buttons */
    enum gn_gesture gesture;
    int64_t time_ns; /* monotonic: of the first edge that led to it */
};

#endif
