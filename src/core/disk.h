/* System calls in the shape of the tables that tests replace (kiosk/state.h, take/files.h); the
 * real ones do not look at `user`. */
#ifndef GN_CORE_DISK_H
#define GN_CORE_DISK_H

#include <stdbool.h>
#include <sys/types.h>

/* Each as its namesake: -1 and errno on failure. */
ssize_t gn_disk_write(void *user, int fd, const void *data, size_t size);
int gn_disk_fsync(void *user, int fd);
int gn_disk_close(void *user, int fd);

/* All of the data, by that call. False: errno. */
bool gn_disk_write_all(ssize_t (*call)(void *user, int fd, const void *data, size_t size),
                       void *user, int fd, const void *data, size_t size);

#endif
