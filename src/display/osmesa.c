/* Mesa's off-screen library, opened at run time. A desktop core context; with ARB_ES3_compatibility
 * it accepts the same shaders. OSMesa needs a buffer to be made current; frames are rendered to
 * FBOs instead. */
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <stdlib.h>

#include "core/arena.h"
#include "core/library.h"
#include "display/private.h"

enum { BUFFER_PX = 16 }; /* side of the unused buffer */

struct osmesa {
    void *library;
    OSMesaContext context;
    __typeof__(OSMesaCreateContextAttribs) *create;
    __typeof__(OSMesaDestroyContext) *destroy;
    __typeof__(OSMesaMakeCurrent) *make_current;
    __typeof__(OSMesaGetProcAddress) *get_proc;
    unsigned char buffer[BUFFER_PX * BUFFER_PX * 4];
};

static bool make_context(struct osmesa *o, struct gn_err *err) {
    static const int wanted[] = {OSMESA_FORMAT,
                                 OSMESA_RGBA,
                                 OSMESA_PROFILE,
                                 OSMESA_CORE_PROFILE,
                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                 3,
                                 OSMESA_CONTEXT_MINOR_VERSION,
                                 3,
                                 0};
    o->library = gn_library_open("libOSMesa.so.8", "libosmesa6", err);
    if (!o->library) {
        o->library = gn_library_open("libOSMesa.so.6", "libosmesa6", NULL);
        if (!o->library) return false;
        *err = (struct gn_err){0};
    }
    *(void **)&o->create = dlsym(o->library, "OSMesaCreateContextAttribs");
    *(void **)&o->destroy = dlsym(o->library, "OSMesaDestroyContext");
    *(void **)&o->make_current = dlsym(o->library, "OSMesaMakeCurrent");
    *(void **)&o->get_proc = dlsym(o->library, "OSMesaGetProcAddress");
    if (!o->create || !o->destroy || !o->make_current || !o->get_proc)
        return gn_fail(err, "libOSMesa is too old: gnomon needs Mesa 12 or later");
    o->context = o->create(wanted, NULL);
    if (!o->context) return gn_fail(err, "libOSMesa cannot create an OpenGL 3.3 core context");
    if (!o->make_current(o->context, o->buffer, GL_UNSIGNED_BYTE, BUFFER_PX, BUFFER_PX))
        return gn_fail(err, "OSMesaMakeCurrent failed");
    return true;
}

static void osmesa_close(struct gn_display *display) {
    struct osmesa *o = display->state;
    if (!o) return;
    if (o->context) o->make_current(NULL, NULL, 0, 0, 0);
    if (o->context) o->destroy(o->context);
    free(o); /* the library stays loaded: threads it started do not survive dlclose */
    display->state = NULL;
}

static bool osmesa_open(struct gn_display *display, struct gn_warnings *warnings,
                        struct gn_err *err) {
    (void)warnings;
    struct osmesa *o = display->state = gn_xalloc(1, sizeof *o);
    if (make_context(o, err)) return true;
    osmesa_close(display);
    return false;
}

static gn_display_proc osmesa_get_proc(struct gn_display *display, const char *name) {
    struct osmesa *o = display->state;
    return (gn_display_proc)o->get_proc(name);
}

const struct gn_display_ops gn_display_osmesa = {
    .name = "osmesa",
    .what = "off-screen rendering by the CPU (Mesa's OSMesa)",
    .desktop = true,
    .open = osmesa_open,
    .get_proc = osmesa_get_proc,
    .close = osmesa_close,
};
