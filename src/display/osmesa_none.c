/* Replaces osmesa.c if its package was missing at build time. */
#include "display/private.h"

static bool fail_open(struct gn_display *display, struct gn_warnings *warnings,
                      struct gn_err *err) {
    (void)display, (void)warnings;
    return gn_fail(err, "not built in; install libosmesa6-dev and build again");
}

const struct gn_display_ops gn_display_osmesa = {
    .name = "osmesa",
    .what = "off-screen rendering by the CPU (not built in)",
    .desktop = true,
    .open = fail_open, /* a display that does not open needs none of the rest */
};
