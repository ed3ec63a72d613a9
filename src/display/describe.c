#include <EGL/egl.h>

#include "core/text.h"
#include "display/display.h"

/* By functions of the client library itself, which every EGL 1.5 finds by name. */
void gn_display_describe_egl(struct gn_display *display, char *out, size_t size) {
    __typeof__(eglGetCurrentDisplay) *current =
        (__typeof__(eglGetCurrentDisplay) *)gn_display_get_proc(display, "eglGetCurrentDisplay");
    __typeof__(eglQueryString) *query =
        (__typeof__(eglQueryString) *)gn_display_get_proc(display, "eglQueryString");
    out[0] = 0;
    EGLDisplay egl = current && query ? current() : EGL_NO_DISPLAY;
    if (egl == EGL_NO_DISPLAY) return;
    const char *version = query(egl, EGL_VERSION), *vendor = query(egl, EGL_VENDOR);
    gn_text_format(out, size, "%s %s", version ? version : "", vendor ? vendor : "");
}
