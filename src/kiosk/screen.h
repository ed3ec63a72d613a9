/* A screen of the kiosk: its display, its GL context, the scene and the views in it, its captions,
 * and its share of the machine. The process (private.h) has the loop, options, loader, input and
 * parts; these functions find it by screen->show, and know of no other screen. They stand
 * in the order of README.md; some have headers of their own. */
#ifndef GN_KIOSK_SCREEN_H
#define GN_KIOSK_SCREEN_H

#include "kiosk/modes.h"
#include "kiosk/split.h"
#include "kiosk/still.h"
#include "kiosk/text.h"
#include "kiosk/truth.h"
#include "kiosk/turntable.h"
#include "kiosk/viewer.h"
#include "options/options.h"
#include "stage/loader.h"
#include "stage/stage.h"

/* ---- the state ------------------------------------------------------------------------------ */

/* The context of its GL. */
struct gn_show_context {
    struct gn_screen_opts screen_opts;
    uint32_t generation;     /* of the context that stage.gl lives in; 0: none */
    bool message;            /* the screen shows a text in place of pictures */
    bool lacks_range;        /* and a problem says so */
    const char *scaled_by;   /* what makes the last frame as large as the screen: "plane", "blit",
                                "none"; NULL: no frame yet */
    uint64_t checked_stalls; /* stalled flips when the GPU was last tested, */
    int64_t checked_ns;      /* which was then */
};
struct gn_show_scaling { /* scale = auto */
    double automatic;    /* that was decided; 0: not yet, for the scene and that size */
    uint32_t width_px, height_px;
};
struct gn_show_hand { /* of who turns the view */
    struct gn_turntable turntable;
    bool holds; /* the window's left button */
    bool wakes; /* a touch of a dark screen, in this step */
};
struct gn_show_staged {         /* a scene that is to be shown next, or a reload's */
    struct gn_loaded *loaded;   /* NULL: there is none */
    struct gn_view view;        /* of it, for its programs; its pose once the upload has begun */
    bool whole;                 /* all of it is on the GPU */
    uint64_t sent, all;         /* bytes of it that are there, and of all of it, about */
    bool stale;                 /* dropped in a pause: gone after that frame */
    struct gn_show_looks looks; /* of it; a reload's has one, at 0 */
};
/* Work ahead: pieces that are done between frames. */
struct gn_show_ahead {
    int64_t due_ns;   /* when the next piece is, if there is any */
    bool idle;        /* there was none at the last attempt */
    bool alone;       /* frames are slow: a piece is a step of its own, */
    bool has_turn;    /* and this one is */
    int64_t until_ns; /* after a slow frame work on what is waited for has all turns until then */
    bool dropped;     /* memory is to be returned to the system */
    bool keeps;       /* the programs of the mode that is shown are marked as such */
};
/* A fade begins with a kept picture. */
struct gn_show_fade {
    bool prepared;    /* the GPU has what keeping takes */
    bool keeps, kept; /* the next frame's picture is to be kept; it was */
};

struct gn_show;
struct gn_show_screen {
    struct gn_show *show; /* the process */
    struct gn_stage stage;
    int scene;                  /* the number of the stage's scene */
    struct gn_show_looks looks; /* of the stage's scene */
    struct gn_show_staged staged;
    struct gn_show_context context;
    struct gn_show_scaling scaling;
    struct gn_kiosk_rules rules;
    struct gn_kiosk kiosk;
    struct gn_kiosk_view drawn; /* by the last frame */
    struct gn_show_text text;
    struct gn_show_ahead ahead;
    struct gn_show_fade fade;
    struct gn_show_hand hand;
    const struct gn_scene *clips_of; /* whose pose was chosen last: another one's was not seen */
    int64_t clips_begun_ns;          /* when other clips were chosen: stage.pose.at.fade */
    struct gn_show_viewer viewer;
    struct gn_show_split split;
    struct gn_show_truth truth; /* while the split is on */
    struct gn_show_still still;
    bool changed; /* the next picture differs: draw it */
    bool pauses;  /* a frame is being drawn: nothing may use its GL */
};

/* ---- step.c: the top ------------------------------------------------------------------------ */

int64_t gn_show_screen_due_ns(const struct gn_show_screen *screen); /* of the next step; 0: now */
/* The parts of a step, in this order: events of the display, moves and input; the machine and the
 * context; the wanted mode and scene, then at most a frame. */
