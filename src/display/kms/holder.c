#include "display/kms/holder.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/file.h"

/* The kernel does not report a card's master: returns the process that has it open. Session
 * managers hold cards on behalf of others: returns one only if there is no other process. */
bool gn_kms_find_holder(const char *node, char *out, size_t size) {
    static const char *const managers[] = {"systemd-logind", "elogind", "seatd"};
    DIR *all = opendir("/proc");
    bool found = false, sure = false;
    for (struct dirent *entry; all && !sure && (entry = readdir(all));) {
        char path[48], name[32];
        const long pid = strtol(entry->d_name, NULL, 10);
        if (pid <= 0 || pid == getpid()) continue;
        snprintf(path, sizeof path, "/proc/%ld/fd", pid);
        const int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        DIR *fds = folder < 0 ? NULL : fdopendir(folder);
        if (folder >= 0 && !fds) close(folder);
        bool is_open = false;
        for (struct dirent *fd; fds && !is_open && (fd = readdir(fds));) {
            char target[128];
            const ssize_t length = readlinkat(dirfd(fds), fd->d_name, target, sizeof target - 1);
            if (length <= 0) continue;
            target[length] = 0;
            is_open = strcmp(target, node) == 0;
        }
        if (fds) closedir(fds);
        if (!is_open) continue;
        snprintf(path, sizeof path, "/proc/%ld/comm", pid);
        if (!gn_file_read_text(path, name, sizeof name)) snprintf(name, sizeof name, "a program");
        name[strcspn(name, "\n")] = 0;
        sure = true;
        for (size_t i = 0; i < sizeof managers / sizeof *managers; i++)
            sure &= strncmp(name, managers[i], strlen(managers[i])) != 0;
        if (sure || !found) snprintf(out, size, "%s (pid %ld)", name, pid);
        found = true;
    }
    if (all) closedir(all);
    return found;
}
