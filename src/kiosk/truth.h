/* The truth right of the line of the split screen: what `render --shadow truth` draws of the shown
 * mode's moment. A thread casts the rays while the scene's time stands; once the view changes they
 * are dropped, and cast again when it has rested. */
#ifndef GN_KIOSK_TRUTH_H
#define GN_KIOSK_TRUTH_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"
#include "frame/frame.h"

struct gn_show;
struct gn_rays;

struct gn_show_truth { /* zeroed: off */
    bool on, shown, pauses;
    struct gn_rays *rays;   /* NULL: none yet */
    struct gn_frame *frame; /* builds the plans that are drawn with them; NULL: none yet */
    struct gn_truth_of {
        struct gn_frame_view_opts view;
        struct gn_moment moment;
        uint32_t width_px, height_px;
        int mode;
    } of;               /* what is cast */
    int64_t changed_ns; /* since then it is the same */
    int percent;        /* that the caption tells */
    int64_t told_ns;    /* when it was told */
};

/* The scene's time stands until the end, which also comes when that goes on. */
void gn_truth_begin(struct gn_show *show);
void gn_truth_end(struct gn_show *show);
/* The thread ends; the scene may go. */
void gn_truth_drop(struct gn_show *show);
/* Before frames: tells how far it is. */
void gn_truth_step(struct gn_show *show);
bool gn_truth_wants_frame(const struct gn_show *show);
int64_t gn_truth_due_ns(const struct gn_show *show); /* when to step again; INT64_MAX: never */
/* In place of gn_stage_draw() of the shown mode: that, until the truth is there. */
bool gn_truth_draw(struct gn_show *show, int64_t time_ns, struct gn_err *err);

#endif
