/* The list of modes, and one of them entered. */
#ifndef GN_KIOSK_MODES_H
#define GN_KIOSK_MODES_H

#include "kiosk/machine.h"
#include "kiosk/offers.h"
#include "options/options.h"
#include "stage/stage.h"

struct gn_show;
struct gn_show_screen;

/* Modes: those of the INI file, else what the scene offers, else the techniques. Of these a kiosk
 * goes through soft, sharp and no shadows, unless an option or a button names one; a window through
 * all. */
struct gn_show_modes {
    int count, first; /* first: that is entered, of options->settings or resumes */
    const char *names[GN_KIOSK_MODES_MAX];
    char titles[GN_KIOSK_MODES_MAX][64]; /* the same on the screen */
    uint32_t passed_by;                  /* as in gn_kiosk_rules */
    int settings[GN_KIOSK_MODES_MAX];    /* places in options->all */
    int base;                            /* the one without settings of its own; -1: none */
    bool offered;                        /* they are these: */
    struct gn_offers offers;
};
/* Of one scene, for each mode: how it is drawn, and about its programs. */
struct gn_show_looks {
    struct gn_stage_look of[GN_KIOSK_MODES_MAX];
    uint32_t ready, made; /* bits 1 << mode: they are there; they were made at least once */
};

/* Whether with these options the modes are what the scene offers (gn_options_leave_modes()). In a
 * window they are the techniques. */
bool gn_show_offers(const struct gn_show *show, const struct gn_options *options);
/* Fills modes, scenes and rules from the options and the stage's scene, which is the one of that
 * place in the list of next-scene. */
void gn_show_list_modes(struct gn_show *show, int scene);
/* Another scene is shown: its own offers, where the modes are offers. */
void gn_show_list_again(struct gn_show_screen *screen);
/* -1: no mode of that name. */
int gn_show_find_mode(const struct gn_show_modes *modes, const char *name);
const struct gn_settings *gn_show_settings(const struct gn_show *show, int mode);
/* Rules that `ctl set` may change: idle, fade, captions. */
void gn_show_take_rules(struct gn_show_screen *screen);
/* Fills looks from the settings of each mode, by gn_stage_look_build(). False: one of them cannot
 * draw that scene. */
bool gn_show_build_looks(const struct gn_show *show, const struct gn_scene *scene,
                         struct gn_show_looks *looks, struct gn_err *err);
/* Puts the settings of the mode that is shown on the stage. */
void gn_show_enter(struct gn_show_screen *screen);
/* Sets the camera of a view; called for each frame. */
void gn_show_take_view(struct gn_show_screen *screen, const struct gn_kiosk_view *view,
                       int64_t seen_ns);

#endif
