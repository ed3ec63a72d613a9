#include "kiosk/keeper.h"

#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/worker.h"

struct gn_keeper {
    struct gn_worker worker;
    const struct gn_disk *disk;
    char path[PATH_MAX];
    int older;      /* the thread's */
    uint64_t taken; /* the owner's, as `asked` */
    /* under the mutex */
    uint64_t asked, saved; /* numbers of the last save of each kind */
    struct gn_state next;
    bool ok; /* the result of `saved` */
    struct gn_err err;
};

static void save_next(struct gn_keeper *k) {
    struct gn_state state = k->next;
    struct gn_err err = {0};
    const uint64_t number = k->asked;
    pthread_mutex_unlock(&k->worker.mutex);
    const bool ok = gn_state_save(k->disk, k->path, k->older, &state, &err);
    if (ok) k->older = 1 - k->older;
    pthread_mutex_lock(&k->worker.mutex);
    k->saved = number;
    k->ok = ok;
    k->err = err;
    gn_worker_tell(&k->worker);
    pthread_cond_signal(&k->worker.changed); /* gn_keeper_close() waits */
}

static void *run_keeper(void *user) {
    struct gn_keeper *k = user;
    gn_worker_begin(&k->worker);
    while (k->saved != k->asked || !k->worker.closed)
        if (k->saved != k->asked)
            save_next(k);
        else
            gn_worker_wait(&k->worker, INT64_MAX);
    gn_worker_leave(&k->worker);
    return NULL;
}

struct gn_keeper *gn_keeper_open(const struct gn_disk *disk, const char *path, int older,
                                 struct gn_err *err) {
    struct gn_keeper *k = gn_xalloc(1, sizeof *k);
    k->disk = disk;
    k->older = older;
    snprintf(k->path, sizeof k->path, "%s", path);
    const int error = gn_worker_start(&k->worker, run_keeper);
    if (error == 0) return k;
    gn_fail(err, "%s: no thread to save it: %s", path, strerror(error));
    return NULL;
}

int gn_keeper_fd(const struct gn_keeper *k) { return k->worker.event; }

void gn_keeper_save(struct gn_keeper *k, const struct gn_state *state) {
    pthread_mutex_lock(&k->worker.mutex);
    k->next = *state;
    k->asked++;
    pthread_cond_signal(&k->worker.changed);
    pthread_mutex_unlock(&k->worker.mutex);
}

bool gn_keeper_is_busy(const struct gn_keeper *k) { return k->taken != k->asked; }

bool gn_keeper_take(struct gn_keeper *k, bool *ok, struct gn_err *err) {
    gn_worker_hear(&k->worker);
    const bool is_done = k->saved == k->asked && k->taken != k->asked;
    if (is_done) {
        k->taken = k->saved;
        *ok = k->ok;
        if (!*ok) *err = k->err;
    }
    pthread_mutex_unlock(&k->worker.mutex);
    return is_done;
}

bool gn_keeper_close(struct gn_keeper *k, int64_t wait_ns, struct gn_err *err) {
    if (!k) return true;
    const int64_t due_ns = gn_clock_monotonic_ns() + wait_ns;
    pthread_mutex_lock(&k->worker.mutex);
    while (k->saved != k->asked && gn_clock_monotonic_ns() < due_ns)
        gn_worker_wait(&k->worker, due_ns);
    bool ok = k->taken == k->asked || (k->saved == k->asked && k->ok);
    if (k->saved != k->asked)
        gn_fail(err, "%s: still being written", k->path);
    else if (!ok)
        *err = k->err;
    pthread_mutex_unlock(&k->worker.mutex);
    gn_worker_close(&k->worker); /* the thread frees it when the disk has answered */
    return ok;
}
