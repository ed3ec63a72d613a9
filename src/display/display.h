/* Where pictures go, behind one vtable: a row and a file add one. A display owns the GL context and
 * makes it current in the thread that opened it. */
#ifndef GN_DISPLAY_DISPLAY_H
#define GN_DISPLAY_DISPLAY_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"
#include "core/warn.h"

typedef void (*gn_display_proc)(void);
struct gn_display;
struct gn_display_ops {
    const char *name; /* as in --backend: "egl", "osmesa" */
    const char *what; /* one line for doctor */
    bool desktop;     /* its context is desktop GL that reads ES 3.0 shaders */
    bool (*open)(struct gn_display *display, struct gn_warnings *warnings,
                 struct gn_err *err); /* makes a context current */
    gn_display_proc (*get_proc)(struct gn_display *display, const char *name);
    void (*close)(struct gn_display *display);
};
struct gn_display {
    const struct gn_display_ops *ops;
    void *state; /* private to ops */
};

/* All that were built in, in the order in which "auto" tries them; NULL ends. */
extern const struct gn_display_ops *const gn_displays[];

/* Opens by name ("auto": the first that opens). A name that exists but was not built in says so. */
bool gn_display_open(struct gn_display *display, const char *name, struct gn_warnings *warnings,
                     struct gn_err *err);
gn_display_proc gn_display_get_proc(void *display, const char *name); /* for gn_gl_opts */
void gn_display_close(struct gn_display *display); /* a zeroed one may be closed */

#endif
