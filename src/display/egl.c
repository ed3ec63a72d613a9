#include "display/egl.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

bool gn_egl_load(struct gn_egl *egl, struct gn_err *err) {
    setenv("EGL_LOG_LEVEL", "fatal", 0); /* otherwise Mesa prints to stderr */
    void *library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    egl->gles = dlopen("libGLESv2.so.2", RTLD_NOW | RTLD_LOCAL);
    if (!library || !egl->gles)
        return gn_fail(err, "%s is missing; install libegl1 libgles2",
                       library ? "libGLESv2.so.2" : "libEGL.so.1");
#define X(type, name)                                                                              \
    *(void **)&egl->name = dlsym(library, "egl" #name);                                            \
    if (!egl->name) return gn_fail(err, "libEGL.so.1 has no egl" #name "; install libegl1");
    GN_EGL_TABLE(X)
#undef X
    return true;
}

bool gn_egl_has(const char *list, const char *word) {
    const size_t length = strlen(word);
    for (const char *at = list; at && (at = strstr(at, word)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0)) return true;
    return false;
}
