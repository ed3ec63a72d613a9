/* A touch screen, or a mouse: its events become moves and taps. One finger turns, two or more pan
 * and, by the change of their distance, zoom; a short touch that stays in place is a tap. A mouse
 * turns with its left button held, pans with another one, zooms by its wheel; a click in place is a
 * tap. Pure: events and times come in; descriptors are `devices` and `evdev`. */
#ifndef GN_INPUT_TOUCH_H
#define GN_INPUT_TOUCH_H

#include <stdbool.h>
#include <stdint.h>

enum gn_touch_kind {
    GN_TOUCH_NONE,
    GN_TOUCH_SCREEN, /* fingers on the picture itself */
    GN_TOUCH_TABLET, /* a mouse with absolute positions, as in virtual machines */
    GN_TOUCH_MOUSE,
};
struct gn_touch_axis {
    int32_t min, max; /* max <= min: unknown, all positions are one */
    int32_t per_mm;   /* 0: unknown */
};
struct gn_touch_opts { /* what a device is */
    enum gn_touch_kind kind;
    bool has_slots; /* several fingers: protocol B of the kernel (multi-touch-protocol.rst) */
    struct gn_touch_axis x, y;
    unsigned rotate_deg; /* 0, 90, 180, 270: the glass is mounted turned clockwise on the panel */
};

enum { GN_TOUCH_SLOTS = 16, GN_TOUCH_BUTTONS = 3 };
struct gn_touch_state { /* as the kernel has it */
    int slot;           /* that events of fingers are about */
    int32_t id[GN_TOUCH_SLOTS], x[GN_TOUCH_SLOTS], y[GN_TOUCH_SLOTS]; /* id -1: no finger */
    bool buttons[GN_TOUCH_BUTTONS]; /* left (or a touch), right, middle */
};

struct gn_touch_moves { /* since they were taken; zeroed: none */
    /* to the right and up: on glass in shares of the panel's width and height, as it is scanned
     * out; of a mouse in heights of the picture, as it is seen */
    float turn[2], pan[2];
    float zoom;  /* logarithm of how many times nearer, by fingers */
    float wheel; /* notches, positive moves closer */
    bool used;   /* touched, clicked or moved */
};

struct gn_touch { /* zeroed: no device */
    struct gn_touch_opts opts;
    struct gn_touch_state state;
    struct gn_touch_moves moves; /* the reader zeroes them */
    struct gn_touch_at {         /* at the last report */
        int count;
        int32_t id[GN_TOUCH_SLOTS];
        double x, y;   /* of their middle: shares of the panel, or counts of the mouse */
        double spread; /* mean distance to it */
    } at;
    double aspect;             /* of the panel: its width by its height */
    double mouse_x, mouse_y;   /* counts since it was opened */
    int held_by;               /* the button that began to drag; -1: none */
    double begun_x, begun_y;   /* of what may become a tap */
    int64_t begun_ns, last_ns; /* the first finger, the last event */
    bool is_tap;               /* it still may */
};

void gn_touch_init(struct gn_touch *touch, const struct gn_touch_opts *opts);
/* An event of the kernel (linux/input.h), autorepeat excluded. Returns true if it ends a tap. */
bool gn_touch_event(struct gn_touch *touch, unsigned type, unsigned code, int32_t value,
                    int64_t time_ns);
/* The state was read: at first, and after events were lost. What is down is no tap, and has not
 * moved. */
void gn_touch_set(struct gn_touch *touch, const struct gn_touch_state *state, int64_t time_ns);
/* A finger or a button is down; not one without an event for half a minute: glass gets stuck. */
bool gn_touch_is_held(const struct gn_touch *touch, int64_t now_ns);

/* Adds `more`, of the same kind. */
void gn_touch_add(struct gn_touch_moves *moves, const struct gn_touch_moves *more);

#endif
