#include "core/disk.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/fs.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static int disk_open(void *user, int folder, const char *name, int flags, mode_t mode) {
    (void)user;
    return openat(folder, name, flags | O_CLOEXEC, mode);
}

static ssize_t disk_read(void *user, int fd, void *out, size_t size) {
    (void)user;
    return read(fd, out, size);
}

static ssize_t disk_write(void *user, int fd, const void *data, size_t size) {
    (void)user;
    return write(fd, data, size);
}

static int disk_fsync(void *user, int fd) {
    (void)user;
    return fsync(fd);
}

static int disk_close(void *user, int fd) {
    (void)user;
    return close(fd);
}

static int disk_mkdir(void *user, int folder, const char *name, mode_t mode) {
    (void)user;
    return mkdirat(folder, name, mode);
}

static int disk_rename(void *user, int folder, const char *from, const char *to) {
    (void)user;
    return renameat(folder, from, folder, to);
}

static int disk_exchange(void *user, int folder, const char *a, const char *b) {
    (void)user;
    return (int)syscall(SYS_renameat2, folder, a, folder, b, RENAME_EXCHANGE);
}

static int disk_symlink(void *user, const char *target, int folder, const char *name) {
    (void)user;
    return symlinkat(target, folder, name);
}

static int disk_unlink(void *user, int folder, const char *name, int flags) {
    (void)user;
    return unlinkat(folder, name, flags);
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static bool add_name(struct gn_disk_names *names, const char *name) {
    const int count = names->count;
    if (count == GN_DISK_NAMES_MAX) {
        errno = EFBIG;
        return false;
    }
    if ((count & (count - 1)) == 0) { /* full at each power of two */
        char **more = realloc(names->items, (count ? 2 * (size_t)count : 1) * sizeof *more);
        if (!more) return false;
        names->items = more;
    }
    names->items[count] = strdup(name);
    if (!names->items[count]) return false;
    names->count++;
    return true;
}

static int disk_list(void *user, int folder, struct gn_disk_names *names) {
    (void)user;
    const int own = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *stream = own < 0 ? NULL : fdopendir(own);
    if (!stream) {
        if (own >= 0) close(own);
        return -1;
    }
    const struct dirent *entry;
    bool ok = true;
    while (errno = 0, ok && (entry = readdir(stream)))
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            ok = add_name(names, entry->d_name);
    const int reason = errno;
    closedir(stream);
    errno = reason;
    if (reason) return -1;
    if (names->count) qsort(names->items, (size_t)names->count, sizeof(char *), compare_names);
    return 0;
}

void gn_disk_free_names(struct gn_disk_names *names) {
    for (int i = 0; i < names->count; i++) free(names->items[i]);
    free(names->items);
    *names = (struct gn_disk_names){0};
}

const struct gn_disk gn_disk = {
    .open = disk_open,
    .read = disk_read,
    .write = disk_write,
    .fsync = disk_fsync,
    .close = disk_close,
    .mkdir = disk_mkdir,
    .rename = disk_rename,
    .exchange = disk_exchange,
    .symlink = disk_symlink,
    .unlink = disk_unlink,
    .list = disk_list,
};

ssize_t gn_disk_read_all(const struct gn_disk *disk, int fd, void *out, size_t size) {
    size_t used = 0;
    while (used < size) {
        const ssize_t got = disk->read(disk->user, fd, (char *)out + used, size - used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) break;
        used += (size_t)got;
    }
    return (ssize_t)used;
}

bool gn_disk_write_all(const struct gn_disk *disk, int fd, const void *data, size_t size) {
    const char *at = data;
    while (size > 0) {
        const ssize_t put = disk->write(disk->user, fd, at, size);
        if (put < 0 && errno == EINTR) continue;
        if (put == 0) errno = EIO;
        if (put <= 0) return false;
        at += put;
        size -= (size_t)put;
    }
    return true;
}
