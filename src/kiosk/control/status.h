/* The state of a kiosk as JSON, for `gnomon ctl status`. */
#ifndef GN_KIOSK_CONTROL_STATUS_H
#define GN_KIOSK_CONTROL_STATUS_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "kiosk/control/control.h"

struct gn_show;

struct gn_show_status {
    int64_t memory_ns; /* when memory_mb was read; at most once a second */
    double memory_mb;
};

/* New references: the full status; the part that actions change. */
json_t *gn_show_status_make(const struct gn_show *show, struct gn_show_status *status,
                            struct gn_control_counts counts);
json_t *gn_show_status_short(const struct gn_show *show);

#endif
