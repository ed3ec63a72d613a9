/* The split screen of a window: the same moment in two modes, on either side of a line that the
 * mouse drags. Each frame draws the left mode, keeps that picture, draws the mode that is shown,
 * and lays the kept part over it. */
#ifndef GN_KIOSK_SPLIT_H
#define GN_KIOSK_SPLIT_H

#include <stdbool.h>

#include "core/err.h"
#include "display/pointer.h"
#include "stage/view.h"

struct gn_show_screen;

struct gn_show_split {   /* zeroed: off */
    bool on, grips;      /* grips: the mouse drags the line */
    int left;            /* mode on the left; on the right is the one that is shown, or truth */
    float at;            /* place of the line: 0 the picture's left edge, 1 its right */
    struct gn_view view; /* of the left mode, at the moment that is shown */
};

/* On: the shown mode goes to the left, and the next one is shown on the right; off: that stays. */
void gn_split_toggle(struct gn_show_screen *screen);
/* In place of the right mode its truth, with a split if there is none; off: as before. */
void gn_split_toggle_truth(struct gn_show_screen *screen);
void gn_split_end(struct gn_show_screen *screen);
/* A drag that begins near the line moves it, and does not turn the view. */
void gn_split_take_pointer(struct gn_show_screen *screen, struct gn_pointer *pointer);
/* Draws the left mode and keeps that picture, before the frame of the shown mode at the same time
 * of the scene. NULL on failure. */
const struct gn_plan *gn_split_draw_left(struct gn_show_screen *screen, int64_t time_ns,
                                         struct gn_err *err);
void gn_split_lay_over(struct gn_show_screen *screen); /* after it */

#endif
