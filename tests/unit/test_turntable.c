/* The turntable that rests while the view is turned by hand. */
#include "kiosk/turntable.h"

#include <stdlib.h>

#include "check.h"
#include "core/clock.h"

#define S GN_NS_PER_S

static void test_untouched_it_never_rests(void **state) {
    (void)state;
    struct gn_turntable t = {0};
    for (int i = 1; i < 100; i++) {
        assert_false(gn_turntable_rests(&t, 5 * S, i * S));
        assert_true(gn_turntable_due_ns(&t, 5 * S, i * S) == INT64_MAX);
        assert_int_equal(gn_turntable_step(&t, 5 * S, i * S, i * S), 0);
    }
}

static void test_it_stands_until_the_rest_is_over(void **state) {
    (void)state;
    struct gn_turntable t = {0};
    gn_turntable_step(&t, 5 * S, 100 * S, 10 * S);
    gn_turntable_use(&t, 100 * S);
    assert_true(gn_turntable_rests(&t, 5 * S, 104 * S));
    assert_true(gn_turntable_due_ns(&t, 5 * S, 104 * S) == 105 * S);
    assert_int_equal(gn_turntable_step(&t, 5 * S, 103 * S, 13 * S), 3 * S);
    gn_turntable_use(&t, 104 * S); /* again */
    assert_int_equal(gn_turntable_step(&t, 5 * S, 108 * S, 18 * S), 8 * S);
    assert_false(gn_turntable_rests(&t, 5 * S, 109 * S));
    assert_true(gn_turntable_due_ns(&t, 5 * S, 109 * S) == INT64_MAX);
    assert_int_equal(gn_turntable_step(&t, 5 * S, 110 * S, 20 * S), 9 * S);
    assert_int_equal(gn_turntable_step(&t, 5 * S, 120 * S, 30 * S), 9 * S);
}

static void test_rest_of_no_time_is_none(void **state) {
    (void)state;
    struct gn_turntable t = {0};
    gn_turntable_step(&t, 0, 100 * S, 0);
    gn_turntable_use(&t, 100 * S);
    assert_false(gn_turntable_rests(&t, 0, 100 * S));
    assert_int_equal(gn_turntable_step(&t, 0, 101 * S, S), 0);
}

static void test_while_the_scene_stands_nothing_is_counted(void **state) {
    (void)state;
    struct gn_turntable t = {0};
    gn_turntable_step(&t, 5 * S, 100 * S, 7 * S);
    gn_turntable_use(&t, 100 * S);
    assert_int_equal(gn_turntable_step(&t, 5 * S, 103 * S, 7 * S), 0); /* paused */
}

static void test_it_begins_where_it_was_switched_off(void **state) {
    (void)state;
    struct gn_turntable t = {0};
    gn_turntable_step(&t, 5 * S, 100 * S, 10 * S);
    t.off = true;
    assert_int_equal(gn_turntable_step(&t, 5 * S, 200 * S, 110 * S), 110 * S);
    t.off = false;
    assert_int_equal(gn_turntable_step(&t, 5 * S, 205 * S, 115 * S), 110 * S);
}

/* However many frames were drawn, it has stood for as long. */
static void test_it_goes_on_from_where_it_stood_at_any_rate_of_frames(void **state) {
    (void)state;
    unsigned seed = 4;
    for (int round = 0; round < 200; round++) {
        struct gn_turntable t = {0};
        int64_t now_ns = 1000 * S, rested_ns = 0;
        gn_turntable_step(&t, 5 * S, now_ns, 0);
        gn_turntable_use(&t, now_ns);
        while (now_ns < 1020 * S) {
            now_ns += 1 + rand_r(&seed) % (3 * S);
            const int64_t before_ns = rested_ns;
            rested_ns = gn_turntable_step(&t, 5 * S, now_ns, 2 * (now_ns - 1000 * S));
            assert_true(rested_ns >= before_ns);
        }
        assert_true(llabs(rested_ns - 10 * S) < 100); /* of the scene's time: twice as fast */
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_untouched_it_never_rests),
        cmocka_unit_test(test_it_stands_until_the_rest_is_over),
        cmocka_unit_test(test_rest_of_no_time_is_none),
        cmocka_unit_test(test_while_the_scene_stands_nothing_is_counted),
        cmocka_unit_test(test_it_begins_where_it_was_switched_off),
        cmocka_unit_test(test_it_goes_on_from_where_it_stood_at_any_rate_of_frames),
    };
    return RUN(tests);
}
