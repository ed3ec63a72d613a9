#include "core/file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/beneath.h"
#include "core/stop.h"
#include "core/sweep.h"

static const char *kind_name(mode_t mode) {
    return S_ISDIR(mode)    ? "a folder"
           : S_ISFIFO(mode) ? "a FIFO"
           : S_ISSOCK(mode) ? "a socket"
                            : "a device";
}

static void close_quietly(int fd) {
    if (fd >= 0) close(fd);
}

static bool fail_errno(struct gn_err *err, const char *path, const char *verb) {
    return gn_fail(err, "%s: cannot %s: %s", path, verb, strerror(errno));
}

static bool fail_size(struct gn_err *err, const char *path, size_t limit) {
    return gn_fail(err, "%s: larger than the limit of %zu bytes", path, limit);
}

enum { SLICE = 4 << 20 };
struct progress {
    atomic_uint *permille;
    unsigned whole;
};

/* The size when the file was opened is only a hint: it may grow, and files of /proc report 0. */
static bool read_all(int fd, const char *path, size_t hint, size_t limit,
                     const struct progress *progress, struct gn_bytes *out, struct gn_err *err) {
    size_t room = hint + 1;
    out->data = malloc(room + 1);
    while (out->data) {
        const size_t left = room - out->size, most = progress && left > SLICE ? SLICE : left;
        if (progress)
            atomic_store(progress->permille,
                         (unsigned)((uint64_t)out->size * progress->whole / room));
        ssize_t got = read(fd, out->data + out->size, most);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail_errno(err, path, "read");
        if (got == 0) break;
        out->size += (size_t)got;
        if (limit && out->size > limit) return fail_size(err, path, limit);
        if (out->size < room) continue;
        room = room * 2 + 4096;
        uint8_t *larger = realloc(out->data, room + 1);
        if (!larger) return gn_fail(err, "%s: too large for this machine's memory", path);
        out->data = larger;
    }
    if (!out->data) return gn_fail(err, "%s: too large for this machine's memory", path);
    out->data[out->size] = 0;
    return true;
}

/* Whether it is a regular file. fd -1: errno says why there is none. */
static bool check_regular(int fd, const char *path, struct stat *info, struct gn_err *err) {
    if (fd < 0 && errno == ENXIO)
        return gn_fail(err, "%s: is a socket or device, not a file", path);
    if (fd < 0) return fail_errno(err, path, "open");
    if (fstat(fd, info) != 0) return fail_errno(err, path, "read");
    return S_ISREG(info->st_mode) ||
           gn_fail(err, "%s: is %s, not a file", path, kind_name(info->st_mode));
}

static bool read_regular(int fd, const char *path, size_t limit, const struct progress *progress,
                         struct gn_bytes *out, struct gn_err *err) {
    struct stat info = {0};
    *out = (struct gn_bytes){0};
    bool ok = check_regular(fd, path, &info, err);
    if (ok && limit && (uintmax_t)info.st_size > limit) ok = fail_size(err, path, limit);
    ok = ok && read_all(fd, path, (size_t)info.st_size, limit, progress, out, err);
    close_quietly(fd);
    if (!ok) gn_bytes_finish(out);
    return ok;
}

bool gn_file_read_fd(int fd, const char *path, size_t limit, struct gn_bytes *out,
                     struct gn_err *err) {
    return read_regular(fd, path, limit, NULL, out, err);
}

