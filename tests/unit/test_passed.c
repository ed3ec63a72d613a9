/* Descriptors that come over a control socket. */
#include "unit/check.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "unit/control_help.h"

static void pass(int fd, const char *text, const int *fds, int count) {
    char control[CMSG_SPACE(8 * sizeof(int))] = {0};
    struct iovec piece = {(void *)text, strlen(text)};
    struct msghdr message = {.msg_iov = &piece,
                             .msg_iovlen = 1,
                             .msg_control = control,
                             .msg_controllen = CMSG_SPACE((size_t)count * sizeof *fds)};
    struct cmsghdr *header = CMSG_FIRSTHDR(&message);
    header->cmsg_len = CMSG_LEN((size_t)count * sizeof *fds);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    memcpy(CMSG_DATA(header), fds, (size_t)count * sizeof *fds);
    assert_int_equal(sendmsg(fd, &message, MSG_NOSIGNAL), piece.iov_len);
}

static int open_descriptors(void) {
    int count = 0;
    for (int fd = 0; fd < 256; fd++) count += fcntl(fd, F_GETFD) >= 0;
    return count;
}

static bool is_same_file(int a, int b) {
    struct stat x, y;
    return fstat(a, &x) == 0 && fstat(b, &y) == 0 && x.st_ino == y.st_ino && x.st_dev == y.st_dev;
}

static void a_descriptor_goes_with_the_request_that_wants_one(void **state) {
    (void)state;
    static const char shot[] = "{\"cmd\":\"screenshot\",\"file\":\"/x.png\"}\n";
    struct gn_control *control = gn_ctl_test.control;
    int files[8];
    for (int i = 0; i < 8; i++) files[i] = memfd_create("test", MFD_CLOEXEC);
    const int fd = enter_client();
    step();
    const int before = open_descriptors();

    say(fd, "{\"cmd\":\"status\"}\n");
    pass(fd, shot, &files[0], 1);
    step();
    const struct gn_request *r = gn_control_next(control);
    assert_int_equal(r->fd, -1);
    gn_control_answer(control, r, json_object());
    step();
    r = gn_control_next(control);
    assert_int_equal(r->command, GN_CTL_SCREENSHOT);
    assert_true(is_same_file(r->fd, files[0]) && fcntl(r->fd, F_GETFD) == FD_CLOEXEC);
    gn_control_answer(control, r, json_object());
    assert_int_equal(open_descriptors(), before);

    /* the next has none; of many one is kept, and what nobody wants goes with the client */
    say(fd, shot);
    step();
    r = gn_control_next(control);
    assert_int_equal(r->fd, -1);
    gn_control_answer(control, r, json_object());
    for (int i = 0; i < 20; i++) {
        pass(fd, "{\"cmd\":\"status\"}\n", files, 8);
        serve();
    }
    assert_true(open_descriptors() <= before + 1);
    pass(fd, shot, &files[3], 1);
    step();
    r = gn_control_next(control);
    assert_true(is_same_file(r->fd, files[3]));
    gn_control_answer(control, r, json_object());
    pass(fd, "{}\n", files, 2);
    serve();
    close(fd);
    serve();
    assert_int_equal(open_descriptors(), before - 2); /* both ends of the connection */
    for (int i = 0; i < 8; i++) close(files[i]);
}

/* In place of libc's: closing a pipe takes as long as a user's file system that does not answer,
 * and closing much memory, or a socket with messages, as if much memory were freed. */
