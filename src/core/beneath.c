/* openat2() (Linux 5.6) with RESOLVE_BENEATH makes the kernel check each step of the path. It also
 * refuses an absolute link to a file inside, older kernels do not have it, and filters of system
 * calls hide it (ENOSYS, EPERM): then the file is opened without access to its content, the kernel
 * says what its path is, and only a file whose path begins with the folder's is opened for reading,
 * through the descriptor. See openat2(2), open(2) on O_PATH, proc_pid_fd(5). */
#include "core/beneath.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <linux/openat2.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { READ_FLAGS = O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC };

/* The name of the descriptor in /proc, and what the kernel says that it leads to. */
struct place {
    char link[32], path[PATH_MAX];
};

static bool find_place(int fd, struct place *place) {
    snprintf(place->link, sizeof place->link, "/proc/self/fd/%d", fd);
    const ssize_t length = readlink(place->link, place->path, sizeof place->path);
    if (length <= 0 || length >= (ssize_t)sizeof place->path) return false; /* it may be cut */
    place->path[length] = 0;
    return place->path[0] == '/';
}

static bool is_beneath(const char *folder, const char *path) {
    size_t length = strlen(folder);
    while (length > 0 && folder[length - 1] == '/') length--; /* "/" */
    return strncmp(path, folder, length) == 0 && path[length] == '/';
}

static int open_checked(int folder, const char *name) {
    struct place top, place;
    const int found = openat(folder, name, O_PATH | O_CLOEXEC);
    if (found < 0) return -errno;
    int result = -EXDEV;
    if (find_place(folder, &top) && find_place(found, &place) && is_beneath(top.path, place.path)) {
        const int fd = open(place.link, READ_FLAGS);
        result = fd < 0 ? -errno : fd;
    }
    close(found);
    return result;
}

static int open_exactly(int top, const char *name) {
    const struct open_how how = {.flags = READ_FLAGS,
                                 .resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS};
    const int fd = (int)syscall(SYS_openat2, top, name, &how, sizeof how);
    if (fd >= 0) return fd;
    const bool is_plain = errno != EXDEV && errno != ELOOP && errno != EAGAIN && errno != ENOSYS &&
                          errno != EPERM && errno != EINVAL;
    return is_plain ? -errno : open_checked(top, name);
}

/* Replaces the part of a path from `part` on, `length` long, by the one entry of its folder that
 * differs in case only. False: there is none, or more than one. */
static bool match_part(int top, char *path, char *part, size_t length) {
    const char kept = *part;
    *part = 0;
    const int folder = openat(top, *path ? path : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    *part = kept;
    DIR *entries = folder >= 0 ? fdopendir(folder) : NULL;
    char match[NAME_MAX + 1] = "";
    int matches = 0;
    for (const struct dirent *e; entries && matches < 2 && (e = readdir(entries));) {
        if (strncasecmp(e->d_name, part, length) != 0 || e->d_name[length]) continue;
        snprintf(match, sizeof match, "%s", e->d_name);
        matches = strncmp(match, part, length) == 0 ? INT_MAX : matches + 1;
    }
    if (entries)
        closedir(entries);
    else if (folder >= 0)
        close(folder);
    if (matches == 1 || matches == INT_MAX) memcpy(part, match, length);
    return matches == 1 || matches == INT_MAX;
}

/* Names of Windows may differ from the file's in case. */
static int open_in_any_case(int top, const char *name) {
    char path[PATH_MAX];
    if (snprintf(path, sizeof path, "%s", name) >= (int)sizeof path) return -ENOENT;
    for (char *part = path; *part;) {
        const size_t length = strcspn(part, "/");
        if (length > NAME_MAX || (length > 0 && !match_part(top, path, part, length)))
            return -ENOENT;
        part += length;
        part += *part == '/';
    }
    return open_exactly(top, path);
}

int gn_open_beneath(const char *folder, const char *name) {
    const int top = open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (top < 0) return -errno;
    int fd = open_exactly(top, name);
    if (fd == -ENOENT && *name != '/') fd = open_in_any_case(top, name);
    close(top);
    return fd;
}
