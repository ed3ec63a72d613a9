/* GLFW's connection to the window system, X11 or Wayland, of which GLFW exposes no descriptor. */
#ifndef GN_DISPLAY_WINDOW_LINK_H
#define GN_DISPLAY_WINDOW_LINK_H

#include <stdbool.h>

struct gn_window_link {
    const char *name; /* "X11", "Wayland"; "" if neither */
    void *display;    /* Display or wl_display */
    int fd;           /* borrowed; readable when events have arrived; -1: unknown, poll */
    int (*x_pending)(void *display);
    bool gone;       /* the X server has ended */
    int kept_stderr; /* the real stderr, while Xlib's messages about that are suppressed */
};

/* For an initialised GLFW. The link must not move until the connection is closed: Xlib's error
 * handlers write to it instead of ending the program. */
void gn_window_link_open(struct gn_window_link *link, void *glfw_library);
/* Whether the X server has ended; restores stderr. */
bool gn_window_link_has_ended(struct gn_window_link *link);
/* Whether events were read from the descriptor but not dispatched. */
bool gn_window_link_pending(const struct gn_window_link *link);

#endif
