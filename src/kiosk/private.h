/* The kiosk, inside: its state in parts, and what its files call of each other. The files stand
 * from the top to the bottom: each calls only those after it. */
#ifndef GN_KIOSK_PRIVATE_H
#define GN_KIOSK_PRIVATE_H

#include <limits.h>

#include "caption/captions.h"
#include "core/loop.h"
#include "kiosk/control/answer.h"
#include "kiosk/info_page.h"
#include "kiosk/latency.h"
#include "kiosk/machine.h"
#include "kiosk/part.h"
#include "kiosk/screenshot.h"
#include "kiosk/show.h"
#include "kiosk/split.h"
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
/* Modes: those of the INI file, else the techniques. */
struct gn_show_modes {
    int count, first;
    const char *names[GN_KIOSK_MODES_MAX];
    int settings[GN_KIOSK_MODES_MAX]; /* places in options->all */
    int base;                         /* the one without settings of its own; -1: none */
};
/* Of one scene, for each mode: how it is drawn, and about its programs. */
struct gn_show_looks {
    struct gn_stage_look of[GN_KIOSK_MODES_MAX];
    uint32_t ready, made; /* bits 1 << mode: they are there; they were made at least once */
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

/* A reload, and the first load: its scene loads while frames go on. */
enum { GN_SHOW_RELOAD = GN_KIOSK_SCENES_MAX /* the number of its scene */, GN_SHOW_WHY = 512 };
enum gn_reload_cause {
    GN_RELOAD_ASKED, /* SIGHUP, ctl reload */
    GN_RELOAD_FILE,  /* ctl scene and rollback: a failure is told to the client alone */
    GN_RELOAD_DROP,  /* a file dropped onto the window: a caption has a failure for a while */
    GN_RELOAD_SEEN,  /* a file that is shown has changed: likewise */
};
struct gn_show_wish { /* the reload that the next step begins, once `reloads` is set */
    enum gn_reload_cause cause;
    char file[PATH_MAX]; /* of GN_RELOAD_FILE; "": the options' scenes */
};
struct gn_show_reload {
    struct gn_options *options; /* read; NULL: none */
    struct gn_loaded *loaded;   /* their scene; NULL: not yet, or it is staged */
    const char *file;           /* as in gn_show_config */
    enum gn_reload_cause cause;
    int scene;             /* of the list of next-scene, where the mode names none */
    bool first;            /* there is nothing to go back to */
    bool alone;            /* its scene did not fit on the GPU beside the one that is shown */
    char why[GN_SHOW_WHY]; /* why the built-in scene replaces the first one; "": it does not */
};

/* Texts on the picture. */
struct gn_show_text {
    struct gn_captions *captions;
    struct gn_info_page page;
    int bar;                   /* percent of a load, as the last frame showed it; -1: none */
    char help[1536];           /* in place of the information page; "": none */
    struct gn_kiosk_view view; /* that the last caption is about, */
    int64_t since_ns;          /* and since when */
    char modes[120];           /* of the split screen */
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

/* ---- reload.c: SIGHUP, ctl reload and ctl scene ---------------------------------------------- */

/* The reload that show->wish wants: reads the options again, and begins to load their scene, or the
 * wish's file in all modes. An unfinished reload is dropped. */
void gn_show_reload(struct gn_show *show);
/* The functions of struct gn_part_host. */
bool gn_show_renew(struct gn_show *show, bool turned);
void gn_show_scene_files(const struct gn_show *show, const char *out_paths[3]);
/* The same with another scene in all modes, as a file that is dropped onto the window. If it cannot
 * be loaded a caption has the reason for a while. */
void gn_show_load_file(struct gn_show *show, const char *path);
/* The first load: starts it and waits for a second; then frames begin without it. */
bool gn_show_load_first(struct gn_show *show, struct gn_err *err);
/* Goes on with either. False: the new configuration cannot be shown and the old one is gone. */
bool gn_show_step_reload(struct gn_show *show, struct gn_err *err);
void gn_show_drop_reload(struct gn_show *show);

/* control/answer.c stands here; see control/answer.h. */

/* viewer.c stands here; see viewer.h. */

/* ---- frame.c: from the state to a frame ------------------------------------------------------ */

bool gn_show_wants_frame(const struct gn_show *show);
bool gn_show_frame(struct gn_show *show, struct gn_err *err);

/* split.c stands here; see split.h. */

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

/* ---- captions.c: texts on the picture -------------------------------------------------------- */

/* With the font of the settings; called again after a reload. A font that cannot be used is an
 * error that lasts. */
void gn_show_open_captions(struct gn_show *show);
/* Sets the texts of the frame of that view. */
void gn_show_write_captions(struct gn_show *show, const struct gn_kiosk_view *view, int64_t now_ns);
/* The last part of a path; NULL: the built-in scene. */
const char *gn_show_path_name(const char *path);
/* When the texts need another frame; 0: at once, INT64_MAX: never. */
int64_t gn_show_captions_due_ns(const struct gn_show *show);
/* The bar of a load wants another frame; when to ask again (INT64_MAX: nothing loads,
 * or the screen is dark or has no monitor). */
bool gn_show_bar_moves(const struct gn_show *show);
int64_t gn_show_bar_due_ns(const struct gn_show *show);

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

/* truth.c stands here; see truth.h. */

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

/* ---- modes.c: the list of modes, and one of them entered ------------------------------------- */

/* Fills modes, scenes and rules from the options. */
void gn_show_list_modes(struct gn_show *show);
/* -1: no mode of that name. */
int gn_show_find_mode(const struct gn_show_modes *modes, const char *name);
const struct gn_settings *gn_show_settings(const struct gn_show *show, int mode);
/* Rules that `ctl set` may change: idle, fade, captions. */
void gn_show_take_rules(struct gn_show *show);
/* How each mode draws that scene. */
bool gn_show_look(const struct gn_show *show, const struct gn_scene *scene,
                  struct gn_show_looks *looks, struct gn_err *err);
/* Puts the settings of the mode that is shown on the stage. */
void gn_show_enter(struct gn_show *show);
/* Sets the camera of a view; called for each frame. */
void gn_show_take_view(struct gn_show *show, const struct gn_kiosk_view *view, int64_t seen_ns);

#endif
