/* Keys from the terminal that the program was started in. Its line editing and echo are off while
 * we are in its foreground, signals work as ever; on Ctrl-Z, and at the end, which may be a crash,
 * it is as it was. In the background it is left alone: it is not ours. Its end is not ours either:
 * it is just not read any more. There is at most one in a process, since signals are the process's.
 */
#ifndef GN_INPUT_TERMINAL_H
#define GN_INPUT_TERMINAL_H

#include <stdbool.h>
#include <stdint.h>

#include "input/terminal_keys.h"

struct gn_terminal { /* fd -1: there is none */
    int fd;          /* not ours to close */
    int wake_fd;     /* readable after we have been continued */
    int epoll;
    uint64_t tag; /* of fd in the epoll; tag + 1: of wake_fd */
    bool reading; /* fd is in the epoll */
    struct gn_terminal_keys keys;
};

/* Takes fd if it is a terminal; false: it is none, or another one is open. */
bool gn_terminal_open(struct gn_terminal *terminal, int fd, int epoll, uint64_t tag);
void gn_terminal_close(struct gn_terminal *terminal);
/* For handlers that call _exit(): if there is a terminal, it is as it was. Async-signal-safe. */
void gn_terminal_leave(void);
/* What can be read now, at most size bytes; 0: nothing, for now or for ever. Never blocks. */
int gn_terminal_read(struct gn_terminal *terminal, uint8_t *out, int size);
/* We have been continued: perhaps in the foreground. */
void gn_terminal_resume(struct gn_terminal *terminal);

#endif
