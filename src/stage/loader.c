#include "stage/loader.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/thread.h"
#include "stage/stage.h"

/* Shared by loader and thread; the last one to leave frees it. The thread uses nothing else. */
struct job {
    struct gn_loaded *loaded;
    struct gn_scene_limits limits;
    char *path; /* NULL: the default scene */
    int number;
    int event; /* a duplicate of the loader's; the thread closes it */
    atomic_int state;
    atomic_bool cancelled;
    atomic_uint permille; /* done */
};
enum { RUNS, IS_DONE, IS_LEFT };

struct gn_loader {
    int event;
    struct job *job; /* NULL: none */
};

void gn_loaded_destroy(struct gn_loaded *loaded) {
    if (!loaded) return;
    gn_pose_finish(&loaded->pose);
    gn_scene_destroy(loaded->scene);
    free(loaded);
}

static void *destroy_in_thread(void *argument) {
    gn_thread_lower_priority();
    gn_loaded_destroy(argument);
    return NULL;
}

void gn_loaded_drop(struct gn_loaded *loaded) {
    if (loaded && (!loaded->scene || gn_thread_start_detached(destroy_in_thread, loaded) != 0))
        gn_loaded_destroy(loaded);
}

static void job_destroy(struct job *job) {
    gn_loaded_destroy(job->loaded);
    free(job->path);
    free(job);
}

static void *load_in_thread(void *argument) {
    static const uint64_t one = 1;
    struct job *job = argument;
    struct gn_loaded *l = job->loaded;
    gn_thread_lower_priority();
    l->scene = gn_stage_read(job->path, &job->limits, &l->warnings, &l->err);
    if (l->scene) gn_pose_init(&l->pose, l->scene, GN_POSE_DEFAULT);
    const int event = job->event; /* the job may be freed once it is done */
    if (atomic_exchange(&job->state, IS_DONE) == IS_LEFT) job_destroy(job);
    if (write(event, &one, sizeof one) < 0) {
    }
    close(event);
    return NULL;
}

struct gn_loader *gn_loader_open(struct gn_err *err) {
    struct gn_loader *loader = gn_xalloc(1, sizeof *loader);
    loader->event = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (loader->event >= 0) return loader;
    gn_fail(err, "show: cannot wait for scenes: %s", strerror(errno));
    free(loader);
    return NULL;
}

int gn_loader_fd(const struct gn_loader *loader) { return loader->event; }

bool gn_loader_is_busy(const struct gn_loader *loader) { return loader->job; }

int gn_loader_number(const struct gn_loader *loader) {
    const struct job *job = loader->job;
    return job && !atomic_load(&job->cancelled) ? job->number : -1;
}

double gn_loader_progress(const struct gn_loader *loader) {
    return gn_loader_number(loader) < 0 ? -1.0 : atomic_load(&loader->job->permille) / 1000.0;
}

void gn_loader_cancel(struct gn_loader *loader) {
    if (loader->job) atomic_store(&loader->job->cancelled, true);
}

bool gn_loader_start(struct gn_loader *loader, int number, const char *path,
                     const struct gn_scene_limits *limits, struct gn_err *err) {
    struct job *job = gn_xalloc(1, sizeof *job);
    job->loaded = gn_xalloc(1, sizeof *job->loaded);
    job->loaded->number = job->number = number;
    job->limits = *limits;
    job->limits.cancel = &job->cancelled;
    job->limits.progress = &job->permille;
    job->path = path ? strdup(path) : NULL;
    job->event = fcntl(loader->event, F_DUPFD_CLOEXEC, 0);
    if (job->event < 0) {
        gn_fail(err, "no descriptor to load a scene: %s", strerror(errno));
    } else {
        const int error = gn_thread_start_detached(load_in_thread, job);
        if (error == 0) {
            loader->job = job;
            return true;
        }
        gn_fail(err, "no thread to load a scene: %s", strerror(error));
    }
    if (job->event >= 0) close(job->event);
    job_destroy(job);
    return false;
}

struct gn_loaded *gn_loader_take(struct gn_loader *loader) {
    uint64_t count;
    struct job *job = loader->job;
    if (read(loader->event, &count, sizeof count) < 0) {
    }
    if (!job || atomic_load(&job->state) != IS_DONE) return NULL;
    struct gn_loaded *loaded = job->loaded;
    job->loaded = NULL;
    if (atomic_load(&job->cancelled)) {
        gn_loaded_drop(loaded);
        loaded = NULL;
    }
    loader->job = NULL;
    job_destroy(job);
    return loaded;
}

void gn_loader_close(struct gn_loader *loader) {
    if (!loader) return;
    gn_loader_cancel(loader);
    if (loader->job && atomic_exchange(&loader->job->state, IS_LEFT) == IS_DONE)
        job_destroy(loader->job);
    close(loader->event);
    free(loader);
}
