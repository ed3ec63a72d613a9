/* Opening a display starts a driver. Meanwhile output of libraries to stderr is discarded, except
 * with -v, and a crash of the driver ends the program with one line like any other failure. */
#ifndef GN_STAGE_WAKE_H
#define GN_STAGE_WAKE_H

#include <signal.h>

#include "core/warn.h"
#include "display/display.h"
#include "options/settings.h"

enum { GN_WAKE_CRASHES = 5 };
struct gn_wake { /* zeroed is ready */
    int kept;    /* a duplicate of stderr; -1: stderr is unchanged */
    struct sigaction old[GN_WAKE_CRASHES];
    struct gn_err no_cache; /* why the driver's cache was switched off; "": it was not */
};
/* Around code that starts a driver. */
void gn_wake_begin(struct gn_wake *wake, const struct gn_settings *settings);
void gn_wake_end(struct gn_wake *wake);

/* gn_display_open() of --backend. */
bool gn_wake_display(struct gn_display *display, const struct gn_settings *settings,
                     struct gn_warnings *warnings, struct gn_err *err);

#endif
