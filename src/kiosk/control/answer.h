/* The answers to requests, whoever brings them: actions, options, status, screenshots. */
#ifndef GN_KIOSK_CONTROL_ANSWER_H
#define GN_KIOSK_CONTROL_ANSWER_H

#include "kiosk/control/request.h"

struct gn_show;

/* What brings requests: a part of the kiosk with a row of its own (socket.c). Each request is
 * answered once, perhaps later, and lives until then. A reply is a reference that is taken; it has
 * an "ok" only where that is false (gn_reply_failure()). NULL: there was no memory for it. */
struct gn_transport {
    void *self;
    void (*answer)(void *self, const struct gn_request *request, json_t *reply);
};

void gn_show_take_request(struct gn_show *show, const struct gn_transport *from,
                          const struct gn_request *request);
/* Its requests that wait are gone; they get no answer any more. */
void gn_show_forget_requests(struct gn_show *show, const struct gn_transport *from);

/* Answers the request for a reload; why not NULL: it failed, and nothing has changed,
 * unless the old scene was gone already: then the kiosk ends. */
void gn_show_answer_reload(struct gn_show *show, const struct gn_err *why);

#endif
