#include "display/kms/holder.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool is_open_in(int folder, const char *node) {
    DIR *fds = fdopendir(folder);
    bool found = false;
    if (!fds) close(folder);
    for (struct dirent *entry; fds && !found && (entry = readdir(fds));) {
        char target[128];
        const ssize_t length = readlinkat(dirfd(fds), entry->d_name, target, sizeof target - 1);
        if (length <= 0) continue;
        target[length] = 0;
        found = strcmp(target, node) == 0;
    }
    if (fds) closedir(fds);
    return found;
}

static void read_name(long pid, char *out, size_t size) {
    char path[48];
    snprintf(path, sizeof path, "/proc/%ld/comm", pid);
    FILE *file = fopen(path, "re");
    if (!file || !fgets(out, (int)size, file)) snprintf(out, size, "a program");
    if (file) fclose(file);
    out[strcspn(out, "\n")] = 0;
}

/* Session managers hold cards on behalf of others. */
static bool is_broker(const char *name) {
    static const char *const names[] = {"systemd-logind", "elogind", "seatd"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strncmp(name, names[i], strlen(names[i])) == 0) return true;
    return false;
}

/* The kernel does not report a card's master: returns the process that has it open, a session
 * manager only if there is no other. */
bool gn_kms_find_holder(const char *node, char *out, size_t size) {
    DIR *all = opendir("/proc");
    bool found = false, sure = false;
    for (struct dirent *entry; all && !sure && (entry = readdir(all));) {
        char path[48], name[32];
        const long pid = strtol(entry->d_name, NULL, 10);
        if (pid <= 0 || pid == getpid()) continue;
        snprintf(path, sizeof path, "/proc/%ld/fd", pid);
        const int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (folder < 0 || !is_open_in(folder, node)) continue;
        read_name(pid, name, sizeof name);
        sure = !is_broker(name);
        if (sure || !found) snprintf(out, size, "%s (pid %ld)", name, pid);
        found = true;
    }
    if (all) closedir(all);
    return found;
}
