#include "display/window/link.h"

#include <dlfcn.h>
#include <stddef.h>

#include "core/quiet.h"

#define X11     "libX11.so.6"
#define WAYLAND "libwayland-client.so.0"

/* A function of a library that GLFW has loaded; NULL if not loaded. Adds a reference. */
static void *function_of(const char *library, const char *name) {
    void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    return handle ? dlsym(handle, name) : NULL;
}

static void *ask_for_display(void *library, const char *name) {
    void *(*get)(void);
    *(void **)&get = dlsym(library, name);
    return get ? get() : NULL;
}

/* Requests in progress continue after the connection broke, and Xlib reports each on stderr. */
static struct gn_window_link *only;
static int end_quietly(void *display) {
    (void)display;
    if (only->kept_stderr < 0) only->kept_stderr = gn_quiet_begin();
    return 0;
}

/* A request about another program's window, which may be gone: that of a dropped file's source. */
static int ignore_error(void *display, void *event) {
    (void)display, (void)event;
    return 0;
}

static void end_later(void *display, void *link) {
    (void)display;
    ((struct gn_window_link *)link)->gone = true;
}

void gn_window_link_open(struct gn_window_link *link, void *glfw_library) {
    int (*number)(void *display);
    *link = (struct gn_window_link){.name = "", .fd = -1, .kept_stderr = -1};
    link->display = ask_for_display(glfw_library, "glfwGetX11Display");
    if (!link->display) {
        link->display = ask_for_display(glfw_library, "glfwGetWaylandDisplay");
        if (!link->display) return;
        *(void **)&number = function_of(WAYLAND, "wl_display_get_fd");
        link->name = "Wayland";
        link->fd = number ? number(link->display) : -1;
        return;
    }
    *(void **)&number = function_of(X11, "XConnectionNumber");
    *(void **)&link->x_pending = function_of(X11, "XPending");
    link->name = "X11";
    link->fd = number && link->x_pending ? number(link->display) : -1;
    /* without a handler Xlib prints a message and exits when the server has ended */
    void (*set_exit)(void *display, void (*handler)(void *, void *), void *data);
    void *(*set)(int (*handler)(void *)), *(*set_error)(int (*handler)(void *, void *));
    *(void **)&set_exit = function_of(X11, "XSetIOErrorExitHandler");
    *(void **)&set = function_of(X11, "XSetIOErrorHandler");
    *(void **)&set_error = function_of(X11, "XSetErrorHandler");
    if (!set_exit || !set || !set_error) return;
    set_error(ignore_error); /* Xlib's own ends the program, too */
    only = link;
    set_exit(link->display, end_later, link);
    set(end_quietly);
}

bool gn_window_link_has_ended(struct gn_window_link *link) {
    gn_quiet_end(link->kept_stderr);
    link->kept_stderr = -1;
    return link->gone;
}

bool gn_window_link_pending(const struct gn_window_link *link) {
    return link->x_pending && !link->gone && link->x_pending(link->display) > 0;
}
