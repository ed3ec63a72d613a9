/* A window on X11 or Wayland by GLFW. Libraries are opened at run time.
 *
 * GLFW exposes no descriptor, so that of the window system's connection is used. A library below
 * may read that empty and queue our events, so events are polled after every call that might. A
 * timer paces frames: a vsynced swap blocks forever while the window is hidden. */
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "core/library.h"
#include "display/kms/flip.h"
#include "display/private.h"
#include "display/window/glfw.h"
#include "display/window/icon.h"
#include "display/window/key.h"

/* One per process, like the library. Never terminated: that unloads the driver, which its threads
 * do not always survive. */
static struct glfw glfw;

struct window {
    GLFWwindow *handle;
    struct gn_screen_opts opts;
    bool shown, damaged;
    bool toggles; /* toggle full screen after event handling */
    bool iconified;
    bool resized; /* resized since the last swap: that frame may have the old size */
    int width_px,
        height_px; /* framebuffer size from the last event; querying it would read events */
    struct gn_watch events; /* the connection is readable */
    struct gn_timer timer;
    struct gn_flip flip;
    struct gn_pointer pointer;
    struct gn_drag drag;
    int windowed[4]; /* x, y, width, height before full screen */
    char title[200];
    char dropped[PATH_MAX]; /* the file that pointer.file points to */
};

#define POLL_NS INT64_C(10000000)
enum { POLLS_MAX = 16 };

/* ---- libraries ---- */

