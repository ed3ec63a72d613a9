#include "kiosk/keeper.h"

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/thread.h"

struct gn_keeper {
    const struct gn_disk *disk;
    char path[PATH_MAX];
    int done; /* an eventfd */
    int older;
    pthread_t thread;
    bool runs;
    pthread_mutex_t mutex; /* of the next three */
    bool ended, more;      /* the thread takes nothing any more; it is to save `last`, too */
    struct gn_state last;
    struct gn_state state; /* the thread's while it runs, as the rest */
    bool ok;
    struct gn_err err;
};

struct gn_keeper *gn_keeper_create(const struct gn_disk *disk, const char *path, int older,
                                   struct gn_err *err) {
    struct gn_keeper *k = gn_xalloc(1, sizeof *k);
    k->disk = disk;
    k->older = older;
    snprintf(k->path, sizeof k->path, "%s", path);
    k->done = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    pthread_mutex_init(&k->mutex, NULL);
    if (k->done >= 0) return k;
    gn_fail(err, "%s: cannot wait for saves: %s", path, strerror(errno));
    free(k);
    return NULL;
}

int gn_keeper_fd(const struct gn_keeper *k) { return k->done; }

bool gn_keeper_is_busy(const struct gn_keeper *k) { return k->runs; }

static void save(struct gn_keeper *k) {
    k->err = (struct gn_err){0};
    k->ok = gn_state_save(k->disk, k->path, k->older, &k->state, &k->err);
    if (k->ok) k->older = 1 - k->older;
}

/* Whether the thread goes on, with the last state. */
static bool take_last(struct gn_keeper *k) {
    pthread_mutex_lock(&k->mutex);
    const bool more = k->more;
    if (more) k->state = k->last;
    k->more = false;
    k->ended = !more;
    pthread_mutex_unlock(&k->mutex);
    return more;
}

static void *save_in_thread(void *user) {
    static const uint64_t one = 1;
    struct gn_keeper *k = user;
    gn_thread_lower_priority();
    do save(k);
    while (take_last(k));
    if (write(k->done, &one, sizeof one) < 0) abort(); /* cannot overflow */
    return NULL;
}

bool gn_keeper_start(struct gn_keeper *k, const struct gn_state *state, struct gn_err *err) {
    k->state = *state;
    k->ended = false;
    const int reason = pthread_create(&k->thread, NULL, save_in_thread, k);
    k->runs = reason == 0;
    return k->runs || gn_fail(err, "%s: no thread: %s", k->path, strerror(reason));
}

bool gn_keeper_take(struct gn_keeper *k, bool *ok, struct gn_err *err) {
    uint64_t count;
    if (!k->runs || read(k->done, &count, sizeof count) != sizeof count) return false;
    pthread_join(k->thread, NULL);
    k->runs = false;
    *ok = k->ok;
    if (!*ok) *err = k->err;
    return true;
}

bool gn_keeper_start_last(struct gn_keeper *k, const struct gn_state *state, struct gn_err *err) {
    if (k->runs) {
        pthread_mutex_lock(&k->mutex);
        const bool taken = !k->ended;
        k->more = taken;
        if (taken) k->last = *state;
        pthread_mutex_unlock(&k->mutex);
        if (taken) return true;
        pthread_join(k->thread, NULL); /* it is about to end */
    }
    return gn_keeper_start(k, state, err);
}

bool gn_keeper_close(struct gn_keeper *k, int64_t wait_ns, struct gn_err *err) {
    struct timespec until;
    if (!k) return true;
    clock_gettime(CLOCK_REALTIME, &until); /* that of pthread_timedjoin_np() */
    const int64_t ns = until.tv_nsec + wait_ns % GN_NS_PER_S;
    until.tv_sec += wait_ns / GN_NS_PER_S + ns / GN_NS_PER_S;
    until.tv_nsec = ns % GN_NS_PER_S;
    if (k->runs && pthread_timedjoin_np(k->thread, NULL, &until) != 0) {
        pthread_detach(k->thread); /* which uses it until the process ends */
        return gn_fail(err, "%s: still being written", k->path);
    }
    const bool ok = !k->runs || k->ok;
    if (!ok) *err = k->err;
    close(k->done);
    pthread_mutex_destroy(&k->mutex);
    free(k);
    return ok;
}
