#include "core/syscall_filter.h"

#include <errno.h>
#include <fcntl.h>
#include <seccomp.h>
#include <stdbool.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* By name: not every processor nor every libseccomp has all of them. Those that look at a file by
 * its path (newfstatat, statx) are there because libc's fstat() is one of them. */
/* clang-format off */
static const char *const allowed[] = {
    /* memory */
    "brk", "madvise", "mremap", "munmap",
    /* open descriptors */
    "_llseek", "close", "dup", "fstat", "fstat64", "fstatat64", "fstatfs", "fstatfs64", "ftruncate",
    "ftruncate64", "lseek", "newfstatat", "poll", "ppoll", "pread64", "pwrite64", "read", "readv",
    "recvmsg", "statx", "write", "writev",
    /* itself, and the machine */
    "exit", "exit_group", "getegid", "geteuid", "getgid", "getpid", "getppid", "getrlimit",
    "getrusage", "gettid", "getuid", "sched_getaffinity", "sched_yield", "sysinfo", "ugetrlimit",
    "uname",
    /* time and chance */
    "clock_getres", "clock_gettime", "clock_gettime64", "clock_nanosleep", "clock_nanosleep_time64",
    "getrandom", "gettimeofday", "nanosleep", "time",
    /* libc's own: locks, signals, restarts */
    "futex", "futex_time64", "restart_syscall", "rseq", "rt_sigaction", "rt_sigprocmask",
    "rt_sigreturn", "set_robust_list", "sigaltstack", "sigreturn",
};
/* clang-format on */

/* Those that are allowed with some arguments only: the bits `mask` of argument `index` are `value`.
 */
static const struct conditional {
    const char *name;
    unsigned index;
    scmp_datum_t mask, value;
} conditionals[] = {
    {"mmap", 2, PROT_EXEC, 0},           {"mmap2", 2, PROT_EXEC, 0},
    {"mprotect", 2, PROT_EXEC, 0},       {"fcntl", 1, UINT32_MAX, F_GETFD},
    {"fcntl", 1, UINT32_MAX, F_SETFD},   {"fcntl", 1, UINT32_MAX, F_GETFL},
    {"fcntl64", 1, UINT32_MAX, F_GETFD}, {"fcntl64", 1, UINT32_MAX, F_SETFD},
    {"fcntl64", 1, UINT32_MAX, F_GETFL}, {"prlimit64", 0, UINT32_MAX, 0}, /* its own */
};

/* A name that is unknown here cannot be called either. */
static bool allow(scmp_filter_ctx filter, const char *name, unsigned count,
                  const struct scmp_arg_cmp *conditions) {
    const int number = seccomp_syscall_resolve_name(name);
    if (number < 0) return true;
    const int result = seccomp_rule_add_array(filter, SCMP_ACT_ALLOW, number, count, conditions);
    errno = -result;
    return result == 0;
}

static bool add_rules(scmp_filter_ctx filter) {
    bool ok = true;
    for (size_t i = 0; i < sizeof allowed / sizeof allowed[0]; i++)
        ok = ok && allow(filter, allowed[i], 0, NULL);
    for (size_t i = 0; i < sizeof conditionals / sizeof conditionals[0]; i++) {
        const struct conditional *c = &conditionals[i];
        const struct scmp_arg_cmp condition = {c->index, SCMP_CMP_MASKED_EQ, c->mask, c->value};
        ok = ok && allow(filter, c->name, 1, &condition);
    }
    const struct scmp_arg_cmp self = {0, SCMP_CMP_EQ, (scmp_datum_t)getpid(), 0};
    return ok && allow(filter, "tgkill", 1, &self); /* abort() */
}

int gn_syscall_filter(struct gn_err *err) {
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(ENOSYS));
    int result = -1;
    if (!filter)
        gn_fail(err, "cannot make a filter of system calls: no memory");
    else if (seccomp_attr_set(filter, SCMP_FLTATR_API_SYSRAWRC, 1) != 0 || !add_rules(filter))
        gn_fail(err, "cannot make a filter of system calls: %s", strerror(errno));
    else {
        const int loaded = seccomp_load(filter);
        result = loaded == 0 ? 1 : loaded == -EINVAL || loaded == -ENOSYS ? 0 : -1;
        if (result < 0) gn_fail(err, "cannot filter its system calls: %s", strerror(-loaded));
    }
    seccomp_release(filter);
    return result;
}
