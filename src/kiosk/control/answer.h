/* The answers to requests over the control socket: actions, options, status, screenshots. */
#ifndef GN_KIOSK_CONTROL_ANSWER_H
#define GN_KIOSK_CONTROL_ANSWER_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"

struct gn_show;
struct gn_show_control;

/* Opens the socket of --socket, or the default one; a kiosk in a window has no default one. If that
 * fails the kiosk runs without, and a warning says why. */
void gn_show_open_control(struct gn_show *show);
void gn_show_close_control(struct gn_show *show);

/* Answers the requests that have come, a bounded number. */
void gn_show_answer_requests(struct gn_show *show);
/* Answers the request for a reload; why not NULL: it failed, and nothing has changed. */
void gn_show_answer_reload(struct gn_show *show, const struct gn_err *why);

#endif
