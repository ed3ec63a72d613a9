/* What a folder of content shows: its kiosk.ini, or its one scene. */
#ifndef GN_TAKE_SHOWN_H
#define GN_TAKE_SHOWN_H

#include <limits.h>
#include <stdbool.h>

#define GN_TAKE_CURRENT "current"
#define GN_TAKE_INI     "kiosk.ini"

struct gn_take_shown {
    char folder[PATH_MAX]; /* without links: another version is another folder */
    char ini[PATH_MAX];    /* "": there is none, and `scene` is shown */
    char scene[PATH_MAX];  /* "": the configuration names it */
};
/* The folder is one that `gnomon take` keeps, whose link `current` leads to what is shown, or,
 * without such a link, any one. False: nothing is there. */
bool gn_take_shown(const char *folder, struct gn_take_shown *out);

/* By its suffix: .glb, .gltf or what gnomon-import reads. */
bool gn_take_is_scene(const char *name);

#endif
