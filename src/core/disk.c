#include "core/disk.h"

#include <errno.h>
#include <unistd.h>

ssize_t gn_disk_write(void *user, int fd, const void *data, size_t size) {
    (void)user;
    return write(fd, data, size);
}

int gn_disk_fsync(void *user, int fd) {
    (void)user;
    return fsync(fd);
}

int gn_disk_close(void *user, int fd) {
    (void)user;
    return close(fd);
}

bool gn_disk_write_all(ssize_t (*call)(void *user, int fd, const void *data, size_t size),
                       void *user, int fd, const void *data, size_t size) {
    const char *at = data;
    while (size > 0) {
        const ssize_t put = call(user, fd, at, size);
        if (put < 0 && errno == EINTR) continue;
        if (put == 0) errno = EIO;
        if (put <= 0) return false;
        at += put;
        size -= (size_t)put;
    }
    return true;
}
