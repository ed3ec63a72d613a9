/* Debouncing: a level counts once it has been stable for stable_ns, and is then reported with the
 * time of the first edge away from the old level. A level that returns before that is ignored.
 * Pure: times come with the edges. */
#ifndef GN_INPUT_DEBOUNCE_H
#define GN_INPUT_DEBOUNCE_H

#include <stdbool.h>
#include <stdint.h>

struct gn_debounce {
    int64_t stable_ns;
    bool settled;              /* debounced level */
    bool raw;                  /* last level read; may differ only while moving */
    bool moving;               /* raw has not been stable for long enough */
    int64_t first_ns, last_ns; /* first and last edge since then; while moving */
};
struct gn_debounced { /* a change of the debounced level */
    bool level;
    int64_t first_ns; /* of the first edge */
    int64_t time_ns;  /* when it counted: stable_ns after the last edge */
};

void gn_debounce_init(struct gn_debounce *d, int64_t stable_ns, bool level);
/* An edge to that level. Step to time_ns first. An edge to the level it already has means a lost
 * edge: the level was not stable. */
void gn_debounce_edge(struct gn_debounce *d, bool level, int64_t time_ns);
/* A level that was read: an edge if it differs from the last one. */
void gn_debounce_level(struct gn_debounce *d, bool level, int64_t time_ns);
/* When to step; INT64_MAX: not before the next edge. An edge at exactly that time is too late. */
int64_t gn_debounce_deadline(const struct gn_debounce *d);
/* Returns true if the debounced level changed; at most once between edges. */
bool gn_debounce_step(struct gn_debounce *d, int64_t now_ns, struct gn_debounced *out);

#endif
