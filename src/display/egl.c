#include "display/egl.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include "core/library.h"

bool gn_egl_load(struct gn_egl *egl, struct gn_err *err) {
    setenv("EGL_LOG_LEVEL", "fatal", 0); /* otherwise Mesa prints to stderr */
    void *library = gn_library_open("libEGL.so.1", "libegl1", err);
    if (!library) return false;
    egl->gles = gn_library_open("libGLESv2.so.2", "libgles2", err);
    if (!egl->gles) return false;
#define X(name)                                                                                    \
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
