/* What the kiosk counts while it runs. */
#ifndef GN_KIOSK_STATS_H
#define GN_KIOSK_STATS_H

#include <stdint.h>

/* When the last frames were drawn: a ring. Zeroed: none. */
enum { GN_FRAME_TIMES = 256 };
struct gn_frame_times {
    int64_t ns[GN_FRAME_TIMES];
    unsigned next;
};
void gn_frame_times_add(struct gn_frame_times *times, int64_t now_ns);
/* How many were drawn in the second before; at most GN_FRAME_TIMES. */
int gn_frame_times_fps(const struct gn_frame_times *times, int64_t now_ns);

struct gn_show_counts {
    int64_t begun_ns; /* the program, about */
    uint64_t presses; /* of buttons and keys that did something */
    uint64_t frames, most_frames;
    unsigned long allocations; /* in frames after the first, without work ahead */
    uint64_t objects;          /* of GL, in those of them that show what the one before shows */
    struct gn_frame_times times;
};

#endif
