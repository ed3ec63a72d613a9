/* One flip at a time, as a machine that knows no kernel: it is told what happened and when, and
 * says what to do. Times are monotonic nanoseconds.
 *
 * The ladder of a flip that never ends: after 250 ms it counts as stalled; after 2 s the events are
 * drained once more, whether or not the descriptor is readable; after 12 s, when the kernel itself
 * has given up, the CRTC is switched off and on; if the flip after that is lost too, the card is
 * closed and opened; if still none comes, a new process may do better. A completed flip ends it. */
#ifndef GN_DISPLAY_KMS_FLIP_H
#define GN_DISPLAY_KMS_FLIP_H

#include <stdbool.h>
#include <stdint.h>

enum gn_flip_act {
    GN_FLIP_WAIT,    /* nothing to do before gn_flip_deadline() */
    GN_FLIP_DRAIN,   /* read events, even if the descriptor is not readable */
    GN_FLIP_RELIGHT, /* switch the CRTC off and on */
    GN_FLIP_REOPEN,  /* close the card and open it again */
    GN_FLIP_GIVE_UP,
};
enum gn_flip_error {                    /* what an errno of a commit means */
                     GN_FLIP_BUSY,      /* EBUSY, EINTR, EAGAIN: once more after a frame */
                     GN_FLIP_NO_MASTER, /* EACCES, EPERM: somebody else has the screen */
                     GN_FLIP_CARD_GONE, /* ENODEV, ENXIO, EIO, EBADF */
                     GN_FLIP_NO_MEMORY, /* ENOMEM: drop what can be dropped, once more */
                     GN_FLIP_CHANGED, /* EINVAL, ENOSPC, ENOENT, ERANGE, any other: look at the card
                                         again */
};

struct gn_flip {         /* zeroed is ready, but for period_ns */
    int64_t period_ns;   /* of the mode */
    int64_t shortest_ns; /* between two frames: 1/max_fps; 0: the mode's */
    bool no_vblank;      /* the driver has no vblank: flips end at once, a timer paces */
    bool pending;
    int64_t committed_ns, begun_ns;
    int64_t shown_ns;      /* when the last flip was seen; 0: none yet */
    int64_t next_ns;       /* not to draw before */
    int64_t due_ns;        /* the refresh that the pending one was meant for */
    unsigned refreshes;    /* that the last frame took */
    int lost_flips;        /* in a row */
    bool stalled, drained; /* of the pending flip */
    uint64_t shown, missed, stalls;
};

enum gn_flip_error gn_flip_error_of(int error);
/* Drawing begins; the frame's time is gn_flip_seen_ns(). */
void gn_flip_begun(struct gn_flip *flip, int64_t now_ns);
void gn_flip_committed(struct gn_flip *flip, int64_t now_ns);
/* It is seen from shown_ns on (the event's own time, which may lie a little ahead; 0 or one that
 * cannot be: now). */
void gn_flip_done(struct gn_flip *flip, int64_t shown_ns, int64_t now_ns);
/* The pending flip will never be told of: the CRTC or the card is gone. */
void gn_flip_forget(struct gn_flip *flip);
/* The commit was refused for the moment: not before a frame has gone by. */
void gn_flip_refused(struct gn_flip *flip, int64_t now_ns);
/* It is lost, whatever its age: the next rung. */
enum gn_flip_act gn_flip_lost(struct gn_flip *flip);
/* What is to be done now; each rung is told once. */
enum gn_flip_act gn_flip_step(struct gn_flip *flip, int64_t now_ns);
bool gn_flip_may_draw(const struct gn_flip *flip, int64_t now_ns);
/* When a frame that is begun now will be seen. */
int64_t gn_flip_seen_ns(const struct gn_flip *flip, int64_t now_ns);
/* When gn_flip_step() or gn_flip_may_draw() will next say something else; INT64_MAX: never. */
int64_t gn_flip_deadline(const struct gn_flip *flip, int64_t now_ns);

#endif
