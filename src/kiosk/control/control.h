/* The server of the control socket: a request is a line with a JSON object, and each gets one line
 * as a reply, in order. The owner of the kiosk takes the requests and answers them. Nothing here
 * blocks, and a step of the loop does a bounded amount of work, so that no frame waits for it: the
 * rest waits for the next step, and what exceeds the limits is answered with the error "busy". Each
 * request is answered, except when a client does not read for 5 s: it is cut off. */
#ifndef GN_KIOSK_CONTROL_CONTROL_H
#define GN_KIOSK_CONTROL_CONTROL_H

#include <stdint.h>

#include "core/loop.h"
#include "kiosk/control/request.h"

enum {
    GN_CONTROL_CLIENTS_MAX = 64, /* another one replaces a client that was silent for 30 s, else it
                                    gets "busy" and is closed */
    GN_CONTROL_USER_MAX = 16,    /* of these for a user other than root and the kiosk's */
    GN_CONTROL_KEPT = 8,         /* of these for root and the kiosk's user */
    GN_CONTROL_PER_STEP = 16,    /* lines handled, or pieces of 4 KiB discarded */
    GN_CONTROL_CHANGES_PER_S = 20, /* commands that may cost a frame, with a burst of 20; more are
                                      "busy". Of root and the kiosk's user; and as many of all
                                      others together */
};

struct gn_control_counts {
    uint64_t accepted, refused; /* clients; refused: not permitted, or too many */
    uint64_t requests, wrong, busy, answered;
    uint64_t cut; /* clients closed because they did not read */
};

struct gn_control;
/* Makes the socket; see gn_listen_open(). From now on the loop serves clients. NULL: the kiosk runs
 * without, and err says why. */
struct gn_control *gn_control_open(const char *path, struct gn_loop *loop, struct gn_err *err);
void gn_control_close(struct gn_control *control); /* NULL is legal */
struct gn_control_counts gn_control_counts(const struct gn_control *control);

/* The next request, or NULL; to be called after each step of the loop until it is. It lives until
 * it is answered, which may be later; until then its client's other requests wait. */
const struct gn_request *gn_control_next(struct gn_control *control);
/* Takes the reference; "ok": true is added unless it has an "ok". The client may be gone by then.
 */
void gn_control_answer(struct gn_control *control, const struct gn_request *request, json_t *reply);

#endif
