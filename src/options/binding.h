/* Which gesture of which button does what: what the configuration says, or the defaults. */
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

/* What there is without a configuration: the lines GPIO17 (next) and GPIO27 (prev), if there are
 * such, and keys. */
void gn_buttons_defaults(struct gn_buttons *out);
/* Fills the options of an input, an array of GN_BUTTONS_MAX, with what is bound to what. The count.
 */
int gn_buttons_opts(const struct gn_buttons *buttons, struct gn_button_opts *out);
/* What a gesture is to do; kind GN_ACTION_NONE: nothing. */
struct gn_action gn_buttons_action(const struct gn_buttons *buttons,
                                   const struct gn_gesture_event *event);

#endif
