/* The system calls that change files, as a table, so that a test can let each of them fail, or cut
 * the power before it. */
#ifndef GN_CORE_DISK_H
#define GN_CORE_DISK_H

#include <stdbool.h>
#include <sys/types.h>

enum { GN_DISK_NAMES_MAX = 65536 }; /* of one folder: a broken FAT may go round in circles */
struct gn_disk_names {              /* sorted by their bytes */
    char **items;
    int count;
};
void gn_disk_free_names(struct gn_disk_names *names);

/* Each as its namesake: -1 and errno on failure. A name is of the folder that is open as `folder`;
 * with AT_FDCWD it may be a path. */
struct gn_disk {
    void *user;
    int (*open)(void *user, int folder, const char *name, int flags, mode_t mode);
    ssize_t (*read)(void *user, int fd, void *out, size_t size);
    ssize_t (*write)(void *user, int fd, const void *data, size_t size);
    int (*fsync)(void *user, int fd);
    int (*close)(void *user, int fd);
    int (*mkdir)(void *user, int folder, const char *name, mode_t mode);
    int (*rename)(void *user, int folder, const char *from, const char *to);
    int (*exchange)(void *user, int folder, const char *a, const char *b); /* or ENOSYS, EINVAL */
    int (*symlink)(void *user, const char *target, int folder, const char *name);
    int (*unlink)(void *user, int folder, const char *name, int flags);
    /* all names but . and ..; the caller frees them, also after a failure */
    int (*list)(void *user, int folder, struct gn_disk_names *names);
};
extern const struct gn_disk gn_disk; /* the real ones */

/* Until `out` is full or the file ends. Returns the bytes, or -1. */
ssize_t gn_disk_read_all(const struct gn_disk *disk, int fd, void *out, size_t size);
/* False: errno says why not all of the data is written. */
bool gn_disk_write_all(const struct gn_disk *disk, int fd, const void *data, size_t size);

#endif
