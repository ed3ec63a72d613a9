/* The sandbox of gnomon-import's child: this program enters it and tries to get out, with all
 * layers and with each of them hidden from it, as on a kernel that does not have it. */
#include "unit/check.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/file.h"
#include "core/opener.h"
#include "core/sandbox.h"
#include "unit/folder.h"

static char top[] = "/tmp/gnomon-sandbox-XXXXXX";
static int port, memory, asked; /* a listener on this machine; the output; to an opener of files */
static pid_t parent;
static bool has_nobody; /* root can become that user; a container may have none */

static const char *in_top(const char *name) {
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", top, name);
    return path;
}

/* ---- attempts: true when it worked ----------------------------------------------------------- */

static bool can_open(const char *path, int flags) {
    const int fd = open(path, flags, 0600);
    char byte;
    return fd >= 0 &&
           ((flags & O_ACCMODE) != O_RDONLY || flags & O_CREAT || read(fd, &byte, 1) == 1);
}

/* What core/opener.h needs; its tests are in test_opener.c. */
static bool gets_descriptors(void) {
    char byte;
    const int fd = gn_opener_ask(asked, "model", NULL);
    return fd >= 0 && read(fd, &byte, 1) == 1;
}
static bool gets_others(void) { return gn_opener_ask(asked, "../secret", NULL) >= 0; }
static bool computes(void) {
    char *data = malloc(32 << 20);
    if (data) memset(data, 1, 32 << 20);
    return data != NULL;
}
static bool writes_its_output(void) {
    return write(memory, "out", 3) == 3 && lseek(memory, 0, SEEK_SET) == 0;
}

static bool reads_passwd(void) { return can_open("/etc/passwd", O_RDONLY); }
static bool reads_a_model(void) { return can_open(in_top("in/model"), O_RDONLY); }
static bool lists_a_folder(void) {
    char entries[512];
    const int fd = open(top, O_RDONLY | O_DIRECTORY);
    return fd >= 0 && syscall(SYS_getdents64, fd, entries, sizeof entries) > 0;
}
static bool reads_by_openat2(void) {
    const uint64_t how[3] = {O_RDONLY};
    return syscall(SYS_openat2, AT_FDCWD, in_top("in/model"), how, sizeof how) >= 0;
}
static bool writes_into_its_folder(void) { return can_open(in_top("in/model"), O_WRONLY); }
static bool makes_a_file(void) { return can_open(in_top("in/new"), O_WRONLY | O_CREAT); }
static bool makes_a_file_at_home(void) {
    return can_open(getenv("HOME") ? getenv("HOME") : "/tmp", O_RDWR | O_TMPFILE);
}
static bool truncates(void) { return can_open(in_top("in/model"), O_RDONLY | O_TRUNC); }
static bool unlinks(void) { return unlink(in_top("in/victim")) == 0; }
static bool changes_a_mode(void) { return chmod(in_top("in/model"), 0777) == 0; }
static bool writes_by_openat2(void) {
    const uint64_t how[3] = {O_WRONLY};
    return syscall(SYS_openat2, AT_FDCWD, in_top("in/model"), how, sizeof how) >= 0;
}
static bool connects(void) {
    struct sockaddr_in to = {.sin_family = AF_INET,
                             .sin_port = htons((uint16_t)port),
                             .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    return fd >= 0 && connect(fd, (struct sockaddr *)&to, sizeof to) == 0;
}
static bool connects_to_a_socket_file(void) {
    struct sockaddr_un to = {.sun_family = AF_UNIX};
    snprintf(to.sun_path, sizeof to.sun_path, "%s", in_top("socket"));
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    return fd >= 0 && connect(fd, (struct sockaddr *)&to, sizeof to) == 0;
}
static bool executes(void) {
    char *const args[] = {"true", NULL};
    execv("/bin/true", args); /* ends the program, with status 0, if it can */
    return false;
}
static bool forks(void) {
    const pid_t pid = fork();
    if (pid == 0) _exit(0);
    return pid > 0 && waitpid(pid, NULL, 0) == pid; /* SIGCHLD would stop it once it is traced */
}
static bool traces(void) { return ptrace(PTRACE_TRACEME, 0, NULL, NULL) == 0; }
static bool traces_its_parent(void) { return ptrace(PTRACE_SEIZE, parent, NULL, NULL) == 0; }
static bool signals_its_parent(void) { return kill(parent, 0) == 0; }
static bool makes_code(void) {
    return mmap(NULL, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1,
                0) != MAP_FAILED;
}
static bool has_capabilities(void) {
    return prctl(PR_CAPBSET_DROP, 0) == 0 || setgid(0) == 0 || sethostname("x", 1) == 0 ||
           unshare(CLONE_NEWUSER) == 0;
}
static bool has_other_descriptors(void) {
    for (int fd = 3; fd < 200; fd++)
        if (fd != memory && fd != asked && fcntl(fd, F_GETFD) >= 0) return true;
    return false;
}
static bool is_root(void) { return has_nobody && (getuid() == 0 || geteuid() == 0); }

enum { LANDLOCK = GN_SANDBOX_LANDLOCK, FILTER = GN_SANDBOX_FILTER, ALWAYS = 4 };
static const struct attempt {
    const char *name;
    bool (*try)(void);
    int by; /* any of these layers is enough against it; 0: it must work; ALWAYS: none is needed */
} attempts[] = {
#define TRY(function, by)                                                                          \
    { #function, function, by }
    TRY(has_other_descriptors, ALWAYS), /* the first: others leave some */
    TRY(computes, 0),
    TRY(gets_descriptors, 0),
    TRY(gets_others, ALWAYS),
    TRY(writes_its_output, 0),
    TRY(is_root, ALWAYS),
    TRY(reads_passwd, LANDLOCK | FILTER),
    TRY(reads_a_model, LANDLOCK | FILTER),
    TRY(reads_by_openat2, LANDLOCK | FILTER),
    TRY(lists_a_folder, LANDLOCK | FILTER),
    TRY(writes_into_its_folder, LANDLOCK | FILTER),
    TRY(makes_a_file, LANDLOCK | FILTER),
    TRY(makes_a_file_at_home, LANDLOCK | FILTER),
    TRY(truncates, LANDLOCK | FILTER),
    TRY(writes_by_openat2, LANDLOCK | FILTER),
    TRY(unlinks, LANDLOCK | FILTER),
    TRY(executes, LANDLOCK | FILTER),
    TRY(changes_a_mode, FILTER),
    TRY(connects, FILTER),
    TRY(connects_to_a_socket_file, FILTER),
    TRY(forks, FILTER),
    TRY(traces, FILTER),
    TRY(traces_its_parent, FILTER),
    TRY(signals_its_parent, FILTER),
    TRY(makes_code, FILTER),
    TRY(has_capabilities, FILTER),
#undef TRY
};
enum { ATTEMPTS = sizeof attempts / sizeof attempts[0] };

/* ---- the child ------------------------------------------------------------------------------- */

static struct shared {
    int in_force, tried;
    bool worked[ATTEMPTS], has_none; /* has_none: no capabilities */
    struct gn_err err;
} * shared;

/* Those system calls fail with ENOSYS from now on, and so a layer is not there. */
static bool hide(int layers) {
    struct sock_filter code[16] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr))};
    unsigned short n = 1;
    if (layers & LANDLOCK) {
        code[n++] =
            (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ, SYS_landlock_create_ruleset, 0, 1);
        code[n++] = (struct sock_filter)BPF_STMT(BPF_RET, SECCOMP_RET_ERRNO | ENOSYS);
    }
    if (layers & FILTER) {
        code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ, SYS_seccomp, 0, 1);
        code[n++] = (struct sock_filter)BPF_STMT(BPF_RET, SECCOMP_RET_ERRNO | ENOSYS);
        code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ, SYS_prctl, 0, 3);
        code[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS,
                                                 offsetof(struct seccomp_data, args[0]));
        code[n++] = (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ, PR_SET_SECCOMP, 0, 1);
        code[n++] = (struct sock_filter)BPF_STMT(BPF_RET, SECCOMP_RET_ERRNO | EINVAL);
    }
    code[n++] = (struct sock_filter)BPF_STMT(BPF_RET, SECCOMP_RET_ALLOW);
    const struct sock_fprog program = {n, code};
    return !layers || (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
                       prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0);
}

