/* The kiosk, inside: its state in parts, and what its files call of each other. The files stand
 * from the top to the bottom, in the order of README.md: each calls only those after it. Some have
 * headers of their own. */
#ifndef GN_KIOSK_PRIVATE_H
#define GN_KIOSK_PRIVATE_H

#include <limits.h>

#include "core/loop.h"
#include "kiosk/control/answer.h"
#include "kiosk/latency.h"
#include "kiosk/modes.h"
#include "kiosk/part.h"
#include "kiosk/reload.h"
#include "kiosk/screenshot.h"
#include "kiosk/show.h"
#include "kiosk/split.h"
#include "kiosk/text.h"
#include "kiosk/truth.h"
#include "kiosk/turntable.h"
#include "kiosk/viewer.h"
#include "options/binding.h"
#include "options/change.h"
#include "stage/loader.h"
#include "stage/stage.h"

/* ---- the state ------------------------------------------------------------------------------ */

struct gn_show_config {
    struct gn_options *options;  /* owned: a reload makes others */
    struct gn_changes *changes;  /* by `ctl set`; NULL: none yet */
    char asked[PATH_MAX];        /* the scene that the options want; "": the default one */
    bool waits;                  /* options were set that are not shown yet */
    const char *file;            /* in place of the options' scene, in their arena; or NULL */
    bool has_past;               /* that was replaced by a file: */
    char past[PATH_MAX];         /* the one before; "": the options' scenes */
    struct gn_show_place *place; /* NULL: the options say where */
    char error[512];             /* of start or the last reload; options->config_error */
};
/* The screen's context, and what frames are drawn with in it. */
struct gn_show_context {
    struct gn_screen_opts screen_opts;
    uint32_t generation;     /* of the context that stage.gl lives in; 0: none */
    bool message;            /* the screen shows a text in place of pictures */
    bool lacks_range;        /* and a problem says so */
    uint64_t checked_stalls; /* stalled flips when the GPU was last tested, */
    int64_t checked_ns;      /* which was then */
};
struct gn_show_buttons {
    struct gn_buttons map;
    struct gn_button_opts opts[GN_BUTTONS_MAX]; /* of the map, for the input */
    struct gn_input *input;                     /* NULL while there is none */
    struct gn_latency latency;
};
struct gn_show_hand { /* of who turns the view */
    struct gn_turntable turntable;
    bool holds; /* the window's left button */
    bool wakes; /* a touch of a dark screen, in this step */
};
struct gn_show_scenes {
    const char *paths[GN_KIOSK_SCENES_MAX]; /* NULL: the default scene */
    int count, listed;                      /* the first `listed` are those of next-scene */
    int shown;                              /* the number of the stage's scene */
    struct gn_loader *loader;
    struct gn_watch loader_watch;
    int64_t load_begun_ns;
    struct gn_loaded *staged;   /* loaded, to be shown next, or a reload's; NULL: none */
    struct gn_view view;        /* of it, for its programs; its pose once the upload has begun */
    bool whole;                 /* all of the staged scene is on the GPU */
    struct gn_show_looks looks; /* of the staged scene; a reload's has one, at 0 */
};

