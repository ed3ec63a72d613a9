/* Latency from a button to the screen: from the kernel's timestamp of the edge that made a gesture
 * to the commit of the first frame that shows its effect. It includes debouncing. Pure. */
#ifndef GN_KIOSK_LATENCY_H
#define GN_KIOSK_LATENCY_H

#include <stdbool.h>
#include <stdint.h>

enum { GN_LATENCY_WAITING = 32, GN_LATENCY_FRAMES = 64, GN_LATENCY_KEPT = 256 };

struct gn_latency_sample {
    int64_t ns;
    int frames; /* committed since the edge, including the one that shows it: 1 is the next one; at
                   most GN_LATENCY_FRAMES */
};
struct gn_latency {                       /* zeroed: no edge yet */
    int64_t edges_ns[GN_LATENCY_WAITING]; /* not shown by any frame yet */
    int waiting;
    int64_t frames_ns[GN_LATENCY_FRAMES]; /* when the last frames were committed, a ring */
    unsigned frames;
    struct gn_latency_sample kept[GN_LATENCY_KEPT]; /* a ring */
    uint64_t count;                                 /* samples since the start */
    struct gn_latency_sample worst;                 /* of each field, since the start */
};

/* All times are monotonic. An edge that will change the picture. When GN_LATENCY_WAITING edges wait
 * already it is not measured. */
void gn_latency_edge(struct gn_latency *latency, int64_t edge_ns);
/* A frame was committed; shows: it has the effect of all edges so far. */
void gn_latency_frame(struct gn_latency *latency, int64_t now_ns, bool shows);
/* The effect of the waiting edges will not be shown: forget them. */
void gn_latency_drop(struct gn_latency *latency);

/* The last sample; zeroed if there is none. */
struct gn_latency_sample gn_latency_last(const struct gn_latency *latency);

struct gn_latency_report {
    uint64_t count;                         /* 0: the rest is 0 */
    struct gn_latency_sample median, worst; /* of the last GN_LATENCY_KEPT (the lower of two in the
                                               middle); of all */
};
struct gn_latency_report gn_latency_read(const struct gn_latency *latency);

#endif
