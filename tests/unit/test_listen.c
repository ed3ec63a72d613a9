#include "unit/check.h"

#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/control/listen.h"
#include "unit/control_help.h"

/* ---- the socket in the file system ---------------------------------------------------------- */

static void the_socket_is_for_its_group_alone(void **state) {
    struct stat info;
    (void)state;
    assert_int_equal(stat(gn_ctl_test.path, &info), 0);
    assert_true(S_ISSOCK(info.st_mode));
    assert_int_equal(info.st_mode & 07777, 0660);
    gn_control_close(gn_ctl_test.control);
    gn_ctl_test.control = NULL;
    assert_int_not_equal(access(gn_ctl_test.path, F_OK), 0);
    const mode_t mask = umask(0);
    gn_ctl_test.control = gn_control_open(gn_ctl_test.path, gn_ctl_test.loop, &gn_ctl_test.err);
    umask(0777);
    assert_int_equal(stat(gn_ctl_test.path, &info), 0);
    assert_int_equal(info.st_mode & 07777, 0660);
    gn_control_close(gn_ctl_test.control);
    gn_ctl_test.control = gn_control_open(gn_ctl_test.path, gn_ctl_test.loop, &gn_ctl_test.err);
    umask(mask);
    assert_true(gn_ctl_test.control && stat(gn_ctl_test.path, &info) == 0);
    assert_int_equal(info.st_mode & 07777, 0660);
}

static void a_living_socket_is_left_alone(void **state) {
    (void)state;
    assert_null(gn_control_open(gn_ctl_test.path, gn_ctl_test.loop, &gn_ctl_test.err));
    assert_non_null(strstr(gn_ctl_test.err.text, "in use by another kiosk"));
    const int fd = enter_client();
    say(fd, "{\"cmd\":\"status\"}\n");
    assert_int_equal(serve(), 1);
    close(fd);
    char other[100];
    snprintf(other, sizeof other, "%s/foreign", gn_ctl_test.folder);
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    snprintf(address.sun_path, sizeof address.sun_path, "%s", other);
    const int foreign = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_int_equal(bind(foreign, (struct sockaddr *)&address, sizeof address), 0);
    assert_int_equal(listen(foreign, 1), 0);
    assert_null(gn_control_open(other, gn_ctl_test.loop, &gn_ctl_test.err));
    assert_non_null(strstr(gn_ctl_test.err.text, "another program listens there"));
    assert_int_equal(access(other, F_OK), 0);
    close(foreign); /* as a process that is killed leaves it */
    struct gn_control *second = gn_control_open(other, gn_ctl_test.loop, &gn_ctl_test.err);
    assert_non_null(second);
    gn_control_close(second);
    assert_int_not_equal(access(other, F_OK), 0);
}

static void what_a_killed_kiosk_leaves_is_replaced(void **state) {
    (void)state;
    char left[100];
    int ready[2];
    snprintf(left, sizeof left, "%s/left", gn_ctl_test.folder);
    assert_int_equal(pipe(ready), 0);
    const pid_t pid = fork();
    if (pid == 0) {
        const bool made = gn_control_open(left, gn_loop_open(NULL), NULL);
        if (write(ready[1], &made, 1) == 1) pause();
        _exit(1);
    }
    char made = 0;
    assert_int_equal(read(ready[0], &made, 1), 1);
    assert_int_equal(made, 1);
    assert_null(gn_control_open(left, gn_ctl_test.loop, &gn_ctl_test.err));
    kill(pid, SIGKILL);
    waitpid(pid, NULL, 0);
    assert_int_equal(access(left, F_OK), 0);
    struct gn_control *second = gn_control_open(left, gn_ctl_test.loop, &gn_ctl_test.err);
    assert_non_null(second);
    const int fd = connect_to(left);
    assert_true(fd >= 0);
    close(fd);
    gn_control_close(second);
    close(ready[0]);
    close(ready[1]);
}

static void what_is_no_socket_stays(void **state) {
    char file[100], deep[200];
    (void)state;
    snprintf(file, sizeof file, "%s/file", gn_ctl_test.folder);
    close(open(file, O_CREAT | O_WRONLY, 0600));
    assert_null(gn_control_open(file, gn_ctl_test.loop, &gn_ctl_test.err));
    assert_non_null(strstr(gn_ctl_test.err.text, "path exists and is not a socket"));
    assert_int_equal(access(file, F_OK), 0);
    snprintf(deep, sizeof deep, "%s/no/such/ctl", gn_ctl_test.folder);
    assert_null(gn_control_open(deep, gn_ctl_test.loop, &gn_ctl_test.err));
    assert_non_null(strstr(gn_ctl_test.err.text, "cannot create it"));
    memset(deep, 'x', 150);
    deep[150] = '\0';
    assert_null(gn_control_open(deep, gn_ctl_test.loop, &gn_ctl_test.err));
    assert_non_null(strstr(gn_ctl_test.err.text, "longer than 107 bytes"));
    snprintf(deep, sizeof deep, "%s/new/ctl", gn_ctl_test.folder);
    struct gn_control *second = gn_control_open(deep, gn_ctl_test.loop, &gn_ctl_test.err);
    assert_non_null(second);
    struct stat info;
    snprintf(file, sizeof file, "%s/new", gn_ctl_test.folder);
    assert_int_equal(stat(file, &info), 0);
    assert_int_equal(info.st_mode & 07777, 0700);
    gn_control_close(second);
}

