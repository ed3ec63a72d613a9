#include "check.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/child.h"

struct shared {
    uint32_t progress;
    int answer;
};

static struct gn_err err;

static int run(void (*work)(void *, const void *), int stall_s, struct shared *out) {
    struct shared *shared = gn_child_share(sizeof *shared, &err);
    assert_non_null(shared);
    const struct gn_child child = {
        .work = work, .argument = &(int){42}, .progress = &shared->progress, .stall_s = stall_s};
    memset(&err, 0, sizeof err);
    bool ok = gn_child_run(&child, shared, &err);
    *out = *shared;
    gn_child_unshare(shared, sizeof *shared);
    return ok;
}

static void answer(void *shared, const void *argument) {
    ((struct shared *)shared)->answer = *(const int *)argument;
}
static void test_what_a_child_leaves_is_here(void **state) {
    (void)state;
    struct shared out;
    assert_true(run(answer, 0, &out));
    assert_int_equal(out.answer, 42);
}

static void crash(void *shared, const void *argument) {
    answer(shared, argument);
    signal(SIGTERM, SIG_DFL);
    raise(SIGTERM);
}
static void test_a_crash_is_an_answer(void **state) {
    (void)state;
    struct shared out;
    assert_false(run(crash, 0, &out));
    assert_string_equal(err.text, "crashes (Terminated)");
    assert_int_equal(out.answer, 42);
}

static void leave(void *shared, const void *argument) {
    (void)shared, (void)argument;
    _exit(3);
}
static void test_an_early_end_is_an_answer(void **state) {
    (void)state;
    struct shared out;
    assert_false(run(leave, 0, &out));
    assert_string_equal(err.text, "exits (status 3)");
}

static void hang(void *shared, const void *argument) {
    (void)shared, (void)argument;
    for (;;) pause();
}
static void test_a_hang_ends(void **state) {
    (void)state;
    struct shared out;
    assert_false(run(hang, 1, &out));
    assert_string_equal(err.text, "hangs (no progress for 1 s)");
}

static void test_a_cancelled_child_is_killed(void **state) {
    (void)state;
    static const atomic_bool cancel = true;
    const struct gn_child child = {.work = hang, .cancel = &cancel};
    assert_false(gn_child_run(&child, NULL, &err));
    assert_string_equal(err.text, "was stopped");
}

static void plod(void *shared, const void *argument) {
    for (int i = 0; i < 6; i++) {
        usleep(300000);
        ((struct shared *)shared)->progress++;
    }
    answer(shared, argument);
}
static void test_progress_is_no_hang(void **state) {
    (void)state;
    struct shared out;
    assert_true(run(plod, 1, &out));
    assert_int_equal(out.answer, 42);
}

static void chat(void *shared, const void *argument) {
    answer(shared, argument);
    fputs("libEGL warning: hello\n", stderr);
    fputs("hello\n", stdout);
    fflush(NULL);
}
static void test_a_child_is_not_heard(void **state) {
    (void)state;
    struct shared out;
    int pipes[2], kept = dup(2);
    char byte;
    assert_int_equal(pipe(pipes), 0);
    dup2(pipes[1], 2);
    close(pipes[1]);
    bool ok = run(chat, 0, &out);
    dup2(kept, 2); /* the pipe's last writing end is gone with this */
    close(kept);
    assert_true(ok);
    assert_int_equal(read(pipes[0], &byte, 1), 0);
    close(pipes[0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_a_child_leaves_is_here),
        cmocka_unit_test(test_a_crash_is_an_answer),
        cmocka_unit_test(test_an_early_end_is_an_answer),
        cmocka_unit_test(test_a_hang_ends),
        cmocka_unit_test(test_a_cancelled_child_is_killed),
        cmocka_unit_test(test_progress_is_no_hang),
        cmocka_unit_test(test_a_child_is_not_heard),
    };
    return RUN(tests);
}
