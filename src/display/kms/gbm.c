/* GBM and EGL on a card, both opened at run time. The context is surfaceless, so that programs
 * compile before a monitor is connected. Where display and GPU are separate devices, Mesa finds the
 * GPU. */
#include <dlfcn.h>
#include <drm_fourcc.h>
#include <errno.h>
#include <fcntl.h>
#include <gbm.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/library.h"
#include "display/egl.h"
#include "display/kms/import.h"
#include "display/kms/scanout.h"

#define GBM_TABLE(X)                                                                               \
    X(gbm_create_device)                                                                           \
    X(gbm_device_destroy)                                                                          \
    X(gbm_surface_create)                                                                          \
    X(gbm_surface_create_with_modifiers)                                                           \
    X(gbm_surface_destroy)                                                                         \
    X(gbm_surface_lock_front_buffer)                                                               \
    X(gbm_surface_release_buffer)                                                                  \
    X(gbm_surface_has_free_buffers)                                                                \
    X(gbm_bo_create)                                                                               \
    X(gbm_bo_destroy)                                                                              \
    X(gbm_bo_get_width)                                                                            \
    X(gbm_bo_get_height)                                                                           \
    X(gbm_bo_get_format)                                                                           \
    X(gbm_bo_get_modifier)                                                                         \
    X(gbm_bo_get_plane_count)                                                                      \
    X(gbm_bo_get_handle_for_plane)                                                                 \
    X(gbm_bo_get_fd_for_plane)                                                                     \
    X(gbm_bo_get_stride_for_plane)                                                                 \
    X(gbm_bo_get_offset)

enum { CONFIGS_MAX = 512 };

struct scanout {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a type and a name */
#define X(name) __typeof__(name) *name;
    GBM_TABLE(X)
#undef X
    struct gn_egl egl;
    PFNEGLCREATEPLATFORMWINDOWSURFACEEXTPROC create_window;
    PFNEGLCREATESYNCKHRPROC create_sync; /* all three or none */
    PFNEGLDESTROYSYNCKHRPROC destroy_sync;
    PFNEGLDUPNATIVEFENCEFDANDROIDPROC dup_fence;
    struct gbm_device *gbm;
    EGLDisplay display;
    EGLContext context;
    EGLConfig context_config; /* EGL_NO_CONFIG_KHR if supported */
    EGLSurface window;
    struct gbm_surface *surface;
    int node; /* render node of another GPU, else -1 */
    struct gn_imports imports;
    bool has_colorspace, can_show; /* can_show: the card accepts this GPU's buffers */
};

/* ---- opening ---- */

static int export_plane(void *state, void *bo, int plane) {
    return ((struct scanout *)state)->gbm_bo_get_fd_for_plane(bo, plane);
}

