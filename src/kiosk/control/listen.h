/* The control socket in the file system: its path, lock and permissions. */
#ifndef GN_KIOSK_CONTROL_LISTEN_H
#define GN_KIOSK_CONTROL_LISTEN_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "core/err.h"

#define GN_LISTEN_PATH_MAX 108 /* with the terminating zero: the kernel's limit */

struct gn_listen { /* descriptors -1: none */
    int fd, lock;
    char path[GN_LISTEN_PATH_MAX];
    dev_t device; /* of the socket's file, so that no other file is removed */
    ino_t inode;
    uid_t uid; /* the kiosk's */
    gid_t gid; /* of the socket's file */
};

/* The default path: /run/gnomon/ctl if that folder is writable, else $XDG_RUNTIME_DIR/gnomon/ctl.
 * False: neither exists. */
bool gn_listen_default(char *path, size_t size);
/* Paths where a client looks for a kiosk: index 0, 1, ..; false: no more. */
bool gn_listen_candidate(int index, char *path, size_t size);

/* Makes the socket with mode 0660 and a lock file beside it (".lock"). The socket of a dead process
 * is replaced; fails if a process listens on it or the path is not a socket. Makes the last folder
 * of the path, with mode 0700, if only that is missing. */
bool gn_listen_open(struct gn_listen *listen, const char *path, struct gn_err *err);
/* Could gn_listen_open() make it, as far as names tell? Opens and makes nothing. */
bool gn_listen_check(const char *path, struct gn_err *err);
/* Removes both files, if they are still ours. */
void gn_listen_close(struct gn_listen *listen);

bool gn_listen_is_owner(const struct gn_listen *listen, uid_t uid); /* the kiosk's user, or root */
/* Is the peer permitted: the kiosk's user, root, or a member of the socket's group? *uid is the
 * peer's. */
bool gn_listen_permits(const struct gn_listen *listen, int fd, uid_t *uid);

#endif
