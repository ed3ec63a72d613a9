/* Both ends of core/opener.h in one process: a thread opens, the test asks. */
#include "unit/check.h"

#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"
#include "core/opener.h"
#include "unit/folder.h"

static char top[] = "/tmp/gnomon-opener-XXXXXX", folder[64], model[64];
static int ends[2];
static pthread_t thread;
static struct gn_err err;

static void put(const char *name, const char *text) {
    char path[128];
    snprintf(path, sizeof path, "%s/%s", top, name);
    assert_true(gn_file_write(path, text, strlen(text), &err));
}

/* Until the other end is closed. */
static void *serve(void *user) {
    const struct gn_opener opener = {ends[0], folder, model};
    struct pollfd p = {.fd = ends[0], .events = POLLIN};
    (void)user;
    while (poll(&p, 1, 10000) == 1 && !(p.revents & POLLHUP)) gn_opener_serve(&opener);
    return NULL;
}

static void expect_text(const char *name, const char *text) {
    struct gn_bytes bytes;
    const int fd = gn_opener_ask(ends[1], name, &err);
    if (fd < 0) fail_msg("%s: %s", name, err.text);
    assert_int_equal(fcntl(fd, F_GETFD), FD_CLOEXEC);
    assert_int_equal(fcntl(fd, F_GETFL) & O_ACCMODE, O_RDONLY);
    assert_true(gn_file_read_fd(fd, name, 0, &bytes, &err));
    assert_string_equal(bytes.data, text);
    gn_bytes_finish(&bytes);
}

static void expect_refusal(const char *name, const char *why) {
    assert_int_equal(gn_opener_ask(ends[1], name, &err), -1);
    if (!strstr(err.text, why)) fail_msg("%.100s: \"%s\"", name, err.text);
}

static void files_of_the_folder_and_the_model_are_opened(void **state) {
    (void)state;
    expect_text("", "model");
    expect_text("a", "a");
    expect_text("sub/b", "b");
    expect_text("a", "a");
}

static void others_are_refused_with_the_reason(void **state) {
    (void)state;
    char name[PATH_MAX + 1];
    memset(name, 'x', sizeof name);
    name[PATH_MAX] = 0;
    expect_refusal(name, "File name too long");
    name[PATH_MAX - 1] = 0;
    expect_refusal(name, "File name too long");
    expect_refusal("../model", "leads outside");
    expect_refusal("/etc/passwd", "leads outside");
    expect_refusal("out", "leads outside");
    expect_refusal("sub", "is a folder");
    expect_refusal("fifo", "is a FIFO");
    expect_refusal("none", "No such file");
    expect_text("a", "a");
}

static int count_descriptors(void) {
    int count = 0;
    for (int fd = 0; fd < 256; fd++) count += fcntl(fd, F_GETFD) >= 0;
    return count;
}

/* Bytes that gn_opener_ask() never sends, descriptors, and replies that nobody reads. */
static void a_hostile_process_gets_no_more(void **state) {
    (void)state;
    char junk[2 * PATH_MAX], control[CMSG_SPACE(sizeof(int))] = {0};
    const int before = count_descriptors();
    const struct gn_opener opener = {ends[0], folder, model};
    memset(junk, 'a', sizeof junk);
    assert_int_equal(send(ends[1], junk, 1, 0), 1); /* no zero at its end */
    gn_opener_serve(&opener);
    assert_int_equal(send(ends[1], junk, sizeof junk, 0), sizeof junk);
    gn_opener_serve(&opener);
    assert_int_equal(send(ends[1], "", 0, 0), 0);
    gn_opener_serve(&opener);
    assert_int_equal(recv(ends[1], junk, sizeof junk, MSG_DONTWAIT), -1);

    struct iovec piece = {"none", 5};
    struct msghdr message = {.msg_iov = &piece,
                             .msg_iovlen = 1,
                             .msg_control = control,
                             .msg_controllen = sizeof control};
    *CMSG_FIRSTHDR(&message) = (struct cmsghdr){
        .cmsg_len = CMSG_LEN(sizeof(int)), .cmsg_level = SOL_SOCKET, .cmsg_type = SCM_RIGHTS};
    assert_int_equal(sendmsg(ends[1], &message, 0), 5); /* descriptor 0 */
    gn_opener_serve(&opener);
    assert_int_equal(count_descriptors(), before);

    alarm(10); /* it must not wait */
    for (int i = 0; i < 2000; i++)
        if (send(ends[1], "a", 2, MSG_DONTWAIT) == 2) gn_opener_serve(&opener);
    alarm(0);
    assert_int_equal(count_descriptors(), before);
    gn_opener_serve(&opener); /* nothing asked */
}

static int connect_ends(void **state) {
    (void)state;
    return socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends);
}

static int close_ends(void **state) {
    (void)state;
    close(ends[1]);
    return close(ends[0]);
}

static int start(void **state) {
    return connect_ends(state) == 0 && pthread_create(&thread, NULL, serve, NULL) == 0 ? 0 : -1;
}

static int stop(void **state) {
    (void)state;
    shutdown(ends[1], SHUT_RDWR);
    pthread_join(thread, NULL);
    return close_ends(state);
}

static int enter(void **state) {
    (void)state;
    char path[128];
    if (!mkdtemp(top)) return -1;
    snprintf(folder, sizeof folder, "%s/in", top);
    snprintf(model, sizeof model, "%s/model", top);
    mkdir(folder, 0700);
    snprintf(path, sizeof path, "%s/sub", folder);
    mkdir(path, 0700);
    snprintf(path, sizeof path, "%s/fifo", folder);
    mkfifo(path, 0600);
    snprintf(path, sizeof path, "%s/out", folder);
    (void)!symlink(model, path);
    put("model", "model");
    put("in/a", "a");
    put("in/sub/b", "b");
    return 0;
}

static int leave(void **state) {
    (void)state;
    return gn_test_remove_folder(top);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(files_of_the_folder_and_the_model_are_opened, start, stop),
        cmocka_unit_test_setup_teardown(others_are_refused_with_the_reason, start, stop),
        cmocka_unit_test_setup_teardown(a_hostile_process_gets_no_more, connect_ends, close_ends),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
