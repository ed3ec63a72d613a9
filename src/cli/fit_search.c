#include <stdlib.h>

#include "cli/fit.h"
#include "core/arena.h"

#define LEAST_SAVING (1.0 / 200) /* of the frame's time */
#define ALIKE        1e-9        /* times that differ by a smaller share are the same */

struct known { /* what has been measured */
    gn_fit_set taken;
    double ms;
};
struct search {
    struct gn_fit *fit;
    struct known *known;
    int count, room;
    struct gn_err *err;
};

static bool measure(struct search *s, gn_fit_set taken, double *ms) {
    for (int i = 0; i < s->count; i++)
        if (s->known[i].taken == taken) {
            *ms = s->known[i].ms;
            return true;
        }
    if (!s->fit->measure(s->fit->user, taken, ms, s->err)) return false;
    if (s->count == s->room) {
        s->room = 2 * s->room + 32;
        s->known = gn_xrealloc(s->known, (size_t)s->room, sizeof *s->known);
    }
    s->known[s->count++] = (struct known){taken, *ms};
    return true;
}

/* What saved time beside an earlier choice may cost time beside a later one: small maps, which get
 * cascades, where a technique is cheap. */
static bool drop_useless(struct search *s, int upto) {
    struct gn_fit *fit = s->fit;
    for (int i = 0; i < upto; i++) {
        const gn_fit_set without = fit->taken & ~((gn_fit_set)1 << i);
        double ms;
        if (without == fit->taken) continue;
        if (!measure(s, without, &ms)) return false;
        if (ms > fit->ms * (1 + ALIKE)) continue;
        fit->taken = without;
        fit->ms = ms;
    }
    return true;
}

static bool give_up(struct search *s) {
    struct gn_fit *fit = s->fit;
    for (int i = 0; i < fit->count && fit->ms > fit->goal_ms; i++) {
        const gn_fit_set with = fit->taken | (gn_fit_set)1 << i;
        double ms;
        if (!measure(s, with, &ms)) return false;
        if (ms > fit->ms * (1 - LEAST_SAVING)) continue;
        fit->taken = with;
        fit->ms = ms;
        if (!drop_useless(s, i)) return false;
    }
    return true;
}

static bool give_back(struct search *s) {
    struct gn_fit *fit = s->fit;
    const double most_ms = fit->is_met ? fit->goal_ms : fit->ms * (1 + ALIKE);
    for (int i = GN_FIT_STEPS_MAX - 1; i >= 0; i--) {
        const gn_fit_set without = fit->taken & ~((gn_fit_set)1 << i);
        double ms;
        if (without == fit->taken) continue;
        if (!measure(s, without, &ms)) return false;
        if (ms > most_ms) continue;
        fit->taken = without;
        fit->ms = ms;
    }
    return true;
}

/* What each of them saves, once those that were given back are not there. */
static bool weigh_steps(struct search *s) {
    struct gn_fit *fit = s->fit;
    gn_fit_set upto = 0;
    for (int i = 0; i < fit->count; i++) {
        upto |= fit->taken & (gn_fit_set)1 << i;
        if (!measure(s, upto, &fit->step_ms[i])) return false;
    }
    return true;
}

bool gn_fit_search(struct gn_fit *fit, struct gn_err *err) {
    struct search s = {.fit = fit, .err = err};
    fit->taken = 0;
    bool ok = measure(&s, 0, &fit->best_ms);
    fit->ms = fit->best_ms;
    ok = ok && give_up(&s);
    fit->is_met = ok && fit->ms <= fit->goal_ms;
    ok = ok && give_back(&s) && weigh_steps(&s);
    free(s.known);
    return ok;
}
