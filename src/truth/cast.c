#include "truth/cast.h"

#include <pthread.h>
#include <sched.h>

#include "core/hash.h"

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

/* 1 where a shader reads none. */
static float occlusion(const struct gn_cast_opts *opts, size_t pixel,
                       const struct gn_ray_surface *surface) {
    const struct gn_scene *scene = opts->rays->scene;
    struct gn_occlusion_site site;
    double whole = 0;
    if (!gn_item_is_occluded(scene, &scene->items[surface->item])) return 1;
    gn_occlusion_site_of(opts->pose, surface, &site);
    for (int k = 0; k < 2; k++) { /* no bands: each pixel has directions of its own */
        const uint64_t turn = gn_hash(GN_HASH_INIT + (uint64_t)k, &pixel, sizeof pixel);
        site.turn[k] = (float)(turn >> 40) * 0x1p-24f;
    }
    const double light =
        gn_occlusion_cast(opts->occlusion, &site, 0, (uint32_t)opts->samples, &whole);
    return whole > 0 ? (float)(light / whole) : 1;
}

/* Of directional lamps. */
static float sum_of_seen(const struct gn_cast_opts *opts, const struct gn_ray_surface *surface) {
    float sum = 0;
    for (uint32_t i = 0; i < opts->lamp_count; i++) {
        const double *along = opts->lamps[i].direction_ws, *n = surface->normal_ws;
        if (n[0] * along[0] + n[1] * along[1] + n[2] * along[2] < 0)
            sum += visibility(opts, &opts->lamps[i], surface);
    }
    return sum;
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
        if (opts->occlusion)
            job->out[0][at] = seen ? occlusion(opts, at, &surface) : GN_CAST_BACKGROUND;
        if (opts->sums) job->out[0][at] = seen ? sum_of_seen(opts, &surface) : GN_CAST_BACKGROUND;
        for (uint32_t i = 0; i < opts->lamp_count && !opts->sums; i++)
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
