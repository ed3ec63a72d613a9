/* Descriptors that clients pass over the socket (SCM_RIGHTS). */
#ifndef GN_KIOSK_CONTROL_PASSED_H
#define GN_KIOSK_CONTROL_PASSED_H

#include <sys/types.h>

/* As recv(), without blocking. *passed becomes a memory file (memfd_create) that came with the
 * bytes, which is the caller's to close, or -1. Other descriptors are closed in a thread: to close
 * a file of a user's own file system (FUSE) waits for that user's program. */
ssize_t gn_passed_receive(int socket, void *to, size_t room, int *passed);
/* Closes a memory file; a large one in a thread, too, since the kernel frees its memory meanwhile.
 */
void gn_passed_close(int fd);
/* Closes a client's socket; in a thread if messages wait in it, with whatever descriptors. */
void gn_passed_close_socket(int socket);

#endif
