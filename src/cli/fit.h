/* gnomon fit: what a board must do without so that it draws a scene as often as is wanted. The
 * search is here, apart from what it weighs: a set of steps, each of which gives something up. */
#ifndef GN_CLI_FIT_H
#define GN_CLI_FIT_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"

enum { GN_FIT_STEPS_MAX = 64 };
typedef uint64_t gn_fit_set; /* a bit for each step that is taken */

struct gn_fit_step {
    const char *option, *value; /* of the table of options, as one writes them */
    const char *light;          /* of the light of that name alone; or NULL */
    const char *loses;          /* what the picture loses, measured */
};
struct gn_fit {
    int count; /* of steps, in the order in which they are given up */
    double goal_ms;
    /* A frame's time with these steps taken, in *ms. False: it fails, and so does the search. */
    bool (*measure)(void *user, gn_fit_set taken, double *ms, struct gn_err *err);
    void *user;
    /* found: */
    gn_fit_set taken;
    double best_ms, ms;               /* with no step taken, and with those */
    double step_ms[GN_FIT_STEPS_MAX]; /* with those of them up to this one */
    bool is_met;
};

/* Takes step after step until the goal is met, but none that saves less than a two-hundredth of
 * the frame, and drops earlier ones that save nothing beside it; then gives back, beginning with
 * the last, each that is not needed for the goal, or that changes nothing once later ones are
 * taken. Where all steps do not suffice the result is what they reach together. The same set is
 * measured once. */
bool gn_fit_search(struct gn_fit *fit, struct gn_err *err);

#endif
