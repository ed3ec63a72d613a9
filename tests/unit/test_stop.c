#include "unit/check.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/file.h"
#include "core/stop.h"
#include "unit/folder.h"

enum { SIZE = 1 << 20 };

static char folder[] = "/tmp/gnomon-stop-XXXXXX";

static int enter(void **state) {
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state) {
    (void)state;
    return gn_test_remove_folder(folder);
}

static bool is_here(const char *start) {
    bool found = false;
    DIR *dir = opendir(folder);
    for (struct dirent *e; (e = readdir(dir));)
        found |= strncmp(e->d_name, start, strlen(start)) == 0;
    closedir(dir);
    return found;
}

static void sleep_us(long us) {
    const struct timespec time = {us / 1000000, us % 1000000 * 1000};
    nanosleep(&time, NULL);
}

/* A child that does this for ever, and has begun. */
static pid_t start(void (*work)(void)) {
    int ends[2];
    char byte = 0;
    assert_int_equal(pipe(ends), 0);
    const pid_t pid = fork();
    if (pid == 0) {
        gn_stop_block();
        gn_stop_end_process();
        if (write(ends[1], &byte, 1) != 1) _exit(1);
        for (;;) work();
    }
    assert_int_equal(read(ends[0], &byte, 1), 1);
    close(ends[0]);
    close(ends[1]);
    return pid;
}

/* Its exit status. */
static int stop(pid_t pid, int signal) {
    int status = 0;
    kill(pid, signal);
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void write_file(void) {
    static char data[SIZE];
    struct gn_err err = {0};
    if (!gn_file_write("whole", data, sizeof data, &err)) _exit(1);
}

static void an_interrupted_writer_leaves_a_whole_file_or_none(void **state) {
    (void)state;
    srand(1);
    for (int i = 0; i < 60; i++) {
        struct stat info;
        unlink("whole");
        const pid_t pid = start(write_file);
        sleep_us(rand() % 4000);
        assert_int_equal(stop(pid, SIGTERM), 128 + SIGTERM);
        assert_false(is_here(".gnomon-"));
        assert_true(stat("whole", &info) == 0 ? info.st_size == SIZE : errno == ENOENT);
    }
}

static void spin(void) {
    for (volatile int i = 0; i < 1000; i++) {
    }
}

static void a_busy_thread_delays_no_signal(void **state) {
    (void)state;
    assert_int_equal(stop(start(spin), SIGINT), 128 + SIGINT);
    assert_int_equal(stop(start(spin), SIGTERM), 128 + SIGTERM);
}

static void an_ignored_signal_stays_ignored(void **state) {
    (void)state;
    signal(SIGINT, SIG_IGN);
    const pid_t pid = start(spin);
    kill(pid, SIGINT);
    sleep_us(20000);
    assert_int_equal(waitpid(pid, NULL, WNOHANG), 0);
    assert_int_equal(stop(pid, SIGTERM), 128 + SIGTERM);
    signal(SIGINT, SIG_DFL);
}

static void create_file(void *name) { close(open(name, O_CREAT | O_WRONLY, 0600)); }

/* A loop that does not get to the signal. */
static void a_late_loop_is_ended_with_0(void **state) {
    (void)state;
    static char restored[] = "restored";
    const pid_t pid = fork();
    if (pid == 0) {
        gn_stop_block();
        gn_stop_set_restore(create_file, restored);
        gn_stop_end_late(200000000);
        kill(getpid(), SIGTERM);
        for (int i = 0; i < 100; i++) sleep_us(100000);
        _exit(3);
    }
    int status = 0;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
    assert_int_equal(unlink(restored), 0);
}

/* The loop takes the signal in time. */
static void a_loop_in_time_ends_by_itself(void **state) {
    (void)state;
    const pid_t pid = fork();
    if (pid == 0) {
        sigset_t signals;
        int number;
        gn_stop_block();
        gn_stop_signals(&signals);
        gn_stop_end_late(200000000);
        kill(getpid(), SIGTERM);
        sigwait(&signals, &number);
        sleep_us(600000);
        _exit(3);
    }
    int status = 0;
    assert_int_equal(waitpid(pid, &status, 0), pid);
    assert_int_equal(WEXITSTATUS(status), 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_interrupted_writer_leaves_a_whole_file_or_none),
        cmocka_unit_test(a_busy_thread_delays_no_signal),
        cmocka_unit_test(an_ignored_signal_stays_ignored),
        cmocka_unit_test(a_late_loop_is_ended_with_0),
        cmocka_unit_test(a_loop_in_time_ends_by_itself),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
