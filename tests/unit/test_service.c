/* What a supervisor hears, on a socket of our own. */
#include "kiosk/service.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/clock.h"
#include "image/shot.h"
#include "unit/check.h"

#define S GN_NS_PER_S

static char path[108];
static int heard = -1;
static struct gn_loop *loop;
static int64_t clock_ns;

static int set_up(void **state) {
    (void)state;
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    snprintf(path, sizeof path, "/tmp/gnomon-service-%d", (int)getpid());
    snprintf(address.sun_path, sizeof address.sun_path, "%s", path);
    unlink(path);
    heard = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (bind(heard, (struct sockaddr *)&address, sizeof address) != 0) return -1;
    setenv("NOTIFY_SOCKET", path, 1);
    setenv("WATCHDOG_USEC", "20000000", 1);
    unsetenv("WATCHDOG_PID");
    clock_ns = 100 * S;
    loop = gn_loop_open(NULL);
    gn_loop_fake_clock(loop, &clock_ns);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    gn_loop_close(loop);
    close(heard);
    return unlink(path);
}

/* All that was heard since, as "READY=1 WATCHDOG=1"; "" for nothing. */
static const char *hear(void) {
    static char all[4000];
    char one[300];
    all[0] = 0;
    for (ssize_t n; (n = recv(heard, one, sizeof one - 1, 0)) >= 0;) {
        one[n] = 0;
        const size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", used ? " " : "", one);
    }
    return all;
}

static void open_it(struct gn_service *service) {
    struct gn_err err = {0};
    if (!gn_service_open(service, loop, 100 * S, &err)) fail_msg("%s", err.text);
}

static void test_ready_before_the_first_frame(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.may_draw = true};
    open_it(&service);
    assert_null(getenv("NOTIFY_SOCKET")); /* not for those that it starts */
    assert_null(getenv("WATCHDOG_USEC"));
    assert_false(gn_service_step(&service, &screen, 101 * S));
    assert_string_equal(hear(), "READY=1");
    screen.counts.shown = 1;
    snprintf(screen.what, sizeof screen.what, "HDMI-A-1 1920x1080@60.00 atomic");
    gn_service_step(&service, &screen, 102 * S);
    assert_string_equal(hear(), "STATUS=HDMI-A-1 1920x1080@60.00 atomic");
    gn_service_step(&service, &screen, 103 * S);
    assert_string_equal(hear(), "");
    gn_service_close(&service);
    assert_string_equal(hear(), "STOPPING=1");
    gn_service_close(&service);
    assert_string_equal(hear(), "");
}

static void test_ready_when_it_waits_for_a_monitor(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.status = "waiting for a monitor"};
    open_it(&service);
    gn_service_step(&service, &screen, 101 * S);
    assert_string_equal(hear(), "STATUS=waiting for a monitor READY=1");
    for (int64_t s = 102; s < 200; s++) assert_false(gn_service_step(&service, &screen, s * S));
    assert_non_null(strstr(hear(), "WATCHDOG=1 WATCHDOG=1"));
    gn_service_close(&service);
}

static void test_fed_by_flips_alone(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.counts.shown = 1};
    open_it(&service);
    gn_service_step(&service, &screen, 100 * S);
    assert_string_equal(hear(), "READY=1");
    assert_false(gn_service_step(&service, &screen, 104 * S));
    assert_string_equal(hear(), "");
    assert_false(gn_service_step(&service, &screen, 105 * S)); /* a quarter of its patience */
    assert_string_equal(hear(), "WATCHDOG=1");
    for (int64_t s = 106; s < 110; s++) assert_false(gn_service_step(&service, &screen, s * S));
    for (int64_t s = 110; s < 300; s++) assert_true(gn_service_step(&service, &screen, s * S));
    assert_string_equal(hear(), ""); /* it hangs, however often the loop goes round */
    screen.counts.shown++;
    assert_false(gn_service_step(&service, &screen, 300 * S));
    assert_string_equal(hear(), "WATCHDOG=1");
    screen.counts.shown = 1; /* the display was opened again */
    assert_false(gn_service_step(&service, &screen, 305 * S));
    assert_string_equal(hear(), "WATCHDOG=1");
    gn_service_close(&service);
}

