/* What was wanted last is told to a television, once, however often it takes; on a fake adapter,
 * with seconds of 2 ms. */
#include "unit/check.h"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "display/television.h"
#include "unit/cec_fake.h"

#define SECOND_NS   (2 * GN_NS_PER_S / 1000)
#define PATIENCE_NS (60 * GN_NS_PER_S)

static struct gn_television *open_television(struct cec_fake *fake) {
    struct gn_err err = {0};
    const struct gn_television_opts opts = {
        .cec = {.ops = &cec_fake_ops, .context = fake, .drm = "/nonexistent"},
        .second_ns = SECOND_NS};
    struct gn_television *t = gn_television_open(&opts, &err);
    if (!t) fail_msg("%s", err.text);
    return t;
}

/* Waits as a loop does, by the descriptor, until the state is so. */
#define WAIT(t, s, condition)                                                                      \
    do {                                                                                           \
        const int64_t end_ns = gn_clock_monotonic_ns() + PATIENCE_NS;                              \
        for (gn_television_read(t, s); !(condition); gn_television_read(t, s)) {                   \
            poll(&(struct pollfd){gn_television_fd(t), POLLIN, 0}, 1, 1000);                       \
            if (gn_clock_monotonic_ns() > end_ns) fail_msg("never: %s", #condition);               \
        }                                                                                          \
    } while (0)

/* No thread uses the fake any more. */
static void close_television(struct gn_television *t, struct cec_fake *fake) {
    gn_television_close(t);
    for (int open = 1; open > 0; usleep(1000)) {
        cec_fake_lock();
        open = fake->open;
        cec_fake_unlock();
    }
}

static void pauses_grow_and_then_only_what_helps_goes_on(void **state) {
    (void)state;
    static const int expected[] = {1, 2, 4, 8, 16};
    for (int tries = 1; tries <= 5; tries++) {
        assert_int_equal(gn_television_pause_s(GN_CEC_NO_ANSWER, true, tries), expected[tries - 1]);
        assert_int_equal(gn_television_pause_s(GN_CEC_NO_ADAPTER, false, tries),
                         expected[tries - 1]);
    }
    assert_int_equal(gn_television_pause_s(GN_CEC_NO_ANSWER, true, 6), 60);
    assert_int_equal(gn_television_pause_s(GN_CEC_NO_ANSWER, true, 1000000), 60);
    assert_int_equal(gn_television_pause_s(GN_CEC_NO_ANSWER, false, 6), -1);
    assert_int_equal(gn_television_pause_s(GN_CEC_NO_ADAPTER, false, 6), 60);
    assert_int_equal(gn_television_pause_s(GN_CEC_TOLD, true, 3), -1);
    assert_int_equal(gn_television_pause_s(GN_CEC_UNPLUGGED, false, 0), 5);
    assert_int_equal(gn_television_pause_s(GN_CEC_STARTS, true, 1), 2);
    assert_int_equal(gn_television_pause_s(GN_CEC_STARTS, true, 10), -1);
}

static void each_change_is_told_once(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    usleep(20000);
    gn_television_read(t, &s);
    assert_true(s.wanted == GN_TELEVISION_ANY && s.attempts == 0); /* nobody has said anything */
    for (int night = 1; night <= 3; night++) {
        for (int i = 0; i < 50; i++) gn_television_set(t, true, "HDMI-A-1");
        WAIT(t, &s, s.told == GN_TELEVISION_ON);
        for (int i = 0; i < 50; i++) gn_television_set(t, false, NULL);
        WAIT(t, &s, s.told == GN_TELEVISION_STANDBY);
        usleep(20000);
        for (int i = 0; i < 50; i++) gn_television_set(t, false, NULL);
        usleep(20000);
        assert_int_equal(cec_fake_count(fake, "40:36"), night);
        assert_int_equal(cec_fake_count(fake, "40:04"), night);
        assert_int_equal(cec_fake_count(fake, "4f:82:10:00"), night);
    }
    gn_television_read(t, &s);
    assert_int_equal(s.attempts, 6);
    assert_string_equal(s.device, "/dev/cec0");
    assert_string_equal(s.waits, "");
    close_television(t, fake);
}

/* While one attempt takes long, others come and go. */
static void what_was_wanted_last_holds(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    fake->delay_us = 20000;
    for (int i = 0; i < 20; i++) {
        const int64_t before_ns = gn_clock_monotonic_ns();
        gn_television_set(t, i % 2 == 0, NULL);
        assert_true(gn_clock_monotonic_ns() - before_ns < GN_NS_PER_S);
        usleep((useconds_t)(i % 5) * 5000);
    }
    WAIT(t, &s, s.told == s.wanted);
    assert_int_equal(s.wanted, GN_TELEVISION_STANDBY);
    cec_fake_lock();
    assert_false(fake->powered);
    assert_true(s.attempts <= 20);
    cec_fake_unlock();
    close_television(t, fake);
}

static void a_change_in_the_middle_of_an_attempt_follows_it(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    gn_television_set(t, false, NULL);
    WAIT(t, &s, s.told == GN_TELEVISION_STANDBY);
    cec_fake_lock();
    fake->delay_us = 100000;
    cec_fake_unlock();
    gn_television_set(t, true, NULL);
    while (cec_fake_count(fake, "40:04") == 0) usleep(1000);
    gn_television_set(t, false, NULL);
    WAIT(t, &s, s.attempts == 3);
    assert_int_equal(s.told, GN_TELEVISION_STANDBY);
    assert_int_equal(cec_fake_count(fake, "40:36"), 2);
    close_television(t, fake);
}

/* The thread may see the change, or not: but no standby follows another. */
static void what_is_taken_back_before_it_is_told_is_not_told(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    for (int i = 0; i < 200; i++) {
        cec_fake_lock();
        fake->log[0] = '\0';
        cec_fake_unlock();
        gn_television_set(t, false, NULL);
        WAIT(t, &s, s.told == GN_TELEVISION_STANDBY);
        gn_television_set(t, true, NULL);
        gn_television_set(t, false, NULL);
        WAIT(t, &s, s.told == GN_TELEVISION_STANDBY);
        usleep(1000);
        assert_int_equal(cec_fake_count(fake, "40:36 40:36"), 0);
    }
    close_television(t, fake);
}

static void one_that_misses_messages_is_told_until_it_hears(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    fake->nacks = 3;
    gn_television_set(t, true, NULL);
    WAIT(t, &s, s.told == GN_TELEVISION_ON);
    assert_int_equal(s.attempts, 4);
    assert_string_equal(s.problem, "");
    assert_string_equal(s.waits, "");
    close_television(t, fake);
}

static void silence_is_a_problem_until_it_ends(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    cec_fake_lock();
    fake->nacks = -1;
    cec_fake_unlock();
    gn_television_set(t, true, NULL);
    WAIT(t, &s, s.attempts >= 1);
    assert_string_equal(s.problem, ""); /* not at once */
    assert_non_null(strstr(s.waits, "does not answer"));
    WAIT(t, &s, s.problem[0]);
    assert_true(s.attempts >= GN_TELEVISION_TRIES);
    assert_non_null(strstr(s.problem, "/dev/cec0 does not answer"));
    cec_fake_lock();
    fake->nacks = 0;
    cec_fake_unlock();
    WAIT(t, &s, s.told == GN_TELEVISION_ON);
    assert_string_equal(s.problem, "");

    /* one that does not hear that it is to be off is left alone in the end */
    cec_fake_lock();
    fake->nacks = -1;
    cec_fake_unlock();
    const uint64_t before = s.attempts;
    gn_television_set(t, false, NULL);
    WAIT(t, &s, s.problem[0]);
    usleep(300000);
    gn_television_read(t, &s);
    assert_int_equal(s.attempts - before, GN_TELEVISION_TRIES);
    cec_fake_lock();
    fake->nacks = 0;
    cec_fake_unlock();
    gn_television_set(t, true, NULL);
    WAIT(t, &s, s.told == GN_TELEVISION_ON);
    assert_string_equal(s.problem, "");
    close_television(t, fake);
}

static void an_unplugged_one_is_waited_for_without_a_problem(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    cec_fake_lock();
    fake->adapters[0].address = CEC_FAKE_NONE;
    cec_fake_unlock();
    gn_television_set(t, false, NULL);
    WAIT(t, &s, s.attempts >= GN_TELEVISION_TRIES + 4);
    assert_string_equal(s.problem, "");
    assert_non_null(strstr(s.waits, "no television is connected to /dev/cec0"));
    cec_fake_lock();
    fake->adapters[0].address = 0x1000;
    cec_fake_unlock();
    WAIT(t, &s, s.told == GN_TELEVISION_STANDBY);
    assert_int_equal(cec_fake_count(fake, "40:36"), 1);
    close_television(t, fake);
}

static void an_adapter_that_comes_late_is_found(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    cec_fake_lock();
    fake->adapters[0].present = false;
    cec_fake_unlock();
    gn_television_set(t, false, NULL);
    WAIT(t, &s, s.problem[0]);
    assert_non_null(strstr(s.problem, "no CEC adapter"));
    cec_fake_lock();
    fake->adapters[2] = (struct cec_fake_adapter){.present = true, .address = 0x3000};
    cec_fake_unlock();
    WAIT(t, &s, s.told == GN_TELEVISION_STANDBY);
    assert_string_equal(s.problem, "");
    assert_string_equal(s.device, "/dev/cec2");
    close_television(t, fake);
}

static void one_that_starts_hears_again_what_to_show(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    fake->starts = 3;
    gn_television_set(t, true, NULL);
    WAIT(t, &s, s.attempts == 4);
    usleep(30000);
    assert_int_equal(cec_fake_count(fake, "4f:82:10:00"), 4);
    gn_television_read(t, &s);
    assert_true(s.attempts == 4 && s.told == GN_TELEVISION_ON);
    close_television(t, fake);
}

static void at_another_connector_there_is_another_one(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    gn_television_set(t, true, "HDMI-A-1");
    WAIT(t, &s, s.told == GN_TELEVISION_ON);
    gn_television_set(t, true, ""); /* unplugged */
    gn_television_set(t, true, "HDMI-A-1");
    usleep(20000);
    assert_int_equal(cec_fake_count(fake, "40:04"), 1);
    gn_television_set(t, true, "HDMI-A-2");
    WAIT(t, &s, s.attempts == 2 && s.told == GN_TELEVISION_ON);
    assert_int_equal(cec_fake_count(fake, "40:04"), 2);
    close_television(t, fake);
}

/* The screen comes up at another connector in the middle of an attempt. */
static void a_connector_that_comes_in_an_attempt_is_told_after_it(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    fake->delay_us = 50000;
    gn_television_set(t, true, "");
    usleep(20000);
    gn_television_set(t, true, "HDMI-A-2");
    WAIT(t, &s, s.attempts == 2 && s.told == GN_TELEVISION_ON);
    assert_int_equal(cec_fake_count(fake, "40:04"), 2);
    close_television(t, fake);
}

static int starts_left(struct cec_fake *fake) {
    cec_fake_lock();
    const int left = fake->starts;
    cec_fake_unlock();
    return left;
}

/* One that had no power for long is told again, too. */
static void one_that_starts_late_hears_it_again(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    struct gn_television *t = open_television(fake);
    struct gn_television_state s;
    fake->nacks = -1;
    gn_television_set(t, true, NULL);
    WAIT(t, &s, s.attempts >= 12);
    cec_fake_lock();
    fake->nacks = 0;
    fake->starts = 2;
    cec_fake_unlock();
    WAIT(t, &s, s.told == GN_TELEVISION_ON && !s.waits[0]);
    WAIT(t, &s, starts_left(fake) == 0); /* each answer is that of another attempt */
    close_television(t, fake);
}

static void it_closes_at_once_in_the_middle_of_an_attempt(void **state) {
    (void)state;
    struct cec_fake *fake = cec_fake_new();
    fake->delay_us = 200000;
    for (int i = 0; i < 10; i++) {
        struct gn_television *t = open_television(fake);
        gn_television_set(t, i % 2, NULL);
        usleep((useconds_t)i * 3000);
        const int64_t before_ns = gn_clock_monotonic_ns();
        gn_television_close(t);
        assert_true(gn_clock_monotonic_ns() - before_ns < GN_NS_PER_S / 10);
    }
    gn_television_close(NULL);
    struct gn_television *last = open_television(fake);
    close_television(last, fake);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pauses_grow_and_then_only_what_helps_goes_on),
        cmocka_unit_test(each_change_is_told_once),
        cmocka_unit_test(what_was_wanted_last_holds),
        cmocka_unit_test(a_change_in_the_middle_of_an_attempt_follows_it),
        cmocka_unit_test(what_is_taken_back_before_it_is_told_is_not_told),
        cmocka_unit_test(one_that_misses_messages_is_told_until_it_hears),
        cmocka_unit_test(silence_is_a_problem_until_it_ends),
        cmocka_unit_test(an_unplugged_one_is_waited_for_without_a_problem),
        cmocka_unit_test(an_adapter_that_comes_late_is_found),
        cmocka_unit_test(one_that_starts_hears_again_what_to_show),
        cmocka_unit_test(at_another_connector_there_is_another_one),
        cmocka_unit_test(a_connector_that_comes_in_an_attempt_is_told_after_it),
        cmocka_unit_test(one_that_starts_late_hears_it_again),
        cmocka_unit_test(it_closes_at_once_in_the_middle_of_an_attempt),
    };
    return RUN(tests);
}
