#include "image/xserver.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/clock.h"

#define X11_TABLE(X)                                                                               \
    X(XOpenDisplay)                                                                                \
    X(XSetErrorHandler)                                                                            \
    X(XDefaultRootWindow)                                                                          \
    X(XQueryTree)                                                                                  \
    X(XFetchName)                                                                                  \
    X(XFree)                                                                                       \
    X(XGetWindowAttributes)                                                                        \
    X(XGetImage)                                                                                   \
    X(XResizeWindow)                                                                               \
    X(XCreateSimpleWindow)                                                                         \
    X(XMapRaised)                                                                                  \
    X(XDestroyWindow)                                                                              \
    X(XInternAtom)                                                                                 \
    X(XGetWindowProperty)                                                                          \
    X(XChangeProperty)                                                                             \
    X(XSetSelectionOwner)                                                                          \
    X(XCheckTypedEvent)                                                                            \
    X(XSendEvent)                                                                                  \
    X(XWarpPointer)                                                                                \
    X(XKeysymToKeycode)                                                                            \
    X(XSync)

struct gn_xserver {
    pid_t pid;
    Display *display;
    Window root;
    Time time; /* of the last event that was made up */
#define X(name) __typeof__(name) *name;
    X11_TABLE(X)
#undef X
};

static bool load(struct gn_xserver *x) {
    void *library = dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
#define X(name)                                                                                    \
    *(void **)&x->name = library ? dlsym(library, #name) : NULL;                                   \
    if (!x->name) return false;
    X11_TABLE(X)
#undef X
    return true;
}

/* It chooses a free number and tells it. */
static bool spawn(struct gn_xserver *x, char number[16]) {
    int tells[2];
    char size[40], fd[16];
    snprintf(size, sizeof size, "%dx%dx24", GN_XSERVER_WIDTH_PX, GN_XSERVER_HEIGHT_PX);
    if (pipe(tells) != 0) return false;
    snprintf(fd, sizeof fd, "%d", tells[1]);
    x->pid = fork();
    if (x->pid == 0) {
        const int nothing = open("/dev/null", O_RDWR);
        for (int i = 0; i < 3; i++) dup2(nothing, i);
        close(tells[0]);
        execlp("Xvfb", "Xvfb", "-displayfd", fd, "-screen", "0", size, "-nolisten", "tcp",
               (char *)NULL);
        _exit(127);
    }
    close(tells[1]);
    ssize_t length = 0, n = 0;
    while (length < 15 && (n = read(tells[0], number + length, (size_t)(15 - length))) > 0)
        length += n;
    close(tells[0]);
    number[length] = 0;
    number[strcspn(number, "\n")] = 0;
    return number[0];
}

static int ignore(Display *display, XErrorEvent *event) {
    (void)display, (void)event;
    return 0;
}

static bool open_display(struct gn_xserver *x, const char *number) {
    char name[20];
    snprintf(name, sizeof name, ":%s", number);
    setenv("DISPLAY", name, 1);
    unsetenv("WAYLAND_DISPLAY");
    x->XSetErrorHandler(ignore); /* a window may be gone by the time that it is asked */
    x->display = x->XOpenDisplay(name);
    if (x->display) x->root = x->XDefaultRootWindow(x->display);
    return x->display;
}

static struct gn_xserver *start(bool *missing, struct gn_err *err) {
    static struct gn_xserver one; /* a connection can only be closed while its server lives */
    struct gn_xserver *x = &one;
    *x = (struct gn_xserver){0};
    char number[16] = "";
    *missing = !load(x);
    if (*missing)
        gn_fail(err, "libX11.so.6 is missing; install libx11-6");
    else if (!spawn(x, number)) {
        int status = 0;
        waitpid(x->pid, &status, 0);
        *missing = WIFEXITED(status) && WEXITSTATUS(status) == 127;
        gn_fail(err, *missing ? "Xvfb is missing; install xvfb" : "Xvfb does not start");
        x->pid = 0;
    } else if (open_display(x, number))
        return x;
    else
        gn_fail(err, "Xvfb :%s cannot be reached", number);
    gn_xserver_stop(x);
    return NULL;
}

struct gn_xserver *gn_xserver_start(void) {
    struct gn_err err = {0};
    bool missing;
    struct gn_xserver *x = start(&missing, &err);
    if (x) return x;
    printf("the window is not tested: %s\n", err.text);
    exit(missing ? 77 : 1);
}

void gn_xserver_stop(struct gn_xserver *x) {
    if (!x) return;
    if (x->pid > 0) {
        kill(x->pid, SIGTERM);
        waitpid(x->pid, NULL, 0);
    }
    unsetenv("DISPLAY");
}

pid_t gn_xserver_pid(const struct gn_xserver *x) { return x->pid; }

/* ---- windows ---- */

static bool is_shown(struct gn_xserver *x, Window window, XWindowAttributes *a) {
    return x->XGetWindowAttributes(x->display, window, a) && a->map_state == IsViewable;
}

/* "gnomon", or "scene.glb - gnomon" */
static bool has_name(const char *own, const char *name) {
    const size_t length = strlen(own), end = strlen(name);
    return length >= end && strcmp(own + length - end, name) == 0;
}

static Window find(struct gn_xserver *x, const char *name) {
    Window root, parent, *all = NULL, found = 0;
    XWindowAttributes a;
    unsigned count = 0;
    if (!x->XQueryTree(x->display, x->root, &root, &parent, &all, &count)) return 0;
    for (unsigned i = 0; i < count && !found; i++) {
        char *own = NULL;
        x->XFetchName(x->display, all[i], &own);
        if (own && has_name(own, name) && is_shown(x, all[i], &a)) found = all[i];
        if (own) x->XFree(own);
    }
    if (all) x->XFree(all);
    return found;
}

gn_xwindow gn_xserver_find(struct gn_xserver *x, const char *name, int seconds) {
    const int64_t until_ns = gn_clock_monotonic_ns() + seconds * GN_NS_PER_S;
    Window window = 0;
    while ((window = find(x, name)) == 0 && gn_clock_monotonic_ns() < until_ns) usleep(20000);
    return window;
}

bool gn_xserver_grab(struct gn_xserver *x, gn_xwindow window, struct gn_picture *picture) {
    XWindowAttributes a;
    if (!is_shown(x, window, &a) || a.x < 0 || a.y < 0 || a.x + a.width > GN_XSERVER_WIDTH_PX ||
        a.y + a.height > GN_XSERVER_HEIGHT_PX)
        return false;
    XImage *image = x->XGetImage(x->display, window, 0, 0, (unsigned)a.width, (unsigned)a.height,
                                 AllPlanes, ZPixmap);
    if (!image) return false;
    gn_picture_init(picture, a.width, a.height, 3);
    for (int row = 0; row < a.height; row++)
        for (int column = 0; column < a.width; column++) {
            const unsigned long pixel = XGetPixel(image, column, row);
            float *to = gn_picture_at(picture, column, row);
            for (int k = 0; k < 3; k++) to[k] = (float)(pixel >> (16 - 8 * k) & 255) / 255.0f;
        }
    XDestroyImage(image);
    return true;
}

bool gn_xserver_title(struct gn_xserver *x, gn_xwindow window, char *out, size_t size) {
    char *own = NULL;
    const bool has = x->XFetchName(x->display, window, &own) && own;
    snprintf(out, size, "%s", has ? own : "");
    if (own) x->XFree(own);
    return has;
}

size_t gn_xserver_icon(struct gn_xserver *x, gn_xwindow window, unsigned long **out) {
    Atom type;
    int format;
    unsigned long count = 0, left;
    unsigned char *data = NULL;
    x->XGetWindowProperty(x->display, window, x->XInternAtom(x->display, "_NET_WM_ICON", False), 0,
                          1 << 20, False, XA_CARDINAL, &type, &format, &count, &left, &data);
    *out = calloc(count + 1, sizeof **out);
    if (data) memcpy(*out, data, count * sizeof **out);
    if (data) x->XFree(data);
    return count;
}

void gn_xserver_resize(struct gn_xserver *x, gn_xwindow window, int width_px, int height_px) {
    x->XResizeWindow(x->display, window, (unsigned)width_px, (unsigned)height_px);
    x->XSync(x->display, False);
}

void gn_xserver_cover(struct gn_xserver *x) {
    const Window over = x->XCreateSimpleWindow(x->display, x->root, 0, 0, GN_XSERVER_WIDTH_PX,
                                               GN_XSERVER_HEIGHT_PX, 0, 0, 0xff00ff);
    x->XMapRaised(x->display, over);
    x->XSync(x->display, False);
    usleep(100000);
    x->XDestroyWindow(x->display, over);
    x->XSync(x->display, False);
}

/* ---- the hand ---- */

void gn_xserver_close(struct gn_xserver *x, gn_xwindow window) {
    XEvent event = {.xclient = {.type = ClientMessage, .window = window, .format = 32}};
    event.xclient.message_type = x->XInternAtom(x->display, "WM_PROTOCOLS", False);
    event.xclient.data.l[0] = (long)x->XInternAtom(x->display, "WM_DELETE_WINDOW", False);
    x->XSendEvent(x->display, window, False, 0, &event);
    x->XSync(x->display, False);
}

void gn_xserver_key(struct gn_xserver *x, gn_xwindow window, unsigned long keysym) {
    XEvent event = {.xkey = {.display = x->display,
                             .window = window,
                             .root = x->root,
                             .same_screen = True,
                             .keycode = x->XKeysymToKeycode(x->display, keysym)}};
    for (int type = KeyPress; type <= KeyRelease; type++) {
        event.type = type;
        event.xkey.time = x->time += 100;
        x->XSendEvent(x->display, window, True, type == KeyPress ? KeyPressMask : KeyReleaseMask,
                      &event);
    }
    x->XSync(x->display, False);
}

static void move_to(struct gn_xserver *x, Window window, int column, int row) {
    x->XWarpPointer(x->display, None, window, 0, 0, 0, 0, column, row);
    x->XSync(x->display, False);
}

static void press(struct gn_xserver *x, Window window, unsigned button, int type) {
    XEvent event = {.xbutton = {.type = type,
                                .display = x->display,
                                .window = window,
                                .root = x->root,
                                .same_screen = True,
                                .time = x->time += 100,
                                .button = button}};
    x->XSendEvent(x->display, window, True,
                  type == ButtonPress ? ButtonPressMask : ButtonReleaseMask, &event);
    x->XSync(x->display, False);
}

void gn_xserver_drag(struct gn_xserver *x, gn_xwindow window, unsigned button, int right_px,
                     int down_px) {
    XWindowAttributes a;
    if (!is_shown(x, window, &a)) return;
    const int column = a.width / 2, row = a.height / 2;
    move_to(x, window, column, row);
    press(x, window, button, ButtonPress);
    move_to(x, window, column + right_px / 2, row + down_px / 2);
    move_to(x, window, column + right_px, row + down_px);
    press(x, window, button, ButtonRelease);
}

/* ---- drag and drop (XDND) ---- */

static void send_drop(struct gn_xserver *x, Window from, Window to, const char *kind,
                      const long data[4]) {
    XEvent event = {.xclient = {.type = ClientMessage, .window = to, .format = 32}};
    event.xclient.message_type = x->XInternAtom(x->display, kind, False);
    event.xclient.data.l[0] = (long)from;
    for (int i = 0; i < 4; i++) event.xclient.data.l[1 + i] = data[i];
    x->XSendEvent(x->display, to, False, 0, &event);
    x->XSync(x->display, False);
}

/* The window asks for what is dropped: tells it. */
static bool answer_request(struct gn_xserver *x, const char *text) {
    XEvent event;
    if (!x->XCheckTypedEvent(x->display, SelectionRequest, &event)) return false;
    const XSelectionRequestEvent *r = &event.xselectionrequest;
    x->XChangeProperty(x->display, r->requestor, r->property, r->target, 8, PropModeReplace,
                       (const unsigned char *)text, (int)strlen(text));
    XEvent reply = {.xselection = {.type = SelectionNotify,
                                   .requestor = r->requestor,
                                   .selection = r->selection,
                                   .target = r->target,
                                   .property = r->property,
                                   .time = r->time}};
    x->XSendEvent(x->display, r->requestor, False, 0, &reply);
    x->XSync(x->display, False);
    return true;
}

bool gn_xserver_drop(struct gn_xserver *x, gn_xwindow window, const char *path) {
    const Window from = x->XCreateSimpleWindow(x->display, x->root, 0, 0, 1, 1, 0, 0, 0);
    const long uris = (long)x->XInternAtom(x->display, "text/uri-list", False),
               copy = (long)x->XInternAtom(x->display, "XdndActionCopy", False);
    char text[600];
    bool asked = false;
    snprintf(text, sizeof text, "file://%s\r\n", path);
    x->XSetSelectionOwner(x->display, x->XInternAtom(x->display, "XdndSelection", False), from,
                          CurrentTime);
    send_drop(x, from, window, "XdndEnter", (const long[4]){5l << 24, uris, 0, 0});
    send_drop(x, from, window, "XdndPosition", (const long[4]){0, 10 << 16 | 10, 0, copy});
    send_drop(x, from, window, "XdndDrop", (const long[4]){0, 0, 0, 0});
    for (int i = 0; i < 500 && !asked; i++) {
        asked = answer_request(x, text);
        usleep(10000);
    }
    x->XDestroyWindow(x->display, from);
    x->XSync(x->display, False);
    return asked;
}
