#include "core/worker.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "core/clock.h"
#include "core/thread.h"

static void init_locks(struct gn_worker *w) {
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_cond_init(&w->changed, &attributes);
    pthread_condattr_destroy(&attributes);
    pthread_mutex_init(&w->mutex, NULL);
}

int gn_worker_start(struct gn_worker *w, void *(*run)(void *)) {
    w->users = 2;
    init_locks(w);
    w->event = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    const int error = w->event < 0 ? errno : gn_thread_start_detached(run, w);
    if (error == 0) return 0;
    if (w->event >= 0) close(w->event);
    pthread_mutex_lock(&w->mutex);
    w->users = 1;
    gn_worker_leave(w);
    return error;
}

void gn_worker_begin(struct gn_worker *w) {
    gn_thread_lower_priority();
    pthread_mutex_lock(&w->mutex);
}

void gn_worker_tell(struct gn_worker *w) {
    static const uint64_t one = 1;
    if (!w->closed && write(w->event, &one, sizeof one) < 0) {
    }
}

void gn_worker_wait(struct gn_worker *w, int64_t due_ns) {
    const struct timespec due = {due_ns / GN_NS_PER_S, due_ns % GN_NS_PER_S};
    if (due_ns == INT64_MAX)
        pthread_cond_wait(&w->changed, &w->mutex);
    else
        pthread_cond_timedwait(&w->changed, &w->mutex, &due);
}

void gn_worker_leave(struct gn_worker *w) {
    const bool is_last = --w->users == 0;
    pthread_mutex_unlock(&w->mutex);
    if (!is_last) return;
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->mutex);
    free(w);
}

void gn_worker_hear(struct gn_worker *w) {
    uint64_t count;
    if (read(w->event, &count, sizeof count) < 0) {
    }
    pthread_mutex_lock(&w->mutex);
}

void gn_worker_close(struct gn_worker *w) {
    pthread_mutex_lock(&w->mutex);
    w->closed = true;
    close(w->event);
    pthread_cond_signal(&w->changed);
    gn_worker_leave(w);
}
