/* Keys and mouse of a window, accumulated until they are read: pure, and the same for every window
 * system. */
#ifndef GN_DISPLAY_POINTER_H
#define GN_DISPLAY_POINTER_H

#include <stdbool.h>

#include "core/key.h"

enum gn_pointer_key { /* actions of the window's own keys */
                      GN_POINTER_NONE,
                      GN_POINTER_QUIT,
                      GN_POINTER_HOME,        /* resets the view to the camera's */
                      GN_POINTER_FULL_SCREEN, /* toggles; handled by the window */
};

enum { GN_POINTER_KEYS_MAX = 64 };
struct gn_pointer {        /* zeroed: no input */
    bool quit;             /* the quit key, or the window was closed */
    bool home;             /* applied before the moves below */
    float turn[2], pan[2]; /* drags to the right and up, in heights of the window */
    float wheel;           /* notches; positive moves closer */
    struct gn_key_event keys[GN_POINTER_KEYS_MAX]; /* keys other than the window's own, in order;
                                                      the excess is dropped */
    char letters[GN_POINTER_KEYS_MAX]; /* ASCII characters that those presses typed, as the layout
                                          has them, but the window's own; 0: none */
    unsigned key_count;
    /* the left button, to the right and down in widths and heights of the window: for a handle that
     * is dragged */
    bool pressed, dragged, released;
    float press[2], drag[2];
    const char *file; /* dropped onto the window, until the next one is; NULL: none */
};
bool gn_pointer_is_zero(const struct gn_pointer *pointer);
/* Adds `more`, which came after `pointer`. */
void gn_pointer_add(struct gn_pointer *pointer, const struct gn_pointer *more);
void gn_pointer_key(struct gn_pointer *pointer, const struct gn_key_event *event);
/* The character of the press that came last; one of GN_KEY_NONE is added if that has one already.
 * Characters that are not ASCII, and control characters, are ignored. */
void gn_pointer_letter(struct gn_pointer *pointer, unsigned letter);
void gn_pointer_act(struct gn_pointer *pointer, enum gn_pointer_key action);

enum gn_button { GN_BUTTON_LEFT, GN_BUTTON_RIGHT, GN_BUTTON_MIDDLE };
struct gn_drag { /* zeroed: no button is down */
    enum gn_button button;
    bool drags, pans;
    double x, y; /* last position, to the right and down */
};
/* The button that began a drag ends it; others are ignored meanwhile. Left turns, or pans with
 * shift; the other two pan. */
void gn_drag_button(struct gn_drag *drag, enum gn_button button, bool down, bool shift);
/* x, y from the window's upper left corner, in the same unit as its height. */
void gn_drag_move(struct gn_drag *drag, double x, double y, double height,
                  struct gn_pointer *pointer);

#endif