static void test_fed_by_pieces_of_a_frame(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.counts.shown = 1};
    open_it(&service);
    gn_service_step(&service, &screen, 100 * S);
    hear();
    for (int64_t s = 100; s < 121; s++) gn_service_pause(&service, (uint64_t)s, s * S);
    assert_string_equal(hear(), "WATCHDOG=1 WATCHDOG=1 WATCHDOG=1 WATCHDOG=1");
    for (int64_t s = 121; s < 200; s++) gn_service_pause(&service, 120, s * S);
    assert_string_equal(hear(), ""); /* the GPU hangs */
    gn_service_close(&service);
    gn_service_pause(&service, 121, 300 * S);
}

static void test_fed_while_it_sleeps(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.counts.shown = 7, .blank = true};
    open_it(&service);
    for (int64_t s = 100; s < 121; s++) assert_false(gn_service_step(&service, &screen, s * S));
    assert_string_equal(hear(), "READY=1 WATCHDOG=1 WATCHDOG=1 WATCHDOG=1 WATCHDOG=1");
    screen.blank = false; /* awake, it has to show something again */
    for (int64_t s = 121; s < 125; s++) assert_false(gn_service_step(&service, &screen, s * S));
    assert_true(gn_service_step(&service, &screen, 125 * S));
    assert_string_equal(hear(), "");
    gn_service_close(&service);
}

static void test_the_loop_wakes_up_for_the_watchdog(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.counts.shown = 7, .blank = true};
    open_it(&service);
    for (int64_t s = 105; s < 125; s += 5) {
        assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 1);
        assert_true(clock_ns == s * S);
        gn_service_step(&service, &screen, clock_ns);
    }
    assert_string_equal(hear(), "READY=1 WATCHDOG=1 WATCHDOG=1 WATCHDOG=1 WATCHDOG=1");
    screen.blank = false; /* awake, and no flip comes */
    for (int64_t s = 125; s < 145; s += 5) {
        gn_loop_step(loop, GN_LOOP_NEVER);
        assert_true(clock_ns == s * S);
        assert_true(gn_service_step(&service, &screen, clock_ns));
    }
    gn_service_close(&service);
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 0);
}

static void test_without_a_watchdog(void **state) {
    (void)state;
    static const char *const none[][2] = {{"", NULL}, {"0", NULL}, {"x", NULL}, {"10000", "1"}};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        struct gn_service service;
        struct gn_screen screen = {.counts.shown = 1};
        setenv("NOTIFY_SOCKET", path, 1);
        setenv("WATCHDOG_USEC", none[i][0], 1);
        if (none[i][1]) setenv("WATCHDOG_PID", none[i][1], 1);
        open_it(&service);
        assert_null(service.timer.link.loop);
        for (int64_t s = 100; s < 900; s++) assert_false(gn_service_step(&service, &screen, s * S));
        assert_string_equal(hear(), "READY=1");
        gn_service_close(&service);
        hear();
    }
}

static void test_without_a_supervisor(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.counts.shown = 1};
    unsetenv("NOTIFY_SOCKET");
    open_it(&service);
    assert_int_equal(service.socket, -1);
    assert_false(gn_service_step(&service, &screen, 900 * S));
    gn_service_close(&service);
    assert_string_equal(hear(), "");
}

