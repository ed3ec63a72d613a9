/* Opening a display wakes up a driver: what libraries print meanwhile is not heard, unless -v asks
 * for it, and a driver that crashes ends the program with one line like any other failure. */
#ifndef GN_CLI_WAKE_H
#define GN_CLI_WAKE_H

#include "cli/options.h"
#include "core/warn.h"
#include "display/display.h"

/* gn_display_open() of --backend. */
bool gn_wake_display(struct gn_display *display, const struct gn_options *options,
                     struct gn_warnings *warnings, struct gn_err *err);

#endif