/* Work ahead: pieces that are done between frames. */
struct gn_show_ahead {
    int64_t due_ns; /* when the next piece is, if there is any */
    bool idle;      /* there was none at the last attempt */
    bool alone;     /* frames are slow: a piece is a step of its own, */
    bool has_turn;  /* and this one is */
    bool dropped;   /* memory is to be returned to the system */
    bool keeps;     /* the programs of the mode that is shown are marked as such */
};
/* A fade begins with a kept picture. */
struct gn_show_fade {
    bool prepared;    /* the GPU has what keeping takes */
    bool keeps, kept; /* the next frame's picture is to be kept; it was */
};
/* The first scene: it may not be loaded, and another be shown in its place. */
struct gn_show_first {
    int scene;              /* in the list of next-scene, as the state has it */
    char lost[GN_SHOW_WHY]; /* why; "": it was loaded */
    const char *instead;    /* what is shown */
    int tries;              /* of the scenes of the state */
};
struct gn_show {
    struct gn_show_config config;
    struct gn_warnings *warnings;
    struct gn_loop *loop;
    struct gn_signals signals;
    struct gn_stage stage;
    struct gn_show_context context;
    struct gn_show_buttons buttons;
    struct gn_show_hand hand;
    struct gn_show_modes modes;
    struct gn_show_looks looks; /* of the stage's scene */
    struct gn_show_scenes scenes;
    struct gn_show_wish wish;
    struct gn_show_reload reload;
    struct gn_kiosk_rules rules;
    struct gn_kiosk kiosk;
    struct gn_kiosk_view drawn; /* by the last frame */
    struct gn_show_text text;
    struct gn_problems problems;
    struct gn_show_ahead ahead;
    struct gn_show_fade fade;
    const struct gn_scene *clips_of; /* whose pose was chosen last: another one's was not seen */
    int64_t clips_begun_ns;          /* when other clips were chosen: stage.pose.at.fade */
    struct gn_show_counts counts;
    struct gn_parts parts;
    struct gn_show_first first;
    struct gn_show_control *control;  /* NULL: no control socket */
    struct gn_screenshot *screenshot; /* NULL without control */
    struct gn_show_viewer viewer;
    struct gn_show_split split;
    struct gn_show_truth truth; /* while the split is on */
    bool changed;               /* the next picture differs: draw it */
    bool ends, reloads, failed;
};

/* ---- show.c: the top; these for tests ------------------------------------------------------- */

struct gn_show *gn_show_open(const struct gn_options *options, struct gn_warnings *warnings,
                             struct gn_err *err);
void gn_show_close(struct gn_show *show);
/* Waits until something is to be done, and does it: at most a frame. All times are the loop's: a
 * test may step it on a fake clock. */
bool gn_show_step(struct gn_show *show, struct gn_err *err);

/* ---- remember.c: [kiosk] state --------------------------------------------------------------- */

/* Whether there is another scene to load in place of the first, which could not be: the options
 * then name it. */
bool gn_show_try_other(struct gn_show *show, struct gn_options **options,
                       const struct gn_loaded *loaded);

/* ---- frame.c: from the state to a frame ------------------------------------------------------ */

bool gn_show_wants_frame(const struct gn_show *show);
bool gn_show_frame(struct gn_show *show, struct gn_err *err);

/* ---- screen.c: the display and its context --------------------------------------------------- */

bool gn_show_open_display(struct gn_show *show, struct gn_err *err);
/* False: between these settings the display has to be opened again. */
bool gn_show_same_screen(const struct gn_settings *a, const struct gn_settings *b);
/* Frame options that follow from the screen: size, rotation, encoding, MSAA. */
void gn_show_fit_to_screen(struct gn_show *show);
bool gn_show_is_stale(const struct gn_show *show); /* gn_show_keep_context() is due */
/* Renews a lost context and starts GL in a new one. A failure of GL is shown on the screen. */
bool gn_show_keep_context(struct gn_show *show, struct gn_err *err);
void gn_show_stop_gl(struct gn_show *show);

/* ---- set.c: options set while it runs ---------------------------------------------------------
 */

bool gn_show_set_option(struct gn_show *show, const struct gn_option_row *row, const char *text,
                        struct gn_err *err);
/* Shows what was set as soon as its programs are made; to be called after work ahead. */
void gn_show_enter_set(struct gn_show *show);

/* ---- ahead.c: programs and scenes made ready while others are shown -------------------------- */

/* Does a piece, if there is any: a program, or an upload of at most 1 MiB. While the wanted mode or
 * scene waits, as many as a quarter of a frame's time allows. */
void gn_show_work(struct gn_show *show);
/* Other programs than before are needed. */
void gn_show_unready(struct gn_show *show);
bool gn_show_has_work(const struct gn_show *show);
/* The context ends, and with it all programs and uploads. */
void gn_show_forget_work(struct gn_show *show);
bool gn_show_open_loader(struct gn_show *show, struct gn_err *err);
void gn_show_close_loader(struct gn_show *show);
/* Not while the loader is busy. path NULL: the default scene. */
void gn_show_start_load(struct gn_show *show, int number, const char *path,
                        const struct gn_settings *settings);
