/* A reload (SIGHUP, ctl reload and ctl scene, a file that changed), and the first load: its scene
 * loads while frames go on. */
#ifndef GN_KIOSK_RELOAD_H
#define GN_KIOSK_RELOAD_H

#include <limits.h>
#include <stdbool.h>

#include "core/err.h"
#include "kiosk/machine.h"

struct gn_loaded;
struct gn_options;
struct gn_show;

enum { GN_SHOW_RELOAD = GN_KIOSK_SCENES_MAX /* the number of its scene */, GN_SHOW_WHY = 512 };
enum gn_reload_cause {
    GN_RELOAD_ASKED, /* SIGHUP, ctl reload */
    GN_RELOAD_FILE,  /* ctl scene and rollback: a failure is told to the client alone */
    GN_RELOAD_DROP,  /* a file dropped onto the window: a caption tells of a failure */
    GN_RELOAD_SEEN,  /* a file that is watched has changed: likewise; but what cannot be read in
                        kiosk.ini stays (begin_reload()), as of ASKED */
};
struct gn_show_wish { /* begins when `reloads` is set and the first scene is there */
    enum gn_reload_cause cause;
    char file[PATH_MAX]; /* "": the options' scenes */
};
struct gn_show_reload {
    struct gn_options *options; /* read; NULL: none */
    struct gn_loaded *loaded;   /* their scene, or without one why it failed: in the loader, or once
                                   it was staged (fail_reload()); NULL: not yet, or it is staged */
    const char *file;           /* as in gn_show_config */
    enum gn_reload_cause cause;
    int scene;             /* of the list of next-scene, where the mode names none */
    bool first;            /* there is nothing to go back to */
    bool alone;            /* its scene did not fit on the GPU beside the one that is shown */
    char why[GN_SHOW_WHY]; /* why the built-in scene replaces the first one; "": it does not */
};

/* If one is wanted (`reloads`, with show->wish): reads the options again into show->reload;
 * gn_show_step_reload() loads their scene, or the wish's file in all modes. An unfinished reload is
 * dropped. */
void gn_show_reload(struct gn_show *show);
/* The same with another scene in all modes, as a file that is dropped onto the window. If it cannot
 * be loaded a caption says so, and the status has the reason. */
void gn_show_load_file(struct gn_show *show, const char *path);
/* The first load: starts it and waits for a second; then frames begin without it. */
bool gn_show_load_first(struct gn_show *show, struct gn_err *err);
/* Goes on with either. False: the new configuration cannot be shown, and the old one is gone or
 * there was none. */
bool gn_show_step_reload(struct gn_show *show, struct gn_err *err);
void gn_show_drop_reload(struct gn_show *show);
/* Both for struct gn_part_host. */
bool gn_show_renew(struct gn_show *show, bool turned);
void gn_show_scene_files(const struct gn_show *show, const char *out_paths[3]);

#endif
