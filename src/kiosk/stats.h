/* Statistics on stdout: with --stats a line a second, with -v a line with the first frame. */
#ifndef GN_KIOSK_STATS_H
#define GN_KIOSK_STATS_H

#include "core/loop.h"
#include "display/display.h"
#include "options/settings.h"

/* When the last frames were drawn: a ring. Zeroed: none. */
enum { GN_FRAME_TIMES = 256 };
struct gn_frame_times {
    int64_t ns[GN_FRAME_TIMES];
    unsigned next;
};
void gn_frame_times_add(struct gn_frame_times *times, int64_t now_ns);
/* How many were drawn in the second before; at most GN_FRAME_TIMES. */
int gn_frame_times_fps(const struct gn_frame_times *times, int64_t now_ns);

struct gn_show_stats {
    const struct gn_display *display;
    struct gn_timer timer; /* of the next line; added only where lines are wanted */
    int64_t due_ns;
    bool first_printed, prints_first;
    int64_t last_ns, draw_ns; /* since the last line: time spent drawing */
    uint64_t drawn, all_drawn;
    struct gn_screen_counts last;
};

/* Zeroed before. From now on the loop prints a line a second to stdout, if the settings want it. */
void gn_show_stats_open(struct gn_show_stats *stats, const struct gn_settings *settings,
                        const struct gn_display *display, struct gn_loop *loop);
void gn_show_stats_close(struct gn_show_stats *stats);
/* A frame was sent that took so long to draw. */
void gn_show_stats_frame(struct gn_show_stats *stats, int64_t draw_ns);

#endif
