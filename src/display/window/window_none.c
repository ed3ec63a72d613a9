/* Replaces window.c if its package was missing at build time. */
#include "display/private.h"

static bool fail_open(struct gn_display *display, struct gn_warnings *warnings,
                      struct gn_err *err) {
    (void)display, (void)warnings;
    return gn_fail(err, "not built in; install libglfw3-dev and build again");
}

const struct gn_display_ops gn_display_window = {
    .name = "window",
    .is_window = true,
    .what = "a window on a desktop (not built in)",
    .open = fail_open, /* a display that does not open needs none of the rest */
};
