#include "stage/detail.h"

#include <pthread.h>
#include <stdlib.h>

#include "core/arena.h"
#include "core/thread.h"

struct gn_detailer {
    const struct gn_scene *scene;
    struct gn_detail *detail; /* the thread's until it is done */
    pthread_t thread;
    bool begun, works;
    atomic_bool cancel, done;
};

struct gn_detailer *gn_detailer_create(const struct gn_scene *scene) {
    struct gn_detailer *d = gn_xalloc(1, sizeof *d);
    d->scene = scene;
    return d;
}

static void *make_in_thread(void *data) {
    struct gn_detailer *d = data;
    gn_thread_lower_priority();
    d->detail = gn_detail_make(d->scene, &d->cancel);
    atomic_store(&d->done, true);
    return NULL;
}

static void end_thread(struct gn_detailer *d) {
    if (d->works) pthread_join(d->thread, NULL);
    d->works = false;
}

void gn_detailer_destroy(struct gn_detailer *d) {
    if (!d) return;
    atomic_store(&d->cancel, true);
    end_thread(d);
    gn_detail_destroy(d->detail);
    free(d);
}

const struct gn_detail *gn_detailer_take(struct gn_detailer *d, bool now) {
    if (!d->begun && now) d->detail = gn_detail_make(d->scene, NULL);
    if (!d->begun && !now) d->works = pthread_create(&d->thread, NULL, make_in_thread, d) == 0;
    d->begun = true;
    if (d->works && (now || atomic_load(&d->done))) end_thread(d);
    return d->works ? NULL : d->detail;
}

bool gn_detailer_works(const struct gn_detailer *d) { return d && d->works; }