static bool load_glfw(struct gn_err *err) {
    if (glfw.library) return true;
    void *library = gn_library_open("libglfw.so.3", "libglfw3", err);
    if (!library) return false;
#define X(name)                                                                                    \
    *(void **)&glfw.name = dlsym(library, "glfw" #name);                                           \
    if (!glfw.name) return gn_fail(err, "libglfw.so.3 has no glfw" #name "; install libglfw3");
    GLFW_TABLE(X)
#undef X
    glfw.library = library;
    return true;
}

/* GLFW's last error; never NULL. */
static const char *glfw_error(void) {
    const char *text = NULL;
    glfw.GetError(&text);
    return text ? text : "no reason given";
}

/* ---- events ---- */

static void poll_events(void) {
    for (int i = 0; i < POLLS_MAX && !glfw.link.gone; i++) {
        glfw.PollEvents();
        if (!gn_window_link_pending(&glfw.link)) return;
    }
}

/* ---- keys and pointer ---- */

static struct window *window_of(GLFWwindow *handle) { return glfw.GetWindowUserPointer(handle); }

static void on_close(GLFWwindow *handle) {
    gn_pointer_act(&window_of(handle)->pointer, GN_POINTER_QUIT);
}

static void on_refresh(GLFWwindow *handle) { window_of(handle)->damaged = true; }

static void on_size(GLFWwindow *handle, int width, int height) {
    struct window *w = window_of(handle);
    w->width_px = width;
    w->height_px = height;
    w->damaged = w->resized = true;
}

static void on_iconify(GLFWwindow *handle, int iconified) {
    window_of(handle)->iconified = iconified;
    window_of(handle)->damaged = true;
}

static void on_key(GLFWwindow *handle, int key, int code, int event, int modifiers) {
    static const struct {
        int key;
        enum gn_pointer_key action;
    } keys[] = {{GLFW_KEY_ESCAPE, GN_POINTER_QUIT},
                {GLFW_KEY_HOME, GN_POINTER_HOME},
                {GLFW_KEY_F11, GN_POINTER_FULL_SCREEN}};
    (void)code, (void)modifiers;
    struct window *w = window_of(handle);
    const struct gn_key_event other = {.key = (uint16_t)gn_window_key(key),
                                       .down = event == GLFW_PRESS,
                                       .time_ns = gn_clock_monotonic_ns()};
    if (other.key && event != GLFW_REPEAT) gn_pointer_key(&w->pointer, &other);
    for (size_t i = 0; i < sizeof keys / sizeof *keys && event == GLFW_PRESS; i++) {
        if (keys[i].key != key) continue;
        gn_pointer_act(&w->pointer, keys[i].action);
        w->toggles |= keys[i].action == GN_POINTER_FULL_SCREEN;
    }
}

/* By character, not by key: layouts differ. */
static void on_letter(GLFWwindow *handle, unsigned letter) {
    struct gn_pointer *pointer = &window_of(handle)->pointer;
    if (letter == 'q' || letter == 'Q')
        gn_pointer_act(pointer, GN_POINTER_QUIT);
    else
        gn_pointer_letter(pointer, letter);
}

/* Of several files the first. */
static void on_drop(GLFWwindow *handle, int count, const char **paths) {
    struct window *w = window_of(handle);
    if (count < 1 || strlen(paths[0]) >= sizeof w->dropped) return;
    snprintf(w->dropped, sizeof w->dropped, "%s", paths[0]);
    w->pointer.file = w->dropped;
}

static bool find_in_window(const struct window *w, double x, double y, float out[2]) {
    int width = 0, height = 0;
    glfw.GetWindowSize(w->handle, &width, &height);
    if (width <= 0 || height <= 0) return false;
    out[0] = (float)(x / width);
    out[1] = (float)(y / height);
    return true;
}

static void on_button(GLFWwindow *handle, int button, int event, int modifiers) {
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    const enum gn_button which = button == GLFW_MOUSE_BUTTON_LEFT    ? GN_BUTTON_LEFT
                                 : button == GLFW_MOUSE_BUTTON_RIGHT ? GN_BUTTON_RIGHT
                                                                     : GN_BUTTON_MIDDLE;
    struct window *w = window_of(handle);
    gn_drag_button(&w->drag, which, event == GLFW_PRESS, modifiers & GLFW_MOD_SHIFT);
    if (which != GN_BUTTON_LEFT) return;
    const bool presses = event == GLFW_PRESS && !(modifiers & GLFW_MOD_SHIFT);
    w->pointer.pressed |= presses;
    w->pointer.released |= event == GLFW_RELEASE;
    if (presses) find_in_window(w, w->drag.x, w->drag.y, w->pointer.press);
}

static void on_move(GLFWwindow *handle, double x, double y) {
    struct window *w = window_of(handle);
    int width = 0, height = 0;
    glfw.GetWindowSize(handle, &width, &height);
    gn_drag_move(&w->drag, x, y, height, &w->pointer);
    if (w->drag.drags && !w->drag.pans)
        w->pointer.dragged |= find_in_window(w, x, y, w->pointer.drag);
}

static void on_wheel(GLFWwindow *handle, double x, double y) {
    (void)x;
    window_of(handle)->pointer.wheel += (float)y;
}

/* ---- full screen ---- */

/* The monitor below the window's centre; without window positions (Wayland), the first. */
static GLFWmonitor *monitor_at(const int at[4]) {
    int count = 0;
    GLFWmonitor **all = glfw.GetMonitors(&count);
    for (int i = 0; i < count; i++) {
        const GLFWvidmode *mode = glfw.GetVideoMode(all[i]);
        int x = 0, y = 0;
        glfw.GetMonitorPos(all[i], &x, &y);
        const int right = at[0] + at[2] / 2 - x, down = at[1] + at[3] / 2 - y;
        if (mode && right >= 0 && right < mode->width && down >= 0 && down < mode->height)
            return all[i];
    }
    return count > 0 ? all[0] : NULL;
}

static void read_place(const struct window *w, int at[4]) {
    at[0] = at[1] = 0;
    glfw.GetWindowPos(w->handle, &at[0], &at[1]);
    glfw.GetWindowSize(w->handle, &at[2], &at[3]);
}

static int64_t period_of(const struct window *w) {
    int at[4];
    read_place(w, at);
    GLFWmonitor *monitor = monitor_at(at);
    const GLFWvidmode *mode = monitor ? glfw.GetVideoMode(monitor) : NULL;
    return GN_NS_PER_S / (mode && mode->refreshRate > 0 ? mode->refreshRate : 60);
}

static void toggle_full_screen(struct window *w) {
    int *at = w->windowed;
    w->toggles = false;
    w->damaged = true;
    if (glfw.GetWindowMonitor(w->handle)) {
        glfw.SetWindowMonitor(w->handle, NULL, at[0], at[1], at[2], at[3], 0);
        return;
    }
    read_place(w, at);
    GLFWmonitor *monitor = monitor_at(at);
    const GLFWvidmode *mode = monitor ? glfw.GetVideoMode(monitor) : NULL;
    if (!mode) return;
    glfw.SetWindowMonitor(w->handle, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    w->flip.period_ns = period_of(w);
}

/* ---- published state ---- */

/* Updates the state after every call that may have read events; reads none itself. */
static bool update_screen(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct window *w = display->state;
    struct gn_screen *s = &display->screen;
    if (gn_window_link_has_ended(&glfw.link)) {
        gn_fail(err, "the X server has ended");
        if (err) err->status = GN_EXIT_DISPLAY;
        return false;
    }
    const bool seen = w->width_px > 0 && w->height_px > 0 && !w->iconified && !s->lost;
    s->lit = seen && !s->blank;
    s->black = s->blank && w->damaged;
    s->width_px = seen ? (uint32_t)w->width_px : 0;
    s->height_px = seen ? (uint32_t)w->height_px : 0;
    s->may_draw = seen && (!s->blank || s->black) && gn_flip_may_draw(&w->flip, now_ns);
    s->damaged = w->damaged;
    s->period_ns = w->flip.period_ns;
    s->seen_ns = gn_flip_seen_ns(&w->flip, now_ns);
    s->counts.shown = w->flip.shown;
    s->counts.missed = w->flip.missed;
    gn_pointer_add(&s->pointer, &w->pointer);
    w->pointer = (struct gn_pointer){0};
    snprintf(s->what, sizeof s->what, "window %dx%d %s", w->width_px, w->height_px, glfw.link.name);
    /* events that arrived while drawing are dispatched at once */
    const bool has_events = w->toggles || !gn_pointer_is_zero(&s->pointer);
    w->timer.due_ns = has_events ? now_ns : gn_flip_deadline(&w->flip, now_ns);
    if (glfw.link.fd < 0 && w->timer.due_ns > now_ns + POLL_NS) w->timer.due_ns = now_ns + POLL_NS;
    return true;
}

/* ---- opening ---- */

static void window_close(struct gn_display *display) {
    struct window *w = display->state;
    if (!w) return;
    if (w->handle && !glfw.link.gone) glfw.DestroyWindow(w->handle);
    gn_loop_remove(&w->events);
    gn_loop_remove_timer(&w->timer);
    free(w);
    display->state = NULL;
}

static struct window *create_window(struct gn_display *display, struct gn_err *err) {
    if (!load_glfw(err)) return NULL;
    struct window *w = display->state = gn_xalloc(1, sizeof *w);
    setenv("EGL_LOG_LEVEL", "fatal", 0); /* otherwise Mesa prints to stderr */
    if (glfw.Init()) {
        if (!glfw.link.name) gn_window_link_open(&glfw.link, glfw.library);
        return w;
    }
    const char *wayland = getenv("WAYLAND_DISPLAY"), *x11 = getenv("DISPLAY");
    if (wayland && *wayland && !(x11 && *x11) && !dlsym(glfw.library, "glfwGetWaylandDisplay"))
        gn_fail(err, "this libglfw.so.3 is for X11 alone, and DISPLAY is not set: install "
                     "libglfw3-wayland in its place, or xwayland");
    else
        gn_fail(err, "no display server found (%s); check WAYLAND_DISPLAY and DISPLAY",
                glfw_error());
    window_close(display);
    return NULL;
}

/* Hidden until its first frame. Prefers an sRGB framebuffer and a robust context; falls back to one
 * or none of them. */
static bool make_window(struct window *w, uint32_t width_px, uint32_t height_px,
                        struct gn_err *err) {
    for (int attempt = w->opts.unencoded ? 2 : 0; attempt < 4; attempt++) {
        const int hints[][2] = {
            {GLFW_CLIENT_API, GLFW_OPENGL_ES_API},
            {GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API},
            {GLFW_CONTEXT_VERSION_MAJOR, 3},
            {GLFW_CONTEXT_VERSION_MINOR, 0},
            {GLFW_CONTEXT_ROBUSTNESS,
             attempt % 2 == 0 ? GLFW_LOSE_CONTEXT_ON_RESET : GLFW_NO_ROBUSTNESS},
            {GLFW_SRGB_CAPABLE, attempt < 2},
            {GLFW_SAMPLES, 0}, /* multisampling would resolve encoded values */
            {GLFW_ALPHA_BITS, 0},
            {GLFW_STENCIL_BITS, 8},
            {GLFW_VISIBLE, GLFW_FALSE},
            {GLFW_AUTO_ICONIFY, GLFW_FALSE},
        };
        for (size_t i = 0; i < sizeof hints / sizeof *hints; i++)
            glfw.WindowHint(hints[i][0], hints[i][1]);
        glfw.WindowHintString(GLFW_X11_CLASS_NAME, "gnomon");
        glfw.WindowHintString(GLFW_X11_INSTANCE_NAME, "gnomon");
        w->handle = glfw.CreateWindow((int)width_px, (int)height_px,
                                      w->title[0] ? w->title : "gnomon", NULL, NULL);
        if (!w->handle) continue;
        glfw.MakeContextCurrent(w->handle);
        return true;
    }
    return gn_fail(err, "cannot create a window with OpenGL ES 3.0 (%s)", glfw_error());
}

/* Off screen: a hidden window. */
static bool window_open(struct gn_display *display, struct gn_warnings *warnings,
                        struct gn_err *err) {
    (void)warnings;
    struct window *w = create_window(display, err);
    if (!w) return false;
    if (make_window(w, 16, 16, err)) return true;
    window_close(display);
    return false;
}

/* ---- the window as a screen ---- */

/* Desktops take the size that fits. On Wayland windows have no icon of their own. */
static void set_icon(const struct window *w) {
    enum { SMALL = 32, LARGE = 64 };
    static uint8_t small[4 * SMALL * SMALL], large[4 * LARGE * LARGE];
    gn_window_icon(small, SMALL);
    gn_window_icon(large, LARGE);
    const GLFWimage icons[] = {{SMALL, SMALL, small}, {LARGE, LARGE, large}};
    glfw.SetWindowIcon(w->handle, 2, icons);
}

/* Everything bound to the window handle, including the context. */
static bool make_screen(struct gn_display *display, uint32_t width_px, uint32_t height_px,
                        struct gn_err *err) {
    struct window *w = display->state;
    struct gn_screen *s = &display->screen;
    if (!make_window(w, width_px, height_px, err)) return false;
    glfw.SetWindowUserPointer(w->handle, w);
    glfw.SetWindowCloseCallback(w->handle, on_close);
    glfw.SetWindowRefreshCallback(w->handle, on_refresh);
    glfw.SetFramebufferSizeCallback(w->handle, on_size);
    glfw.SetWindowIconifyCallback(w->handle, on_iconify);
    glfw.SetKeyCallback(w->handle, on_key);
    glfw.SetCharCallback(w->handle, on_letter);
    glfw.SetMouseButtonCallback(w->handle, on_button);
    glfw.SetCursorPosCallback(w->handle, on_move);
    glfw.SetScrollCallback(w->handle, on_wheel);
    glfw.SetDropCallback(w->handle, on_drop);
    set_icon(w);
    /* X11: the swap waits at most when late, and does not tear */
    glfw.SwapInterval(glfw.link.x_pending ? 1 : 0);
    w->flip = (struct gn_flip){.no_vblank = true,
                               .period_ns = period_of(w),
                               .shown = w->flip.shown,
                               .missed = w->flip.missed};
    w->flip.shortest_ns = w->opts.max_fps > 0 ? GN_NS_PER_S / w->opts.max_fps : 0;
    s->has_context = true;
    s->generation++;
    /* whether the framebuffer is really sRGB */
    __typeof__(eglQuerySurface) *query = (__typeof__(query))glfw.GetProcAddress("eglQuerySurface");
    EGLint space = 0;
    s->srgb =
        query &&
        query(glfw.GetEGLDisplay(), glfw.GetEGLSurface(w->handle), EGL_GL_COLORSPACE_KHR, &space) &&
        space == EGL_GL_COLORSPACE_SRGB_KHR;
    glfw.GetFramebufferSize(w->handle, &w->width_px, &w->height_px);
    poll_events();
    return true;
}

static bool window_open_screen(struct gn_display *display, const struct gn_screen_opts *opts,
                               int64_t now_ns, struct gn_warnings *warnings, struct gn_err *err) {
    (void)warnings;
    struct window *w = create_window(display, err);
    if (!w) return false;
    w->opts = *opts;
    w->timer.due_ns = GN_LOOP_NEVER;
    gn_loop_add_timer(opts->loop, &w->timer);
    w->events = (struct gn_watch){.fd = glfw.link.fd, .events = EPOLLIN};
    display->screen = (struct gn_screen){.rotate_deg = opts->rotate_deg};
    if (glfw.link.fd >= 0 && !gn_loop_add(opts->loop, &w->events))
        gn_fail(err, "cannot wait for the window: %s", strerror(errno));
    else if (make_screen(display, opts->width_px ? opts->width_px : 1280,
                         opts->height_px ? opts->height_px : 720, err))
        return update_screen(display, now_ns, err);
    window_close(display);
    return false;
}

static bool window_dispatch(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct window *w = display->state;
    poll_events();
    if (w->toggles) {
        toggle_full_screen(w);
        poll_events();
    }
    return update_screen(display, now_ns, err);
}

static void window_lose(struct gn_display *display, int64_t now_ns) {
    display->screen.lost = true;
    update_screen(display, now_ns, NULL);
}

/* Window and context are one object: recreates both. */
static bool window_renew(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct window *w = display->state;
    int at[4];
    if (!display->screen.lost) return update_screen(display, now_ns, err);
    const bool full = glfw.GetWindowMonitor(w->handle);
    read_place(w, at);
    if (full) memcpy(at, w->windowed, sizeof at);
    glfw.DestroyWindow(w->handle);
    w->handle = NULL;
    w->shown = w->iconified = false;
    w->drag = (struct gn_drag){0};
    display->screen.lost = display->screen.has_context = false;
    if (!make_screen(display, (uint32_t)at[2], (uint32_t)at[3], err)) {
        if (err) err->status = GN_EXIT_DISPLAY;
        return false;
    }
    if (glfw.link.x_pending) glfw.SetWindowPos(w->handle, at[0], at[1]);
    if (full) toggle_full_screen(w);
    w->damaged = true;
    return update_screen(display, now_ns, err);
}

static bool window_begin(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct window *w = display->state;
    if (!display->screen.may_draw) return false;
    if (!w->shown) {
        glfw.ShowWindow(w->handle);
        poll_events();
        w->shown = true;
    }
    gn_flip_begun(&w->flip, now_ns);
    if (!update_screen(display, now_ns, err) || !display->screen.may_draw) return false;
    w->damaged = display->screen.damaged = false;
    return true;
}

static bool window_present(struct gn_display *display, int64_t now_ns, struct gn_err *err) {
    struct window *w = display->state;
    glfw.SwapBuffers(w->handle);
    w->damaged |= w->resized;
    w->resized = false;
    gn_flip_committed(&w->flip, now_ns);
    gn_flip_done(&w->flip, now_ns, now_ns);
    poll_events();
    return update_screen(display, now_ns, err);
}

static void window_blank(struct gn_display *display, bool on, int64_t now_ns) {
    struct window *w = display->state;
    w->damaged |= display->screen.blank != on;
    display->screen.blank = on;
    update_screen(display, now_ns, NULL);
}

static void window_set_title(struct gn_display *display, const char *title) {
    struct window *w = display->state;
    snprintf(w->title, sizeof w->title, "%s", title);
    if (w->handle) glfw.SetWindowTitle(w->handle, w->title);
}

static gn_display_proc window_get_proc(struct gn_display *display, const char *name) {
    (void)display;
    return (gn_display_proc)glfw.GetProcAddress(name);
}

static const struct gn_screen_ops window_screen_ops = {
    .open = window_open_screen,
    .dispatch = window_dispatch,
    .renew = window_renew,
    .begin = window_begin,
    .present = window_present,
    .lose = window_lose,
    .blank = window_blank,
    .set_title = window_set_title,
};

const struct gn_display_ops gn_display_window = {
    .name = "window",
    .is_window = true,
    .what = "a window on a desktop, X11 or Wayland (GLFW)",
    .open = window_open,
    .get_proc = window_get_proc,
    .close = window_close,
    .screen = &window_screen_ops,
};