static bool close_is_slow;
static int slow_here; /* how often the thread of the loop waited for one */
int close(int fd) {
    struct stat info;
    char byte;
    if (close_is_slow && fstat(fd, &info) == 0 &&
        (S_ISFIFO(info.st_mode) || (S_ISREG(info.st_mode) && info.st_blocks > 65536) ||
         (S_ISSOCK(info.st_mode) && recv(fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0))) {
        slow_here += gettid() == getpid();
        usleep(300000);
    }
    return (int)syscall(SYS_close, fd);
}

static void a_descriptor_that_is_slow_to_close_keeps_nobody_waiting(void **state) {
    (void)state;
    int pipes[2];
    assert_int_equal(pipe(pipes), 0);
    const int fd = enter_client();
    serve();
    const int before = open_descriptors();
    close_is_slow = true;
    for (int i = 0; i < 50; i++) {
        pass(fd, "{\"cmd\":\"status\"}\n", &pipes[1], 1);
        assert_int_equal(serve(), 1);
    }
    assert_int_equal(slow_here, 0);
    assert_int_equal(count_lines(heard(fd)), 50);
    assert_in_range(open_descriptors() - before, 1, 8);
    close_is_slow = false;
    for (int i = 0; i < 100 && open_descriptors() != before; i++) usleep(50000);
    assert_int_equal(open_descriptors(), before);
    close(pipes[0]);
    close(pipes[1]);
    close(fd);
}

static void much_memory_is_closed_aside(void **state) {
    (void)state;
    static const char shot[] = "{\"cmd\":\"screenshot\",\"file\":\"/x.png\"}\n";
    int files[2];
    const int fd = enter_client();
    serve();
    const int before = open_descriptors();
    for (int i = 0; i < 2; i++) {
        files[i] = memfd_create("test", MFD_CLOEXEC);
        assert_int_equal(fallocate(files[i], 0, 0, 40 << 20), 0);
    }
    close_is_slow = true;
    pass(fd, shot, files, 2); /* one too many */
    assert_int_equal(serve(), 1);
    pass(fd, "{\"cmd\":\"status\"}\n", files, 1); /* and one for nothing */
    assert_int_equal(serve(), 1);
    close_is_slow = false;
    close(files[0]);
    close(files[1]);
    close(fd);
    close_is_slow = true;
    serve();
    assert_int_equal(slow_here, 0);
    close_is_slow = false;
    for (int i = 0; i < 100 && open_descriptors() != before - 2; i++) usleep(50000);
    assert_int_equal(open_descriptors(), before - 2);
}

static void what_a_refused_client_sent_is_closed_aside(void **state) {
    (void)state;
    const int places = GN_CONTROL_CLIENTS_MAX;
    const int file = memfd_create("test", MFD_CLOEXEC);
    int fds[GN_CONTROL_CLIENTS_MAX];
    for (int i = 0; i < places; i++) {
        fds[i] = enter_client();
        serve();
    }
    const int before = open_descriptors(), late = connect_to(gn_ctl_test.path);
    pass(late, "{}\n", &file, 1);
    close_is_slow = true;
    serve();
    assert_int_equal(slow_here, 0);
    close_is_slow = false;
    assert_non_null(strstr(heard(late), "busy"));
    for (int i = 0; i < 100 && open_descriptors() != before + 1; i++) usleep(50000);
    assert_int_equal(open_descriptors(), before + 1);
    close(late);
    close(file);
    for (int i = 0; i < places; i++) close(fds[i]);
}

static void a_request_that_is_never_answered_keeps_no_descriptor(void **state) {
    (void)state;
    const int file = memfd_create("test", MFD_CLOEXEC), fd = enter_client();
    step();
    const int before = open_descriptors();
    pass(fd, "{\"cmd\":\"screenshot\",\"file\":\"/x.png\"}\n", &file, 1);
    step();
    assert_int_equal(open_descriptors(), before + 1);
    assert_non_null(gn_control_next(gn_ctl_test.control));
    gn_ctl_test_close(NULL);
    gn_ctl_test_open(NULL);
    assert_int_equal(open_descriptors(), before - 1);
    close(fd);
    close(file);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, gn_ctl_test_open, gn_ctl_test_close)

int main(void) {
    signal(SIGPIPE, SIG_IGN);
    const struct CMUnitTest tests[] = {
        TEST(a_descriptor_goes_with_the_request_that_wants_one),
        TEST(a_descriptor_that_is_slow_to_close_keeps_nobody_waiting),
        TEST(much_memory_is_closed_aside),
        TEST(what_a_refused_client_sent_is_closed_aside),
        TEST(a_request_that_is_never_answered_keeps_no_descriptor),
    };
    return cmocka_run_group_tests(tests, gn_ctl_test_begin, gn_ctl_test_end);
}
