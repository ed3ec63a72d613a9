/* The control socket in the file system: where it is, who made it, and who may come in. */
#ifndef GN_KIOSK_CONTROL_LISTEN_H
#define GN_KIOSK_CONTROL_LISTEN_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

#include "core/err.h"

#define GN_LISTEN_PATH_MAX 108 /* with the ending zero: the kernel's bound */

struct gn_listen { /* descriptors -1: none */
    int fd, lock;
    char path[GN_LISTEN_PATH_MAX];
    dev_t device; /* of the socket's file, so that no other one is taken away */
    ino_t inode;
    uid_t uid; /* the kiosk's */
    gid_t gid; /* of the socket's file */
};

/* Where a kiosk makes its socket if nobody says: /run/gnomon/ctl where that folder may be written
 * to, else $XDG_RUNTIME_DIR/gnomon/ctl. False: neither is there. */
bool gn_listen_default(char *path, size_t size);
/* Where to look for one that somebody else made: index 0, 1, ..; false: there are no more. */
bool gn_listen_candidate(int index, char *path, size_t size);

/* Makes the socket, of mode 0660, and a lock beside it (".lock"). What a dead process has left is
 * replaced; a living one's, and what is no socket, is left alone and a failure. The last folder of
 * the path is made, of mode 0700, if it alone is missing. */
bool gn_listen_open(struct gn_listen *listen, const char *path, struct gn_err *err);
/* Takes both away, if they are still ours. */
void gn_listen_close(struct gn_listen *listen);

/* May whoever is at the other end ask? The kiosk's own user, root, and members of the socket's
 * group; *uid gets who it is. */
bool gn_listen_permits(const struct gn_listen *listen, int fd, uid_t *uid);

#endif
