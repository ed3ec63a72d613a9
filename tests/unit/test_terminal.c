/* A program in a terminal, with a shell beside it that does what shells do: the background, the
 * foreground, Ctrl-Z, and the end. The terminal is a pseudo-terminal of our own. */
#include "input/terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "check.h"
#include "core/clock.h"
#include "input/private.h"
#include "stage/wake.h"
#include "unit/gpio_fake.h"

static int master, slave, gestures[2];
static pid_t job;
static struct gn_loop *loop; /* of the input */

static void open_terminal(void) {
    char name[64];
    master = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (master < 0 || grantpt(master) || unlockpt(master) || ptsname_r(master, name, sizeof name)) {
        printf("there are no pseudo-terminals here\n");
        exit(77);
    }
    slave = open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
}

static struct gn_input *open_input(void) {
    static const struct gn_button_opts buttons[] = {
        {.name = "n", .keys = "n right", .gestures = 1u << GN_GESTURE_CLICK},
        {.name = "e", .keys = "esc", .gestures = 1u << GN_GESTURE_CLICK},
        {.name = "q", .keys = "q", .gestures = 1u << GN_GESTURE_CLICK}};
    loop = gn_loop_open(NULL);
    const struct gn_input_opts opts = {
        .loop = loop, .buttons = buttons, .button_count = 3, .terminal = true};
    const struct gn_input_world world = {.gpio = &fake_gpio_none, .terminal = &slave};
    return gn_input_open_in(&world, &opts, gn_clock_monotonic_ns(), NULL, NULL);
}

static void close_input(struct gn_input *input) {
    gn_input_close(input);
    gn_loop_close(loop);
}

/* Is there anything to do for the input within that time? Then it is done. */
static bool wakes(int ms) {
    return gn_loop_step(loop, gn_clock_monotonic_ns() + INT64_C(1000000) * ms) > 0;
}

static bool is_ready(int fd, int ms) {
    struct pollfd poller = {.fd = fd, .events = POLLIN};
    return poll(&poller, 1, ms) == 1;
}

/* Not line by line, no echo; signals as ever. */
static bool is_raw(void) {
    struct termios now;
    tcgetattr(slave, &now);
    return !(now.c_lflag & (ICANON | ECHO)) && now.c_lflag & ISIG;
}
static bool is_plain(void) {
    struct termios now;
    tcgetattr(slave, &now);
    return (now.c_lflag & (ICANON | ECHO)) == (ICANON | ECHO);
}

/* ---- alone --------------------------------------------------------------------------------- */

static int take(struct gn_input *input) {
    struct gn_gesture_event event;
    return gn_input_next(input, &event) ? event.button : -1;
}

static void test_what_is_typed_clicks_and_settings_come_back(void **state) {
    (void)state;
    open_terminal();
    assert_true(is_plain());
    struct gn_input *input = open_input();
    assert_non_null(input);
    assert_true(is_raw());
    assert_int_equal(write(master, "x\33[C", 4), 4);
    assert_true(wakes(2000));
    assert_int_equal(take(input), 0);
    assert_int_equal(write(master, "\33", 1), 1);
    assert_true(wakes(2000));
    assert_int_equal(take(input), -1);
    assert_true(wakes(2000)); /* the timer */
    assert_int_equal(take(input), 1);
    close_input(input);
    assert_true(is_plain());
    close(master);
    close(slave);
}

static void test_the_end_of_the_terminal_is_not_the_end(void **state) {
    (void)state;
    open_terminal();
    struct gn_input *input = open_input();
    close(master);
    for (int i = 0; i < 3; i++) wakes(0);
    assert_false(wakes(50)); /* it does not spin */
    const struct gn_terminal *t = input->states[GN_SOURCE_terminal];
    assert_false(t->reading);
    close_input(input);
    close(slave);
}

static void test_what_is_no_terminal_is_not_read(void **state) {
    (void)state;
    slave = open("/dev/null", O_RDONLY | O_CLOEXEC);
    struct gn_input *input = open_input();
    assert_non_null(input);
    assert_null(input->states[GN_SOURCE_terminal]);
    assert_false(wakes(0));
    close_input(input);
    close(slave);
}

/* ---- a sudden end -------------------------------------------------------------------------- */

