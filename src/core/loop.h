/* The event loop: descriptors, timers and signals, each with a callback. One epoll and one timerfd
 * for the whole program.
 *
 * Sources are structs of their owner, linked into the loop: nothing is allocated, and a source
 * must not move while it is added. A step calls first the ready descriptors and then the due
 * timers, each group in the order in which they were added. So the order is the same in each run,
 * and an object with several descriptors can collect what is ready in their callbacks and handle
 * all of it in the callback of a timer that they make due.
 *
 * A callback may add and remove any source, its own too; a removed one is not called any more. It
 * may not step or close the loop. */
#ifndef GN_CORE_LOOP_H
#define GN_CORE_LOOP_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/epoll.h> /* sigset_t, too */

#include "core/err.h"

#define GN_LOOP_NEVER INT64_MAX

struct gn_loop;
struct gn_loop_link { /* private */
    struct gn_loop *loop;
    struct gn_loop_link *previous, *next;
};

/* A descriptor. Zeroed and with fd -1 it is not added. */
struct gn_watch {
    struct gn_loop_link link;
    int fd;                                   /* not owned: remove the watch before it is closed */
    uint32_t events;                          /* of epoll(7): EPOLLIN, EPOLLOUT | EPOLLET, .. */
    uint32_t came;                            /* those that the call is for */
    void (*call)(void *user, int64_t now_ns); /* NULL: it only ends the wait */
    void *user;
    uint32_t ready; /* private */
};
/* A time, monotonic. To start, move or stop it assign due_ns. */
struct gn_timer {
    struct gn_loop_link link;
    int64_t due_ns; /* GN_LOOP_NEVER: stopped, as it is before each call; 0: due at once */
    void (*call)(void *user, int64_t now_ns); /* NULL: it only ends the wait */
    void *user;
};
/* Signals of the process, blocked from the time when they are added, for good. */
struct gn_signals {
    struct gn_watch watch; /* private; fd -1: not added */
    void (*call)(void *user, int number);
    void *user;
};

struct gn_loop *gn_loop_open(struct gn_err *err);
void gn_loop_close(struct gn_loop *loop); /* removes what is left; NULL is legal */
/* For tests: from now on *clock_ns is the time, the loop never blocks, and a step that finds
 * nothing to do moves the time to the next timer or the end of its wait. */
void gn_loop_fake_clock(struct gn_loop *loop, int64_t *clock_ns);
int64_t gn_loop_now_ns(const struct gn_loop *loop); /* reads the clock */

/* False and errno: the descriptor cannot be waited for; then it is not added. */
bool gn_loop_add(struct gn_loop *loop, struct gn_watch *watch);
void gn_loop_remove(struct gn_watch *watch); /* legal when not added */
void gn_loop_add_timer(struct gn_loop *loop, struct gn_timer *timer);
void gn_loop_remove_timer(struct gn_timer *timer); /* legal when not added */
bool gn_loop_add_signals(struct gn_loop *loop, struct gn_signals *signals, const sigset_t *set);
void gn_loop_remove_signals(struct gn_signals *signals);

/* Waits until a descriptor is ready or a timer is due, at the latest until until_ns (0: does not
 * wait), and calls their callbacks. Returns how many there were, including those without a
 * callback. */
int gn_loop_step(struct gn_loop *loop, int64_t until_ns);

#endif
