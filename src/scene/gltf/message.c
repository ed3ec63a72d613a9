/* Messages of a load: the file, the path in its JSON, and what is wrong there. */
#include <stdarg.h>
#include <stdio.h>

#include "scene/private.h"

enum { PATH_STEPS = 24 };

/* "nodes[3].mesh: " into text. */
static void write_path(const struct gn_at *at, char *text, size_t size) {
    const struct gn_at *steps[PATH_STEPS];
    int count = 0;
    for (; at && at->up && count < PATH_STEPS; at = at->up) steps[count++] = at;
    size_t used = 0;
    text[0] = 0;
    for (int i = count - 1; i >= 0 && used < size; i--) {
        const char *dot = i == count - 1 ? "" : ".";
        if (steps[i]->key)
            used += (size_t)snprintf(text + used, size - used, "%s%s", dot, steps[i]->key);
        else
            used += (size_t)snprintf(text + used, size - used, "[%zu]", steps[i]->index);
    }
    if (count > 0 && used < size) snprintf(text + used, size - used, ": ");
}

bool gn_gltf_fail(struct gn_gltf *g, const struct gn_at *at, const char *format, ...) {
    if (g->failed) return false;
    g->failed = true;
    char where[200], what[300];
    write_path(at, where, sizeof where);
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    return gn_fail(g->err, "%s: %s%s", g->path, where, what);
}

void gn_gltf_warn(struct gn_gltf *g, const struct gn_at *at, const char *format, ...) {
    char where[200], what[300];
    write_path(at, where, sizeof where);
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    gn_warn(g->warnings, "%s: %s%s", g->path, where, what);
}
