/* A process opens files for another one that has no right to: the other names a file, and gets the
 * open descriptor (SCM_RIGHTS). Both are connected by a socketpair of AF_UNIX, SOCK_SEQPACKET. */
#ifndef GN_CORE_OPENER_H
#define GN_CORE_OPENER_H

#include <sys/types.h>

#include "core/err.h"

struct gn_opener {
    int socket;         /* the end that requests come from */
    const char *folder; /* of its files and those below regular ones are opened, for reading; see
                           gn_open_beneath() */
    const char *file;   /* so is this one, wherever it lies; its name is "" */
};

/* Answers one request, if one waits. Trusts nothing that comes. Never waits for the other process,
 * except for the file system. */
void gn_opener_serve(const struct gn_opener *opener);

/* In the other process: the descriptor of that file, or -1 with the reason. Waits. Needs no system
 * calls but write() and recvmsg(). */
int gn_opener_ask(int socket, const char *name, struct gn_err *err);

/* As send(), with a descriptor beside the first byte; -1: without one. */
ssize_t gn_send_with(int socket, const void *data, size_t size, int fd, int flags);

#endif
