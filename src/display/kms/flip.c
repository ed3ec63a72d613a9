#include "display/kms/flip.h"

#include <errno.h>

#define NS_PER_MS  INT64_C(1000000)
#define STALLED_NS (250 * NS_PER_MS)
#define DRAIN_NS   (2000 * NS_PER_MS)
#define LOST_NS    (12000 * NS_PER_MS) /* the kernel itself waits 10 s */

enum { REFRESHES_MAX = 8 }; /* a longer pause does not predict the next frame */

enum gn_flip_error gn_flip_error_of(int error) {
    switch (error) {
    case EBUSY:
    case EINTR:
    case EAGAIN: return GN_FLIP_BUSY;
    case EACCES:
    case EPERM: return GN_FLIP_NO_MASTER;
    case ENODEV:
    case ENXIO:
    case EIO:
    case EBADF: return GN_FLIP_CARD_GONE;
    case ENOMEM: return GN_FLIP_NO_MEMORY;
    default: return GN_FLIP_CHANGED;
    }
}

/* The first refresh after now_ns. */
static int64_t refresh_after(const struct gn_flip *f, int64_t now_ns) {
    if (f->no_vblank || f->shown_ns == 0 || now_ns < f->shown_ns) return now_ns + f->period_ns;
    return f->shown_ns + ((now_ns - f->shown_ns) / f->period_ns + 1) * f->period_ns;
}

void gn_flip_begun(struct gn_flip *f, int64_t now_ns) {
    f->begun_ns = now_ns;
    f->due_ns = refresh_after(f, now_ns);
}

void gn_flip_committed(struct gn_flip *f, int64_t now_ns) {
    if (f->begun_ns == 0) gn_flip_begun(f, now_ns);
    f->pending = true;
    f->stalled = f->drained = false;
    f->committed_ns = now_ns;
}

static void end_flip(struct gn_flip *f) {
    f->pending = false;
    f->begun_ns = 0;
}

void gn_flip_done(struct gn_flip *f, int64_t shown_ns, int64_t now_ns) {
    if (!f->pending) return;
    const bool possible = shown_ns > f->begun_ns - f->period_ns && shown_ns < now_ns + f->period_ns;
    f->shown_ns = possible ? shown_ns : now_ns;
    const int64_t late_ns = f->shown_ns - f->due_ns + f->period_ns / 2;
    const int64_t late = late_ns > 0 && f->shown > 0 ? late_ns / f->period_ns : 0;
    f->missed += (uint64_t)late;
    f->refreshes = (unsigned)(late < REFRESHES_MAX ? late + 1 : 1);
    f->shown++;
    f->lost_flips = 0;
    if (f->no_vblank) { /* a timer paces, on a grid of its own; a late frame shifts the grid */
        const int64_t interval = f->shortest_ns > f->period_ns ? f->shortest_ns : f->period_ns;
        const bool on_grid = f->next_ns > 0 && f->begun_ns - f->next_ns < interval;
        f->next_ns = (on_grid ? f->next_ns : f->begun_ns) + interval;
        if (f->next_ns < now_ns) f->next_ns = now_ns;
    } else { /* vblank paces: every kth refresh, drawing from the refresh before it */
        const int64_t k = (f->shortest_ns - f->period_ns / 10 + f->period_ns - 1) / f->period_ns;
        f->next_ns = k > 1 ? f->shown_ns + (k - 1) * f->period_ns : 0;
    }
    end_flip(f);
}

void gn_flip_forget(struct gn_flip *f) { end_flip(f); }

void gn_flip_refused(struct gn_flip *f, int64_t now_ns) { f->next_ns = now_ns + f->period_ns; }

enum gn_flip_act gn_flip_lost(struct gn_flip *f) {
    static const enum gn_flip_act acts[] = {GN_FLIP_RELIGHT, GN_FLIP_REOPEN, GN_FLIP_GIVE_UP};
    const int last = (int)(sizeof acts / sizeof *acts) - 1;
    const enum gn_flip_act act = acts[f->lost_flips < last ? f->lost_flips : last];
    f->lost_flips++;
    end_flip(f);
    return act;
}

enum gn_flip_act gn_flip_step(struct gn_flip *f, int64_t now_ns) {
    if (!f->pending) return GN_FLIP_WAIT;
    const int64_t age_ns = now_ns - f->committed_ns;
    if (age_ns >= STALLED_NS && !f->stalled) {
        f->stalled = true;
        f->stalls++;
    }
    if (age_ns >= LOST_NS) return gn_flip_lost(f);
    if (age_ns < DRAIN_NS || f->drained) return GN_FLIP_WAIT;
    f->drained = true;
    return GN_FLIP_DRAIN;
}

bool gn_flip_may_draw(const struct gn_flip *f, int64_t now_ns) {
    return !f->pending && now_ns >= f->next_ns;
}

int64_t gn_flip_seen_ns(const struct gn_flip *f, int64_t now_ns) {
    const int64_t more = f->no_vblank || f->refreshes < 2 ? 0 : f->refreshes - 1;
    return refresh_after(f, now_ns) + more * f->period_ns;
}

int64_t gn_flip_deadline(const struct gn_flip *f, int64_t now_ns) {
    if (!f->pending) return f->next_ns > now_ns ? f->next_ns : INT64_MAX;
    if (!f->stalled) return f->committed_ns + STALLED_NS;
    return f->committed_ns + (f->drained ? LOST_NS : DRAIN_NS);
}