bool gn_show_take_events(struct gn_show_screen *screen, struct gn_err *err);
bool gn_show_step_machine(struct gn_show_screen *screen, struct gn_err *err);
bool gn_show_step_picture(struct gn_show_screen *screen, struct gn_err *err);

/* ---- frame.c: from the state to a frame ------------------------------------------------------ */

bool gn_show_wants_frame(const struct gn_show_screen *screen);
bool gn_show_frame(struct gn_show_screen *screen, struct gn_err *err);

/* ---- screen.c: the display and its context --------------------------------------------------- */

bool gn_show_open_display(struct gn_show_screen *screen, struct gn_err *err);
/* False: between these settings the display has to be opened again. */
bool gn_show_same_screen(const struct gn_settings *a, const struct gn_settings *b);
/* The share of the screen's width and height that the scene is drawn at. */
double gn_show_scale(const struct gn_show_screen *screen);
/* Where the scene is drawn smaller and the display can scale, it does for this frame. bare: nothing
 * is drawn over the scene, as large as the screen. After gn_show_fit_to_screen(). */
void gn_show_scale_frame(struct gn_show_screen *screen, bool bare);
/* Frame options that follow from the screen: size, scale, rotation, encoding, MSAA. */
void gn_show_fit_to_screen(struct gn_show_screen *screen);
bool gn_show_is_stale(const struct gn_show_screen *screen); /* gn_show_keep_context() is due */
/* Renews a lost context and starts GL in a new one. A failure of GL is shown on the screen. */
bool gn_show_keep_context(struct gn_show_screen *screen, struct gn_err *err);
void gn_show_stop_gl(struct gn_show_screen *screen);

/* ---- set.c: options set while it runs ------------------------------------------------------- */

bool gn_show_set_option(struct gn_show_screen *screen, const struct gn_option_row *row,
                        const char *text, struct gn_err *err);
/* Shows what was set as soon as its programs are made; to be called after work ahead. */
void gn_show_enter_set(struct gn_show_screen *screen);

/* ---- ahead.c: programs and scenes made ready while others are shown -------------------------- */

/* Does a piece, if there is any: a program, or an upload of at most 1 MiB. While the wanted mode or
 * scene waits, as many as a quarter of a frame's time allows. */
void gn_show_work(struct gn_show_screen *screen);
/* Other programs than before are needed. */
void gn_show_unready(struct gn_show_screen *screen);
bool gn_show_has_work(const struct gn_show_screen *screen);
/* The context ends, and with it all programs and uploads. */
void gn_show_forget_work(struct gn_show_screen *screen);
/* Loads the wanted scene, and shows the wanted mode and scene once they are ready. */
void gn_show_advance(struct gn_show_screen *screen);
/* The next step shows another mode or scene: a complete reload (gn_show_step_reload()), or what is
 * wanted (gn_show_advance()). */
bool gn_show_can_advance(const struct gn_show_screen *screen);
/* Stages reload.loaded, or changes the look of what is staged. If its programs fail later,
 * reload.loaded has the reason. */
void gn_show_stage_reload(struct gn_show_screen *screen, const struct gn_stage_look *look);
bool gn_show_reload_is_staged(const struct gn_show_screen *screen); /* complete or not */
bool gn_show_reload_is_ready(const struct gn_show_screen *screen);  /* it is complete */
/* Replaces the stage's scene by the staged one. With GL only if that is complete. */
void gn_show_take_staged(struct gn_show_screen *screen);
void gn_show_drop_staged(struct gn_show_screen *screen);

/* ---- moves.c: moves by hand to the view ------------------------------------------------------ */

void gn_show_take_moves(struct gn_show_screen *screen, struct gn_pointer *pointer);
void gn_show_wake_by_hand(struct gn_show_screen *screen); /* after gn_show_take_input() */
void gn_show_suppress_taps(struct gn_show_screen *screen);
void gn_show_turn_home(struct gn_show_screen *screen); /* the view is the camera's again */
bool gn_show_turntable_moves(const struct gn_show_screen *screen);
int64_t gn_show_turntable_due_ns(
    const struct gn_show_screen *screen); /* when it goes on; INT64_MAX */
void gn_show_step_turntable(struct gn_show_screen *screen, int64_t seen_ns, int64_t scene_ns);

#endif