/* Loads the wanted scene, and shows the wanted mode and scene once they are ready. */
void gn_show_advance(struct gn_show *show);
/* gn_show_advance() can show the wanted mode and scene now. */
bool gn_show_can_advance(const struct gn_show *show);
/* Stages reload.loaded, or changes the look of what is staged. A failure is in reload.loaded. */
void gn_show_stage_reload(struct gn_show *show, const struct gn_stage_look *look);
bool gn_show_reload_is_staged(const struct gn_show *show); /* complete or not */
bool gn_show_reload_is_ready(const struct gn_show *show);  /* it is complete */
/* Replaces the stage's scene by the staged one. With GL only if that is complete. */
void gn_show_take_staged(struct gn_show *show);
void gn_show_drop_staged(struct gn_show *show);

/* ---- input.c: buttons and keys --------------------------------------------------------------- */

/* After the display is open: a window has keys of its own. Called again after a reload. */
bool gn_show_open_input(struct gn_show *show, struct gn_err *err);
/* Turns gestures into actions, and reports of the input into warnings on stderr. */
void gn_show_take_input(struct gn_show *show, const struct gn_pointer *pointer);

/* ---- moves.c: moves by hand to the view ------------------------------------------------------ */

void gn_show_take_moves(struct gn_show *show, struct gn_pointer *pointer);
void gn_show_wake_by_hand(struct gn_show *show); /* after gn_show_take_input() */
void gn_show_suppress_taps(struct gn_show *show);
void gn_show_turn_home(struct gn_show *show); /* the view is the camera's again */
bool gn_show_turntable_moves(const struct gn_show *show);
int64_t gn_show_turntable_due_ns(const struct gn_show *show); /* when it goes on; INT64_MAX */
void gn_show_step_turntable(struct gn_show *show, int64_t seen_ns, int64_t scene_ns);

/* ---- begin.c: from arguments to a first mode ------------------------------------------------- */

/* With the settings of the first mode, or of none. */
struct gn_options *gn_show_read_options(const struct gn_options *like, struct gn_warnings *warnings,
                                        struct gn_err *err);
void gn_show_drop_options(struct gn_options *options);
/* That scene in all modes. Returns the path's copy, which is the options'. */
const char *gn_show_put_file(struct gn_options *options, const char *path);
/* That scene where the settings name the path; NULL: the built-in one. */
void gn_show_replace_scene(struct gn_options *options, const char *path, const char *by);
/* A black stage, and options without any scene; those that there are become a reload's. */
bool gn_show_load_nothing(struct gn_show *show, struct gn_err *err);
/* How the options draw the scene of the first load. If that failed, the built-in scene replaces it
 * in both, and why has the reason for the screen, else "". Not in a window, whose user reads it in
 * the terminal. */
bool gn_show_look_at_first(const struct gn_show *show, struct gn_options *options,
                           struct gn_loaded *loaded, struct gn_stage_look *look,
                           char why[GN_SHOW_WHY], struct gn_err *err);
/* After the options and the stage are loaded: lists modes and scenes, enters the first. */
bool gn_show_begin(struct gn_show *show, struct gn_err *err);

/* ---- events.c: actions as events of the machine ---------------------------------------------- */

void gn_show_act(struct gn_show *show, const struct gn_action *action, int64_t time_ns);
/* Whether there is the mode, or in the scene that is shown the clip, that it names. */
bool gn_show_check_action(const struct gn_show *show, const struct gn_action *action,
                          struct gn_err *err);
/* A caption of the viewer, for 2 s. */
__attribute__((format(printf, 2, 3))) void gn_show_note(struct gn_show *show, const char *format,
                                                        ...);
/* One that lasts: the caption stays until a reload, and the status has it as config.error. */
void gn_show_report_error(struct gn_show *show, enum gn_problem kind, const char *text);

#endif
