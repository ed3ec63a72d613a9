/* Surfaceless EGL on the GPU that Mesa selects, or llvmpipe. Libraries are opened at run time, so
 * that the program starts without them and names the missing package. Without ES 3 an ES 2 context
 * is made current, so that gl/ can name the GPU in its error. */
#include <dlfcn.h>
#include <stdlib.h>

#include "core/arena.h"
#include "display/egl.h"
#include "display/private.h"

struct surfaceless {
    struct gn_egl egl;
    EGLDisplay display;
    EGLContext context;
    EGLSurface surface; /* EGL_NO_SURFACE if not needed */
};

/* Without a config if supported: nothing is drawn to an EGL surface. */
static bool make_context(struct surfaceless *s, EGLint major, bool needs_surface) {
    const char *has = s->egl.QueryString(s->display, EGL_EXTENSIONS);
    const EGLint renderable = major >= 3 ? EGL_OPENGL_ES3_BIT_KHR : EGL_OPENGL_ES2_BIT;
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, major, EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    const EGLint wanted[] = {EGL_RENDERABLE_TYPE, renderable, EGL_SURFACE_TYPE,
                             needs_surface ? EGL_PBUFFER_BIT : 0, EGL_NONE};
    EGLint count = 0;
    if ((needs_surface || !gn_egl_has(has, "EGL_KHR_no_config_context")) &&
        (!s->egl.ChooseConfig(s->display, wanted, &config, 1, &count) || count == 0))
        return false;
    s->context = s->egl.CreateContext(s->display, config, EGL_NO_CONTEXT, version);
    if (s->context == EGL_NO_CONTEXT) return false;
    if (needs_surface) s->surface = s->egl.CreatePbufferSurface(s->display, config, size);
    return true;
}

static bool open_context(struct surfaceless *s, struct gn_err *err) {
    if (!gn_egl_load(&s->egl, err)) return false;
    const char *client = s->egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!gn_egl_has(client, "EGL_MESA_platform_surfaceless"))
        return gn_fail(err, "EGL lacks surfaceless contexts; install libegl-mesa0");
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)s->egl.GetProcAddress("eglGetPlatformDisplayEXT");
    if (!get_display) return gn_fail(err, "EGL lacks eglGetPlatformDisplayEXT");
    s->display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (s->display == EGL_NO_DISPLAY || !s->egl.Initialize(s->display, NULL, NULL))
        return gn_fail(
            err,
            "eglInitialize failed (0x%x); install libgl1-mesa-dri, or check memory and open files",
            s->egl.GetError());
    s->egl.BindAPI(EGL_OPENGL_ES_API);
    const char *has = s->egl.QueryString(s->display, EGL_EXTENSIONS);
    const bool needs_surface = !gn_egl_has(has, "EGL_KHR_surfaceless_context");
    if (!make_context(s, 3, needs_surface) && !make_context(s, 2, needs_surface))
        return gn_fail(err, "cannot create an OpenGL ES context (0x%x)", s->egl.GetError());
    if (!s->egl.MakeCurrent(s->display, s->surface, s->surface, s->context))
        return gn_fail(err, "eglMakeCurrent failed (0x%x)", s->egl.GetError());
    return true;
}

static void surfaceless_close(struct gn_display *display) {
    struct surfaceless *s = display->state;
    if (!s) return;
    if (s->display != EGL_NO_DISPLAY) {
        s->egl.MakeCurrent(s->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (s->surface != EGL_NO_SURFACE) s->egl.DestroySurface(s->display, s->surface);
        if (s->context != EGL_NO_CONTEXT) s->egl.DestroyContext(s->display, s->context);
    }
    /* The libraries and the EGL display stay, and the next open reuses them: terminating unloads
     * the driver, which its threads do not always survive. */
    free(s);
    display->state = NULL;
}

static bool surfaceless_open(struct gn_display *display, struct gn_warnings *warnings,
                             struct gn_err *err) {
    (void)warnings;
    struct surfaceless *s = display->state = gn_xalloc(1, sizeof *s);
    if (open_context(s, err)) return true;
    surfaceless_close(display);
    return false;
}

static gn_display_proc surfaceless_get_proc(struct gn_display *display, const char *name) {
    struct surfaceless *s = display->state;
    gn_display_proc proc = (gn_display_proc)s->egl.GetProcAddress(name);
    if (!proc) *(void **)&proc = dlsym(s->egl.gles, name);
    return proc;
}

const struct gn_display_ops gn_display_surfaceless = {
    .name = "egl",
    .what = "off-screen rendering by the GPU, or llvmpipe (surfaceless EGL)",
    .open = surfaceless_open,
    .get_proc = surfaceless_get_proc,
    .close = surfaceless_close,
};
