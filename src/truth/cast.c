#include "truth/cast.h"

#include <pthread.h>
#include <sched.h>

enum { THREADS_MAX = 256 };

struct job {
    const struct gn_cast_opts *opts;
    float *const *out;
    atomic_int next_row;
};

static float visibility(const struct gn_cast_opts *opts, const struct gn_ray_lamp *lamp,
                        const struct gn_ray_surface *surface) {
    return opts->samples > 1 ? (float)gn_raycast_share(opts->rays, lamp, surface, opts->samples)
                             : (float)gn_raycast_visible(opts->rays, lamp, surface);
}

static bool is_cancelled(const struct gn_cast_opts *opts) {
    return opts->cancel && atomic_load_explicit(opts->cancel, memory_order_relaxed);
}

static void cast_row(const struct job *job, int y) {
    const struct gn_cast_opts *opts = job->opts;
    for (int x = 0; x < opts->eye->width_px && !is_cancelled(opts); x++) {
        const size_t at = (size_t)y * (size_t)opts->eye->width_px + (size_t)x;
        struct gn_ray_surface surface;
        const bool seen = gn_raycast_eye(opts->rays, opts->eye, x, y, &surface);
        for (uint32_t i = 0; i < opts->lamp_count; i++)
            job->out[i][at] =
                seen ? visibility(opts, &opts->lamps[i], &surface) : GN_CAST_BACKGROUND;
    }
}

static void *cast_rows(void *data) {
    struct job *job = data;
    for (int y; (y = atomic_fetch_add(&job->next_row, 1)) < job->opts->eye->height_px;)
        cast_row(job, y);
    return NULL;
}

static int count_processors(void) {
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

void gn_cast(const struct gn_cast_opts *opts, float *const out[]) {
    struct job job = {.opts = opts, .out = out};
    pthread_t threads[THREADS_MAX];
    const int rows = opts->eye->height_px;
    int wanted = opts->threads > 0 ? opts->threads : count_processors(), started = 0;
    if (wanted > THREADS_MAX) wanted = THREADS_MAX;
    while (started < wanted - 1 && pthread_create(&threads[started], NULL, cast_rows, &job) == 0)
        started++;
    for (int y; (y = atomic_fetch_add(&job.next_row, 1)) < rows;) {
        cast_row(&job, y);
        if (opts->progress) opts->progress(opts->user, (double)(y + 1) / rows);
    }
    while (started) pthread_join(threads[--started], NULL);
    if (opts->progress) opts->progress(opts->user, 1);
}