static void fault(void) {
    volatile char *page = mmap(NULL, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    *page = 1;
}
static void quit(void) { raise(SIGQUIT); } /* Ctrl-\ */
static void driver_crash(void) {
    struct gn_wake wake = {0};
    const struct gn_settings settings = {0};
    gn_wake_begin(&wake, &settings);
    fault();
}

static void test_a_crash_leaves_the_terminal_as_it_was(void **state) {
    (void)state;
    static const struct {
        void (*die)(void);
        int signal; /* 0: it exits */
    } deaths[] = {{fault, SIGSEGV}, {abort, SIGABRT}, {quit, SIGQUIT}, {driver_crash, 0}};
    for (size_t i = 0; i < sizeof deaths / sizeof *deaths; i++) {
        int status;
        open_terminal();
        const pid_t child = fork();
        if (child == 0) {
            for (int k = 1; k < 32; k++) signal(k, SIG_DFL); /* cmocka catches faults */
            setrlimit(RLIMIT_CORE, &(struct rlimit){0});
            dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
            if (!open_input() || !is_raw()) _exit(0);
            deaths[i].die();
            _exit(0);
        }
        assert_int_equal(waitpid(child, &status, 0), child);
        if (WIFEXITED(status) ? !WEXITSTATUS(status) : WTERMSIG(status) != deaths[i].signal)
            fail_msg("%zu: status %d", i, status);
        if (!is_plain()) fail_msg("%zu: raw", i);
        close(master);
        close(slave);
    }
}

/* ---- under a shell ------------------------------------------------------------------------- */

/* The program: writes the button's name for each click, ends with q. */
static void run_job(void) {
    setpgid(0, 0);
    close(gestures[0]);
    signal(SIGTTOU, SIG_DFL);
    struct gn_input *input = open_input();
    if (!input || write(gestures[1], "!", 1) != 1) _exit(9);
    for (int button = -1; button != 2;) {
        gn_loop_step(loop, GN_LOOP_NEVER);
        button = take(input);
        if (button >= 0 && write(gestures[1], &"neq"[button], 1) != 1) _exit(9);
    }
    close_input(input);
    _exit(is_plain() ? 0 : 8);
}

#define REQUIRE(condition)                                                                         \
    if (!(condition)) {                                                                            \
        fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                            \
        kill(job, SIGKILL);                                                                        \
        _exit(1);                                                                                  \
    }

static bool hears(char name, int ms) {
    char byte = 0;
    return is_ready(gestures[0], ms) && read(gestures[0], &byte, 1) == 1 && byte == name;
}

static bool comes(bool (*what)(void)) {
    for (int i = 0; i < 200 && !what(); i++) usleep(10000);
    return what();
}

static void type(const char *text) { REQUIRE(write(master, text, strlen(text)) > 0); }

static bool is_running(void) {
    int status;
    return waitpid(job, &status, WNOHANG | WUNTRACED) == 0;
}

static void foreground(pid_t group) { REQUIRE(tcsetpgrp(slave, group) == 0); }

static void run_shell(void) {
    int status;
    setsid();
    open_terminal();
    signal(SIGTTOU, SIG_IGN);
    REQUIRE(ioctl(slave, TIOCSCTTY, 0) == 0 && pipe(gestures) == 0);
    job = fork();
    if (job == 0) run_job();
    close(gestures[1]);
    setpgid(job, job);
    REQUIRE(hears('!', 5000));

    /* started in the background: what is typed is not for it, and it goes on */
    type("n\n");
    REQUIRE(!is_ready(gestures[0], 200) && is_running() && is_plain());
    tcflush(slave, TCIFLUSH);

    foreground(job);
    kill(-job, SIGCONT);
    REQUIRE(comes(is_raw));
    type("n");
    REQUIRE(hears('n', 5000));

    type("\x1a"); /* Ctrl-Z */
    REQUIRE(waitpid(job, &status, WUNTRACED) == job && WIFSTOPPED(status));
    REQUIRE(is_plain());
    foreground(getpid());
    kill(-job, SIGCONT); /* bg */
    type("n\n");
    REQUIRE(!is_ready(gestures[0], 200) && is_running() && is_plain());
    tcflush(slave, TCIFLUSH);

    foreground(job); /* fg */
    kill(-job, SIGCONT);
    REQUIRE(comes(is_raw));
    type("\33");
    REQUIRE(hears('e', 5000));
    kill(job, SIGSTOP); /* which cannot be caught: the shell puts its own settings there */
    REQUIRE(waitpid(job, &status, WUNTRACED) == job && WIFSTOPPED(status));
    struct termios plain;
    tcgetattr(slave, &plain);
    plain.c_lflag |= ICANON | ECHO;
    tcsetattr(slave, TCSANOW, &plain);
    kill(-job, SIGCONT);
    REQUIRE(comes(is_raw));
    type("q");
    REQUIRE(hears('q', 5000));
    REQUIRE(waitpid(job, &status, 0) == job && WIFEXITED(status) && WEXITSTATUS(status) == 0);
    REQUIRE(is_plain());
    _exit(0);
}

static void test_it_behaves_under_a_shell(void **state) {
    (void)state;
    int status;
    const pid_t shell = fork();
    if (shell == 0) run_shell();
    assert_int_equal(waitpid(shell, &status, 0), shell);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_typed_clicks_and_settings_come_back),
        cmocka_unit_test(test_the_end_of_the_terminal_is_not_the_end),
        cmocka_unit_test(test_what_is_no_terminal_is_not_read),
        cmocka_unit_test(test_a_crash_leaves_the_terminal_as_it_was),
        cmocka_unit_test(test_it_behaves_under_a_shell),
    };
    return RUN(tests);
}
