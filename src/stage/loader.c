#include "stage/loader.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/thread.h"
#include "core/worker.h"
#include "stage/detail.h"
#include "stage/occlusion.h"
#include "stage/stage.h"

struct gn_loader {
    struct gn_worker worker;
    enum {
        IDLE,
        LOADS,
        IS_DONE
    } state; /* under the mutex; the rest is the thread's while it loads */
    struct gn_loaded *loaded;
    struct gn_scene_limits limits;
    char *path; /* NULL: the default scene */
    int number;
    bool busy; /* the owner's */
    atomic_bool cancelled;
    atomic_uint permille; /* done */
};

static void destroy_loaded(struct gn_loaded *loaded) {
    if (!loaded) return;
    gn_occluder_destroy(loaded->occluder);
    gn_detailer_destroy(loaded->detailer);
    gn_pose_finish(&loaded->pose);
    gn_scene_destroy(loaded->scene);
    free(loaded);
}

static void *destroy_in_thread(void *argument) {
    gn_thread_lower_priority();
    destroy_loaded(argument);
    return NULL;
}

void gn_loaded_drop(struct gn_loaded *loaded) {
    if (loaded && (!loaded->scene || gn_thread_start_detached(destroy_in_thread, loaded) != 0))
        destroy_loaded(loaded);
}

static void load(struct gn_loader *loader) {
    struct gn_loaded *l = loader->loaded;
    pthread_mutex_unlock(&loader->worker.mutex);
    l->scene = gn_stage_read(loader->path, &loader->limits, &l->warnings, &l->err);
    if (l->scene) {
        gn_pose_init(&l->pose, l->scene, GN_POSE_DEFAULT);
        l->occluder = gn_occluder_create(l->scene);
        l->detailer = gn_detailer_create(l->scene);
    }
    pthread_mutex_lock(&loader->worker.mutex);
    loader->state = IS_DONE;
    gn_worker_tell(&loader->worker);
}

static void *run_loader(void *argument) {
    struct gn_loader *loader = argument;
    gn_worker_begin(&loader->worker);
    while (!loader->worker.closed)
        if (loader->state == LOADS)
            load(loader);
        else
            gn_worker_wait(&loader->worker, INT64_MAX);
    destroy_loaded(loader->loaded);
    free(loader->path);
    gn_worker_leave(&loader->worker);
    return NULL;
}

struct gn_loader *gn_loader_open(struct gn_err *err) {
    struct gn_loader *loader = gn_xalloc(1, sizeof *loader);
    const int error = gn_worker_start(&loader->worker, run_loader);
    if (error == 0) return loader;
    gn_fail(err, "show: no thread to load scenes: %s", strerror(error));
    return NULL;
}

int gn_loader_fd(const struct gn_loader *loader) { return loader->worker.event; }

bool gn_loader_is_busy(const struct gn_loader *loader) { return loader->busy; }

int gn_loader_number(const struct gn_loader *loader) {
    return loader->busy && !atomic_load(&loader->cancelled) ? loader->number : -1;
}

double gn_loader_progress(const struct gn_loader *loader) {
    return gn_loader_number(loader) < 0 ? -1.0 : atomic_load(&loader->permille) / 1000.0;
}

void gn_loader_cancel(struct gn_loader *loader) { atomic_store(&loader->cancelled, true); }

void gn_loader_start(struct gn_loader *loader, int number, const char *path,
                     const struct gn_scene_limits *limits) {
    pthread_mutex_lock(&loader->worker.mutex);
    loader->loaded = gn_xalloc(1, sizeof *loader->loaded);
    loader->loaded->number = loader->number = number;
    loader->limits = *limits;
    loader->limits.cancel = &loader->cancelled;
    loader->limits.progress = &loader->permille;
    free(loader->path);
    loader->path = path ? strdup(path) : NULL;
    atomic_store(&loader->cancelled, false);
    atomic_store(&loader->permille, 0);
    loader->busy = true;
    loader->state = LOADS;
    pthread_cond_signal(&loader->worker.changed);
    pthread_mutex_unlock(&loader->worker.mutex);
}

struct gn_loaded *gn_loader_take(struct gn_loader *loader) {
    struct gn_loaded *loaded = NULL;
    gn_worker_hear(&loader->worker);
    if (loader->state == IS_DONE) {
        loaded = loader->loaded;
        loader->loaded = NULL;
        loader->state = IDLE;
        loader->busy = false;
    }
    pthread_mutex_unlock(&loader->worker.mutex);
    if (!loaded || !atomic_load(&loader->cancelled)) return loaded;
    gn_loaded_drop(loaded);
    return NULL;
}

void gn_loader_close(struct gn_loader *loader) {
    if (!loader) return;
    gn_loader_cancel(loader);
    gn_worker_close(&loader->worker);
}
