/* Allocation for a load, within the limit memory_mb. */
#include "scene/private.h"

#include <inttypes.h>
#include <string.h>

static uint64_t used_bytes(const struct gn_gltf *g) {
    return (uint64_t)g->memory.scene->used + g->memory.load.used + g->memory.step.used +
           g->memory.other_bytes;
}

size_t gn_gltf_room(const struct gn_gltf *g) {
    uint64_t limit = g->limits.memory_mb << 20, used = used_bytes(g);
    return used < limit ? (size_t)(limit - used) : 0;
}

static void note_most(struct gn_gltf *g) {
    const size_t used = (size_t)used_bytes(g);
    if (used > g->memory.most_bytes) g->memory.most_bytes = used;
}

void *gn_gltf_alloc(struct gn_gltf *g, struct gn_arena *arena, uint64_t count, size_t size) {
    if (g->failed) return NULL;
    uint64_t bytes = 0;
    void *memory = NULL;
    if (!__builtin_mul_overflow(count, size, &bytes) && bytes <= gn_gltf_room(g))
        memory = gn_arena_alloc(arena, (size_t)count, size);
    if (!memory)
        gn_gltf_fail(g, NULL, "out of memory, or over the limit memory_mb=%" PRIu64,
                     g->limits.memory_mb);
    note_most(g);
    return memory;
}

bool gn_gltf_count(struct gn_gltf *g, uint64_t bytes) {
    if (bytes > gn_gltf_room(g))
        return gn_gltf_fail(g, NULL, "out of memory, or over the limit memory_mb=%" PRIu64,
                            g->limits.memory_mb);
    g->memory.other_bytes += bytes;
    note_most(g);
    return !g->failed;
}

char *gn_gltf_strdup(struct gn_gltf *g, const char *text) {
    size_t size = text ? strlen(text) + 1 : 1;
    char *copy = gn_gltf_alloc(g, g->memory.scene, size, 1);
    if (copy && text) memcpy(copy, text, size);
    return copy;
}
