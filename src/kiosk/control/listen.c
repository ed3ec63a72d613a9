#include "kiosk/control/listen.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#ifndef SO_PEERGROUPS
#define SO_PEERGROUPS 59 /* Linux 4.13; asm-generic/socket.h */
#endif

#define SYSTEM_FOLDER "/run/gnomon"
enum { GROUPS_MAX = 1024, BACKLOG = 64 };

/* ---- paths that cannot be ------------------------------------------------------------------- */

static bool check_length(const char *path, struct gn_err *err) {
    return strlen(path) < GN_LISTEN_PATH_MAX ||
           gn_fail(err, "control socket %.200s: longer than %d bytes", path,
                   GN_LISTEN_PATH_MAX - 1);
}

static bool fail_kind(const char *path, struct gn_err *err) {
    return gn_fail(err, "control socket %s: path exists and is not a socket; not replacing it",
                   path);
}

bool gn_listen_check(const char *path, struct gn_err *err) {
    char folder[GN_LISTEN_PATH_MAX];
    struct stat info;
    if (!check_length(path, err)) return false;
    if (lstat(path, &info) == 0) return S_ISSOCK(info.st_mode) || fail_kind(path, err);
    snprintf(folder, sizeof folder, "%s", path);
    for (int level = 0; level < 2; level++) { /* the last folder is made */
        char *slash = strrchr(folder, '/');
        if (!slash || slash == folder) return true;
        *slash = '\0';
        if (stat(folder, &info) != 0) continue;
        return S_ISDIR(info.st_mode) ||
               gn_fail(err, "control socket %s: %s is not a folder", path, folder);
    }
    return gn_fail(err, "control socket %s: there is no folder %s", path, folder);
}

/* ---- where ---------------------------------------------------------------------------------- */

static bool user_path(char *path, size_t size) {
    const char *folder = getenv("XDG_RUNTIME_DIR");
    return folder && folder[0] == '/' && snprintf(path, size, "%s/gnomon/ctl", folder) < (int)size;
}

bool gn_listen_default(char *path, size_t size) {
    if (access(SYSTEM_FOLDER, W_OK | X_OK) != 0) return user_path(path, size);
    snprintf(path, size, "%s/ctl", SYSTEM_FOLDER);
    return true;
}

bool gn_listen_candidate(int index, char *path, size_t size) {
    if (index == 1) return user_path(path, size);
    if (index == 0) snprintf(path, size, "%s/ctl", SYSTEM_FOLDER);
    return index == 0;
}

/* ---- the lock ------------------------------------------------------------------------------- */

static bool fail_errno(const struct gn_listen *l, const char *what, struct gn_err *err) {
    return gn_fail(err, "control socket %s: %s: %s", l->path, what, strerror(errno));
}

static void lock_path(const struct gn_listen *l, char *out, size_t size) {
    snprintf(out, size, "%s.lock", l->path);
}

static bool is_same_file(int fd, const char *path) {
    struct stat open, there;
    return fstat(fd, &open) == 0 && lstat(path, &there) == 0 && open.st_dev == there.st_dev &&
           open.st_ino == there.st_ino;
}

/* The lock is held until the process ends or crashes. The previous holder may have unlinked the
 * file just before we locked it: then the lock is worthless, and we try again. */
static bool take_lock(struct gn_listen *l, struct gn_err *err) {
    char path[GN_LISTEN_PATH_MAX + 8];
    lock_path(l, path, sizeof path);
    for (int attempt = 0; attempt < 10; attempt++) {
        l->lock = open(path, O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, 0600);
        if (l->lock < 0) return fail_errno(l, "cannot create it", err);
        const bool locked = flock(l->lock, LOCK_EX | LOCK_NB) == 0;
        if (locked && is_same_file(l->lock, path)) return true;
        close(l->lock);
        l->lock = -1;
        if (!locked)
            return gn_fail(err,
                           "control socket %s: in use by another kiosk; running without it "
                           "(choose another with --socket)",
                           l->path);
    }
    return gn_fail(err, "control socket %s: its lock file is replaced again and again", l->path);
}

