/* A kiosk in a window as a viewer: its keys (options/viewer_keys.h), title and screenshots. */
#ifndef GN_KIOSK_VIEWER_H
#define GN_KIOSK_VIEWER_H

#include "display/pointer.h"
#include "kiosk/screenshot.h"

struct gn_show_screen;

struct gn_show_viewer { /* zeroed: not a window, or no key yet */
    unsigned held;      /* arrows that are down: bits 1 << place in their row */
    int64_t turned_ns;  /* up to when the view has turned for them */
    bool helps;         /* the help page is shown */
    char note[300];     /* text of GN_KIOSK_CAPTION_NOTE */
    int64_t note_ns;    /* how long it is shown at least; 0: as other captions */
    bool hinted;        /* at the key of the help page */
    char title[200];
    struct gn_screenshot *screenshot; /* NULL: none yet */
    char screenshot_path[400];
};

/* Takes the keys that are the viewer's out of the pointer, and acts on them; arrows become turns
 * there. Not those that the configuration gives to a button. */
void gn_viewer_take_keys(struct gn_show_screen *screen, struct gn_pointer *pointer);
/* Names the key of the help page once, when the first picture of the window is there. */
void gn_viewer_hint(struct gn_show_screen *screen);
/* When it is due by itself: an arrow is held down. INT64_MAX: never. */
int64_t gn_viewer_due_ns(const struct gn_show_screen *screen);
/* "sundial.glb - gnomon" */
void gn_viewer_set_title(struct gn_show_screen *screen);
void gn_viewer_close(struct gn_show_screen *screen);

#endif
