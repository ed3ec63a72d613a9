#include <errno.h>
#include <string.h>

#include "display/kms/flip.h"
#include "unit/check.h"

#define MS    INT64_C(1000000)
#define FRAME (16 * MS)

static struct gn_flip at_60(void) { return (struct gn_flip){.period_ns = FRAME}; }

static void frame(struct gn_flip *f, int64_t begun, int64_t shown) {
    gn_flip_begun(f, begun);
    gn_flip_committed(f, begun + MS);
    gn_flip_done(f, shown, shown);
}

static void test_one_flip_in_flight(void **state) {
    (void)state;
    struct gn_flip f = at_60();
    assert_true(gn_flip_may_draw(&f, 0));
    gn_flip_begun(&f, MS);
    gn_flip_committed(&f, 2 * MS);
    assert_false(gn_flip_may_draw(&f, 100 * MS));
    gn_flip_done(&f, FRAME, FRAME);
    assert_true(gn_flip_may_draw(&f, FRAME));
    assert_int_equal(f.shown, 1);
    gn_flip_done(&f, 2 * FRAME, 2 * FRAME); /* an event that nobody waits for */
    assert_int_equal(f.shown, 1);
}

static void test_missed_refreshes_are_counted(void **state) {
    (void)state;
    struct gn_flip f = at_60();
    frame(&f, MS, FRAME);
    frame(&f, FRAME + MS, 2 * FRAME);
    assert_int_equal(f.missed, 0);
    frame(&f, 2 * FRAME + MS, 5 * FRAME);
    assert_int_equal(f.missed, 2);
    frame(&f, 100 * FRAME + MS, 101 * FRAME); /* nothing was to be shown in between */
    assert_int_equal(f.missed, 2);
}

static void test_seen_at_the_refresh_that_will_show_it(void **state) {
    (void)state;
    struct gn_flip f = at_60();
    frame(&f, MS, FRAME);
    assert_int_equal(gn_flip_seen_ns(&f, FRAME + MS), 2 * FRAME);
    frame(&f, FRAME + MS, 3 * FRAME); /* takes two refreshes: so will the next */
    assert_int_equal(gn_flip_seen_ns(&f, 3 * FRAME + MS), 5 * FRAME);
}

static void test_fewer_frames_than_refreshes(void **state) {
    (void)state;
    struct gn_flip f = {.period_ns = FRAME, .shortest_ns = 3 * FRAME};
    frame(&f, MS, FRAME);
    assert_false(gn_flip_may_draw(&f, 2 * FRAME));
    assert_int_equal(gn_flip_deadline(&f, 2 * FRAME), 3 * FRAME);
    assert_true(gn_flip_may_draw(&f, 3 * FRAME));
    gn_flip_begun(&f, 3 * FRAME + MS);
    assert_int_equal(f.due_ns, 4 * FRAME);
}

static void test_a_timer_paces_where_there_is_no_vblank(void **state) {
    (void)state;
    struct gn_flip f = {.period_ns = FRAME, .no_vblank = true};
    int64_t now = 5 * MS;
    for (int i = 0; i < 10; i++) {
        assert_true(gn_flip_may_draw(&f, now));
        frame(&f, now, now + 2 * MS);
        assert_false(gn_flip_may_draw(&f, now + 2 * MS));
        now = gn_flip_deadline(&f, now + 2 * MS);
        assert_int_equal(now, 5 * MS + (i + 1) * FRAME);
    }
    assert_int_equal(f.missed, 0);
    frame(&f, now, now + 40 * MS); /* late: the next one at once */
    assert_true(gn_flip_may_draw(&f, now + 40 * MS));
    assert_int_equal(f.missed, 2);
}