static bool is_powerless(void) {
    struct __user_cap_header_struct header = {.version = _LINUX_CAPABILITY_VERSION_3};
    struct __user_cap_data_struct data[2] = {{0}};
    if (syscall(SYS_capget, &header, data) != 0) return false;
    for (int i = 0; i < 2; i++)
        if (data[i].effective || data[i].permitted || data[i].inheritable) return false;
    return prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) == 1;
}

static void run_child(int hidden, int from) {
    const int kept[2] = {memory, asked};
    if (!hide(hidden)) _exit(9);
    shared->in_force = gn_sandbox_enter(kept, &shared->err);
    if (shared->in_force >= 0 && !(shared->in_force & FILTER)) shared->has_none = is_powerless();
    for (int i = from; shared->in_force >= 0 && i < ATTEMPTS; i++) {
        shared->tried = i;
        shared->worked[i] = attempts[i].try();
    }
    shared->tried = ATTEMPTS;
    _exit(0);
}

static void put(const char *name, const char *text) {
    struct gn_err err = {0};
    assert_true(gn_file_write(in_top(name), text, strlen(text), &err));
}

/* Tries all with those layers hidden; an attempt that ends the child is one that worked. */
static void try_all(int hidden) {
    int ends[2];
    char in[64];
    *shared = (struct shared){0};
    snprintf(in, sizeof in, "%s/in", top);
    assert_int_equal(socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends), 0);
    asked = ends[1];
    put("in/model", "model"); /* an earlier one may have got at it */
    put("in/victim", "victim");
    chmod(in_top("in/model"), 0666); /* nobody may, too: it is not these bits that refuse */
    for (int from = 0; from < ATTEMPTS; from = shared->tried + 1) {
        int status;
        shared->tried = -1;
        const pid_t pid = fork();
        if (pid == 0) run_child(hidden, from);
        const struct gn_opener opener = {ends[0], in, NULL};
        while (waitpid(pid, &status, WNOHANG) == 0) {
            struct pollfd p = {.fd = ends[0], .events = POLLIN};
            if (poll(&p, 1, 1) == 1) gn_opener_serve(&opener);
        }
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        assert_true(shared->tried >= 0);
        if (shared->tried < ATTEMPTS) shared->worked[shared->tried] = true;
    }
    close(ends[0]);
    close(ends[1]);
    if (shared->in_force < 0) fail_msg("%s", shared->err.text);
    assert_int_equal(shared->in_force & hidden, 0);
    int wrong = 0;
    for (int i = 0; i < ATTEMPTS; i++) {
        const bool must_work = attempts[i].by == 0,
                   must_not = attempts[i].by & (shared->in_force | ALWAYS);
        if ((must_work && !shared->worked[i]) || (must_not && shared->worked[i])) {
            fprintf(stderr, "layers %d: %s %s\n", shared->in_force, attempts[i].name,
                    must_work ? "does not work" : "works");
            wrong++;
        }
    }
    assert_int_equal(wrong, 0);
}

