/* The state of a kiosk as JSON, for `gnomon ctl status`. */
#ifndef GN_KIOSK_CONTROL_STATUS_H
#define GN_KIOSK_CONTROL_STATUS_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "kiosk/control/control.h"

struct gn_show;

enum { GN_STATUS_FRAMES = 256 };
struct gn_show_status {
    int64_t begun_ns;
    bool waits;                          /* options were set that are not shown yet */
    int64_t frames_ns[GN_STATUS_FRAMES]; /* when the last frames were drawn, a ring */
    unsigned next;
    int64_t memory_ns; /* when it was looked at last; it is no more than once a second */
    double memory_mb;
};

void gn_show_status_begin(struct gn_show_status *status, int64_t now_ns);
void gn_show_status_frame(struct gn_show_status *status, int64_t now_ns);
/* How many frames were drawn in the second before; at most GN_STATUS_FRAMES. */
int gn_show_status_fps(const struct gn_show_status *status, int64_t now_ns);

/* New references: all of it; what an action may have changed. */
json_t *gn_show_status_make(const struct gn_show *show, struct gn_show_status *status,
                            struct gn_control_counts counts);
json_t *gn_show_status_short(const struct gn_show *show);

#endif
