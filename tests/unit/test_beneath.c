/* Confinement to the model's folder: with openat2(), and where the kernel or a filter of system
 * calls hides it. Each case runs in a child, because such a filter cannot be taken away again. */
#include "unit/check.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/beneath.h"
#include "core/file.h"
#include "scene/scene.h"
#include "unit/folder.h"

static char top[] = "/tmp/gnomon-beneath-XXXXXX", folder[64];

static void put(const char *name, const char *text) {
    char path[256];
    struct gn_err err = {0};
    snprintf(path, sizeof path, "%s/%s", top, name);
    assert_true(gn_file_write(path, text, strlen(text), &err));
}

static void link_to(const char *name, const char *prefix, const char *target) {
    char path[256], full[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    snprintf(full, sizeof full, "%s%s", prefix, target);
    assert_int_equal(symlink(full, path), 0);
}

/* Makes 15 nested folders in `at`, a link `name` to the deepest; returns a descriptor of it. */
static int add_depth(int at, const char *name) {
    char part[250], target[15 * 250 + 1] = "";
    memset(part, 'd', sizeof part);
    part[sizeof part - 1] = 0;
    int inner = dup(at);
    for (int i = 0; i < 15; i++) {
        assert_int_equal(mkdirat(inner, part, 0700), 0);
        const int next = openat(inner, part, O_PATH | O_DIRECTORY);
        close(inner);
        inner = next;
        strcat(strcat(target, i ? "/" : ""), part);
    }
    assert_int_equal(symlinkat(target, at, name), 0);
    return inner;
}

static int enter(void **state) {
    (void)state;
    if (!mkdtemp(top)) return -1;
    snprintf(folder, sizeof folder, "%s/in", top);
    char path[256];
    mkdir(folder, 0700);
    snprintf(path, sizeof path, "%s/sub", folder);
    mkdir(path, 0700);
    snprintf(path, sizeof path, "%s/intruder", top); /* its path begins as the folder's does */
    mkdir(path, 0700);
    put("secret", "secret");
    put("intruder/secret", "secret");
    put("in/a", "inside");
    put("in/sub/b", "inside");
    put("in/twice", "inside");
    put("in/TWICE", "inside");
    put("in/deep.gltf", "{\"asset\":{\"version\":\"2.0\"},"
                        "\"buffers\":[{\"uri\":\"one/two/out\",\"byteLength\":4}]}");
    link_to("near", "", "sub/b");
    link_to("far", folder, "/sub/b"); /* absolute, and inside */
    link_to("round", "../in/", "a");
    link_to("up", "../", "secret");
    link_to("out", top, "/secret");
    link_to("twin", top, "/intruder");
    link_to("magic", "/proc/self/", "root");
    link_to("loop", "", "loop");
    link_to("none", "", "nowhere");
    snprintf(path, sizeof path, "%s/fifo", folder);
    mkfifo(path, 0600);
    snprintf(path, sizeof path, "%s/secret", top); /* by way of a path over PATH_MAX */
    const int at = open(folder, O_PATH | O_DIRECTORY);
    const int one = add_depth(at, "one"), two = add_depth(one, "two");
    assert_int_equal(symlinkat(path, two, "out"), 0);
    close(two);
    close(one);
    close(at);
    return 0;
}

static int leave(void **state) {
    (void)state;
    return gn_test_remove_folder(top);
}

/* openat2() fails from now on. */
static bool hide_openat2(int reason) {
    struct sock_filter code[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat2, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | (uint32_t)reason),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
    const struct sock_fprog program = {sizeof code / sizeof code[0], code};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0 &&
           syscall(SYS_openat2, -1, "", NULL, 0) < 0 && errno == reason;
}

static int try_names(void) {
    static const struct {
        const char *name, *message; /* message NULL: reads "inside" */
    } cases[] = {
        {"a", NULL},
        {"sub/b", NULL},
        {"sub/../a", NULL},
        {"near", NULL},
        {"far", NULL},
        {"round", NULL},
        {"A", NULL},
        {"Sub/B", NULL},
        {"SUB/../a", NULL},
        {"Twice", "in/Twice: cannot open: No such file"}, /* there are twice and TWICE */
        {"TWIN/secret", "leads outside the model's folder"},
        {"up", "'up' leads outside the model's folder"},
        {"out", "'out' leads outside the model's folder"},
        {"../secret", "leads outside the model's folder"},
        {"sub/../../secret", "leads outside the model's folder"},
        {"twin/secret", "leads outside the model's folder"},
        {"one/two/out", "leads outside the model's folder"},
        {"magic/etc/passwd", "leads outside the model's folder"},
        {"/etc/passwd", "leads outside the model's folder"},
        {"loop", "in/loop: cannot open: Too many levels"},
        {"none", "in/none: cannot open: No such file"},
        {"gone", "in/gone: cannot open: No such file"},
        {"fifo", "is a FIFO, not a file"},
        {"sub", "is a folder, not a file"},
    };
    int wrong = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct gn_bytes bytes = {0};
        struct gn_err err = {0};
        const int fd = gn_file_open_beneath(folder, cases[i].name, &err);
        const bool ok = fd >= 0 && gn_file_read_fd(fd, cases[i].name, 100, &bytes, &err);
        const char *got = ok ? (const char *)bytes.data : err.text;
        const char *message = cases[i].message ? cases[i].message : "inside";
        if (ok != !cases[i].message || !strstr(got, message)) {
            fprintf(stderr, "%s: \"%s\", expected \"%s\"\n", cases[i].name, got, message);
            wrong++;
        }
        gn_bytes_finish(&bytes);
    }
    return wrong;
}

/* reason: of the failing openat2(); 0: as the kernel has it */
static void run_case(int reason) {
    const pid_t pid = fork();
    assert_true(pid >= 0);
    if (pid == 0) _exit(reason && !hide_openat2(reason) ? 99 : try_names());
    int status;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

static void only_files_of_the_folder_are_read(void **state) {
    (void)state;
    run_case(0);
}

static void so_it_is_on_an_older_kernel(void **state) {
    (void)state;
    run_case(ENOSYS);
}

static void so_it_is_where_openat2_is_forbidden(void **state) {
    (void)state;
    run_case(EPERM);
}

/* realpath() fails with ENAMETOOLONG on this path, and open() does not */
static void a_scene_cannot_lead_out_by_a_long_path(void **state) {
    (void)state;
    char path[128];
    struct gn_err err = {0};
    snprintf(path, sizeof path, "%s/deep.gltf", folder);
    assert_null(gn_scene_load(path, NULL, NULL, &err));
    if (!strstr(err.text, "'one/two/out' leads outside the model's folder"))
        fail_msg("\"%s\"", err.text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_files_of_the_folder_are_read),
        cmocka_unit_test(so_it_is_on_an_older_kernel),
        cmocka_unit_test(so_it_is_where_openat2_is_forbidden),
        cmocka_unit_test(a_scene_cannot_lead_out_by_a_long_path),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
