/* In place of libassimp (LD_PRELOAD): a library that was taken over by the model. Inside the
 * process that reads it, it tries what that process must not do, and says what worked as assimp's
 * error. GN_HIDE=landlock or filter: as on a machine without. */
#include <limits.h> /* needed by assimp's headers */

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

static char worked[400];
static bool has_landlock;

static void note(const char *attempt, bool works) {
    if (works) strcat(strcat(worked, " "), attempt);
}

static bool opens(const char *path, int flags) { return open(path, flags, 0600) >= 0; }

static bool connects(const char *model) {
    struct sockaddr_un to = {.sun_family = AF_UNIX};
    snprintf(to.sun_path, sizeof to.sun_path, "%s", model);
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0); /* to a file that is no socket, when it can */
    return fd >= 0 && (connect(fd, (struct sockaddr *)&to, sizeof to) == 0 || errno != ENOSYS);
}

static bool forks(void) {
    const pid_t pid = fork();
    if (pid == 0) _exit(0);
    return pid > 0 && waitpid(pid, NULL, 0) == pid;
}

const struct aiScene *aiImportFileExWithProperties(const char *model, unsigned flags,
                                                   struct aiFileIO *io,
                                                   const struct aiPropertyStore *properties) {
    char beside[4096], *const sh[] = {"sh", "-c", "exit 9", NULL};
    (void)flags, (void)properties;
    note("landlock", has_landlock);
    note("gets-model", io->OpenProc(io, model, "rb") != NULL);
    note("gets-outside",
         io->OpenProc(io, "../secret", "rb") || io->OpenProc(io, "/etc/passwd", "rb"));
    note("reads-model", opens(model, O_RDONLY));
    note("reads-passwd", opens("/etc/passwd", O_RDONLY));
    note("writes-model", opens(model, O_WRONLY));
    snprintf(beside, sizeof beside, "%s.new", model);
    note("makes-file", opens(beside, O_WRONLY | O_CREAT));
    note("unlinks", unlink(beside) == 0);
    note("connects", connects(model));
    note("signals", kill(getpid(), 0) == 0);
    note("forks", forks());
    note("makes-code",
         mmap(NULL, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED);
    execv("/bin/sh", sh);
    note("traces", ptrace(PTRACE_SEIZE, getppid(), NULL, NULL) == 0 ||
                       ptrace(PTRACE_TRACEME, 0, NULL, NULL) == 0);
    return NULL;
}

const char *aiGetErrorString(void) { return worked; }

__attribute__((constructor)) static void hide(void) {
    const char *what = getenv("GN_HIDE");
    struct sock_filter landlock[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_landlock_create_ruleset, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    struct sock_filter filter[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_seccomp, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_prctl, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[0])),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, PR_SET_SECCOMP, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    has_landlock = syscall(SYS_landlock_create_ruleset, NULL, 0, 1) > 0;
    const bool is_filter = what && strcmp(what, "filter") == 0;
    struct sock_fprog program = {sizeof landlock / sizeof *landlock, landlock};
    if (is_filter) program = (struct sock_fprog){sizeof filter / sizeof *filter, filter};
    if (what && *what &&
        (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0))
        abort();
}
