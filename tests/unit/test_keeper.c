/* The thread that saves the state: a disk that does not answer holds nobody up but the end. */
#include "unit/check.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <semaphore.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/keeper.h"

static struct gn_err err;

/* A disk that waits in fsync for a byte of a pipe, and keeps what is written. */
static struct slow {
    int pipe[2];
    sem_t begun;                     /* saves */
    char text[2][GN_STATE_TEXT_MAX]; /* of both generations */
    char fresh[GN_STATE_TEXT_MAX];
    size_t size;
    int reason; /* of a create that fails; 0: none does */
} disk;

static int open_file(void *user, int folder, const char *name, int flags, mode_t mode) {
    (void)user, (void)folder, (void)name, (void)mode;
    if (flags & O_DIRECTORY) return 2000;
    disk.size = 0;
    sem_post(&disk.begun);
    errno = disk.reason;
    return disk.reason ? -1 : 1000;
}
static ssize_t write_data(void *user, int fd, const void *data, size_t size) {
    (void)user, (void)fd;
    memcpy(disk.fresh + disk.size, data, size);
    disk.fresh[disk.size += size] = 0;
    return (ssize_t)size;
}
static int flush(void *user, int fd) {
    char byte;
    (void)user;
    return fd == 2000 || read(disk.pipe[0], &byte, 1) == 1 ? 0 : -1;
}
static int close_fd(void *user, int fd) {
    (void)user, (void)fd;
    return 0;
}
static int rename_to(void *user, int folder, const char *from, const char *to) {
    (void)user, (void)folder, (void)from;
    memcpy(disk.text[strcmp(to, "s.2") == 0], disk.fresh, sizeof disk.fresh);
    return 0;
}

static const struct gn_disk calls = {
    .open = open_file, .write = write_data, .fsync = flush, .close = close_fd, .rename = rename_to};

static void let_go(void) { assert_int_equal(write(disk.pipe[1], "x", 1), 1); }

static bool finish(struct gn_keeper *keeper) {
    struct pollfd p = {.fd = gn_keeper_fd(keeper), .events = POLLIN};
    bool ok = false;
    assert_int_equal(poll(&p, 1, 10000), 1);
    assert_true(gn_keeper_take(keeper, &ok, &err));
    return ok;
}

static void a_disk_that_does_not_answer_holds_nobody_up(void **state) {
    (void)state;
    bool ok = false;
    struct gn_state s = {.sequence = 7, .mode = "A"};
    struct gn_keeper *keeper = gn_keeper_open(&calls, "s", 1, &err);
    assert_int_equal(pipe(disk.pipe), 0);
    assert_int_equal(sem_init(&disk.begun, 0, 0), 0);
    assert_non_null(keeper);
    gn_keeper_save(keeper, &s); /* or this test does not go on */
    snprintf(s.mode, sizeof s.mode, "changed meanwhile");
    usleep(20000);
    assert_true(gn_keeper_is_busy(keeper));
    assert_false(gn_keeper_take(keeper, &ok, &err));
    let_go();
    assert_true(finish(keeper));
    assert_false(gn_keeper_is_busy(keeper));
    assert_non_null(strstr(disk.text[1], "mode A\n"));

    /* the next one goes to the other generation */
    s = (struct gn_state){.sequence = 8, .mode = "B"};
    gn_keeper_save(keeper, &s);
    let_go();
    assert_true(finish(keeper));
    assert_non_null(strstr(disk.text[0], "mode B\n"));
    assert_non_null(strstr(disk.text[1], "mode A\n"));

    /* one that fails stays there, and the end waits for the one that is under way */
    disk.reason = ENOSPC;
    gn_keeper_save(keeper, &s);
    assert_false(finish(keeper));
    assert_non_null(strstr(err.text, "s.2: cannot write: No space left"));
    disk.reason = 0;
    s.sequence = 9;
    while (sem_trywait(&disk.begun) == 0) {
    }
    gn_keeper_save(keeper, &s);
    sem_wait(&disk.begun);
    s = (struct gn_state){.sequence = 10, .mode = "C"};
    gn_keeper_save(keeper, &s); /* while that is written */
    let_go();
    let_go();
    assert_true(gn_keeper_close(keeper, 10 * GN_NS_PER_S, &err));
    assert_non_null(strstr(disk.text[1], "sequence 9\n"));
    assert_non_null(strstr(disk.text[0], "sequence 10\n"));
    assert_true(gn_keeper_close(NULL, 0, &err));
}

static void the_end_waits_for_a_disk_but_not_for_long(void **state) {
    (void)state;
    struct gn_state s = {.sequence = 11};
    struct gn_keeper *keeper = gn_keeper_open(&calls, "s", 1, &err);
    gn_keeper_save(keeper, &s);
    let_go();
    assert_true(gn_keeper_close(keeper, 10 * GN_NS_PER_S, &err));
    assert_non_null(strstr(disk.text[1], "sequence 11\n"));

    /* the file of a save that fails at the end is named */
    keeper = gn_keeper_open(&calls, "s", 1, &err);
    disk.reason = EROFS;
    gn_keeper_save(keeper, &s);
    assert_false(gn_keeper_close(keeper, 10 * GN_NS_PER_S, &err));
    assert_non_null(strstr(err.text, "s.2: cannot write: Read-only"));
    disk.reason = 0;

    /* it does not answer: the thread keeps what it works on */
    err = (struct gn_err){0};
    keeper = gn_keeper_open(&calls, "s", 1, &err);
    gn_keeper_save(keeper, &s);
    const int64_t begun_ns = gn_clock_monotonic_ns();
    assert_false(gn_keeper_close(keeper, GN_NS_PER_S / 20, &err));
    assert_true(gn_clock_monotonic_ns() - begun_ns >= GN_NS_PER_S / 20);
    assert_string_equal(err.text, "s: still being written");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disk_that_does_not_answer_holds_nobody_up),
        cmocka_unit_test(the_end_waits_for_a_disk_but_not_for_long),
    };
    return RUN(tests);
}
