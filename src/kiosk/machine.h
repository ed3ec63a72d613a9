/* The state machine of the kiosk: a state, an event, the next state. Pure: time comes with the
 * events (monotonic), so a day of a kiosk is a list of events that can be replayed. The state names
 * the mode and scene that are `wanted`; the drawing side makes them ready and sends GN_KIOSK_READY,
 * and until then the old picture stays. gn_kiosk_view() derives from it what a frame shows. */
#ifndef GN_KIOSK_MACHINE_H
#define GN_KIOSK_MACHINE_H

#include <stdbool.h>
#include <stdint.h>

#include "options/action.h"

enum { GN_KIOSK_MODES_MAX = 32, GN_KIOSK_SCENES_MAX = 64, GN_KIOSK_SPEED_MOST = 4 };

struct gn_kiosk_rules {                    /* zero means the default written beside */
    int mode_count;                        /* 1 */
    int scene_count;                       /* 1; those of the list of next-scene, numbered first */
    int first_mode;                        /* 0; of GN_IDLE_FIRST */
    uint8_t own_scene[GN_KIOSK_MODES_MAX]; /* 1 + the scene that the mode itself names; 0: none */
    uint32_t own_camera; /* bits 1 << mode: the mode names a camera, which is used on entering */
    uint32_t restarts;   /* bits 1 << mode: entering it its clips begin */
    uint32_t passed_by;  /* bits 1 << mode: next and prev do not stop there */
    bool replays;        /* next and prev enter the mode that is shown, if it is the only one */
    enum gn_idle idle;
    int64_t idle_after_ns; /* 0: never */
    int64_t fade_ns;       /* how long, from the old picture to the new; 0: at once */
    int64_t caption_ns;    /* how long; 0: no captions */
    bool names_first;      /* the first picture has a caption, too */
    int64_t wake_ns;       /* outside of the hours: how long after a press it is on; 0: never */
    bool sleeps_black;     /* outside of them it shows black; else it is switched off */
    bool plays_alone;      /* buttons do nothing while a clip plays once */
};

enum gn_kiosk_caption {
    GN_KIOSK_CAPTION_NONE,
    GN_KIOSK_CAPTION_MODE,
    GN_KIOSK_CAPTION_SCENE,
    GN_KIOSK_CAPTION_CAMERA,
    GN_KIOSK_CAPTION_PAUSE,
    GN_KIOSK_CAPTION_SUN,
    GN_KIOSK_CAPTION_NOTE,    /* a text of the viewer */
    GN_KIOSK_CAPTION_PROBLEM, /* what the last problem is called */
};
struct gn_kiosk_place {
    int mode, scene; /* in the list of next-scene; a scene that the mode names takes precedence */
};
struct gn_kiosk {                        /* zeroed: the first mode and scene, no event yet */
    struct gn_kiosk_place shown, wanted; /* they differ while the wanted one is made ready */
    uint32_t camera;                     /* offset from the mode's camera */
    uint32_t bad_modes;                  /* bits 1 << mode: it failed */
    uint64_t bad_scenes;
    bool paused, blanked, info;
    bool asleep, woken;  /* outside of the hours; a press has lit the screen for a while */
    int speed;           /* logarithm to base 2 of the scene's speed, at most GN_KIOSK_SPEED_MOST */
    int64_t sun_ahead_s; /* of the time of [sun], by steps; at most 100 years */
    int64_t scene_ns;    /* the scene's time in the last frame */
    int64_t clips_begun_ns;   /* the scene's time at which the clips of the shown mode began */
    int64_t seen_ns;          /* when that frame is on the screen; 0: no frame yet */
    int64_t fade_begun_ns;    /* monotonic; 0: no fade */
    int64_t caption_begun_ns; /* monotonic */
    enum gn_kiosk_caption caption;
    int64_t used_ns; /* the last action or move by hand, the end of a clip, or what the idle timeout
                        did */
    uint32_t idled;  /* how often it did: the view moved by hand is the camera's again, too */
    struct gn_kiosk_play {
        int clip_plus_1; /* that plays once; 0: none. The scene's time stands meanwhile */
        int64_t time_ns, length_ns;
        struct gn_kiosk_place wanted; /* when it began: it goes on when that is shown */
    } play;
};

enum gn_kiosk_event_kind {
    GN_KIOSK_ACTION,
    GN_KIOSK_FRAME,        /* a frame was drawn that is on the screen at time_ns */
    GN_KIOSK_TICK,         /* time passes */
    GN_KIOSK_READY,        /* `mode` and `scene` can be drawn now */
    GN_KIOSK_MODE_FAILED,  /* `mode` cannot be drawn */
    GN_KIOSK_SCENE_FAILED, /* `scene` cannot be loaded */
    GN_KIOSK_NOTE,         /* `caption` is to be shown */
    GN_KIOSK_CAMERA,       /* `camera` is chosen */
    GN_KIOSK_HOURS, /* the hours in which the screen is on begin (`by` 0) or end (1), or go on */
    GN_KIOSK_SPEED, /* the scene's time goes twice as fast (`by` 1), or half (-1) */
    GN_KIOSK_EVENT_COUNT,
};
struct gn_kiosk_event {
    enum gn_kiosk_event_kind kind;
    int64_t time_ns;
    enum gn_action_kind action;
    enum gn_turn turn;
    bool pressed;    /* an action of a button or key */
    int mode;        /* also of GN_ACTION_MODE; -1: no such mode */
    int clip;        /* of GN_ACTION_PLAY; -1: no such clip */
    int64_t clip_ns; /* its length */
    int64_t sun_s;   /* of GN_ACTION_SUN: its step; 0: back to none */
    int scene;       /* a number as gn_kiosk_scene() returns it */
    enum gn_kiosk_caption caption;
    uint32_t camera; /* as in gn_kiosk */
    int by;
};

/* The number of a place's scene: the one that the mode names, else the one of the list. */
int gn_kiosk_scene(const struct gn_kiosk_rules *rules, const struct gn_kiosk_place *place);
bool gn_kiosk_is_dark(const struct gn_kiosk *state);
bool gn_kiosk_waits(const struct gn_kiosk *state); /* the wanted place is not shown yet */
struct gn_kiosk gn_kiosk_step(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state,
                              const struct gn_kiosk_event *event);

/* What a frame shows that is on the screen at seen_ns. */
struct gn_kiosk_view {
    int mode, scene;
    uint32_t camera;
    int64_t time_ns; /* of the scene */
    int64_t clips_begun_ns;
    int clip;        /* that plays once; -1: none */
    int64_t clip_ns; /* its time */
    bool stands;     /* paused */
    bool dark, info;
    float old; /* weight of the kept picture in a fade, 1 to 0 */
    enum gn_kiosk_caption caption;
    int caption_mode, caption_scene; /* that the caption names */
};
struct gn_kiosk_view gn_kiosk_view(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state,
                                   int64_t seen_ns);
/* When the next GN_KIOSK_TICK is due; INT64_MAX: never. */
int64_t gn_kiosk_deadline(const struct gn_kiosk_rules *rules, const struct gn_kiosk *state);

#endif
