/* The limit on seconds, the flag that cancels a load, and its progress. The limit counts processor
 * time of the thread that loads, so that a busy machine or a slow disk refuses no scene that it
 * would show otherwise. */
#include "scene/private.h"

#include <inttypes.h>

#include "core/clock.h"

bool gn_gltf_check_time(struct gn_gltf *g) {
    if (!g->failed && g->limits.cancel && atomic_load(g->limits.cancel))
        return gn_gltf_fail(g, NULL, "no longer wanted");
    if (g->failed || gn_clock_thread_cpu_ns() < g->end_ns) return !g->failed;
    return gn_gltf_fail(g, NULL, "takes longer to load than the limit seconds=%" PRIu64,
                        g->limits.seconds);
}

void gn_gltf_progress(const struct gn_gltf *g, uint64_t done, uint64_t all) {
    const unsigned from = g->permille[0], length = g->permille[1] - from;
    if (g->limits.progress)
        atomic_store(g->limits.progress, from + (unsigned)(length * done / all));
}
