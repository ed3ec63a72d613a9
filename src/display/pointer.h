/* What somebody does at a window with keys and a mouse, summed up until it is read: pure, and the
 * same for every window system. */
#ifndef GN_DISPLAY_POINTER_H
#define GN_DISPLAY_POINTER_H

#include <stdbool.h>

#include "core/key.h"

enum gn_hand_key { /* what a key stands for */
                   GN_HAND_NONE,
                   GN_HAND_QUIT,
                   GN_HAND_HOME,        /* the view as the camera has it */
                   GN_HAND_FULL_SCREEN, /* and back; the window's own affair */
};

enum { GN_HAND_KEYS_MAX = 64 };
struct gn_hand {           /* zeroed: nothing was done */
    bool quit;             /* by a key, or the window was closed */
    bool home;             /* before what stands below */
    float turn[2], pan[2]; /* drags to the right and up, in heights of the window */
    float wheel;           /* notches away from the hand: nearer */
    struct gn_key_event keys[GN_HAND_KEYS_MAX]; /* that are not the window's own, in order; what is
                                                   too much is left out */
    unsigned key_count;
};
bool gn_hand_is_zero(const struct gn_hand *hand);
/* What `more` did after `hand`. */
void gn_hand_add(struct gn_hand *hand, const struct gn_hand *more);
void gn_hand_key(struct gn_hand *hand, const struct gn_key_event *event);
void gn_hand_act(struct gn_hand *hand, enum gn_hand_key action);

enum gn_button { GN_BUTTON_LEFT, GN_BUTTON_RIGHT, GN_BUTTON_MIDDLE };
struct gn_pointer { /* zeroed: no button is down */
    enum gn_button button;
    bool drags, pans;
    double x, y; /* where it was last, to the right and down */
};
/* The button that begins a drag ends it; others do nothing meanwhile. Left turns, or pans with
 * shift; the two others pan. */
void gn_pointer_button(struct gn_pointer *pointer, enum gn_button button, bool down, bool shift);
/* To x, y from the window's upper left corner, in the unit of its height. */
void gn_pointer_move(struct gn_pointer *pointer, double x, double y, double height,
                     struct gn_hand *hand);

#endif
