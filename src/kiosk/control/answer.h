/* What a running kiosk answers over its control socket: actions, options, its state, screenshots.
 */
#ifndef GN_KIOSK_CONTROL_ANSWER_H
#define GN_KIOSK_CONTROL_ANSWER_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"

struct gn_show;
struct gn_show_control;

/* Makes the socket that the options name, or the usual one, and watches it. Without one the kiosk
 * runs all the same: a warning says why, if anybody asked for one. A kiosk in a window has none
 * unless it was asked for. */
void gn_show_open_control(struct gn_show *show);
void gn_show_close_control(struct gn_show *show);

/* Answers the requests that have come, a bounded number. */
void gn_show_answer_requests(struct gn_show *show);
/* Options that were set are shown once their programs are there; to be called after any work. */
void gn_show_enter_changed(struct gn_show *show);
/* A reload that was asked for is done; why: it is not, and everything is as it was. */
void gn_show_answer_reload(struct gn_show *show, const struct gn_err *why);

#endif