static void test_the_ladder_of_a_lost_flip(void **state) {
    (void)state;
    static const enum gn_flip_act ends[] = {GN_FLIP_RELIGHT, GN_FLIP_REOPEN, GN_FLIP_GIVE_UP};
    struct gn_flip f = at_60();
    for (int i = 0; i < 3; i++) {
        gn_flip_committed(&f, 0);
        assert_int_equal(gn_flip_deadline(&f, 0), 250 * MS);
        assert_int_equal(gn_flip_step(&f, 250 * MS), GN_FLIP_WAIT);
        assert_int_equal(f.stalls, i + 1);
        assert_int_equal(gn_flip_deadline(&f, 250 * MS), 2000 * MS);
        assert_int_equal(gn_flip_step(&f, 2000 * MS), GN_FLIP_DRAIN);
        assert_int_equal(gn_flip_step(&f, 2001 * MS), GN_FLIP_WAIT);
        assert_int_equal(gn_flip_deadline(&f, 2001 * MS), 12000 * MS);
        assert_int_equal(gn_flip_step(&f, 12000 * MS), ends[i]);
        assert_false(f.pending);
    }
}

static void test_a_flip_that_ends_is_a_new_start(void **state) {
    (void)state;
    struct gn_flip f = at_60();
    gn_flip_committed(&f, 0);
    assert_int_equal(gn_flip_step(&f, 12000 * MS), GN_FLIP_RELIGHT);
    gn_flip_committed(&f, 12000 * MS);
    gn_flip_done(&f, 12010 * MS, 12010 * MS);
    gn_flip_committed(&f, 12020 * MS);
    assert_int_equal(gn_flip_step(&f, 25000 * MS), GN_FLIP_RELIGHT);
}

static void test_an_impossible_time_is_not_believed(void **state) {
    (void)state;
    struct gn_flip f = at_60();
    frame(&f, 1000 * MS, 1010 * MS);
    gn_flip_begun(&f, 1011 * MS);
    gn_flip_committed(&f, 1012 * MS);
    gn_flip_done(&f, 0, 1026 * MS);
    assert_int_equal(f.shown_ns, 1026 * MS);
    gn_flip_committed(&f, 1030 * MS);
    gn_flip_done(&f, 99999 * MS, 1042 * MS);
    assert_int_equal(f.shown_ns, 1042 * MS);
}

static void test_refused_waits_a_frame(void **state) {
    (void)state;
    struct gn_flip f = at_60();
    gn_flip_refused(&f, 10 * MS);
    assert_false(gn_flip_may_draw(&f, 11 * MS));
    assert_int_equal(gn_flip_deadline(&f, 11 * MS), 10 * MS + FRAME);
}

static void test_what_an_errno_means(void **state) {
    (void)state;
    assert_int_equal(gn_flip_error_of(EBUSY), GN_FLIP_BUSY);
    assert_int_equal(gn_flip_error_of(EACCES), GN_FLIP_NO_MASTER);
    assert_int_equal(gn_flip_error_of(ENODEV), GN_FLIP_CARD_GONE);
    assert_int_equal(gn_flip_error_of(ENOMEM), GN_FLIP_NO_MEMORY);
    assert_int_equal(gn_flip_error_of(EINVAL), GN_FLIP_CHANGED);
    assert_int_equal(gn_flip_error_of(EDOM), GN_FLIP_CHANGED);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_flip_in_flight),
        cmocka_unit_test(test_missed_refreshes_are_counted),
        cmocka_unit_test(test_seen_at_the_refresh_that_will_show_it),
        cmocka_unit_test(test_fewer_frames_than_refreshes),
        cmocka_unit_test(test_a_timer_paces_where_there_is_no_vblank),
        cmocka_unit_test(test_the_ladder_of_a_lost_flip),
        cmocka_unit_test(test_a_flip_that_ends_is_a_new_start),
        cmocka_unit_test(test_an_impossible_time_is_not_believed),
        cmocka_unit_test(test_refused_waits_a_frame),
        cmocka_unit_test(test_what_an_errno_means),
    };
    return RUN(tests);
}
