/* Keys and mouse of a window: one table for the viewer, its help page, --help and the manual. */
#ifndef GN_OPTIONS_VIEWER_KEYS_H
#define GN_OPTIONS_VIEWER_KEYS_H

#include <stdint.h>

enum gn_viewer_command {
    GN_VIEWER_NONE,
    GN_VIEWER_HELP,
    GN_VIEWER_CAMERA, /* the number is the place in `keys`, from 0 */
    GN_VIEWER_ORBIT,  /* likewise: left, right, up, down */
    GN_VIEWER_SPLIT,
    GN_VIEWER_TRUTH,
    GN_VIEWER_ENVIRONMENT,
    GN_VIEWER_CLIP,
    GN_VIEWER_SLOWER,
    GN_VIEWER_FASTER,
    GN_VIEWER_SCREENSHOT,
    GN_VIEWER_RELOAD,
};
enum { GN_VIEWER_KEYS_MAX = 9 };
struct gn_viewer_key {
    const char *name, *meaning;        /* for people */
    const char *group;                 /* of the rows from this one on; NULL: as before */
    enum gn_viewer_command command;    /* NONE: the window or the mouse does it */
    const char *letters;               /* characters, wherever the layout has them; or NULL */
    uint16_t keys[GN_VIEWER_KEYS_MAX]; /* enum gn_key; 0: no more */
};
extern const struct gn_viewer_key gn_viewer_keys[]; /* ends with a NULL name */

/* The row of a key, and its place there; NULL: none. */
const struct gn_viewer_key *gn_viewer_key_find(unsigned key, int *place);
const struct gn_viewer_key *gn_viewer_letter_find(char letter);

#endif