/* What a step writes on stderr, which is a file of our own meanwhile. */
static const char *step_log(struct gn_service *service, const struct gn_screen *screen) {
    static char text[400];
    FILE *file = tmpfile();
    const int own = dup(STDERR_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    gn_service_step(service, screen, 100 * S);
    dup2(own, STDERR_FILENO);
    close(own);
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    return text;
}

static void test_logs_when_it_waits_and_when_a_picture_comes(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.status = "waiting for a monitor"};
    setenv("NOTIFY_SOCKET", path, 1);
    open_it(&service);
    assert_string_equal(step_log(&service, &screen), "gnomon: waiting for a monitor\n");
    assert_string_equal(step_log(&service, &screen), "");
    snprintf(screen.what, sizeof screen.what, "HDMI-A-1 1920x1080@60.00 atomic");
    screen.status[0] = 0; /* there, but nothing is shown yet */
    assert_string_equal(step_log(&service, &screen), "");
    screen.counts.shown = 1;
    assert_string_equal(step_log(&service, &screen),
                        "gnomon: picture on HDMI-A-1 1920x1080@60.00 atomic\n");
    screen.counts.shown = 1000;
    assert_string_equal(step_log(&service, &screen), "");
    snprintf(screen.status, sizeof screen.status, "another console is active");
    assert_string_equal(step_log(&service, &screen), "gnomon: another console is active\n");
    snprintf(screen.status, sizeof screen.status, "waiting for a card");
    screen.counts.shown = 0; /* and it is opened again */
    assert_string_equal(step_log(&service, &screen), "gnomon: waiting for a card\n");
    screen.status[0] = 0;
    assert_string_equal(step_log(&service, &screen), "");
    screen.counts.shown = 1;
    assert_string_equal(step_log(&service, &screen),
                        "gnomon: picture on HDMI-A-1 1920x1080@60.00 atomic\n");
    gn_service_close(&service);
}

/* Opens it while stderr is that file, a terminal or not. */
static void open_with_stderr(struct gn_service *service, const char *file) {
    const int own = dup(STDERR_FILENO), fd = open(file, O_RDWR | O_NOCTTY);
    assert_true(fd >= 0);
    dup2(fd, STDERR_FILENO);
    open_it(service);
    dup2(own, STDERR_FILENO);
    close(own);
    close(fd);
}

static void test_a_terminal_is_told_what_it_waits_for(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_screen screen = {.status = "waiting for a card"};
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    assert_true(grantpt(terminal) == 0 && unlockpt(terminal) == 0);
    unsetenv("NOTIFY_SOCKET");
    unsetenv("JOURNAL_STREAM");
    open_with_stderr(&service, ptsname(terminal));
    assert_string_equal(step_log(&service, &screen), "gnomon: waiting for a card\n");
    assert_string_equal(step_log(&service, &screen), "");
    screen = (struct gn_screen){.what = "DP-1 640x480@60.00 atomic", .counts.shown = 1};
    assert_string_equal(step_log(&service, &screen),
                        "gnomon: picture on DP-1 640x480@60.00 atomic\n");
    open_with_stderr(&service, ptsname(terminal)); /* the picture itself says that it is there */
    assert_string_equal(step_log(&service, &screen), "");
    snprintf(screen.status, sizeof screen.status, "another console is active");
    assert_string_equal(step_log(&service, &screen), "gnomon: another console is active\n");
    close(terminal);
}

static void test_logs_into_the_journal_but_not_into_a_file(void **state) {
    (void)state;
    struct gn_service service;
    const struct gn_screen screen = {.status = "waiting for a monitor"};
    struct stat info;
    char stream[64];
    unsetenv("NOTIFY_SOCKET");
    unsetenv("JOURNAL_STREAM");
    open_with_stderr(&service, "/dev/null");
    assert_string_equal(step_log(&service, &screen), "");
    fstat(STDERR_FILENO, &info);
    snprintf(stream, sizeof stream, "%llu:%llu", (unsigned long long)info.st_dev,
             (unsigned long long)info.st_ino + 1); /* another stderr is the journal */
    setenv("JOURNAL_STREAM", stream, 1);
    open_with_stderr(&service, "/dev/null");
    assert_string_equal(step_log(&service, &screen), "");
    snprintf(stream, sizeof stream, "%llu:%llu", (unsigned long long)info.st_dev,
             (unsigned long long)info.st_ino);
    setenv("JOURNAL_STREAM", stream, 1);
    open_it(&service);
    assert_string_equal(step_log(&service, &screen), "gnomon: waiting for a monitor\n");
    unsetenv("JOURNAL_STREAM");
}

