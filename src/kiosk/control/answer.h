/* The answers to requests over the control socket: actions, options, status, screenshots. */
#ifndef GN_KIOSK_CONTROL_ANSWER_H
#define GN_KIOSK_CONTROL_ANSWER_H

#include <stdbool.h>

#include "core/err.h"

struct gn_show;
struct gn_show_control;

/* Answers the request for a reload; why not NULL: it failed, and nothing has changed. */
void gn_show_answer_reload(struct gn_show *show, const struct gn_err *why);

#endif
