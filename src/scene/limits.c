#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "core/memory.h"
#include "scene/scene.h"

static const struct row {
    const char *name;
    size_t offset;
    uint64_t fallback, most;
    uint64_t share; /* of the machine's memory, megabytes: the fallback is at most 1/share of it.
                       0: whatever the machine */
} ROWS[] = {
    {"file_mb", offsetof(struct gn_scene_limits, file_mb), 512, 1 << 20, 0},
    {"memory_mb", offsetof(struct gn_scene_limits, memory_mb), 1024, 1 << 20, 2},
    {"nodes", offsetof(struct gn_scene_limits, nodes), 100000, 100000000, 0},
    {"instances", offsetof(struct gn_scene_limits, instances), 1000000, 100000000, 0},
    {"vertices", offsetof(struct gn_scene_limits, vertices), 20000000, 1 << 30, 0},
    {"texels", offsetof(struct gn_scene_limits, texels), 67108864, 1 << 30, 0},
    {"keys", offsetof(struct gn_scene_limits, keys), 4000000, 1 << 30, 0},
    {"json_depth", offsetof(struct gn_scene_limits, json_depth), 512, 2000, 0},
    {"seconds", offsetof(struct gn_scene_limits, seconds), 60, 86400, 0},
    {"gpu_mb", offsetof(struct gn_scene_limits, gpu_mb), 1024, 1 << 20, 2},
    {"maps_mb", offsetof(struct gn_scene_limits, maps_mb), 384, 1 << 20, 8},
    {"triangles_per_frame", offsetof(struct gn_scene_limits, triangles_per_frame), 100000000,
     UINT64_C(1) << 40, 0},
    {"overdraw", offsetof(struct gn_scene_limits, overdraw), 100, 1000000, 0},
    {"decoded_mb", offsetof(struct gn_scene_limits, decoded_mb), 1024, 1 << 20, 2},
    {"ahead_percent", offsetof(struct gn_scene_limits, ahead_percent), 10, 100000, 0},
};
enum { ROW_COUNT = sizeof ROWS / sizeof ROWS[0] };
_Static_assert(offsetof(struct gn_scene_limits, cancel) == ROW_COUNT * sizeof(uint64_t),
               "a row per limit");

enum { LEAST_MB = 32 }; /* what a row with a share falls back to on the smallest machine */

static uint64_t fallback_of(const struct row *row) {
    const uint64_t memory_mb = row->share ? gn_memory_total_mb() : 0;
    if (memory_mb == 0) return row->fallback;
    const uint64_t mb = memory_mb / row->share > LEAST_MB ? memory_mb / row->share : LEAST_MB;
    return mb < row->fallback ? mb : row->fallback;
}

static uint64_t *limit_field(struct gn_scene_limits *limits, const struct row *row) {
    return (uint64_t *)(void *)((char *)limits + row->offset);
}

bool gn_scene_limits_set(struct gn_scene_limits *limits, const char *name, uint64_t value,
                         struct gn_err *err) {
    for (size_t i = 0; i < ROW_COUNT; i++) {
        if (strcmp(ROWS[i].name, name) != 0) continue;
        if (value < 1 || value > ROWS[i].most)
            return gn_fail_usage(err, "limit %s: %" PRIu64 " is not in 1..%" PRIu64, name, value,
                                 ROWS[i].most);
        *limit_field(limits, &ROWS[i]) = value;
        return true;
    }
    char names[200] = "";
    for (size_t i = 0, at = 0; i < ROW_COUNT && at < sizeof names; i++)
        at += (size_t)snprintf(names + at, sizeof names - at, " %s", ROWS[i].name);
    return gn_fail_usage(err, "unknown limit '%s'; limits are:%s", name, names);
}

bool gn_scene_limits_raise(const struct gn_scene_limits *limits, const char *name, size_t length,
                           uint64_t value) {
    struct gn_scene_limits now = gn_scene_limits_or_default(limits);
    for (size_t i = 0; i < ROW_COUNT; i++)
        if (strncmp(ROWS[i].name, name, length) == 0 && !ROWS[i].name[length])
            return value > *limit_field(&now, &ROWS[i]);
    return false;
}

struct gn_scene_limits gn_scene_limits_or_default(const struct gn_scene_limits *limits) {
    struct gn_scene_limits result = limits ? *limits : (struct gn_scene_limits){0};
    for (size_t i = 0; i < ROW_COUNT; i++) {
        uint64_t *value = limit_field(&result, &ROWS[i]);
        if (*value == 0) *value = fallback_of(&ROWS[i]);
        if (*value > ROWS[i].most) *value = ROWS[i].most;
    }
    return result;
}

void gn_scene_limits_list(char *out, size_t size) {
    out[0] = '\0';
    for (size_t i = 0, at = 0; i < ROW_COUNT && at < size; i++) {
        at += (size_t)snprintf(out + at, size - at, "%s%s=%" PRIu64, i ? ", " : "", ROWS[i].name,
                               ROWS[i].fallback);
        if (ROWS[i].share && at < size)
            at += (size_t)snprintf(out + at, size - at, " or 1/%" PRIu64 " of the memory",
                                   ROWS[i].share);
    }
}

void gn_scene_limits_print(const struct gn_scene_limits *limits, char *out, size_t size) {
    struct gn_scene_limits all = gn_scene_limits_or_default(limits);
    out[0] = '\0';
    for (size_t i = 0, at = 0; i < ROW_COUNT && at < size; i++)
        at += (size_t)snprintf(out + at, size - at, "%s%s=%" PRIu64, i ? ", " : "", ROWS[i].name,
                               *limit_field(&all, &ROWS[i]));
}