/* ---- who may come in ------------------------------------------------------------------------ */

enum { NOBODY = 65534 };

/* As a child of that user and groups, which leaves what it heard in a pipe. */
static void ask_as(uid_t uid, gid_t gid, gid_t second, char *out, size_t size) {
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    const pid_t pid = fork();
    if (pid == 0) {
        char text[300] = "no connection";
        const gid_t groups[] = {second};
        if (setgroups(second ? 1 : 0, groups) != 0 || setgid(gid) != 0 || setuid(uid) != 0)
            _exit(1);
        const int fd = connect_to(gn_ctl_test.path);
        if (fd >= 0 && send(fd, "{\"cmd\":\"status\"}\n", 17, MSG_NOSIGNAL) <= 17) {
            struct pollfd p = {.fd = fd, .events = POLLIN};
            poll(&p, 1, 5000);
            const ssize_t got = recv(fd, text, sizeof text - 1, 0);
            text[got > 0 ? got : 0] = '\0';
        }
        _exit(write(ends[1], text, strlen(text)) < 0);
    }
    close(ends[1]);
    struct pollfd p = {.fd = ends[0], .events = POLLIN};
    for (int i = 0; i < 500 && poll(&p, 1, 10) == 0; i++) serve();
    const ssize_t got = read(ends[0], out, size - 1);
    out[got > 0 ? got : 0] = '\0';
    close(ends[0]);
    waitpid(pid, NULL, 0);
}

static void who_is_not_permitted_is_turned_away(void **state) {
    char text[300];
    (void)state;
    if (geteuid() != 0) skip();
    assert_int_equal(chmod(gn_ctl_test.folder, 0755), 0);
    assert_int_equal(chown(gn_ctl_test.path, 0, 4242), 0); /* as the file of another group */
    gn_control_close(gn_ctl_test.control);
    assert_int_equal(chown(gn_ctl_test.folder, 0, 4242), 0);
    assert_int_equal(chmod(gn_ctl_test.folder, 02755),
                     0); /* the socket belongs to the folder's group */
    gn_ctl_test.control = gn_control_open(gn_ctl_test.path, gn_ctl_test.loop, &gn_ctl_test.err);
    assert_non_null(gn_ctl_test.control);

    ask_as(NOBODY, NOBODY, 0, text, sizeof text);
    assert_string_equal(text, "no connection");         /* the file's mode keeps it out */
    assert_int_equal(chmod(gn_ctl_test.path, 0666), 0); /* and if somebody opens that */
    ask_as(NOBODY, NOBODY, 0, text, sizeof text);
    assert_non_null(strstr(text, "{\"ok\":false,\"error\":\"permission denied: user 65534"));
    assert_int_equal(gn_control_counts(gn_ctl_test.control).accepted, 0);
    assert_int_equal(gn_control_counts(gn_ctl_test.control).refused, 1);
    ask_as(NOBODY, 4242, 0, text, sizeof text);
    assert_non_null(strstr(text, "\"ok\":true"));
    ask_as(NOBODY, NOBODY, 4242, text, sizeof text);
    assert_non_null(strstr(text, "\"ok\":true"));
    ask_as(NOBODY, NOBODY, 4243, text, sizeof text);
    assert_non_null(strstr(text, "\"ok\":false"));
    ask_as(0, NOBODY, 0, text, sizeof text);
    assert_non_null(strstr(text, "\"ok\":true"));
    assert_int_equal(chmod(gn_ctl_test.path, 0660), 0);
    ask_as(NOBODY, NOBODY, 4242, text, sizeof text); /* the mode lets the group in */
    assert_non_null(strstr(text, "\"ok\":true"));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, gn_ctl_test_open, gn_ctl_test_close)

int main(void) {
    signal(SIGPIPE, SIG_IGN);
    const struct CMUnitTest tests[] = {
        TEST(the_socket_is_for_its_group_alone),      TEST(a_living_socket_is_left_alone),
        TEST(what_a_killed_kiosk_leaves_is_replaced), TEST(what_is_no_socket_stays),
        TEST(who_is_not_permitted_is_turned_away),
    };
    return cmocka_run_group_tests(tests, gn_ctl_test_begin, gn_ctl_test_end);
}
