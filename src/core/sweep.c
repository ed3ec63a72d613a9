#include "core/sweep.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { OLD_S = 60 };

bool gn_sweep_name(char *name, size_t size, const char *folder, int number) {
    return snprintf(name, size, "%s.gnomon-%ld-%d", folder, (long)getpid(), number) < (int)size;
}

static bool is_temporary(const char *name) {
    static const char prefix[] = ".gnomon-", digits[] = "0123456789";
    if (strncmp(name, prefix, strlen(prefix)) != 0) return false;
    name += strlen(prefix);
    const size_t pid = strspn(name, digits);
    if (pid == 0 || name[pid] != '-') return false;
    name += pid + 1;
    return *name && !name[strspn(name, digits)];
}

/* A lock that cannot be had, for whatever reason, means that the file is in use. */
static bool is_left(int folder, const char *name) {
    struct stat info;
    const int fd = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (fd < 0) return false;
    const bool left = fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && info.st_nlink == 1 &&
                      info.st_uid == geteuid() && time(NULL) - info.st_mtime > OLD_S &&
                      flock(fd, LOCK_EX | LOCK_NB) == 0;
    close(fd);
    return left;
}

void gn_sweep_folder(const char *folder) {
    static _Atomic ino_t last; /* the folder that was swept last */
    struct stat info;
    DIR *dir = opendir(*folder ? folder : ".");
    if (!dir) return;
    if (fstat(dirfd(dir), &info) == 0 && atomic_exchange(&last, info.st_ino) != info.st_ino)
        for (const struct dirent *entry; (entry = readdir(dir)) != NULL;)
            if (is_temporary(entry->d_name) && is_left(dirfd(dir), entry->d_name))
                unlinkat(dirfd(dir), entry->d_name, 0);
    closedir(dir);
}
