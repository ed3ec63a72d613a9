/* libEGL and libGLESv2, opened at run time, so that the program starts, and says what to install,
 * where they are missing. They are never closed: what they have started does not always survive
 * being unloaded. */
#ifndef GN_DISPLAY_EGL_H
#define GN_DISPLAY_EGL_H

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdbool.h>

#include "core/err.h"

#define GN_EGL_TABLE(X)                                                                            \
    X(PFNEGLGETPROCADDRESSPROC, GetProcAddress)                                                    \
    X(PFNEGLQUERYSTRINGPROC, QueryString)                                                          \
    X(PFNEGLINITIALIZEPROC, Initialize)                                                            \
    X(PFNEGLTERMINATEPROC, Terminate)                                                              \
    X(PFNEGLBINDAPIPROC, BindAPI)                                                                  \
    X(PFNEGLGETCONFIGSPROC, GetConfigs)                                                            \
    X(PFNEGLGETCONFIGATTRIBPROC, GetConfigAttrib)                                                  \
    X(PFNEGLCHOOSECONFIGPROC, ChooseConfig)                                                        \
    X(PFNEGLCREATECONTEXTPROC, CreateContext)                                                      \
    X(PFNEGLDESTROYCONTEXTPROC, DestroyContext)                                                    \
    X(PFNEGLCREATEPBUFFERSURFACEPROC, CreatePbufferSurface)                                        \
    X(PFNEGLDESTROYSURFACEPROC, DestroySurface)                                                    \
    X(PFNEGLMAKECURRENTPROC, MakeCurrent)                                                          \
    X(PFNEGLSWAPBUFFERSPROC, SwapBuffers)                                                          \
    X(PFNEGLGETERRORPROC, GetError)

struct gn_egl {
    void *gles; /* libGLESv2: not every eglGetProcAddress gives core functions */
#define X(type, name) type name;
    GN_EGL_TABLE(X)
#undef X
};

/* False: err says what to install. */
bool gn_egl_load(struct gn_egl *egl, struct gn_err *err);
/* Is it one of the words of a list with spaces? NULL is an empty list. */
bool gn_egl_has(const char *list, const char *word);

#endif
