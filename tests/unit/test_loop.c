/* The event loop on pipes, with a clock of our own and with the real one. */
#include "core/loop.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/arena.h"
#include "core/clock.h"
#include "unit/check.h"

enum { PIPES = 4 };
static const int64_t MS = 1000000;

static struct gn_loop *loop;
static int64_t clock_ns;
static int pipes[PIPES][2];
static struct gn_watch watches[PIPES];
static struct gn_timer timers[PIPES];
static char calls[200]; /* "r0 t1 ": what was called, in order */

static void note_call(char kind, int index) {
    const size_t used = strlen(calls);
    snprintf(calls + used, sizeof calls - used, "%c%d ", kind, index);
}

static void assert_calls(const char *expected) {
    assert_string_equal(calls, expected);
    calls[0] = '\0';
}

static void read_pipe(void *user, int64_t now_ns) {
    const struct gn_watch *watch = user;
    char byte;
    assert_true(now_ns == gn_loop_now_ns(loop) && watch->came);
    note_call(watch->came & EPOLLHUP ? 'h' : 'r', (int)(watch - watches));
    if (watch->came & EPOLLIN) assert_int_equal(read(watch->fd, &byte, 1), 1);
}

static void note_timer(void *user, int64_t now_ns) {
    const struct gn_timer *timer = user;
    assert_true(timer->due_ns == GN_LOOP_NEVER && now_ns == gn_loop_now_ns(loop));
    note_call('t', (int)(timer - timers));
}

static void write_byte(int pipe) { assert_int_equal(write(pipes[pipe][1], "x", 1), 1); }

static int open_all(void **state) {
    (void)state;
    struct gn_err err = {0};
    loop = gn_loop_open(&err);
    clock_ns = 1000 * GN_NS_PER_S;
    calls[0] = '\0';
    gn_loop_fake_clock(loop, &clock_ns);
    for (int i = 0; i < PIPES; i++) {
        if (pipe2(pipes[i], O_CLOEXEC | O_NONBLOCK) != 0) return -1;
        watches[i] = (struct gn_watch){
            .fd = pipes[i][0], .events = EPOLLIN, .call = read_pipe, .user = &watches[i]};
        timers[i] =
            (struct gn_timer){.due_ns = GN_LOOP_NEVER, .call = note_timer, .user = &timers[i]};
        if (!gn_loop_add(loop, &watches[i])) return -1;
        gn_loop_add_timer(loop, &timers[i]);
    }
    return 0;
}

static int close_all(void **state) {
    (void)state;
    gn_loop_close(loop);
    for (int i = 0; i < PIPES; i++) {
        close(pipes[i][0]);
        close(pipes[i][1]);
    }
    return 0;
}

/* ---- order ---------------------------------------------------------------------------------- */

static void test_descriptors_come_before_timers_each_as_added(void **state) {
    (void)state;
    timers[3].due_ns = clock_ns;
    timers[1].due_ns = clock_ns - 5 * MS;
    for (int i = PIPES - 1; i >= 0; i--) write_byte(i);
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 6);
    assert_calls("r0 r1 r2 r3 t1 t3 ");
    assert_int_equal(gn_loop_step(loop, clock_ns), 0);
    gn_loop_remove(&watches[1]); /* it goes to the end */
    assert_true(gn_loop_add(loop, &watches[1]));
    for (int i = 0; i < PIPES; i++) write_byte(i);
    gn_loop_step(loop, 0);
    assert_calls("r0 r2 r3 r1 ");
}

static void make_timer_due(void *user, int64_t now_ns) {
    read_pipe(user, now_ns);
    timers[0].due_ns = 0;
}

static void test_what_is_collected_is_handled_once_in_the_same_step(void **state) {
    (void)state;
    watches[0].call = watches[2].call = make_timer_due;
    write_byte(0);
    write_byte(2);
    gn_loop_step(loop, GN_LOOP_NEVER);
    assert_calls("r0 r2 t0 ");
}

static void test_a_descriptor_that_is_left_unread_is_ready_again(void **state) {
    (void)state;
    write_byte(0);
    write_byte(0);
    gn_loop_step(loop, 0);
    gn_loop_step(loop, 0);
    gn_loop_step(loop, 0);
    assert_calls("r0 r0 ");
}

static void test_an_end_is_told_of(void **state) {
    (void)state;
    close(pipes[2][1]);
    gn_loop_step(loop, 0);
    assert_calls("h2 ");
    pipes[2][1] = dup(pipes[1][1]);
}

static void test_what_cannot_be_waited_for_is_not_added(void **state) {
    (void)state;
    struct gn_watch none = {.fd = -1, .events = EPOLLIN};
    assert_false(gn_loop_add(loop, &none));
    assert_null(none.link.loop);
    gn_loop_remove(&none);
    gn_loop_remove(&none);
}

/* ---- changes from callbacks ----------------------------------------------------------------- */

static void remove_all(void *user, int64_t now_ns) {
    read_pipe(user, now_ns);
    for (int i = 0; i < PIPES; i++) gn_loop_remove(&watches[i]);
    gn_loop_remove_timer(&timers[1]);
}

static void test_a_removed_source_is_not_called(void **state) {
    (void)state;
    watches[1].call = remove_all;
    timers[1].due_ns = timers[2].due_ns = clock_ns;
    for (int i = 0; i < PIPES; i++) write_byte(i);
    gn_loop_step(loop, 0);
    assert_calls("r0 r1 t2 ");
    gn_loop_step(loop, 0);
    assert_calls("");
}

