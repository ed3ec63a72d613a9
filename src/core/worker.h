/* A thread of work beside the loop whose calls may hang in the kernel, so that it is never waited
 * for. A struct gn_worker is the first member of what the owner and the thread share, which is of
 * gn_xalloc(); whoever leaves last frees it. */
#ifndef GN_CORE_WORKER_H
#define GN_CORE_WORKER_H

#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>

struct gn_worker {
    int event;             /* the owner's descriptor: readable when there is news */
    pthread_mutex_t mutex; /* of what follows, and of what both change */
    pthread_cond_t changed;
    bool closed;
    int users;
};

/* Starts `run`, whose argument is the worker. Returns 0, or an errno: then it is freed. */
int gn_worker_start(struct gn_worker *worker, void *(*run)(void *));

/* The thread's: it begins, which locks the mutex, works until `closed`, and leaves. All but the
 * first are called with the mutex locked; leaving unlocks it. */
void gn_worker_begin(struct gn_worker *worker);
void gn_worker_tell(struct gn_worker *worker); /* there is news */
/* Until the owner signals `changed`, or that time of the monotonic clock; INT64_MAX: none. May end
 * earlier. */
void gn_worker_wait(struct gn_worker *worker, int64_t due_ns);
void gn_worker_leave(struct gn_worker *worker);

/* The owner's: takes the news, and locks the mutex. */
void gn_worker_hear(struct gn_worker *worker);
void gn_worker_close(struct gn_worker *worker); /* the owner leaves */

#endif
