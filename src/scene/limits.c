#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "scene/scene.h"

static const struct row {
    const char *name;
    size_t offset;
    uint64_t fallback, most;
} ROWS[] = {
    {"file_mb", offsetof(struct gn_scene_limits, file_mb), 512, 1 << 20},
    {"memory_mb", offsetof(struct gn_scene_limits, memory_mb), 1024, 1 << 20},
    {"nodes", offsetof(struct gn_scene_limits, nodes), 100000, 100000000},
    {"instances", offsetof(struct gn_scene_limits, instances), 1000000, 100000000},
    {"vertices", offsetof(struct gn_scene_limits, vertices), 20000000, 1 << 30},
    {"texels", offsetof(struct gn_scene_limits, texels), 67108864, 1 << 30},
    {"keys", offsetof(struct gn_scene_limits, keys), 4000000, 1 << 30},
    {"json_depth", offsetof(struct gn_scene_limits, json_depth), 512, 2000},
    {"triangles_per_frame", offsetof(struct gn_scene_limits, triangles_per_frame), 100000000,
     UINT64_C(1) << 40},
};
enum { ROW_COUNT = sizeof ROWS / sizeof ROWS[0] };
_Static_assert(sizeof(struct gn_scene_limits) == ROW_COUNT * sizeof(uint64_t), "a row per limit");

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
    char names[160] = "";
    for (size_t i = 0, at = 0; i < ROW_COUNT && at < sizeof names; i++)
        at += (size_t)snprintf(names + at, sizeof names - at, " %s", ROWS[i].name);
    return gn_fail_usage(err, "unknown limit '%s'; limits are:%s", name, names);
}

struct gn_scene_limits gn_scene_limits_or_default(const struct gn_scene_limits *limits) {
    struct gn_scene_limits result = limits ? *limits : (struct gn_scene_limits){0};
    for (size_t i = 0; i < ROW_COUNT; i++) {
        uint64_t *value = limit_field(&result, &ROWS[i]);
        if (*value == 0) *value = ROWS[i].fallback;
        if (*value > ROWS[i].most) *value = ROWS[i].most;
    }
    return result;
}

void gn_scene_limits_list(char *out, size_t size) {
    out[0] = '\0';
    for (size_t i = 0, at = 0; i < ROW_COUNT && at < size; i++)
        at += (size_t)snprintf(out + at, size - at, "%s%s=%" PRIu64, i ? ", " : "", ROWS[i].name,
                               ROWS[i].fallback);
}