/* ---- tests ----------------------------------------------------------------------------------- */

static void nothing_gets_out_of_all_layers(void **state) {
    (void)state;
    try_all(0);
    printf("layers in force: %d\n", shared->in_force);
}

static void without_landlock_no_file_is_opened_and_nothing_sent(void **state) {
    (void)state;
    try_all(LANDLOCK);
}

static void without_a_filter_no_file_is_read_or_written(void **state) {
    (void)state;
    try_all(FILTER);
    assert_true(shared->has_none);
}

static void without_either_it_has_no_capabilities(void **state) {
    (void)state;
    try_all(LANDLOCK | FILTER);
    assert_int_equal(shared->in_force, 0);
    for (int i = 0; i < ATTEMPTS; i++) { /* the attempts are such as work */
        const char *name = attempts[i].name;
        if (strcmp(name, "reads_passwd") == 0 || strcmp(name, "writes_into_its_folder") == 0 ||
            strcmp(name, "forks") == 0 || strcmp(name, "executes") == 0 ||
            strcmp(name, "makes_code") == 0 || strcmp(name, "connects_to_a_socket_file") == 0)
            assert_true(shared->worked[i]);
    }
    assert_true(shared->has_none);
}

/* The kernel forgets PR_SET_PDEATHSIG when rights change. */
static void it_still_dies_with_its_parent(void **state) {
    (void)state;
    int ends[2], status;
    char byte;
    assert_int_equal(pipe(ends), 0);
    const pid_t middle = fork();
    if (middle == 0) {
        if (fork() == 0) {
            const int kept[2] = {ends[1], -1};
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            gn_sandbox_enter(kept, NULL);
            (void)!write(ends[1], "x", 1);
            for (;;) sleep(1);
        }
        close(ends[1]);
        _exit(read(ends[0], &byte, 1) == 1 ? 0 : 1); /* now it is inside */
    }
    close(ends[1]);
    assert_int_equal(waitpid(middle, &status, 0), middle);
    assert_int_equal(status, 0);
    alarm(10);
    assert_int_equal(read(ends[0], &byte, 1), 0); /* its end is closed */
    alarm(0);
    close(ends[0]);
}

static int enter(void **state) {
    (void)state;
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    struct sockaddr_un file = {.sun_family = AF_UNIX};
    socklen_t size = sizeof at;
    if (!mkdtemp(top)) return -1;
    chmod(top, 0755);
    mkdir(in_top("in"), 0755);
    chmod(in_top("in"), 0777);
    put("secret", "secret");
    parent = getpid();
    memory = memfd_create("test", MFD_CLOEXEC);
    const int listener = socket(AF_INET, SOCK_STREAM, 0);
    if (bind(listener, (struct sockaddr *)&at, sizeof at) != 0 || listen(listener, 99) != 0 ||
        getsockname(listener, (struct sockaddr *)&at, &size) != 0)
        return -1;
    port = ntohs(at.sin_port);
    const int listener2 = socket(AF_UNIX, SOCK_STREAM, 0);
    snprintf(file.sun_path, sizeof file.sun_path, "%s", in_top("socket"));
    if (bind(listener2, (struct sockaddr *)&file, sizeof file) != 0 || listen(listener2, 99) != 0)
        return -1;
    chmod(in_top("socket"), 0666);
    int status = 1;
    const pid_t pid = fork();
    if (pid == 0) _exit(setresuid(65534, 65534, 65534) != 0);
    waitpid(pid, &status, 0);
    has_nobody = status == 0;
    shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return shared == MAP_FAILED ? -1 : 0;
}

static int leave(void **state) {
    (void)state;
    return gn_test_remove_folder(top);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_gets_out_of_all_layers),
        cmocka_unit_test(without_landlock_no_file_is_opened_and_nothing_sent),
        cmocka_unit_test(without_a_filter_no_file_is_read_or_written),
        cmocka_unit_test(without_either_it_has_no_capabilities),
        cmocka_unit_test(it_still_dies_with_its_parent),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