/* Does not block: neither on a FIFO without a writer nor on a device. */
static int open_to_read(const char *path) {
    return open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

bool gn_file_read(const char *path, size_t limit, struct gn_bytes *out, struct gn_err *err) {
    return gn_file_read_fd(open_to_read(path), path, limit, out, err);
}

bool gn_file_read_progress(const char *path, size_t limit, atomic_uint *permille, unsigned whole,
                           struct gn_bytes *out, struct gn_err *err) {
    const struct progress progress = {permille, whole};
    return read_regular(open_to_read(path), path, limit, permille ? &progress : NULL, out, err);
}

/* The descriptor if it is that of a regular file, else closes it. */
static int keep_regular(int fd, const char *path, struct gn_err *err) {
    struct stat info;
    if (check_regular(fd, path, &info, err)) return fd;
    close_quietly(fd);
    return -1;
}

int gn_file_open(const char *path, struct gn_err *err) {
    return keep_regular(open_to_read(path), path, err);
}

int gn_file_open_beneath(const char *folder, const char *name, struct gn_err *err) {
    char path[2 * PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    int fd = gn_open_beneath(folder, name);
    if (fd == -EXDEV) {
        gn_fail(err, "'%.80s' leads outside the model's folder; put the file beside it", name);
        return -1;
    }
    if (fd < 0) errno = -fd, fd = -1;
    return keep_regular(fd, path, err);
}

const char *gn_file_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

bool gn_file_read_text(const char *path, char *out, size_t size) {
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const ssize_t length = fd < 0 ? 0 : read(fd, out, size - 1);
    if (fd >= 0) close(fd);
    out[length > 0 ? length : 0] = 0;
    return length > 0;
}

void gn_bytes_finish(struct gn_bytes *bytes) {
    free(bytes->data);
    *bytes = (struct gn_bytes){0};
}

/* -1: the path names no descriptor of this process. */
static int descriptor_of(const char *path) {
    static const char *const folders[] = {"/dev/fd/", "/proc/self/fd/"};
    if (strcmp(path, "/dev/stdout") == 0) return STDOUT_FILENO;
    if (strcmp(path, "/dev/stderr") == 0) return STDERR_FILENO;
    for (int i = 0; i < 2; i++) {
        const char *number = path + strlen(folders[i]);
        if (strncmp(path, folders[i], strlen(folders[i])) != 0) continue;
        if (*number && strlen(number) < 9 && !number[strspn(number, "0123456789")])
            return atoi(number);
    }
    return -1;
}

/* Writes to the descriptor that the path names, at its present position, or opens the path. */
static bool write_in_place(const char *path, int flags, const void *data, size_t size,
                           struct gn_err *err) {
    struct stat info;
    int fd = descriptor_of(path);
    fd = fd >= 0 ? fcntl(fd, F_DUPFD_CLOEXEC, 0)
                 : open(path, O_WRONLY | O_NOCTTY | O_CLOEXEC | flags);
    if (fd < 0) return fail_errno(err, path, "write");
    bool ok = gn_disk_write_all(&gn_disk, fd, data, size);
    if (ok && fstat(fd, &info) == 0 && S_ISREG(info.st_mode)) { /* the file ends after the data */
        off_t end = lseek(fd, 0, SEEK_CUR);
        ok = end >= 0 && ftruncate(fd, end) == 0;
    }
    if (!ok) fail_errno(err, path, "write");
    if (close(fd) != 0 && ok) ok = fail_errno(err, path, "write");
    return ok;
}

/* A file that exists keeps its mode; until that is set only this user may read its successor. */
static bool write_and_rename(const struct gn_disk *disk, const char *path, const struct stat *old,
                             const void *data, size_t size, struct gn_err *err) {
    /* a new file beside the path */
    void *user = disk->user;
    char name[PATH_MAX], folder[PATH_MAX];
    const char *slash = strrchr(path, '/');
    int fd = -1;
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path + 1) : 0, path);
    gn_sweep_folder(folder);
    gn_stop_hold();
    for (int attempt = 0; attempt < 100 && fd < 0; attempt++) {
        if (!gn_sweep_name(name, sizeof name, folder, attempt)) {
            errno = ENAMETOOLONG;
            break;
        }
        fd = disk->open(user, AT_FDCWD, name, O_WRONLY | O_CREAT | O_EXCL, old ? 0600 : 0666);
        if (fd < 0 && errno != EEXIST) break;
    }
    gn_stop_release(fd >= 0 ? name : NULL);
    if (fd < 0) return fail_errno(err, path, "write");
    flock(fd, LOCK_EX | LOCK_NB); /* in use: not swept */
    bool ok = gn_disk_write_all(disk, fd, data, size) &&
              (!old || fchmod(fd, old->st_mode & 0777) == 0) && disk->fsync(user, fd) == 0;
    int reason = errno;
    if (disk->close(user, fd) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    gn_stop_hold();
    const bool renamed = ok && disk->rename(user, AT_FDCWD, name, path) == 0;
    if (ok && !renamed) reason = errno;
    if (!renamed) disk->unlink(user, AT_FDCWD, name, 0);
    gn_stop_release(NULL);
    if (renamed) return true;
    errno = reason;
    return fail_errno(err, path, "write");
}

static bool replace_file(const struct gn_disk *disk, const char *path, const void *data,
                         size_t size, struct gn_err *err) {
    struct stat info;
    const bool exists = lstat(path, &info) == 0;
    if (!exists && errno != ENOENT) return fail_errno(err, path, "write");
    if (exists && S_ISLNK(info.st_mode))
        return gn_fail(err, "%s: refusing to overwrite a symbolic link; name the file itself",
                       path);
    if (exists && !S_ISREG(info.st_mode))
        return gn_fail(err, "%s: refusing to overwrite %s", path, kind_name(info.st_mode));
    return write_and_rename(disk, path, exists ? &info : NULL, data, size, err);
}

bool gn_file_replace(const char *path, const void *data, size_t size, struct gn_err *err) {
    return replace_file(&gn_disk, path, data, size, err);
}

bool gn_file_keep(const struct gn_disk *disk, const char *path, const void *data, size_t size,
                  struct gn_err *err) {
    if (!replace_file(disk, path, data, size, err)) return false;
    const char *slash = strrchr(path, '/');
    char folder[PATH_MAX];
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path + 1) : 1,
             slash ? path : ".");
    const int fd = disk->open(disk->user, AT_FDCWD, folder, O_RDONLY | O_DIRECTORY, 0);
    const bool ok = fd >= 0 && (disk->fsync(disk->user, fd) == 0 || errno == EINVAL);
    const int reason = errno; /* EINVAL: this file system flushes no folders */
    if (fd >= 0) disk->close(disk->user, fd);
    return ok || gn_fail(err, "%s: cannot write its folder: %s", path, strerror(reason));
}

