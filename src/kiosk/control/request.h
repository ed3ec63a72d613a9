/* A request over the control socket: a line with one JSON object, parsed strictly. */
#ifndef GN_KIOSK_CONTROL_REQUEST_H
#define GN_KIOSK_CONTROL_REQUEST_H

#include <jansson.h>

#include "core/err.h"
#include "options/command.h"

#define GN_REQUEST_LINE_MAX  4096 /* bytes, without the newline */
#define GN_REQUEST_DEPTH_MAX 4    /* brackets in brackets */

struct gn_request {
    enum gn_ctl command;
    const char *words[GN_CTL_WORDS_MAX]; /* as gn_ctl_rows has them, else NULL; in text */
    int fd; /* passed along with it, for commands with GN_CTL_FILE; -1: none. The server's */
    char text[GN_REQUEST_LINE_MAX + 64];
};

/* {"cmd":"set","key":"exposure","value":-2}: strings, for "value" also a number or a boolean. One
 * in brackets may be left out. Not an object, a duplicate, unknown or missing member, or bad UTF-8
 * is a usage error. The words point into out->text. */
bool gn_request_parse(const char *line, size_t length, struct gn_request *out, struct gn_err *err);

/* Replies, new references. Bytes that are not UTF-8 become "?". */
json_t *gn_reply_text(const char *text);
json_t *gn_reply_failure(const struct gn_err *err); /* {"ok":false,"error":..,"status":1 or 2} */

#endif
