/* Actions of a kiosk, by a button, a key or the control socket. */
#ifndef GN_OPTIONS_ACTION_H
#define GN_OPTIONS_ACTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

/* The table of actions: X(ID, id, name, argument, help, member of a request..). An argument in
 * brackets may be left out: on or off, without it the other of the two. A row and the
 * function act_<id> of kiosk/machine.c make an action of buttons, keys and `gnomon ctl`. The first
 * mode follows the last; while the screen is blanked, an action
 * only switches it on. */
/* clang-format off */
#define GN_ACTIONS(X)                                                                              \
    X(NEXT, next, "next", "", "go to the next mode", NULL)                                         \
    X(PREV, prev, "prev", "", "go to the previous mode", NULL)                                     \
    X(MODE, mode, "mode", "NAME", "go to that mode", "name")                                       \
    X(NEXT_SCENE, next_scene, "next-scene", "", "show the next scene", NULL)                       \
    X(NEXT_CAMERA, next_camera, "next-camera", "", "use the scene's next camera", NULL)            \
    X(PLAY, play, "play", "CLIP", "play that clip of the animation once, then go on as before", "clip") \
    X(PAUSE, pause, "pause", "[on|off]", "stop the animation, or resume it", "state")              \
    X(BLANK, blank, "blank", "[on|off]", "turn the screen off, or on again", "state")              \
    X(INFO, info, "info", "[on|off]", "show or hide the information page", "state")                \
    X(SUN, sun, "sun", "STEP", "move the time of the sun by a step, as +1h, -15m or +1d (24 hours), from then on; now: back to the time without steps", "step")
/* clang-format on */

enum gn_action_kind {
    GN_ACTION_NONE,
#define X(ID, ...) GN_ACTION_##ID,
    GN_ACTIONS(X)
#undef X
        GN_ACTION_KIND_COUNT,
};
enum gn_turn { GN_TURN_OTHER, GN_TURN_ON, GN_TURN_OFF };
struct gn_action { /* zeroed: none */
    enum gn_action_kind kind;
    enum gn_turn turn;
    const char *name; /* of the mode or clip, or the step; else NULL; points into the parsed text */
    bool pressed;     /* by a button or key, not by a command */
};

enum gn_idle { /* what a kiosk does after idle_after seconds without an event */
               GN_IDLE_NONE,
               GN_IDLE_FIRST, /* the first mode, scene and camera, as at the start */
               GN_IDLE_NEXT,  /* the next mode, and again after the same time */
};

const char *gn_action_name(enum gn_action_kind kind); /* "next-scene" */
void gn_action_list(char *out, size_t size);          /* "none, next, prev, mode NAME, .." */
/* "on", "off"; NULL: the other. */
bool gn_turn_parse(const char *text, enum gn_turn *out, struct gn_err *err);
/* The step of "sun": "+1h", with minutes m, hours h, days d of 24 hours, or weeks w, up to 100
 * years; "now": 0. */
bool gn_sun_step_parse(const char *text, int64_t *out_s, struct gn_err *err);
/* "next", "pause on", "mode Soft": the name begins behind the first space and points into text,
 * which must live as long as the action. Else a usage error that lists the actions. */
bool gn_action_parse(const char *text, struct gn_action *out, struct gn_err *err);

#endif
