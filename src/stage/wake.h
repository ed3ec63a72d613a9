/* Opening a display wakes up a driver: what libraries print meanwhile is not heard, unless -v asks
 * for it, and a driver that crashes ends the program with one line like any other failure. */
#ifndef GN_STAGE_WAKE_H
#define GN_STAGE_WAKE_H

#include <signal.h>

#include "core/warn.h"
#include "display/display.h"
#include "options/settings.h"

enum { GN_WAKE_CRASHES = 5 };
struct gn_wake { /* zeroed is ready */
    int kept;    /* the descriptor that stderr had; -1: left as it is */
    struct sigaction old[GN_WAKE_CRASHES];
};
/* Around whatever wakes a driver. */
void gn_wake_begin(struct gn_wake *wake, const struct gn_settings *settings);
void gn_wake_end(struct gn_wake *wake);

/* gn_display_open() of --backend. */
bool gn_wake_display(struct gn_display *display, const struct gn_settings *settings,
                     struct gn_warnings *warnings, struct gn_err *err);

#endif
