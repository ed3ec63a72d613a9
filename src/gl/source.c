/* Shader text: a buffer that grows, and files with their #include lines resolved. No GL. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/embedded.h"
#include "core/file.h"
#include "gl/private.h"

enum { INCLUDE_DEPTH = 8, SHADER_BYTES_MAX = 1 << 20 };

void gn_gl_text_add_bytes(struct gn_gl_text *text, const char *data, size_t size) {
    if (text->size + size + 1 > text->room) {
        text->room = 2 * (text->size + size) + 256;
        text->data = gn_xrealloc(text->data, text->room, 1);
    }
    memcpy(text->data + text->size, data, size);
    text->size += size;
    text->data[text->size] = 0;
}

void gn_gl_text_add(struct gn_gl_text *text, const char *format, ...) {
    char line[512];
    va_list args;
    va_start(args, format);
    int size = vsnprintf(line, sizeof line, format, args);
    va_end(args);
    if (size >= (int)sizeof line) size = sizeof line - 1;
    if (size > 0) gn_gl_text_add_bytes(text, line, (size_t)size);
}

void gn_gl_text_finish(struct gn_gl_text *text) {
    free(text->data);
    *text = (struct gn_gl_text){0};
}

char *gn_gl_text_numbered(const struct gn_gl_text *text) {
    struct gn_gl_text out = {0};
    int number = 1;
    for (const char *at = text->data; at && *at; number++) {
        size_t length = strcspn(at, "\n");
        gn_gl_text_add(&out, "%4d  ", number);
        gn_gl_text_add_bytes(&out, at, length);
        gn_gl_text_add_bytes(&out, "\n", 1);
        at += length + (at[length] == '\n');
    }
    for (char *c = out.data; c && *c; c++)
        if (((unsigned char)*c < 0x20 && *c != '\n' && *c != '\t') || *c == 0x7f) *c = '?';
    return out.data;
}

/* The bytes of a shader file. The caller finishes *owned (zero for an embedded file). */
static const char *file_text(const struct gn_gl_source *source, const char *name,
                             struct gn_bytes *owned, struct gn_err *err) {
    *owned = (struct gn_bytes){0};
    if (source->folder) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", source->folder, name);
        return gn_file_read(path, SHADER_BYTES_MAX, owned, err) ? (const char *)owned->data : NULL;
    }
    const struct gn_embedded *file = gn_embedded_find(name);
    if (!file) gn_fail(err, "no embedded shader file %s", name);
    return file ? (const char *)file->data : NULL;
}

static bool seen_before(struct gn_gl_source *source, const char *name) {
    for (unsigned i = 0; i < source->seen_count; i++)
        if (strcmp(source->seen[i], name) == 0) return true;
    return false;
}

static bool remember(struct gn_gl_source *source, const char *name, struct gn_err *err) {
    const unsigned room = sizeof source->seen / sizeof source->seen[0];
    if (source->seen_count == room)
        return gn_fail(err, "shader file %s: more than %u files included", name, room);
    snprintf(source->seen[source->seen_count++], sizeof source->seen[0], "%s", name);
    return true;
}

static bool add_file(struct gn_gl_source *source, const char *name, int depth,
                     struct gn_gl_text *out, struct gn_err *err) {
    if (depth > INCLUDE_DEPTH)
        return gn_fail(err, "shader file %s: included more than %d deep", name, INCLUDE_DEPTH);
    struct gn_bytes owned;
    const char *at = file_text(source, name, &owned, err);
    bool ok = at;
    while (ok && *at) {
        size_t length = strcspn(at, "\n");
        char start[128] = "", included[64];
        if (length < sizeof start) memcpy(start, at, length);
        if (sscanf(start, " # include \"%63[^\"]\"", included) != 1) {
            gn_gl_text_add_bytes(out, at, length);
            gn_gl_text_add_bytes(out, "\n", 1);
        } else if (!seen_before(source, included))
            ok = remember(source, included, err) && add_file(source, included, depth + 1, out, err);
        at += length + (at[length] == '\n');
    }
    gn_bytes_finish(&owned);
    return ok;
}

bool gn_gl_source_add(struct gn_gl_source *source, const char *name, struct gn_gl_text *out,
                      struct gn_err *err) {
    if (!seen_before(source, name) && !remember(source, name, err)) return false;
    return add_file(source, name, 0, out, err);
}

int gn_gl_source_names(const struct gn_gl_source *source, const char *name,
                       char names[GN_GL_NAMES_MAX][64], struct gn_err *err) {
    struct gn_bytes owned;
    const char *text = file_text(source, name, &owned, err);
    static const char mark[] = "//@ names";
    int count = 0;
    for (const char *at = text; at && (at = strstr(at, mark));) {
        at += sizeof mark - 1;
        int used = 0;
        while (count < GN_GL_NAMES_MAX &&
               sscanf(at, "%*[ ]%63[A-Za-z0-9_]%n", names[count], &used) == 1) {
            at += used;
            count++;
        }
    }
    gn_bytes_finish(&owned);
    return text ? count : -1;
}
