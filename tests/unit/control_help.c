#include "unit/control_help.h"

#include <dirent.h>
#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "core/clock.h"
#include "unit/check.h"
#include "unit/folder.h"

struct gn_ctl_test gn_ctl_test;

int connect_to(const char *path) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    snprintf(address.sun_path, sizeof address.sun_path, "%s", path);
    if (connect(fd, (struct sockaddr *)&address, sizeof address) == 0) return fd;
    close(fd);
    return -1;
}

int enter_client(void) {
    const int fd = connect_to(gn_ctl_test.path);
    if (fd < 0) fail_msg("connect: %s", strerror(errno));
    return fd;
}

bool is_readable(int fd) {
    struct pollfd p = {.fd = fd, .events = POLLIN};
    return poll(&p, 1, 0) == 1;
}

bool step(void) { return gn_loop_step(gn_ctl_test.loop, gn_ctl_test.now_ns) > 0; }

int serve(void) {
    struct gn_control *control = gn_ctl_test.control;
    int answered = 0;
    while (step())
        for (const struct gn_request *r; (r = gn_control_next(control)) != NULL; answered++)
            gn_control_answer(control, r, json_pack("{s:s}", "did", gn_ctl_rows[r->command].name));
    return answered;
}

void say(int fd, const char *text) {
    assert_int_equal(send(fd, text, strlen(text), MSG_NOSIGNAL), strlen(text));
}

const char *heard(int fd) {
    static char text[65536];
    const ssize_t got = recv(fd, text, sizeof text - 1, 0);
    text[got > 0 ? got : 0] = '\0';
    return text;
}

bool is_closed(int fd) {
    char byte;
    const ssize_t got = recv(fd, &byte, 1, 0);
    return got == 0 || (got < 0 && errno == ECONNRESET);
}

int count_lines(const char *text) {
    int lines = 0;
    for (; *text; text++) lines += *text == '\n';
    return lines;
}

int gn_ctl_test_open(void **state) {
    struct gn_ctl_test *t = &gn_ctl_test;
    (void)state;
    t->now_ns = gn_clock_monotonic_ns();
    t->loop = gn_loop_open(&t->err);
    if (!t->loop) return -1;
    gn_loop_fake_clock(t->loop, &t->now_ns);
    t->err = (struct gn_err){0};
    t->control = gn_control_open(t->path, t->loop, &t->err);
    return t->control ? 0 : -1;
}

/* Of this process. */
static int count_threads(void) {
    DIR *folder = opendir("/proc/self/task");
    int count = 0;
    for (const struct dirent *entry; folder && (entry = readdir(folder)) != NULL;)
        count += entry->d_name[0] != '.';
    if (folder) closedir(folder);
    return count;
}

int gn_ctl_test_close(void **state) {
    (void)state;
    gn_control_close(gn_ctl_test.control);
    gn_ctl_test.control = NULL;
    gn_loop_close(gn_ctl_test.loop);
    /* threads close what clients had sent and nobody read: no descriptor comes back in a later test
     */
    while (count_threads() > 1) usleep(1000);
    return 0;
}

int gn_ctl_test_begin(void **state) {
    struct gn_ctl_test *t = &gn_ctl_test;
    (void)state;
    snprintf(t->folder, sizeof t->folder, "/tmp/gnomon-ctl-XXXXXX");
    if (!mkdtemp(t->folder)) return -1;
    snprintf(t->path, sizeof t->path, "%s/ctl", t->folder);
    return 0;
}

int gn_ctl_test_end(void **state) {
    (void)state;
    return gn_test_remove_folder(gn_ctl_test.folder);
}