static void test_addresses_that_are_none(void **state) {
    (void)state;
    struct gn_service service;
    struct gn_err err = {0};
    char longer[300] = "/";
    memset(longer + 1, 'x', sizeof longer - 2);
    setenv("NOTIFY_SOCKET", "relative", 1);
    assert_false(gn_service_open(&service, loop, 0, &err));
    assert_non_null(strstr(err.text, "NOTIFY_SOCKET=relative"));
    setenv("NOTIFY_SOCKET", longer, 1);
    assert_false(gn_service_open(&service, loop, 0, &err));
    setenv("NOTIFY_SOCKET", "/nowhere/notify", 1); /* gone again: no reason to end */
    open_it(&service);
    assert_false(gn_service_step(&service, &(struct gn_screen){.counts.shown = 1}, 0));
    gn_service_close(&service);
}

/* ---- the program ---- */

static pid_t start(const char *const args[]) {
    const pid_t pid = fork();
    if (pid != 0) return pid;
    setenv("WATCHDOG_USEC", "400000", 1);
    const char *argv[12] = {gn_shot_program()};
    for (int i = 0; args[i]; i++) argv[1 + i] = args[i];
    execv(argv[0], (char *const *)argv);
    _exit(127);
}

static int count(const char *text, const char *word) {
    int n = 0;
    for (; (text = strstr(text, word)); text += strlen(word)) n++;
    return n;
}

/* For so long after READY=1; what was heard stands in all. */
static void listen_to(pid_t pid, int64_t for_ns, char *all, size_t size) {
    int64_t until_ns = gn_clock_monotonic_ns() + 20 * S;
    bool ready = false;
    all[0] = 0;
    while (gn_clock_monotonic_ns() < until_ns) {
        struct pollfd p = {heard, POLLIN, 0};
        poll(&p, 1, 50);
        const size_t used = strlen(all);
        snprintf(all + used, size - used, " %s", hear());
        if (ready || !strstr(all, "READY=1")) continue;
        ready = true;
        until_ns = gn_clock_monotonic_ns() + for_ns;
    }
    kill(pid, SIGTERM);
    int status = 0;
    waitpid(pid, &status, 0);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    const size_t used = strlen(all);
    snprintf(all + used, size - used, " %s", hear());
}

/* A still picture is drawn again and again to prove that it can be. */
static void test_a_still_picture_keeps_the_watchdog_quiet(void **state) {
    (void)state;
    char all[8000];
    const char *args[] = {
        "show",           "--backend", "egl", "--size",
        "64x64",          "--shadow",  "pcf", /* one mode: no others are made meanwhile */
        "--no-animation", NULL};
    listen_to(start(args), 2 * S, all, sizeof all);
    assert_int_equal(count(all, "READY=1"), 1);
    assert_in_range(count(all, "WATCHDOG=1"), 3, 24); /* 20, fewer on a busy machine */
    assert_int_equal(count(all, "STOPPING=1"), 1);
    assert_true(strstr(all, "READY=1") < strstr(all, "WATCHDOG=1"));
}

static void test_so_does_waiting_for_a_card(void **state) {
    (void)state;
    char all[8000];
    const char *args[] = {"show", "--backend", "kms", "--card", "no-such-card", NULL};
    listen_to(start(args), S, all, sizeof all);
    assert_non_null(strstr(all, "STATUS=waiting for a card"));
    assert_int_equal(count(all, "READY=1"), 1);
    assert_in_range(count(all, "WATCHDOG=1"), 2, 12); /* 10, fewer on a busy machine */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_ready_before_the_first_frame, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_ready_when_it_waits_for_a_monitor, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_fed_by_flips_alone, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_fed_by_pieces_of_a_frame, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_fed_while_it_sleeps, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_the_loop_wakes_up_for_the_watchdog, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_without_a_watchdog, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_without_a_supervisor, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_logs_when_it_waits_and_when_a_picture_comes, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_a_terminal_is_told_what_it_waits_for, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_logs_into_the_journal_but_not_into_a_file, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_addresses_that_are_none, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_a_still_picture_keeps_the_watchdog_quiet, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_so_does_waiting_for_a_card, set_up, tear_down),
    };
    return RUN(tests);
}
