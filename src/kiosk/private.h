/* The kiosk, inside: the process, and what its files call of each other; a screen is in screen.h.
 * The files stand from the top to the bottom, in the order of README.md: each calls only those
 * after it. Some have headers of their own. */
#ifndef GN_KIOSK_PRIVATE_H
#define GN_KIOSK_PRIVATE_H

#include <limits.h>

#include "core/loop.h"
#include "kiosk/control/answer.h"
#include "kiosk/latency.h"
#include "kiosk/part.h"
#include "kiosk/reload.h"
#include "kiosk/screen.h"
#include "kiosk/show.h"
#include "options/binding.h"
#include "options/change.h"
#include "stage/loader.h"

/* ---- the state ------------------------------------------------------------------------------ */

struct gn_show_config {
    struct gn_options *options;  /* owned: a reload makes others */
    struct gn_changes *changes;  /* by `ctl set`; NULL: none yet */
    char asked[PATH_MAX];        /* the scene that the options want, or those of the last reload,
                                    even of one that failed, as it is watched; "": the default */
    bool waits;                  /* options were set that are not shown yet */
    const char *file;            /* in place of the options' scene, in their arena; or NULL */
    bool has_past;               /* that was replaced by a file: */
    char past[PATH_MAX];         /* the one before; "": the options' scenes */
    struct gn_show_place *place; /* NULL: the options say where */
    char error[512];             /* of a reload (ASKED) or gn_show_report_error(), where
                                    options->config_error points here; else it is of the start */
    char shown[192];             /* what the screen says of it, */
    enum gn_problem kind;        /* beside the words of that kind */
};
struct gn_show_buttons {
    struct gn_buttons map;
    struct gn_button_opts opts[GN_BUTTONS_MAX]; /* of the map, for the input */
    struct gn_input *input;                     /* NULL while there is none */
    struct gn_latency latency;
};
struct gn_show_scenes {
    const char *paths[GN_KIOSK_SCENES_MAX]; /* NULL: the default scene */
    int count, listed;                      /* the first `listed` are those of next-scene */
    struct gn_loader *loader;
    struct gn_watch loader_watch;
    int64_t load_begun_ns;
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
    struct gn_show_screen screen; /* the only one so far */
    struct gn_show_buttons buttons;
    struct gn_show_modes modes;
    struct gn_show_scenes scenes;
    struct gn_show_wish wish;
    struct gn_show_reload reload;
    struct gn_problems problems;
    struct gn_show_counts counts;
    struct gn_parts parts;
    struct gn_show_first first;
    struct gn_screenshot *screenshot; /* that a request asks for; NULL: none did so far */
    bool ends, failed;
    bool wants_reload; /* a reload is wanted (wish); `reload` is the one that has begun */
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

/* ---- ahead.c: scenes that load; the rest is in screen.h -------------------------------------- */

bool gn_show_open_loader(struct gn_show *show, struct gn_err *err);
void gn_show_close_loader(struct gn_show *show);
/* Not while the loader is busy. path NULL: the default scene. */
void gn_show_start_load(struct gn_show *show, int number, const char *path,
                        const struct gn_settings *settings);

/* ---- input.c: buttons and keys --------------------------------------------------------------- */

/* After the display is open: a window has keys of its own. Called again after a reload. */
bool gn_show_open_input(struct gn_show *show, struct gn_err *err);
/* Turns gestures into actions, and reports of the input into warnings on stderr. */
void gn_show_take_input(struct gn_show *show, const struct gn_pointer *pointer);

/* ---- begin.c: from arguments to a first mode ------------------------------------------------- */

/* With the settings of the first mode, or of none. A bad file is no failure: config_error then has
 * the reason. NULL: the arguments are wrong, or do not fit the file. */
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
/* After the options and the stage are loaded: lists modes and scenes, enters the first. scene: the
 * place of the stage's scene in the list of next-scene. */
bool gn_show_begin(struct gn_show *show, int scene, struct gn_err *err);

/* ---- events.c: actions as events of the machine ---------------------------------------------- */

/* The next state of the screen's machine. time_ns 0: now. */
void gn_show_send(struct gn_show_screen *screen, struct gn_kiosk_event event);
void gn_show_act(struct gn_show_screen *screen, const struct gn_action *action, int64_t time_ns);
/* Whether there is the mode, or in the scene that is shown the clip, that it names. */
bool gn_show_check_action(const struct gn_show_screen *screen, const struct gn_action *action,
                          struct gn_err *err);
/* A caption of the viewer, for 2 s. */
__attribute__((format(printf, 2, 3))) void gn_show_note(struct gn_show_screen *screen,
                                                        const char *format, ...);
/* One that lasts: a card for a while, then a mark until a reload; the status has it as config.error
 * if nothing else stands there. */
void gn_show_report_error(struct gn_show *show, enum gn_problem kind, const char *text);
/* Its end, in the caption and in the status, too. */
void gn_show_cure_error(struct gn_show *show, enum gn_problem kind);

#endif
