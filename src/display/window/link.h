/* The connection of a window to its window system, X11 or Wayland: GLFW made it, and knows no
 * descriptor to wait for. */
#ifndef GN_DISPLAY_WINDOW_LINK_H
#define GN_DISPLAY_WINDOW_LINK_H

#include <stdbool.h>

struct gn_window_link {
    const char *name; /* "X11", "Wayland"; "" where it is neither */
    void *display;    /* Display or wl_display */
    int fd;           /* theirs; readable when events have come; -1: unknown, to be polled */
    int (*x_pending)(void *display);
    bool gone;       /* the X server has ended */
    int kept_stderr; /* from then on, until that is asked: what Xlib says of it is not heard */
};

/* Of a library of GLFW that is initialised. The link must stay where it is until the connection is
 * closed: an X server that ends is told there, where Xlib would end the program. */
void gn_window_link_open(struct gn_window_link *link, void *glfw_library);
/* The X server has ended; from now on stderr is heard again. */
bool gn_window_link_has_ended(struct gn_window_link *link);
/* Are there events that have been read from the descriptor, but by nobody yet? */
bool gn_window_link_pending(const struct gn_window_link *link);

#endif
