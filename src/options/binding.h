/* The actions of gestures of buttons, from the configuration or by default. */
#ifndef GN_OPTIONS_BINDING_H
#define GN_OPTIONS_BINDING_H

#include "input/input.h"
#include "options/action.h"

struct gn_binding { /* zeroed: nothing */
    bool bound;     /* also to GN_ACTION_NONE, which a configuration may ask for */
    struct gn_action action;
};
struct gn_button_config { /* texts outlive it */
    struct gn_button_opts opts;
    struct gn_binding on[GN_GESTURE_COUNT];
};
struct gn_buttons {
    int count; /* at most GN_BUTTONS_MAX */
    struct gn_button_config items[GN_BUTTONS_MAX];
};

/* The buttons without a configuration: the lines GPIO17 (next) and GPIO27 (prev), if they exist,
 * and keys. */
void gn_buttons_defaults(struct gn_buttons *out);
/* Fills the options of an input, an array of GN_BUTTONS_MAX, from the buttons; returns their
 * count. */
int gn_buttons_opts(const struct gn_buttons *buttons, struct gn_button_opts *out);
/* Whether a button has that key (enum gn_key). */
bool gn_buttons_have_key(const struct gn_buttons *buttons, unsigned key);
/* Whether one of its actions is to go to a mode. */
bool gn_buttons_name_mode(const struct gn_buttons *buttons);
/* The action of a gesture; kind GN_ACTION_NONE: none. */
struct gn_action gn_buttons_action(const struct gn_buttons *buttons,
                                   const struct gn_gesture_event *event);

#endif
