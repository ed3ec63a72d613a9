/* Scenarios: each starts with a new simulated machine and ends with a visible picture. */
#ifndef GN_KMS_SCENES_H
#define GN_KMS_SCENES_H

#include "client.h"

struct scene {
    const char *name;
    void (*build)(void);            /* sets the machine up */
    void (*play)(struct client *c); /* between opening and end; NULL: a few frames */
    struct gn_screen_opts opts;
    float draws;      /* that share of the width and height; 0: all */
    int64_t slack_ns; /* extra time it may take */
    bool may_give_up;
    bool put_back;     /* the console must be visible at the end */
    bool needs_atomic; /* the legacy interface cannot recover from it */
};
extern const struct scene scenes[];
extern const int scene_count;

/* Runs a scenario until its picture is stable or the time is up, then closes everything. `prepare`,
 * if not NULL, is called when the machine is set up. */
struct ending {
    int64_t took_ns; /* from the end of `play` until the right picture is visible */
    long frames, calls;
    bool gave_up;
    char complaint[240]; /* "": success */
};
struct ending scene_run(const struct scene *scene, void (*prepare)(void *), void *context);

#endif
