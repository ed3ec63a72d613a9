/* A contact bounces, a wire hears its neighbours: a level counts once it has been stable for
 * stable_ns, and is then reported with the time of the first edge that led away from the old one.
 * What returns before that has never been. Pure: time comes with the edges. */
#ifndef GN_INPUT_DEBOUNCE_H
#define GN_INPUT_DEBOUNCE_H

#include <stdbool.h>
#include <stdint.h>

struct gn_debounce {
    int64_t stable_ns;
    bool settled;              /* the level that counts */
    bool raw;                  /* the level that was heard last; another one only while moving */
    bool moving;               /* raw has not been stable for long enough */
    int64_t first_ns, last_ns; /* of the edges since it was; while moving */
};
struct gn_debounced { /* the settled level changed */
    bool level;
    int64_t first_ns; /* of the edge that began it */
    int64_t time_ns;  /* when it counted: stable_ns after the last edge */
};

void gn_debounce_init(struct gn_debounce *d, int64_t stable_ns, bool level);
/* An edge to that level. Step to time_ns first. One that leads where the level is already tells of
 * an edge that was lost: the level was not stable. */
void gn_debounce_edge(struct gn_debounce *d, bool level, int64_t time_ns);
/* The level was read: an edge if it is not the one that was heard last, else no news. */
void gn_debounce_level(struct gn_debounce *d, bool level, int64_t time_ns);
/* When to step; INT64_MAX: not before the next edge. An edge at that very time comes too late. */
int64_t gn_debounce_deadline(const struct gn_debounce *d);
/* True: the settled level changed; at most once until the next edge. */
bool gn_debounce_step(struct gn_debounce *d, int64_t now_ns, struct gn_debounced *out);

#endif
