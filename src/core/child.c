#include "core/child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/clock.h"

void *gn_child_share(size_t size, struct gn_err *err) {
    void *shared = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared != MAP_FAILED) return shared;
    gn_fail(err, "no memory to share with a child: %s", strerror(errno));
    return NULL;
}

void gn_child_unshare(void *shared, size_t size) {
    if (shared) munmap(shared, size);
}

static void silence(void) {
    int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int fd = 0; nothing >= 0 && fd < 3; fd++) dup2(nothing, fd);
}

static bool fail_end(int status, struct gn_err *err) {
    if (WIFSIGNALED(status)) return gn_fail(err, "crashes (%s)", strsignal(WTERMSIG(status)));
    return WEXITSTATUS(status) == 0 ||
           gn_fail(err, "ends the process (status %d)", WEXITSTATUS(status));
}

/* A tenth of a second, less at the start: most work is short. */
static void nap(int round) {
    long ms = round < 20 ? 5 : 100;
    nanosleep(&(struct timespec){.tv_nsec = ms * 1000000}, NULL);
}

static bool wait_for(pid_t pid, const struct gn_child *child, void *shared, struct gn_err *err) {
    int stall_s = child->stall_s ? child->stall_s : 60, status = 0;
    int64_t since_ns = gn_clock_monotonic_ns();
    uint32_t seen = 0;
    for (int round = 0;; round++) {
        pid_t ended = waitpid(pid, &status, WNOHANG);
        if (child->watch) child->watch(shared, child->argument);
        if (ended == pid) return fail_end(status, err);
        if (ended < 0 && errno != EINTR) return gn_fail(err, "is lost: %s", strerror(errno));
        uint32_t now = child->progress ? *(const volatile uint32_t *)child->progress : 0;
        if (now != seen) since_ns = gn_clock_monotonic_ns();
        seen = now;
        if (gn_clock_monotonic_ns() - since_ns > stall_s * GN_NS_PER_S) break;
        nap(round);
    }
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    return gn_fail(err, "hangs (nothing for %d s)", stall_s);
}

bool gn_child_run(const struct gn_child *child, void *shared, struct gn_err *err) {
    fflush(NULL);
    pid_t pid = fork();
    if (pid < 0) return gn_fail(err, "cannot be tried: %s", strerror(errno));
    if (pid > 0) return wait_for(pid, child, shared, err);
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* it would outlive a parent that is interrupted */
    silence();
    child->work(shared, child->argument);
    _exit(0);
}
