/* The systemd protocol (sd_notify(3)): a datagram each, to $NOTIFY_SOCKET. READY=1 with the
 * first step, before the first frame: however long that takes, it is the watchdog's. WATCHDOG=1
 * every quarter of $WATCHDOG_USEC, only if a flip has completed since the last one or the screen
 * sleeps: it is switched off, or waits for a card, a monitor or a console. So a flip, GPU or loop
 * that hangs ends with a restart, and a still picture is drawn again in time to feed the watchdog.
 * In place of a flip a further piece of a long frame will do.
 * Without $NOTIFY_SOCKET nothing of that is done.
 *
 * Where there is a supervisor, or stderr is systemd's journal ($JOURNAL_STREAM), a line on stderr
 * says what the screen waits for when it begins to wait, and what it shows with the first picture
 * at the start and after each wait. A terminal gets the same lines, but none about a picture that
 * comes without a wait. */
#ifndef GN_KIOSK_SERVICE_H
#define GN_KIOSK_SERVICE_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/socket.h>
#include <sys/un.h>

#include "core/loop.h"
#include "display/display.h"

struct gn_service {
    int socket;            /* -1: no $NOTIFY_SOCKET */
    struct gn_timer timer; /* ends the wait when step is due; added only with a watchdog */
    int64_t every_ns;      /* a quarter of the watchdog's timeout; 0: no watchdog */
    int64_t next_ns;
    uint64_t shown;  /* completed flips when it was fed last */
    uint64_t pieces; /* of frames, likewise */
    bool ready;
    char status[160]; /* sent last */
    bool logs;        /* lines on stderr */
    bool shows;       /* the last line was about a picture */
    char waits[160];  /* the last line otherwise */
    uint64_t waited;  /* completed flips then */
    struct sockaddr_un to;
    socklen_t to_length;
};

/* Removes both variables from the environment: child processes must not see them. */
bool gn_service_open(struct gn_service *service, struct gn_loop *loop, int64_t now_ns,
                     struct gn_err *err);
/* To be called after gn_display_dispatch(). True: draw a frame, so that a flip completes. */
bool gn_service_step(struct gn_service *service, const struct gn_screen *screen, int64_t now_ns);
/* While a frame is drawn: feeds the watchdog in time, if the GPU has drawn further pieces. */
void gn_service_pause(struct gn_service *service, uint64_t pieces, int64_t now_ns);
void gn_service_close(struct gn_service *service); /* sends STOPPING=1; legal when not open */

#endif
