/* Keys from the controlling terminal. Line editing and echo are off while in the foreground;
 * signals work as usual. Settings are restored on Ctrl-Z and at the end, also after a crash. In the
 * background, and at end of file, the terminal is not read. At most one per process, since signals
 * are per process. */
#ifndef GN_INPUT_TERMINAL_H
#define GN_INPUT_TERMINAL_H

#include <stdbool.h>
#include <stdint.h>

#include "core/loop.h"
#include "input/terminal_keys.h"

struct gn_terminal { /* fd -1: none */
    int fd;          /* borrowed */
    int wake_fd;     /* becomes readable after SIGCONT */
    struct gn_loop *loop;
    struct gn_timer *timer;      /* armed when a descriptor becomes readable */
    struct gn_watch watch, wake; /* of fd and wake_fd */
    bool readable, resumed;      /* of fd and wake_fd; not cleared yet */
    bool reading;                /* fd is watched */
    struct gn_terminal_keys keys;
};

/* Uses fd if it is a terminal; false if it is not, or another one is open. A readable descriptor is
 * noted and arms the timer. */
bool gn_terminal_open(struct gn_terminal *terminal, int fd, struct gn_loop *loop,
                      struct gn_timer *timer);
void gn_terminal_close(struct gn_terminal *terminal);
/* Restores the terminal, for handlers that call _exit(). Async-signal-safe. */
void gn_terminal_leave(void);
/* Reads at most size bytes; 0: nothing now, or end of file. Never blocks. */
int gn_terminal_read(struct gn_terminal *terminal, uint8_t *out, int size);
/* SIGCONT arrived: we may be in the foreground. */
void gn_terminal_resume(struct gn_terminal *terminal);

#endif
