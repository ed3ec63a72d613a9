/* What a kiosk can be told to do, whoever tells it: a button, a key, the control socket. */
#ifndef GN_OPTIONS_ACTION_H
#define GN_OPTIONS_ACTION_H

#include <stdbool.h>

#include "core/err.h"

enum gn_action_kind {
    GN_ACTION_NONE,
    GN_ACTION_NEXT, /* mode, as the file has them; the first follows the last */
    GN_ACTION_PREV,
    GN_ACTION_MODE, /* of that name */
    GN_ACTION_NEXT_SCENE,
    GN_ACTION_NEXT_CAMERA,
    GN_ACTION_PAUSE, /* time stands still, and goes on where it stood */
    GN_ACTION_BLANK, /* the screen goes dark; any action lights it again, and does no more */
    GN_ACTION_INFO,  /* the page with frame rate, GPU, address, versions; and away again */
    GN_ACTION_KIND_COUNT,
};
struct gn_action { /* zeroed: none */
    enum gn_action_kind kind;
    const char *name; /* of the mode, else NULL; whoever parsed it owns it */
};

enum gn_idle { /* what a kiosk does after idle_after seconds without an event */
               GN_IDLE_NONE,
               GN_IDLE_FIRST, /* the first mode, scene and camera, as at the start */
               GN_IDLE_NEXT,  /* the next mode, and again after the same time */
};

const char *gn_action_name(enum gn_action_kind kind); /* "next-scene" */
/* "next", "mode Soft": the name of a mode begins behind the first space and points into text, which
 * must live as long as the action. Else a usage error "label: .." that lists the actions. */
bool gn_action_parse(const char *text, const char *label, struct gn_action *out,
                     struct gn_err *err);

#endif