static bool open_display(struct scanout *s, struct gn_err *err) {
    void *library = gn_library_open("libgbm.so.1", "libgbm1", err);
    if (!library) return false;
#define X(name)                                                                                    \
    *(void **)&s->name = dlsym(library, #name);                                                    \
    if (!s->name) return gn_fail(err, "libgbm.so.1 has no " #name "; install libgbm1");
    GBM_TABLE(X)
#undef X
    if (!gn_egl_load(&s->egl, err)) return false;
    const char *client = s->egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)s->egl.GetProcAddress("eglGetPlatformDisplayEXT");
    s->create_window = (PFNEGLCREATEPLATFORMWINDOWSURFACEEXTPROC)s->egl.GetProcAddress(
        "eglCreatePlatformWindowSurfaceEXT");
    if (!get_display || !s->create_window ||
        (!gn_egl_has(client, "EGL_KHR_platform_gbm") &&
         !gn_egl_has(client, "EGL_MESA_platform_gbm")))
        return gn_fail(err, "EGL does not support platform gbm; install libegl-mesa0");
    s->gbm = s->gbm_create_device(s->node >= 0 ? s->node : s->imports.card);
    if (!s->gbm) return gn_fail(err, "no GBM driver for this device; install libgl1-mesa-dri");
    s->display = get_display(EGL_PLATFORM_GBM_KHR, s->gbm, NULL);
    if (s->display == EGL_NO_DISPLAY || !s->egl.Initialize(s->display, NULL, NULL))
        return gn_fail(
            err,
            "eglInitialize failed (0x%x); install libgl1-mesa-dri, or check memory and open files",
            s->egl.GetError());
    s->egl.BindAPI(EGL_OPENGL_ES_API);
    return true;
}

/* ---- configs ---- */

static EGLint config_attribute(struct scanout *s, EGLConfig config, EGLint name) {
    EGLint value = 0;
    s->egl.GetConfigAttrib(s->display, config, name, &value);
    return value;
}

/* eglChooseConfig ignores EGL_NATIVE_VISUAL_ID, so it is compared here. Single-sampled: a
 * multisampled surface would resolve encoded values. With a stencil buffer, needed by planar
 * shadows: it is free beside 24 bits of depth. */
static EGLConfig find_config(struct scanout *s, uint32_t format) {
    EGLConfig *all = gn_xalloc(CONFIGS_MAX, sizeof *all), found = NULL, best = NULL;
    EGLint count = 0;
    s->egl.GetConfigs(s->display, all, CONFIGS_MAX, &count);
    for (EGLint i = 0; i < count && !best; i++) {
        EGLConfig c = all[i];
        const bool fits = (uint32_t)config_attribute(s, c, EGL_NATIVE_VISUAL_ID) == format &&
                          config_attribute(s, c, EGL_SURFACE_TYPE) & EGL_WINDOW_BIT &&
                          config_attribute(s, c, EGL_RENDERABLE_TYPE) & EGL_OPENGL_ES3_BIT_KHR &&
                          config_attribute(s, c, EGL_DEPTH_SIZE) == 24 &&
                          config_attribute(s, c, EGL_SAMPLES) == 0;
        if (!fits) continue;
        found = c;
        if (config_attribute(s, c, EGL_STENCIL_SIZE) == 8) best = c;
    }
    free(all);
    return best ? best : found;
}

/* ---- the context ---- */

static EGLContext create_context(struct scanout *s, EGLint major, bool robust) {
    const EGLint tail = robust ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT : EGL_NONE;
    const EGLint list[] = {EGL_CONTEXT_CLIENT_VERSION, major, tail, EGL_LOSE_CONTEXT_ON_RESET_EXT,
                           EGL_NONE};
    return s->egl.CreateContext(s->display, s->context_config, EGL_NO_CONTEXT, list);
}

static bool make_context(struct scanout *s, struct gn_err *err) {
    const char *has = s->egl.QueryString(s->display, EGL_EXTENSIONS);
    if (!gn_egl_has(has, "EGL_KHR_surfaceless_context"))
        return gn_fail(err, "the EGL driver lacks EGL_KHR_surfaceless_context");
    if (!gn_egl_has(has, "EGL_KHR_no_config_context"))
        s->context_config = find_config(s, DRM_FORMAT_XRGB8888);
    if (gn_egl_has(has, "EGL_EXT_create_context_robustness"))
        s->context = create_context(s, 3, true);
    if (s->context == EGL_NO_CONTEXT) s->context = create_context(s, 3, false);
    if (s->context == EGL_NO_CONTEXT) s->context = create_context(s, 2, false);
    if (s->context == EGL_NO_CONTEXT)
        return gn_fail(err, "cannot create an OpenGL ES context (0x%x)", s->egl.GetError());
    if (!s->egl.MakeCurrent(s->display, EGL_NO_SURFACE, EGL_NO_SURFACE, s->context))
        return gn_fail(err, "eglMakeCurrent failed (0x%x)", s->egl.GetError());
    return true;
}

static void drop_surface(void *state) {
    struct scanout *s = state;
    if (s->context) s->egl.MakeCurrent(s->display, EGL_NO_SURFACE, EGL_NO_SURFACE, s->context);
    if (s->window != EGL_NO_SURFACE) s->egl.DestroySurface(s->display, s->window);
    if (s->surface) s->gbm_surface_destroy(s->surface);
    gn_import_drop(&s->imports);
    s->window = EGL_NO_SURFACE;
    s->surface = NULL;
}

static void close_all(void *state) {
    struct scanout *s = state;
    if (s->display != EGL_NO_DISPLAY) {
        drop_surface(s);
        s->egl.MakeCurrent(s->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (s->context != EGL_NO_CONTEXT) s->egl.DestroyContext(s->display, s->context);
        s->egl.Terminate(s->display);
    }
    if (s->gbm) s->gbm_device_destroy(s->gbm);
    if (s->node >= 0) close(s->node);
    free(s); /* the libraries stay loaded: threads they started do not survive dlclose */
}

static void *open_device(int card, const char *render_node, struct gn_err *err) {
    struct scanout *s = gn_xalloc(1, sizeof *s);
    s->imports.card = card;
    s->node = render_node ? open(render_node, O_RDWR | O_CLOEXEC) : -1;
    if (render_node && s->node < 0) {
        gn_fail(err, "render node %s: %s%s", render_node, strerror(errno),
                errno == EACCES ? "; add the user to the group render" : "");
        close_all(s);
        return NULL;
    }
    if (!open_display(s, err) || !make_context(s, err)) {
        close_all(s);
        return NULL;
    }
    const char *has = s->egl.QueryString(s->display, EGL_EXTENSIONS);
    s->has_colorspace = gn_egl_has(has, "EGL_KHR_gl_colorspace");
    s->can_show = s->node < 0;
    if (s->node >= 0) { /* tries one buffer; if the card refuses it, frames are copied */
        struct gbm_bo *bo = s->gbm_bo_create(s->gbm, 64, 64, DRM_FORMAT_XRGB8888,
                                             GBM_BO_USE_RENDERING | GBM_BO_USE_LINEAR);
        s->can_show = bo && gn_import_get(&s->imports, bo, 1, export_plane, s);
        gn_import_drop(&s->imports);
        if (bo) s->gbm_bo_destroy(bo);
    }
    if (!gn_egl_has(has, "EGL_ANDROID_native_fence_sync")) return s;
    s->create_sync = (PFNEGLCREATESYNCKHRPROC)s->egl.GetProcAddress("eglCreateSyncKHR");
    s->destroy_sync = (PFNEGLDESTROYSYNCKHRPROC)s->egl.GetProcAddress("eglDestroySyncKHR");
    s->dup_fence =
        (PFNEGLDUPNATIVEFENCEFDANDROIDPROC)s->egl.GetProcAddress("eglDupNativeFenceFDANDROID");
    if (!s->destroy_sync || !s->dup_fence) s->create_sync = NULL;
    return s;
}

static gn_display_proc get_proc(void *state, const char *name) {
    struct scanout *s = state;
    return (gn_display_proc)s->egl.GetProcAddress(name);
}

/* ---- the surface ---- */

static struct gbm_surface *create_buffers(struct scanout *s, const struct gn_surface_opts *o,
                                          uint32_t format) {
    static const uint64_t linear = DRM_FORMAT_MOD_LINEAR;
    const bool listed = o->fallback == GN_FALLBACK_MODIFIERS;
    if (listed && (o->modifier_count == 0 || format != o->formats[0])) return NULL;
    if (o->fallback ==
        GN_FALLBACK_PLAIN) /* without modifiers two devices share linear layout only */
        return s->gbm_surface_create(s->gbm, o->width_px, o->height_px, format,
                                     GBM_BO_USE_RENDERING |
                                         (s->node >= 0 ? GBM_BO_USE_LINEAR : GBM_BO_USE_SCANOUT));
    return s->gbm_surface_create_with_modifiers(s->gbm, o->width_px, o->height_px, format,
                                                listed ? o->modifiers : &linear,
                                                listed ? (unsigned)o->modifier_count : 1);
}

/* srgb: wanted; on return, whether the surface encodes. */
static bool create_window(struct scanout *s, EGLConfig config, bool *srgb) {
    static const EGLint encoded[] = {EGL_GL_COLORSPACE_KHR, EGL_GL_COLORSPACE_SRGB_KHR, EGL_NONE};
    if (*srgb) s->window = s->create_window(s->display, config, s->surface, encoded);
    if (s->window != EGL_NO_SURFACE) return true;
    *srgb = false;
    s->window = s->create_window(s->display, config, s->surface, NULL);
    return s->window != EGL_NO_SURFACE;
}

static bool set_surface(void *state, const struct gn_surface_opts *o, struct gn_surface *out,
                        struct gn_err *err) {
    struct scanout *s = state;
    drop_surface(s);
    if (!s->can_show) return gn_fail(err, "the card accepts no buffers of the render node");
    for (int i = 0; i < o->format_count; i++) {
        EGLConfig config = find_config(s, o->formats[i]);
        if (!config || (s->context_config && config != s->context_config)) continue;
        s->surface = create_buffers(s, o, o->formats[i]);
        out->srgb = s->has_colorspace && !o->unencoded;
        if (s->surface && create_window(s, config, &out->srgb) &&
            s->egl.MakeCurrent(s->display, s->window, s->window, s->context)) {
            out->format = o->formats[i];
            return true;
        }
        drop_surface(s);
    }
    return gn_fail(err, "cannot create a %ux%u scanout surface (0x%x)", o->width_px, o->height_px,
                   s->egl.GetError());
}

/* ---- frames ---- */

static bool describe_buffer(struct scanout *s, struct gbm_bo *bo, struct gn_buffer *out,
                            struct gn_err *err) {
    *out = (struct gn_buffer){
        .key = bo,
        .width_px = s->gbm_bo_get_width(bo),
        .height_px = s->gbm_bo_get_height(bo),
        .format = s->gbm_bo_get_format(bo),
        .modifier = s->gbm_bo_get_modifier(bo),
        .plane_count = s->gbm_bo_get_plane_count(bo),
    };
    const struct gn_import *import =
        s->node >= 0 ? gn_import_get(&s->imports, bo, out->plane_count, export_plane, s) : NULL;
    if (s->node >= 0 && !import)
        return gn_fail(err, "the card refuses a buffer of the render node: %s", strerror(errno));
    for (int i = 0; i < out->plane_count && i < GN_BUFFER_PLANES_MAX; i++) {
        out->handles[i] = import ? import->handles[i] : s->gbm_bo_get_handle_for_plane(bo, i).u32;
        out->strides[i] = s->gbm_bo_get_stride_for_plane(bo, i);
        out->offsets[i] = s->gbm_bo_get_offset(bo, i);
    }
    return true;
}

static bool swap_buffers(void *state, bool want_fence, struct gn_buffer *out, int *fence,
                         struct gn_err *err) {
    struct scanout *s = state;
    EGLSyncKHR sync = EGL_NO_SYNC_KHR;
    *fence = -1;
    if (want_fence && s->create_sync)
        sync = s->create_sync(s->display, EGL_SYNC_NATIVE_FENCE_ANDROID, NULL);
    const bool swapped = s->egl.SwapBuffers(s->display, s->window);
    if (swapped && sync != EGL_NO_SYNC_KHR) *fence = s->dup_fence(s->display, sync);
    if (sync != EGL_NO_SYNC_KHR) s->destroy_sync(s->display, sync);
    if (!swapped) return gn_fail(err, "eglSwapBuffers failed (0x%x)", s->egl.GetError());
    struct gbm_bo *bo = s->gbm_surface_lock_front_buffer(s->surface);
    if (!bo) return gn_fail(err, "gbm_surface_lock_front_buffer failed");
    if (describe_buffer(s, bo, out, err)) return true;
    s->gbm_surface_release_buffer(s->surface, bo);
    return false;
}

static void release_buffer(void *state, void *key) {
    struct scanout *s = state;
    if (s->surface) s->gbm_surface_release_buffer(s->surface, key);
}

static bool has_free(void *state) {
    struct scanout *s = state;
    return s->surface && s->gbm_surface_has_free_buffers(s->surface);
}

const struct gn_scanout_ops gn_scanout_gbm = {
    .open = open_device,
    .get_proc = get_proc,
    .set_surface = set_surface,
    .drop_surface = drop_surface,
    .swap = swap_buffers,
    .release = release_buffer,
    .has_free = has_free,
    .close = close_all,
};
