/* Frame pacing and recovery of one flip at a time, as a pure state machine: it is given events and
 * times and returns actions. Times are monotonic nanoseconds.
 *
 * Recovery of a flip that does not complete: stalled after 250 ms; after 2 s events are drained
 * once more, readable or not; after 12 s (the kernel's own timeout is shorter) the CRTC is switched
 * off and on; if the next flip is lost too, the card is reopened; if that does not help, the
 * process must be restarted. A completed flip resets it. */
#ifndef GN_DISPLAY_KMS_FLIP_H
#define GN_DISPLAY_KMS_FLIP_H

#include <stdbool.h>
#include <stdint.h>

enum gn_flip_act {
    GN_FLIP_WAIT,    /* nothing before gn_flip_deadline() */
    GN_FLIP_DRAIN,   /* read events, even if the descriptor is not readable */
    GN_FLIP_RELIGHT, /* switch the CRTC off and on */
    GN_FLIP_REOPEN,  /* close the card and open it again */
    GN_FLIP_GIVE_UP,
};
enum gn_flip_error {                    /* class of a commit's errno */
                     GN_FLIP_BUSY,      /* EBUSY, EINTR, EAGAIN: retry after a frame */
                     GN_FLIP_NO_MASTER, /* EACCES, EPERM: another process is master */
                     GN_FLIP_CARD_GONE, /* ENODEV, ENXIO, EIO, EBADF */
                     GN_FLIP_NO_MEMORY, /* ENOMEM: retry after a frame */
                     GN_FLIP_CHANGED,   /* EINVAL, ENOSPC, ENOENT, ERANGE, any other: scan the card
                                           again */
};

struct gn_flip {         /* ready when zeroed, except for period_ns */
    int64_t period_ns;   /* of the mode */
    int64_t shortest_ns; /* least time between frames, 1/max_fps; 0: the mode's */
    bool no_vblank;      /* no vblank: flips complete at once, a timer paces */
    bool pending;
    int64_t committed_ns, begun_ns;
    int64_t shown_ns;      /* when the last flip became visible; 0: none yet */
    int64_t next_ns;       /* earliest time to draw */
    int64_t due_ns;        /* refresh the pending flip is meant for */
    unsigned refreshes;    /* refreshes the last frame took */
    int lost_flips;        /* in a row */
    bool stalled, drained; /* of the pending flip */
    uint64_t shown, missed, stalls;
};

enum gn_flip_error gn_flip_error_of(int error);
/* Drawing begins; the frame becomes visible at gn_flip_seen_ns(). */
void gn_flip_begun(struct gn_flip *flip, int64_t now_ns);
void gn_flip_committed(struct gn_flip *flip, int64_t now_ns);
/* The flip completed. shown_ns is the event's time stamp, which may be slightly ahead; 0 or an
 * implausible one means now. */
void gn_flip_done(struct gn_flip *flip, int64_t shown_ns, int64_t now_ns);
/* No event will come for the pending flip: CRTC or card is gone. */
void gn_flip_forget(struct gn_flip *flip);
/* The commit was refused temporarily: waits for one frame. */
void gn_flip_refused(struct gn_flip *flip, int64_t now_ns);
/* The flip is lost, whatever its age: returns the next recovery step. */
enum gn_flip_act gn_flip_lost(struct gn_flip *flip);
/* What to do now; each recovery step is returned once. */
enum gn_flip_act gn_flip_step(struct gn_flip *flip, int64_t now_ns);
bool gn_flip_may_draw(const struct gn_flip *flip, int64_t now_ns);
/* When a frame begun now becomes visible. */
int64_t gn_flip_seen_ns(const struct gn_flip *flip, int64_t now_ns);
/* When the result of gn_flip_step() or gn_flip_may_draw() next changes; INT64_MAX: never. */
int64_t gn_flip_deadline(const struct gn_flip *flip, int64_t now_ns);

#endif
