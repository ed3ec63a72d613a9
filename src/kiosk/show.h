/* The kiosk: `gnomon show` while it runs. */
#ifndef GN_KIOSK_SHOW_H
#define GN_KIOSK_SHOW_H

#include <stdbool.h>

#include "core/warn.h"
#include "options/options.h"

/* Where gn_show_run() runs, whatever the options say. */
struct gn_show_place {
    const char *backend; /* as in --backend; must outlive the call */
    bool opened;         /* the display did open: what failed failed later */
};
/* The kiosk from its start to its end. place NULL: as the options say. */
bool gn_show_run(const struct gn_options *options, struct gn_show_place *place,
                 struct gn_warnings *warnings, struct gn_err *err);

#endif
