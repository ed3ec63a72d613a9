/* From shader files and a program key to the text of a shader (source.c, compose.c). No GL. */
#ifndef GN_GL_SOURCE_H
#define GN_GL_SOURCE_H

#include "core/err.h"
#include "frame/plan.h"

struct gn_gl_text { /* grows; zeroed is empty; always ends in a zero byte once something is in it */
    char *data;
    size_t size, room;
};
void gn_gl_text_add(struct gn_gl_text *text, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void gn_gl_text_add_bytes(struct gn_gl_text *text, const char *data, size_t size);
void gn_gl_text_finish(struct gn_gl_text *text);
/* The same text with a number before each line and ? for control characters; malloc'ed. */
char *gn_gl_text_numbered(const struct gn_gl_text *text);

/* Adds the shader file `name` (a path below shaders_es), from the folder or, if that is NULL, from
 * those embedded, with its #include "name" lines resolved: `name` itself at each call, an included
 * file once per source. */
struct gn_gl_source {
    const char *folder;
    char seen[32][64]; /* included so far */
    unsigned seen_count;
};
bool gn_gl_source_add(struct gn_gl_source *source, const char *name, struct gn_gl_text *out,
                      struct gn_err *err);
/* The words of its `//@ names a b c` lines, zero-separated in `names`; the count, or -1. */
enum { GN_GL_NAMES_MAX = 32 };
int gn_gl_source_names(const struct gn_gl_source *source, const char *name,
                       char names[GN_GL_NAMES_MAX][64], struct gn_err *err);

/* The whole source of one shader of a program. */
enum gn_gl_shader { GN_GL_VERTEX, GN_GL_FRAGMENT };
bool gn_gl_compose(const char *folder, const struct gn_program_key *key, enum gn_gl_shader shader,
                   struct gn_gl_text *out, struct gn_err *err);
/* A key as text: "lit BASE_TEXTURE|HEMISPHERE, SPOT pcf depth, POINT". */
void gn_gl_key_text(const struct gn_program_key *key, char *out, size_t size);

#endif
