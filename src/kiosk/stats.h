/* What a running kiosk says of itself: with --stats a line a second, with -v when the first frame
 * is sent. */
#ifndef GN_KIOSK_STATS_H
#define GN_KIOSK_STATS_H

#include "display/display.h"
#include "options/settings.h"

struct gn_show_stats {
    int timer; /* to be watched; -1: no lines are wanted */
    bool first_is_told, tells_first;
    int64_t last_ns, draw_ns; /* since the last line: time spent drawing */
    uint64_t drawn, all_drawn;
    struct gn_screen_counts last;
};

/* With the timer at -1 before. */
bool gn_show_stats_open(struct gn_show_stats *stats, const struct gn_settings *settings,
                        struct gn_err *err);
void gn_show_stats_close(struct gn_show_stats *stats);
/* A frame was sent that took so long to draw. */
void gn_show_stats_frame(struct gn_show_stats *stats, const struct gn_display *display,
                         int64_t draw_ns);
/* Prints a line to stdout if it is time. */
void gn_show_stats_step(struct gn_show_stats *stats, const struct gn_display *display,
                        int64_t now_ns);

#endif
