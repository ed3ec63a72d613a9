/* Messages of a load: the file, the path in its JSON, and what is wrong there. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "scene/private.h"

enum { PATH_STEPS = 24, PATH_SIZE = 200, TEXT_SIZE = PATH_SIZE + 300 };

/* "nodes[3].mesh: text" into text. */
static void write_message(char text[TEXT_SIZE], const struct gn_at *at, const char *format,
                          va_list args) __attribute__((format(printf, 3, 0)));
static void write_message(char text[TEXT_SIZE], const struct gn_at *at, const char *format,
                          va_list args) {
    const struct gn_at *steps[PATH_STEPS];
    int count = 0;
    for (; at && at->up && count < PATH_STEPS; at = at->up) steps[count++] = at;
    size_t used = 0;
    text[0] = 0;
    for (int i = count - 1; i >= 0 && used < PATH_SIZE; i--) {
        const char *dot = i == count - 1 ? "" : ".";
        if (steps[i]->key)
            used += (size_t)snprintf(text + used, PATH_SIZE - used, "%s%s", dot, steps[i]->key);
        else
            used += (size_t)snprintf(text + used, PATH_SIZE - used, "[%zu]", steps[i]->index);
    }
    if (count > 0 && used < PATH_SIZE) snprintf(text + used, PATH_SIZE - used, ": ");
    used = strlen(text);
    vsnprintf(text + used, TEXT_SIZE - PATH_SIZE, format, args);
}

bool gn_gltf_fail(struct gn_gltf *g, const struct gn_at *at, const char *format, ...) {
    if (g->failed) return false;
    g->failed = true;
    g->failed_part = at != NULL;
    char text[TEXT_SIZE];
    va_list args;
    va_start(args, format);
    write_message(text, at, format, args);
    va_end(args);
    return gn_fail(g->err, "%s: %s", g->path, text);
}

bool gn_gltf_spare(struct gn_gltf *g, const char *without) {
    if (!g->failed || !g->failed_part) return false;
    if (g->err) {
        gn_warn(g->warnings, "%s; %s", g->err->text, without);
        if (!g->spared.text[0]) g->spared = *g->err;
        *g->err = (struct gn_err){0};
    }
    g->failed = false;
    return true;
}

bool gn_gltf_fail_empty(struct gn_gltf *g, const struct gn_at *at, const char *why) {
    if (g->failed || !g->spared.text[0]) return gn_gltf_fail(g, at, "the scene is empty: %s", why);
    g->failed = g->failed_part = true;
    return gn_fail(g->err, "%s", g->spared.text);
}

void gn_gltf_warn(struct gn_gltf *g, const struct gn_at *at, const char *format, ...) {
    char text[TEXT_SIZE];
    va_list args;
    va_start(args, format);
    write_message(text, at, format, args);
    va_end(args);
    gn_warn(g->warnings, "%s: %s", g->path, text);
}
