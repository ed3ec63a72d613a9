/* Each layer holds without the others, since a kernel may have none of them: no capabilities and no
 * network; Landlock (Linux 5.13), by system call because libc has no functions for it; the filter
 * of system calls. See landlock(7), capabilities(7), user_namespaces(7). */
#include "core/sandbox.h"

#include <errno.h>
#include <grp.h>
#include <limits.h>
#include <linux/capability.h>
#include <sched.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "core/syscall_filter.h"

/* ---- Landlock: the headers of Debian 12 are older than these --------------------------------- */

struct ruleset { /* struct landlock_ruleset_attr */
    uint64_t files, network, scopes;
};
enum { GET_VERSION = 1 };

/* All that a version can forbid: bits, and how long its struct is. */
static const struct version {
    struct ruleset all;
    size_t size;
} versions[] = {
    {{.files = 0x1fff}, 8},                                 /* 1: all but those below */
    {{.files = 0x3fff}, 8},                                 /* 2: link, rename to another folder */
    {{.files = 0x7fff}, 8},                                 /* 3: truncate */
    {{.files = 0x7fff, .network = 0x3}, 16},                /* 4: TCP */
    {{.files = 0xffff, .network = 0x3}, 16},                /* 5: ioctl of devices */
    {{.files = 0xffff, .network = 0x3, .scopes = 0x3}, 24}, /* 6: others' signals and sockets */
};
enum { VERSIONS = sizeof versions / sizeof versions[0] };

/* Without a rule nothing is allowed. 1: in force; 0: the kernel has none; -1: failed. */
static int forbid_files(struct gn_err *err) {
    const long found = syscall(SYS_landlock_create_ruleset, NULL, 0, GET_VERSION);
    if (found < 1) return 0;
    const struct version *version = &versions[(found < VERSIONS ? found : VERSIONS) - 1];
    const int rules = (int)syscall(SYS_landlock_create_ruleset, &version->all, version->size, 0);
    const bool ok = rules >= 0 && syscall(SYS_landlock_restrict_self, rules, 0) == 0;
    if (!ok) gn_fail(err, "cannot renounce access to files (Landlock): %s", strerror(errno));
    if (rules >= 0) close(rules);
    return ok ? 1 : -1;
}

/* ---- what a process has ---------------------------------------------------------------------- */

static void close_between(int before, int after) {
    const int first = before > STDERR_FILENO ? before + 1 : STDERR_FILENO + 1, last = after - 1;
    if (first <= last && syscall(SYS_close_range, (unsigned)first, (unsigned)last, 0) != 0)
        for (int fd = first; fd <= last && fd < 4096; fd++) close(fd); /* before Linux 5.9 */
}

static void close_others(const int kept[2]) {
    const int low = kept[0] < kept[1] ? kept[0] : kept[1];
    const int high = kept[0] < kept[1] ? kept[1] : kept[0];
    close_between(-1, low);
    close_between(low, high);
    close_between(high, INT_MAX);
}

/* Root without capabilities still owns root's files and devices. Where a container has no such
 * user it stays root by name. */
static void become_nobody(void) {
    enum { NOBODY = 65534 };
    if (geteuid() != 0) return;
    if (setgroups(0, NULL) != 0 || setresgid(NOBODY, NOBODY, NOBODY) != 0) return;
    (void)!setresuid(NOBODY, NOBODY, NOBODY);
}

static bool drop_capabilities(struct gn_err *err) {
    struct __user_cap_header_struct header = {.version = _LINUX_CAPABILITY_VERSION_3};
    const struct __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3] = {{0}};
    prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0);
    return syscall(SYS_capset, &header, none) == 0 ||
           gn_fail(err, "cannot drop its capabilities: %s", strerror(errno));
}

int gn_sandbox_enter(const int kept[2], struct gn_err *err) {
    const pid_t parent = getppid();
    int parent_signal = 0;
    prctl(PR_GET_PDEATHSIG, &parent_signal);
    close_others(kept);
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) {
        gn_fail(err, "cannot renounce more rights: %s", strerror(errno));
        return -1;
    }
    /* A network of its own, without a link to any other. Not permitted in all containers. */
    (void)!unshare(geteuid() == 0 ? CLONE_NEWNET : CLONE_NEWUSER | CLONE_NEWNET);
    become_nobody();
    if (!drop_capabilities(err)) return -1;

    /* the kernel forgets this signal when rights change; the parent may have died by now */
    prctl(PR_SET_PDEATHSIG, parent_signal);
    if (parent_signal && getppid() != parent) _exit(0);

    const int files = forbid_files(err);
    const int calls = files < 0 ? -1 : gn_syscall_filter(err);
    if (calls < 0) return -1;
    return (files ? GN_SANDBOX_LANDLOCK : 0) | (calls ? GN_SANDBOX_FILTER : 0);
}
