#include "cli/memory.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "display/display.h"

double gn_memory_private_dirty_mb(void) {
    FILE *file = fopen("/proc/self/smaps_rollup", "re");
    if (!file) return NAN;
    char line[256];
    long kib = -1;
    while (kib < 0 && fgets(line, sizeof line, file))
        if (sscanf(line, "Private_Dirty: %ld", &kib) != 1) kib = -1;
    fclose(file);
    return kib < 0 ? NAN : (double)kib / 1024.0;
}

void gn_memory_probe_open(struct gn_memory_probe *probe, const char *backend) {
    int ends[2];
    *probe = (struct gn_memory_probe){.fd = -1};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) < 0) return;
    pid_t pid = fork();
    if (pid == 0) { /* opens the display when asked. _exit: stdio and atexit are the parent's */
        char asked;
        struct gn_display display = {0};
        close(ends[0]);
        int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC); /* the parent prints errors, too */
        if (nothing >= 0) dup2(nothing, STDERR_FILENO);
        if (recv(ends[1], &asked, 1, 0) == 1 && gn_display_open(&display, backend, NULL, NULL)) {
            double mb = gn_memory_private_dirty_mb();
            send(ends[1], &mb, sizeof mb, MSG_NOSIGNAL);
        }
        _exit(0);
    }
    close(ends[1]);
    *probe = (struct gn_memory_probe){pid > 0 ? pid : 0, ends[0]};
}

double gn_memory_probe_read(struct gn_memory_probe *probe) {
    double mb = NAN;
    bool asked = probe->pid && send(probe->fd, "?", 1, MSG_NOSIGNAL) == 1;
    if (asked && recv(probe->fd, &mb, sizeof mb, MSG_WAITALL) != (ssize_t)sizeof mb) mb = NAN;
    gn_memory_probe_close(probe);
    return mb;
}

void gn_memory_probe_close(struct gn_memory_probe *probe) {
    if (!probe->pid && probe->fd <= 0) return;
    close(probe->fd); /* a child that was not asked ends by this */
    if (probe->pid) waitpid(probe->pid, NULL, 0);
    *probe = (struct gn_memory_probe){.fd = -1};
}
