#include "gl/table.h"

static gn_gl_proc find_proc(const struct gn_gl_opts *opts, const char *name,
                            const char *with_suffix) {
    const char *first = opts->desktop ? name : with_suffix; /* ES 3.0 has them by extension only */
    gn_gl_proc proc = opts->get_proc(opts->display, first);
    return proc ? proc : opts->get_proc(opts->display, opts->desktop ? with_suffix : name);
}

bool gn_gl_table_load(struct gn_gl_table *table, const struct gn_gl_opts *opts,
                      struct gn_err *err) {
#define X(type, name)                                                                              \
    table->name = (type)opts->get_proc(opts->display, "gl" #name);                                 \
    if (!table->name)                                                                              \
        return gn_fail(err, "the driver lacks gl" #name ": gnomon needs OpenGL ES 3.0");
    GN_GL_TABLE(X)
#undef X
#define X(type, name, suffix) table->name = (type)find_proc(opts, "gl" #name, "gl" #name suffix);
    GN_GL_TABLE_OPTIONAL(X)
#undef X
    return true;
}
