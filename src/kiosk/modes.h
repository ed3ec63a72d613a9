/* The list of modes, and one of them entered. */
#ifndef GN_KIOSK_MODES_H
#define GN_KIOSK_MODES_H

#include "kiosk/machine.h"
#include "stage/stage.h"

struct gn_show;
struct gn_show_screen;

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

/* Fills modes, scenes and rules from the options. */
void gn_show_list_modes(struct gn_show *show);
/* -1: no mode of that name. */
int gn_show_find_mode(const struct gn_show_modes *modes, const char *name);
const struct gn_settings *gn_show_settings(const struct gn_show *show, int mode);
/* Rules that `ctl set` may change: idle, fade, captions. */
void gn_show_take_rules(struct gn_show_screen *screen);
/* How each mode draws that scene. */
bool gn_show_look(const struct gn_show *show, const struct gn_scene *scene,
                  struct gn_show_looks *looks, struct gn_err *err);
/* Puts the settings of the mode that is shown on the stage. */
void gn_show_enter(struct gn_show_screen *screen);
/* Sets the camera of a view; called for each frame. */
void gn_show_take_view(struct gn_show_screen *screen, const struct gn_kiosk_view *view,
                       int64_t seen_ns);

#endif
