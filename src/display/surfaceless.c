/* EGL without any surface or window system: whatever GPU Mesa finds, or llvmpipe. The libraries are
 * opened at run time, so that the program starts, and says what to install, where they are missing.
 * Where there is no ES 3 a context of ES 2 is made current all the same: gl/ then names the GPU. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "display/private.h"

#define EGL_TABLE(X)                                                                               \
    X(PFNEGLGETPROCADDRESSPROC, GetProcAddress)                                                    \
    X(PFNEGLQUERYSTRINGPROC, QueryString)                                                          \
    X(PFNEGLINITIALIZEPROC, Initialize)                                                            \
    X(PFNEGLBINDAPIPROC, BindAPI)                                                                  \
    X(PFNEGLCHOOSECONFIGPROC, ChooseConfig)                                                        \
    X(PFNEGLCREATECONTEXTPROC, CreateContext)                                                      \
    X(PFNEGLDESTROYCONTEXTPROC, DestroyContext)                                                    \
    X(PFNEGLCREATEPBUFFERSURFACEPROC, CreatePbufferSurface)                                        \
    X(PFNEGLDESTROYSURFACEPROC, DestroySurface)                                                    \
    X(PFNEGLMAKECURRENTPROC, MakeCurrent)                                                          \
    X(PFNEGLGETERRORPROC, GetError)

struct surfaceless {
    void *egl_library, *gles_library;
#define X(type, name) type name;
    EGL_TABLE(X)
#undef X
    EGLDisplay display;
    EGLContext context;
    EGLSurface surface; /* EGL_NO_SURFACE where the driver needs none */
};

static bool load(struct surfaceless *s, struct gn_err *err) {
    setenv("EGL_LOG_LEVEL", "fatal", 0); /* or Mesa chats on stderr about what it did not find */
    s->egl_library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    s->gles_library = dlopen("libGLESv2.so.2", RTLD_NOW | RTLD_LOCAL);
    if (!s->egl_library || !s->gles_library)
        return gn_fail(err, "%s is missing; install libegl1 libgles2",
                       s->egl_library ? "libGLESv2.so.2" : "libEGL.so.1");
#define X(type, name) *(void **)&s->name = dlsym(s->egl_library, "egl" #name);
    EGL_TABLE(X)
#undef X
#define X(type, name)                                                                              \
    if (!s->name) return gn_fail(err, "libEGL.so.1 has no egl" #name "; install libegl1");
    EGL_TABLE(X)
#undef X
    return true;
}

static bool has_word(const char *list, const char *word) {
    size_t length = strlen(word);
    for (const char *at = list; at && (at = strstr(at, word)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0)) return true;
    return false;
}

static bool open_display(struct surfaceless *s, struct gn_err *err) {
    const char *client = s->QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!has_word(client, "EGL_MESA_platform_surfaceless"))
        return gn_fail(err, "this EGL cannot draw without a window; install libegl-mesa0");
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)s->GetProcAddress("eglGetPlatformDisplayEXT");
    if (!get_display) return gn_fail(err, "this EGL has no eglGetPlatformDisplayEXT");
    s->display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (s->display == EGL_NO_DISPLAY || !s->Initialize(s->display, NULL, NULL))
        return gn_fail(err, "EGL finds no driver (0x%x); install libgl1-mesa-dri", s->GetError());
    s->BindAPI(EGL_OPENGL_ES_API);
    return true;
}

static bool choose_config(struct surfaceless *s, EGLint renderable, EGLint surface,
                          EGLConfig *out) {
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, renderable, EGL_SURFACE_TYPE, surface, EGL_NONE};
    EGLint count = 0;
    return s->ChooseConfig(s->display, wanted, out, 1, &count) && count > 0;
}

/* No config where that is allowed: nothing is ever drawn to a surface of EGL's. */
static bool make_context(struct surfaceless *s, EGLint major, bool needs_surface) {
    const char *has = s->QueryString(s->display, EGL_EXTENSIONS);
    const EGLint renderable = major >= 3 ? EGL_OPENGL_ES3_BIT_KHR : EGL_OPENGL_ES2_BIT;
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, major, EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (needs_surface || !has_word(has, "EGL_KHR_no_config_context"))
        if (!choose_config(s, renderable, needs_surface ? EGL_PBUFFER_BIT : 0, &config))
            return false;
    s->context = s->CreateContext(s->display, config, EGL_NO_CONTEXT, version);
    if (s->context == EGL_NO_CONTEXT) return false;
    if (needs_surface) s->surface = s->CreatePbufferSurface(s->display, config, size);
    return true;
}

static bool make_current(struct surfaceless *s, struct gn_err *err) {
    bool needs_surface =
        !has_word(s->QueryString(s->display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");
    if (!make_context(s, 3, needs_surface) && !make_context(s, 2, needs_surface))
        return gn_fail(err, "the driver makes no OpenGL ES context (0x%x)", s->GetError());
    if (!s->MakeCurrent(s->display, s->surface, s->surface, s->context))
        return gn_fail(err, "the driver does not make its context current (0x%x)", s->GetError());
    return true;
}

static void surfaceless_close(struct gn_display *display) {
    struct surfaceless *s = display->state;
    if (!s) return;
    if (s->display != EGL_NO_DISPLAY) {
        s->MakeCurrent(s->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (s->surface != EGL_NO_SURFACE) s->DestroySurface(s->display, s->surface);
        if (s->context != EGL_NO_CONTEXT) s->DestroyContext(s->display, s->context);
    }
    /* The libraries stay, and so does the EGL display, which the next open gets again: terminating
     * it unloads the driver, and what that has started does not always survive it. */
    free(s);
    display->state = NULL;
}

static bool surfaceless_open(struct gn_display *display, struct gn_warnings *warnings,
                             struct gn_err *err) {
    (void)warnings;
    struct surfaceless *s = display->state = gn_xalloc(1, sizeof *s);
    if (load(s, err) && open_display(s, err) && make_current(s, err)) return true;
    surfaceless_close(display);
    return false;
}

static gn_display_proc surfaceless_get_proc(struct gn_display *display, const char *name) {
    struct surfaceless *s = display->state;
    gn_display_proc proc = (gn_display_proc)s->GetProcAddress(name);
    if (!proc) *(void **)&proc = dlsym(s->gles_library, name);
    return proc;
}

const struct gn_display_ops gn_display_surfaceless = {
    .name = "egl",
    .what = "off-screen rendering by the GPU, or llvmpipe (surfaceless EGL)",
    .open = surfaceless_open,
    .get_proc = surfaceless_get_proc,
    .close = surfaceless_close,
};