/* ---- the socket ----------------------------------------------------------------------------- */

static struct sockaddr_un address_of(const struct gn_listen *l) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    memcpy(address.sun_path, l->path, sizeof address.sun_path);
    return address;
}

static bool remove_stale_socket(const struct gn_listen *l, struct gn_err *err) {
    const struct sockaddr_un address = address_of(l);
    struct stat info;
    if (lstat(l->path, &info) != 0) return errno == ENOENT || fail_errno(l, "cannot stat it", err);
    if (!S_ISSOCK(info.st_mode)) return fail_kind(l->path, err);
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const bool refused = fd >= 0 &&
                         connect(fd, (const struct sockaddr *)&address, sizeof address) != 0 &&
                         errno == ECONNREFUSED;
    if (fd >= 0) close(fd);
    if (!refused)
        return gn_fail(err,
                       "control socket %s: another program listens there; running without it "
                       "(choose another with --socket)",
                       l->path);
    return unlink(l->path) == 0 || fail_errno(l, "cannot replace it", err);
}

/* On Linux the file gets the mode of the descriptor, so it is never more permissive than 0660; the
 * umask may have made it less, which chmod() corrects. */
static bool bind_socket(struct gn_listen *l, struct gn_err *err) {
    const struct sockaddr_un address = address_of(l);
    struct stat info;
    l->fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (l->fd < 0 || fchmod(l->fd, 0660) != 0 ||
        bind(l->fd, (const struct sockaddr *)&address, sizeof address) != 0)
        return fail_errno(l, "cannot create it", err);
    if (lstat(l->path, &info) != 0) return fail_errno(l, "cannot stat it", err);
    l->device = info.st_dev;
    l->inode = info.st_ino;
    l->gid = info.st_gid;
    l->uid = geteuid();
    if (chmod(l->path, 0660) != 0 || listen(l->fd, BACKLOG) != 0)
        return fail_errno(l, "cannot listen", err);
    return true;
}

bool gn_listen_open(struct gn_listen *l, const char *path, struct gn_err *err) {
    char folder[GN_LISTEN_PATH_MAX];
    *l = (struct gn_listen){.fd = -1, .lock = -1};
    if (!check_length(path, err)) return false;
    snprintf(l->path, sizeof l->path, "%s", path);
    snprintf(folder, sizeof folder, "%s", path);
    char *slash = strrchr(folder, '/');
    if (slash && slash != folder) {
        *slash = '\0';
        (void)!mkdir(folder, 0700); /* a failure shows when it is used */
    }
    if (take_lock(l, err) && remove_stale_socket(l, err) && bind_socket(l, err)) return true;
    gn_listen_close(l);
    return false;
}

void gn_listen_close(struct gn_listen *l) {
    char lock[GN_LISTEN_PATH_MAX + 8];
    struct stat info;
    if (l->inode && lstat(l->path, &info) == 0 && info.st_dev == l->device &&
        info.st_ino == l->inode)
        unlink(l->path);
    lock_path(l, lock, sizeof lock);
    if (l->lock >= 0 && is_same_file(l->lock, lock)) unlink(lock);
    if (l->fd >= 0) close(l->fd);
    if (l->lock >= 0) close(l->lock);
    *l = (struct gn_listen){.fd = -1, .lock = -1};
}

/* ---- who ------------------------------------------------------------------------------------ */

bool gn_listen_is_owner(const struct gn_listen *l, uid_t uid) { return uid == 0 || uid == l->uid; }

bool gn_listen_permits(const struct gn_listen *l, int fd, uid_t *uid) {
    struct ucred peer = {.uid = (uid_t)-1};
    socklen_t size = sizeof peer;
    const bool known = getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
    *uid = peer.uid;
    if (!known) return false;
    if (gn_listen_is_owner(l, peer.uid) || peer.gid == l->gid) return true;

    gid_t groups[GROUPS_MAX]; /* its supplementary groups */
    size = sizeof groups;
    if (getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, groups, &size) != 0) return false;
    for (size_t i = 0; i < size / sizeof *groups; i++)
        if (groups[i] == l->gid) return true;
    return false;
}
