#include "core/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/clock.h"

void *gn_child_share(size_t size, struct gn_err *err) {
    void *shared = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared != MAP_FAILED) return shared;
    gn_fail(err, "cannot allocate memory shared with a child process: %s", strerror(errno));
    return NULL;
}

void gn_child_unshare(void *shared, size_t size) {
    if (shared) munmap(shared, size);
}

static bool end_child(pid_t pid) {
    kill(pid, SIGKILL);
    waitpid(pid, NULL, 0);
    return false;
}

static bool wait_for_child(pid_t pid, int end, const struct gn_child *child, void *shared,
                           struct gn_err *err) {
    int stall_s = child->stall_s ? child->stall_s : 60, status = 0;
    int wake = child->wake ? child->wake : -1;
    int64_t since_ns = gn_clock_monotonic_ns();
    uint32_t seen = 0;
    for (int round = 0;; round++) {
        pid_t ended = waitpid(pid, &status, WNOHANG);
        if (child->watch) child->watch(shared, child->argument);
        if (ended == pid && WIFSIGNALED(status))
            return gn_fail(err, "crashes (%s)", strsignal(WTERMSIG(status)));
        if (ended == pid)
            return WEXITSTATUS(status) == 0 ||
                   gn_fail(err, "exits (status %d)", WEXITSTATUS(status));
        if (ended < 0 && errno != EINTR)
            return gn_fail(err, "cannot be waited for: %s", strerror(errno));
        if (child->cancel && atomic_load(child->cancel))
            return end_child(pid) || gn_fail(err, "was stopped");
        uint32_t now = child->progress ? *(const volatile uint32_t *)child->progress : 0;
        if (now != seen) since_ns = gn_clock_monotonic_ns();
        seen = now;
        if (gn_clock_monotonic_ns() - since_ns > stall_s * GN_NS_PER_S)
            return end_child(pid) || gn_fail(err, "hangs (no progress for %d s)", stall_s);

        /* Sleeps 0.1 s, less in the first rounds: most work is short. The child's exit ends the
         * sleep where the kernel has pidfd_open() (5.3). */
        struct pollfd wakes[] = {{.fd = end, .events = POLLIN}, {.fd = wake, .events = POLLIN}};
        poll(wakes, 2, round < 20 ? 5 : 100);
        if (wakes[1].revents & ~POLLIN) wake = -1; /* no writer is left */
    }
}

bool gn_child_run(const struct gn_child *child, void *shared, struct gn_err *err) {
    fflush(NULL);
    pid_t parent = getpid(), pid = fork();
    if (pid < 0) return gn_fail(err, "cannot be started: %s", strerror(errno));
    if (pid > 0) {
        int end = (int)syscall(SYS_pidfd_open, pid, 0);
        bool ok = wait_for_child(pid, end, child, shared, err);
        if (end >= 0) close(end);
        return ok;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);  /* dies with an interrupted parent */
    if (getppid() != parent) _exit(0); /* the parent died before prctl() */
    int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int fd = 0; nothing >= 0 && fd < 3; fd++) dup2(nothing, fd);
    child->work(shared, child->argument);
    _exit(0);
}
