/* How long it takes from somebody's finger to the screen: from the time of the edge that made a
 * gesture, as the kernel stamped it, to the commit of the first frame that shows what came of it.
 * The debouncing is part of it. Pure. */
#ifndef GN_KIOSK_LATENCY_H
#define GN_KIOSK_LATENCY_H

#include <stdbool.h>
#include <stdint.h>

enum { GN_LATENCY_WAITING = 32, GN_LATENCY_FRAMES = 64, GN_LATENCY_KEPT = 256 };

struct gn_latency_sample {
    int64_t ns;
    int frames; /* committed since the edge, the one that shows it among them: 1, the very next; at
                   most GN_LATENCY_FRAMES */
};
struct gn_latency {                       /* zeroed: nothing has happened yet */
    int64_t edges_ns[GN_LATENCY_WAITING]; /* what came of them is not on its way yet */
    int waiting;
    int64_t frames_ns[GN_LATENCY_FRAMES]; /* when the last frames were committed, a ring */
    unsigned frames;
    struct gn_latency_sample kept[GN_LATENCY_KEPT]; /* a ring */
    uint64_t count;                                 /* of all that were ever seen */
    struct gn_latency_sample worst;                 /* ever, each of its own */
};

/* All times are monotonic. An edge that will change the picture; where more than
 * GN_LATENCY_WAITING wait the rest is not measured. */
void gn_latency_edge(struct gn_latency *latency, int64_t edge_ns);
/* A frame is committed; shows: what all edges so far have asked for is in it. */
void gn_latency_frame(struct gn_latency *latency, int64_t now_ns, bool shows);
/* What was asked for will not be shown. */
void gn_latency_drop(struct gn_latency *latency);

/* Of what was seen last; zeroed where nothing was. */
struct gn_latency_sample gn_latency_last(const struct gn_latency *latency);

struct gn_latency_report {
    uint64_t count;                         /* 0: the rest is 0 */
    struct gn_latency_sample median, worst; /* of the last GN_LATENCY_KEPT (the lower of two in the
                                               middle); of all */
};
struct gn_latency_report gn_latency_read(const struct gn_latency *latency);

#endif
