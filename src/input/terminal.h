/* Keys from the terminal that the program was started in. Its line editing and echo are off while
 * we are in its foreground, signals work as ever; on Ctrl-Z, and at the end, which may be a crash,
 * it is as it was. In the background it is left alone: it is not ours. Its end is not ours either:
 * it is just not read any more. There is at most one in a process, since signals are the process's.
 */
#ifndef GN_INPUT_TERMINAL_H
#define GN_INPUT_TERMINAL_H

#include <stdbool.h>
#include <stdint.h>

#include "core/loop.h"
#include "input/terminal_keys.h"

struct gn_terminal { /* fd -1: there is none */
    int fd;          /* not ours to close */
    int wake_fd;     /* readable after we have been continued */
    struct gn_loop *loop;
    struct gn_timer *timer;      /* made due by what is readable */
    struct gn_watch watch, wake; /* of fd and wake_fd */
    bool readable, resumed;      /* fd, wake_fd, since that was cleared */
    bool reading;                /* fd is watched */
    struct gn_terminal_keys keys;
};

/* Takes fd if it is a terminal; false: it is none, or another one is open. What is readable is
 * noted, and makes the timer due. */
bool gn_terminal_open(struct gn_terminal *terminal, int fd, struct gn_loop *loop,
                      struct gn_timer *timer);
void gn_terminal_close(struct gn_terminal *terminal);
/* For handlers that call _exit(): if there is a terminal, it is as it was. Async-signal-safe. */
void gn_terminal_leave(void);
/* What can be read now, at most size bytes; 0: nothing, for now or for ever. Never blocks. */
int gn_terminal_read(struct gn_terminal *terminal, uint8_t *out, int size);
/* We have been continued: perhaps in the foreground. */
void gn_terminal_resume(struct gn_terminal *terminal);

#endif
