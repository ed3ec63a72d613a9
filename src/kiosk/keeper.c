#include "kiosk/keeper.h"

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/arena.h"

struct gn_keeper {
    struct gn_state_files files;
    char path[PATH_MAX];
    int done; /* an eventfd */
    int older;
    pthread_t thread;
    bool runs;
    struct gn_state state; /* the thread's while it runs, as the rest */
    bool ok;
    struct gn_err err;
};

struct gn_keeper *gn_keeper_create(const struct gn_state_files *files, const char *path, int older,
                                   struct gn_err *err) {
    struct gn_keeper *k = gn_xalloc(1, sizeof *k);
    k->files = *files;
    k->older = older;
    snprintf(k->path, sizeof k->path, "%s", path);
    k->done = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (k->done >= 0) return k;
    gn_fail(err, "%s: cannot wait for saves: %s", path, strerror(errno));
    free(k);
    return NULL;
}

void gn_keeper_destroy(struct gn_keeper *k) {
    if (!k) return;
    if (k->runs) pthread_join(k->thread, NULL);
    close(k->done);
    free(k);
}

int gn_keeper_fd(const struct gn_keeper *k) { return k->done; }

bool gn_keeper_is_busy(const struct gn_keeper *k) { return k->runs; }

static void save(struct gn_keeper *k) {
    k->err = (struct gn_err){0};
    k->ok = gn_state_save(&k->files, k->path, k->older, &k->state, &k->err);
    if (k->ok) k->older = 1 - k->older;
}

/* Frames have priority: the thread lowers its own, which on Linux does not affect the others. */
static void *save_in_thread(void *user) {
    static const uint64_t one = 1;
    struct gn_keeper *k = user;
    setpriority(PRIO_PROCESS, 0, 10);
    save(k);
    if (write(k->done, &one, sizeof one) < 0) abort(); /* cannot overflow */
    return NULL;
}

bool gn_keeper_start(struct gn_keeper *k, const struct gn_state *state, struct gn_err *err) {
    k->state = *state;
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

bool gn_keeper_finish(struct gn_keeper *k, const struct gn_state *state, struct gn_err *err) {
    if (k->runs) pthread_join(k->thread, NULL);
    k->runs = false;
    k->state = *state;
    save(k);
    if (!k->ok) *err = k->err;
    return k->ok;
}
