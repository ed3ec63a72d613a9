/* libEGL and libGLESv2, opened at run time, so that the program starts without them and names the
 * missing package. Never closed: threads they started do not always survive dlclose. */
#ifndef GN_DISPLAY_EGL_H
#define GN_DISPLAY_EGL_H

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdbool.h>

#include "core/err.h"

/* clang-format off */
#define GN_EGL_TABLE(X) \
    X(GetProcAddress) X(QueryString) X(Initialize) X(Terminate) X(BindAPI) X(GetConfigs) \
    X(GetConfigAttrib) X(ChooseConfig) X(CreateContext) X(DestroyContext) \
    X(CreatePbufferSurface) X(DestroySurface) X(MakeCurrent) X(SwapBuffers) X(GetError)
/* clang-format on */

struct gn_egl {
    void *gles; /* libGLESv2: not every eglGetProcAddress returns core functions */
#define X(name) __typeof__(egl##name) *(name);
    GN_EGL_TABLE(X)
#undef X
};

/* Fails with the package to install. */
bool gn_egl_load(struct gn_egl *egl, struct gn_err *err);
/* Whether a space-separated list has this word; NULL is an empty list. */
bool gn_egl_has(const char *list, const char *word);

#endif
