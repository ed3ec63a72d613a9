/* What gnomon fit gives up of a set of steps: by costs made up here. */
#include <string.h>

#include "cli/fit.h"
#include "unit/check.h"

static int measured;
static struct gn_err err;

/* Steps 0, 1 and 2 save 2, 0.01 and 5 of 20; 3 saves 6, and makes 0 and 2 void; 4 makes it dearer;
 * 5 saves what is left but 1. */
static bool measure(void *user, gn_fit_set taken, double *ms, struct gn_err *why) {
    (void)why;
    measured++;
    if (user && taken == *(const gn_fit_set *)user) return gn_fail(why, "this one fails");
    *ms = 20;
    if (taken >> 3 & 1)
        *ms -= 6;
    else
        *ms -= (taken & 1) * 2 + (double)(taken >> 2 & 1) * 5;
    *ms -= (double)(taken >> 1 & 1) * 0.01;
    *ms += (double)(taken >> 4 & 1) * 3;
    if (taken >> 5 & 1) *ms = 1;
    return true;
}

static struct gn_fit search(double goal_ms) {
    struct gn_fit fit = {.count = 6, .goal_ms = goal_ms, .measure = measure};
    measured = 0;
    assert_true(gn_fit_search(&fit, &err));
    assert_true(fit.best_ms == 20);
    return fit;
}

static void test_the_best_picture_loses_nothing(void **state) {
    (void)state;
    const struct gn_fit fit = search(20);
    assert_true(fit.is_met && fit.taken == 0 && fit.ms == 20 && measured == 1);
}

static void test_steps_are_taken_in_their_order(void **state) {
    (void)state;
    const struct gn_fit fit = search(18);
    assert_true(fit.is_met && fit.taken == 1 && fit.ms == 18);
}

static void test_what_a_later_step_makes_needless_is_given_back(void **state) {
    (void)state;
    struct gn_fit fit = search(15);
    assert_true(fit.is_met && fit.taken == 4 && fit.ms == 15);
    fit = search(2);
    assert_true(fit.is_met && fit.taken == 1 << 5 && fit.ms == 1);
}

/* Step 0 saves 2 of 20, but costs 5 beside step 1, which saves 8; 2 saves 12. */
static bool measure_pair(void *user, gn_fit_set taken, double *ms, struct gn_err *why) {
    (void)user, (void)why;
    *ms = taken & 2 ? 12 + (taken & 1) * 5 : 20 - (taken & 1) * 2;
    if (taken & 4) *ms = 8;
    return true;
}

static void test_what_a_later_step_makes_dear_is_dropped_at_once(void **state) {
    (void)state;
    struct gn_fit fit = {.count = 3, .goal_ms = 12.5, .measure = measure_pair};
    assert_true(gn_fit_search(&fit, &err));
    assert_true(fit.is_met && fit.taken == 2 && fit.ms == 12);
}

static void test_what_saves_nothing_is_not_taken(void **state) {
    (void)state;
    const struct gn_fit fit = search(13.5);
    assert_true(fit.is_met && fit.taken == 5 && fit.ms == 13);
    assert_true(fit.step_ms[0] == 18 && fit.step_ms[1] == 18 && fit.step_ms[5] == 13);
}

/* And of those that do not change it, none is left. */
static void test_a_goal_out_of_reach_gives_what_is_nearest(void **state) {
    (void)state;
    const struct gn_fit fit = search(0.5);
    assert_true(!fit.is_met && fit.taken == 1 << 5 && fit.ms == 1);
    struct gn_fit few = {.count = 4, .goal_ms = 0.5, .measure = measure};
    assert_true(gn_fit_search(&few, &err));
    assert_true(!few.is_met && few.taken == 5 && few.ms == 13);
}

static void test_each_set_is_measured_once(void **state) {
    (void)state;
    search(0.5);
    assert_true(measured <= 1 + 6 + 6);
}

static void test_a_failure_ends_it(void **state) {
    (void)state;
    gn_fit_set fails = 5;
    struct gn_fit fit = {.count = 6, .goal_ms = 1, .measure = measure, .user = &fails};
    assert_false(gn_fit_search(&fit, &err));
    assert_string_equal(err.text, "this one fails");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_best_picture_loses_nothing),
        cmocka_unit_test(test_steps_are_taken_in_their_order),
        cmocka_unit_test(test_what_a_later_step_makes_needless_is_given_back),
        cmocka_unit_test(test_what_a_later_step_makes_dear_is_dropped_at_once),
        cmocka_unit_test(test_what_saves_nothing_is_not_taken),
        cmocka_unit_test(test_a_goal_out_of_reach_gives_what_is_nearest),
        cmocka_unit_test(test_each_set_is_measured_once),
        cmocka_unit_test(test_a_failure_ends_it),
    };
    return RUN(tests);
}
