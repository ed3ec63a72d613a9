/* The truth right of the line of the split screen: what `render --shadow truth` draws of the shown
 * mode's moment. A thread casts the rays while the scene's time stands; once the view changes they
 * are dropped, and cast again when it has rested. */
#ifndef GN_KIOSK_TRUTH_H
#define GN_KIOSK_TRUTH_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"
#include "stage/view.h"

struct gn_show_screen;
struct gn_rays;

struct gn_show_truth { /* zeroed: off */
    bool on, shown, pauses;
    struct gn_rays *rays; /* NULL: none yet */
    struct gn_view view;  /* that they are cast for, and drawn in */
    uint64_t generation;  /* of the shown view, of which they are */
    int64_t changed_ns;   /* when that changed last */
    int percent;          /* that the caption shows */
    int64_t told_ns;      /* since when */
};

/* The scene's time stands until the end, which also comes when that goes on. */
void gn_truth_begin(struct gn_show_screen *screen);
void gn_truth_end(struct gn_show_screen *screen);
/* Ends the thread and what belongs to the context; the scene may go. */
void gn_truth_drop(struct gn_show_screen *screen);
/* Before frames: shows how many rays are cast. */
void gn_truth_step(struct gn_show_screen *screen);
bool gn_truth_wants_frame(const struct gn_show_screen *screen);
int64_t gn_truth_due_ns(
    const struct gn_show_screen *screen); /* when to step again; INT64_MAX: never */
/* Draws the truth of the shown view once it is there, until then the shown view itself. NULL on
 * failure. */
const struct gn_plan *gn_truth_draw(struct gn_show_screen *screen, int64_t time_ns,
                                    struct gn_err *err);

#endif
