/* What the supervisor is told (sd_notify(3)): a datagram each, to $NOTIFY_SOCKET. READY=1 with the
 * first flip that has completed, or when it is known what is waited for; WATCHDOG=1, every half of
 * $WATCHDOG_USEC, only if a flip has completed since the last one, or the screen sleeps: it was
 * switched off, or waits for a card, a monitor, a console. So whatever hangs - a flip, the GPU, the
 * loop - ends with a restart, and a picture that is still is drawn once more to prove that it can
 * be. Without $NOTIFY_SOCKET all of it does nothing. */
#ifndef GN_KIOSK_SERVICE_H
#define GN_KIOSK_SERVICE_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/socket.h>
#include <sys/un.h>

#include "core/loop.h"
#include "display/display.h"

struct gn_service {
    int socket;            /* -1: nobody listens */
    struct gn_timer timer; /* ends the wait when step is due; added only with a watchdog */
    int64_t every_ns;      /* half of the watchdog's patience; 0: no watchdog */
    int64_t next_ns;
    uint64_t shown; /* flips that had completed when it was fed last */
    bool ready;
    char status[160]; /* told last */
    struct sockaddr_un to;
    socklen_t to_length;
};

/* Takes both variables out of the environment: they are not for programs that this one starts. */
bool gn_service_open(struct gn_service *service, struct gn_loop *loop, int64_t now_ns,
                     struct gn_err *err);
/* To be called after the screen was dispatched. True: a frame is wanted, so that one completes. */
bool gn_service_step(struct gn_service *service, const struct gn_screen *screen, int64_t now_ns);
void gn_service_close(struct gn_service *service); /* STOPPING=1; legal when not open */

#endif
