/* What a kiosk shows, as a machine: a state, an event, the next state. Pure: time comes with the
 * events (monotonic), so that a day in a museum is a list that can be played again. It asks for
 * pairs of mode and scene; whoever draws makes ready what is `wanted` and says so, and until then
 * the old picture stays. What the next frame shows is derived from the state by one function. */
#ifndef GN_KIOSK_MACHINE_H
#define GN_KIOSK_MACHINE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "options/action.h"

enum { GN_KIOSK_MODES_MAX = 32, GN_KIOSK_SCENES_MAX = 64 };

struct gn_kiosk_rules {                    /* zero means the default written beside */
    int mode_count;                        /* 1 */
    int scene_count;                       /* 1; those that next-scene goes through come first */
    int first_mode;                        /* 0; where GN_IDLE_FIRST goes back to */
    uint8_t own_scene[GN_KIOSK_MODES_MAX]; /* 1 + the scene that the mode itself names; 0: none */
    uint32_t
        own_camera; /* a bit a mode: it names its camera, so who enters it looks through that */
    enum gn_idle idle;
    int64_t idle_after_ns; /* 0: never */
    int64_t fade_ns;       /* from the old picture to the new; 0: at once */
    int64_t caption_ns;    /* 0: no captions */
};

enum gn_kiosk_caption {
    GN_KIOSK_SAYS_NOTHING,
    GN_KIOSK_SAYS_MODE,
    GN_KIOSK_SAYS_SCENE,
    GN_KIOSK_SAYS_CAMERA,
    GN_KIOSK_SAYS_PAUSE,
    GN_KIOSK_SAYS_PROBLEM, /* what was asked for cannot be had */
};
struct gn_kiosk_place {
    int mode,
        scene; /* scene: of those that next-scene goes through; a mode's own one comes first */
};
struct gn_kiosk { /* zeroed: the first mode and scene, nobody was there yet */
    struct gn_kiosk_place shown, wanted; /* different while something is made ready */
    uint32_t camera;                     /* so many after the mode's */
    uint32_t bad_modes;                  /* a bit each: they cannot be shown */
    uint64_t bad_scenes;
    bool paused, blanked, info;
    int64_t scene_ns;   /* how long the scene has run, as of the last frame */
    int64_t seen_ns;    /* when that is seen; 0: there was none */
    int64_t fade_ns;    /* since when the new picture comes; 0: it is there */
    int64_t caption_ns; /* since when it stands */
    enum gn_kiosk_caption caption;
    int64_t used_ns; /* when somebody did something, or idleness did */
};

enum gn_kiosk_event_kind {
    GN_KIOSK_ACTION,
    GN_KIOSK_FRAME,        /* one is drawn that will be seen at time_ns */
    GN_KIOSK_TICK,         /* time goes by */
    GN_KIOSK_READY,        /* `mode` can be drawn with `scene` at once */
    GN_KIOSK_MODE_FAILED,  /* it cannot, and never will be */
    GN_KIOSK_SCENE_FAILED, /* it could not be loaded */
    GN_KIOSK_EVENT_COUNT,
};
struct gn_kiosk_event {
    enum gn_kiosk_event_kind kind;
    int64_t time_ns;
    enum gn_action_kind action;
    int mode;  /* of GN_ACTION_MODE too: a number, -1 for one that there is not */
    int scene; /* as gn_kiosk_scene() tells */
};

/* The scene of a place: the mode's own, or the one of the list. */
int gn_kiosk_scene(const struct gn_kiosk_rules *rules, const struct gn_kiosk_place *place);
bool gn_kiosk_waits(const struct gn_kiosk *state); /* what is wanted is not shown yet */
struct gn_kiosk gn_kiosk_step(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state,
                              const struct gn_kiosk_event *event);

/* What a frame shows that is seen then. */
struct gn_kiosk_view {
    int mode, scene;
    uint32_t camera;
    int64_t time_ns; /* of the scene since it began */
    bool stands;     /* that time */
    bool dark, info;
    float old; /* share of the picture before in this one, 1 to 0 */
    enum gn_kiosk_caption caption;
    int caption_mode, caption_scene; /* what it is about */
};
struct gn_kiosk_view gn_kiosk_view(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state,
                                   int64_t seen_ns);
/* When a tick is due, even if nothing happens; INT64_MAX: never. */
int64_t gn_kiosk_deadline(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state);

/* One line, for people and for tests. */
void gn_kiosk_print(const struct gn_kiosk *state, FILE *to);

#endif