bool gn_file_write(const char *path, const void *data, size_t size, struct gn_err *err) {
    struct stat info;
    if (!path[0]) return gn_fail(err, "cannot write to a file without a name");

    /* the name of a descriptor or a device, which may be a link of the system's */
    const bool in_dev = strncmp(path, "/dev/", 5) == 0 && strncmp(path, "/dev/shm/", 9) != 0;
    if (in_dev || strncmp(path, "/proc/", 6) == 0) return write_in_place(path, 0, data, size, err);

    const bool exists = lstat(path, &info) == 0;
    if (exists && S_ISDIR(info.st_mode)) return gn_fail(err, "%s: cannot write: is a folder", path);
    if (exists && !S_ISREG(info.st_mode) && !S_ISLNK(info.st_mode))
        return write_in_place(path, O_NOFOLLOW, data, size, err);
    if (exists && S_ISREG(info.st_mode) && access(path, W_OK) != 0)
        return fail_errno(err, path, "write");
    return gn_file_replace(path, data, size, err);
}

void gn_file_fill_standard(void) {
    int fd;
    do fd = open("/dev/null", O_RDWR);
    while (fd >= 0 && fd <= STDERR_FILENO);
    close_quietly(fd);
}

/* errno is unknown if an earlier write failed. */
bool gn_file_flush_output(struct gn_err *err) {
    bool bad = ferror(stdout), flushed = fflush(stdout) == 0;
    if (flushed && !bad) return true;
    int reason = errno;
    struct pollfd output = {.fd = STDOUT_FILENO, .events = POLLOUT};
    if (poll(&output, 1, 0) == 1 && output.revents & (POLLERR | POLLHUP))
        return true; /* the reader has closed the pipe */
    return gn_fail(err, "standard output: cannot write%s%s", flushed ? " all output" : ": ",
                   flushed ? "" : strerror(reason));
}