static void restart_timer(void *user, int64_t now_ns) {
    note_timer(user, now_ns);
    timers[0].due_ns = timers[1].due_ns = timers[2].due_ns = now_ns;
}

static void test_a_timer_is_called_once_a_step(void **state) {
    (void)state;
    timers[1].call = restart_timer;
    timers[1].due_ns = clock_ns;
    gn_loop_step(loop, 0);
    assert_calls("t1 t2 "); /* what comes later in the list is in the same step */
    timers[1].call = note_timer;
    gn_loop_step(loop, 0);
    assert_calls("t0 t1 ");
}

static void remove_timers(void *user, int64_t now_ns) {
    note_timer(user, now_ns);
    for (int i = 0; i < 3; i++) gn_loop_remove_timer(&timers[i]);
}

static void test_a_timer_may_remove_itself_and_the_next(void **state) {
    (void)state;
    timers[1].call = remove_timers;
    for (int i = 0; i < PIPES; i++) timers[i].due_ns = clock_ns;
    gn_loop_step(loop, 0);
    assert_calls("t0 t1 t3 ");
}

/* ---- time ----------------------------------------------------------------------------------- */

static void test_fake_time_jumps_from_timer_to_timer(void **state) {
    (void)state;
    const int64_t begun_ns = clock_ns;
    timers[0].due_ns = begun_ns + 3600 * GN_NS_PER_S;
    timers[1].due_ns = begun_ns + 5 * MS;
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 1);
    assert_true(clock_ns == begun_ns + 5 * MS);
    assert_int_equal(gn_loop_step(loop, begun_ns + 7 * MS), 0);
    assert_true(clock_ns == begun_ns + 7 * MS);
    write_byte(3); /* what is ready takes no time */
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 1);
    assert_true(clock_ns == begun_ns + 7 * MS);
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 1);
    assert_true(clock_ns == begun_ns + 3600 * GN_NS_PER_S);
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 0);
    assert_true(clock_ns == begun_ns + 3600 * GN_NS_PER_S); /* it would wait for ever */
    assert_calls("t1 r3 t0 ");
}

static void test_a_real_wait_ends_with_its_timer_and_not_before(void **state) {
    (void)state;
    gn_loop_fake_clock(loop, NULL);
    const int64_t begun_ns = gn_clock_monotonic_ns();
    watches[0].call = NULL; /* it only ends the wait */
    timers[0].due_ns = begun_ns + 500 * MS;
    timers[0].call = NULL;
    timers[1].due_ns = begun_ns + 10000 * GN_NS_PER_S;
    /* on a busy machine the first wait may be so long that it ends with the timer */
    const int called = gn_loop_step(loop, begun_ns + 10 * MS);
    assert_true(gn_clock_monotonic_ns() - begun_ns >= (called ? 500 : 10) * MS);
    if (!called) assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 1);
    assert_true(gn_clock_monotonic_ns() - begun_ns >= 500 * MS);
    assert_true(gn_clock_monotonic_ns() - begun_ns < 60 * GN_NS_PER_S);
    assert_int_equal(gn_loop_step(loop, 0), 0); /* the timer does not come twice */
    write_byte(0);
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 1);
}

/* ---- signals -------------------------------------------------------------------------------- */

static void note_signal(void *user, int number) {
    (void)user;
    note_call(number == SIGUSR1 ? 'u' : 's', 0);
}

static void test_signals_come_as_calls(void **state) {
    (void)state;
    struct gn_signals signals = {.call = note_signal};
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGUSR1);
    sigaddset(&set, SIGUSR2);
    assert_true(gn_loop_add_signals(loop, &signals, &set));
    raise(SIGUSR2);
    raise(SIGUSR1);
    assert_int_equal(gn_loop_step(loop, GN_LOOP_NEVER), 1);
    assert_calls("u0 s0 ");
    gn_loop_remove_signals(&signals);
    gn_loop_remove_signals(&signals);
    raise(SIGUSR1); /* blocked still */
    assert_int_equal(gn_loop_step(loop, 0), 0);
}

static void test_a_step_allocates_nothing(void **state) {
    (void)state;
    const unsigned long before = gn_alloc_count();
    for (int i = 0; i < 100; i++) {
        write_byte(i % PIPES);
        timers[i % PIPES].due_ns = 0;
        gn_loop_step(loop, GN_LOOP_NEVER);
        calls[0] = '\0';
    }
    assert_int_equal(gn_alloc_count(), before);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, open_all, close_all)
    const struct CMUnitTest tests[] = {
        TEST(test_descriptors_come_before_timers_each_as_added),
        TEST(test_what_is_collected_is_handled_once_in_the_same_step),
        TEST(test_a_descriptor_that_is_left_unread_is_ready_again),
        TEST(test_an_end_is_told_of),
        TEST(test_what_cannot_be_waited_for_is_not_added),
        TEST(test_a_removed_source_is_not_called),
        TEST(test_a_timer_is_called_once_a_step),
        TEST(test_a_timer_may_remove_itself_and_the_next),
        TEST(test_fake_time_jumps_from_timer_to_timer),
        TEST(test_a_real_wait_ends_with_its_timer_and_not_before),
        TEST(test_signals_come_as_calls),
        TEST(test_a_step_allocates_nothing),
    };
    return RUN(tests);
}
