/* The kiosk: `gnomon show` while it runs. */
#ifndef GN_KIOSK_SHOW_H
#define GN_KIOSK_SHOW_H

#include <stdbool.h>

#include "core/warn.h"
#include "options/options.h"

/* The display for gn_show_run(), instead of the options' one. */
struct gn_show_place {
    const char *backend; /* as in --backend; must outlive the call */
    bool opened;         /* set when the display has opened: a failure came later */
};
/* Runs the kiosk from start to end. place NULL: the options' display. */
bool gn_show_run(const struct gn_options *options, struct gn_show_place *place,
                 struct gn_warnings *warnings, struct gn_err *err);

#endif
