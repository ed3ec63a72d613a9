/* Keys from the controlling terminal. Line editing and echo are off while in the foreground;
 * signals work as usual. Settings are restored on Ctrl-Z and at the end, also after a crash. In the
 * background, and at end of file, the terminal is not read. At most one per process, since signals
 * are per process. */
#ifndef GN_INPUT_TERMINAL_H
#define GN_INPUT_TERMINAL_H

#include <stdbool.h>

#include "core/loop.h"
#include "input/terminal_keys.h"

struct gn_terminal {
    int fd;      /* borrowed */
    int wake_fd; /* becomes readable after SIGCONT */
    struct gn_loop *loop;
    struct gn_timer *timer;      /* armed when a descriptor becomes readable */
    struct gn_watch watch, wake; /* of fd and wake_fd */
    bool readable, resumed;      /* of fd and wake_fd; not cleared yet */
    bool reading;                /* fd is watched */
    struct gn_terminal_keys keys;
};

/* Restores the terminal, for handlers that call _exit(). Async-signal-safe. */
void gn_terminal_leave(void);

#endif
