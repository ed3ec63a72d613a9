#include "unit/check.h"

#include "kiosk/latency.h"

#define MS INT64_C(1000000)

static struct gn_latency latency;

static int begin(void **state) {
    (void)state;
    latency = (struct gn_latency){0};
    return 0;
}

static void nothing_has_happened_yet(void **state) {
    (void)state;
    for (int i = 0; i < 10; i++) gn_latency_frame(&latency, i * 16 * MS, true);
    const struct gn_latency_report r = gn_latency_read(&latency);
    assert_int_equal(r.count, 0);
    assert_int_equal(r.median.ns, 0);
    assert_int_equal(r.worst.ns, 0);
}

/* The edge comes while a frame is drawn that knows nothing of it, and settles during the second. */
static void it_ends_with_the_frame_that_shows_it(void **state) {
    (void)state;
    gn_latency_frame(&latency, 100 * MS, true);
    gn_latency_frame(&latency, 120 * MS, true); /* the edge was at 110 */
    gn_latency_edge(&latency, 110 * MS);
    gn_latency_frame(&latency, 140 * MS, false); /* the mode is made ready yet */
    gn_latency_frame(&latency, 160 * MS, true);
    gn_latency_frame(&latency, 180 * MS, true);
    const struct gn_latency_report r = gn_latency_read(&latency);
    assert_int_equal(r.count, 1);
    assert_int_equal(r.median.ns, 50 * MS);
    assert_int_equal(r.median.frames, 3);
    assert_int_equal(r.worst.ns, 50 * MS);
    assert_int_equal(r.worst.frames, 3);
}

static void one_frame_may_show_several(void **state) {
    (void)state;
    gn_latency_edge(&latency, 10 * MS);
    gn_latency_edge(&latency, 30 * MS);
    gn_latency_frame(&latency, 50 * MS, true);
    const struct gn_latency_report r = gn_latency_read(&latency);
    assert_int_equal(r.count, 2);
    assert_int_equal(gn_latency_last(&latency).ns, 20 * MS);
    assert_int_equal(r.median.ns, 20 * MS);
    assert_int_equal(r.worst.ns, 40 * MS);
    assert_int_equal(r.worst.frames, 1);
}

static void what_is_not_shown_does_not_count(void **state) {
    (void)state;
    gn_latency_edge(&latency, 10 * MS);
    gn_latency_drop(&latency);
    gn_latency_frame(&latency, 5000 * MS, true);
    assert_int_equal(gn_latency_read(&latency).count, 0);
}

/* The median is that of the last 256, 745 to 1000 ms; the worst is remembered. */
static void the_median_is_of_late_and_the_worst_of_all(void **state) {
    (void)state;
    gn_latency_edge(&latency, 0);
    gn_latency_frame(&latency, 7000 * MS, true);
    for (int i = 1; i <= 1000; i++) {
        const int64_t edge_ns = (10 + i) * 10000 * MS;
        gn_latency_edge(&latency, edge_ns);
        gn_latency_frame(&latency, edge_ns + i * MS, true);
    }
    const struct gn_latency_report r = gn_latency_read(&latency);
    assert_int_equal(r.count, 1001);
    assert_int_equal(gn_latency_last(&latency).ns, 1000 * MS);
    assert_int_equal(r.median.ns, 872 * MS);
    assert_int_equal(r.median.frames, 1);
    assert_int_equal(r.worst.ns, 7000 * MS);
}

static void too_many_are_left_out(void **state) {
    (void)state;
    for (int i = 0; i < 3 * GN_LATENCY_WAITING; i++) gn_latency_edge(&latency, i * MS);
    for (int i = 0; i < 2 * GN_LATENCY_FRAMES; i++)
        gn_latency_frame(&latency, (1000 + i) * MS, false);
    gn_latency_frame(&latency, 2000 * MS, true);
    const struct gn_latency_report r = gn_latency_read(&latency);
    assert_int_equal(r.count, GN_LATENCY_WAITING);
    assert_int_equal(r.worst.ns, 2000 * MS);
    assert_int_equal(r.worst.frames, GN_LATENCY_FRAMES);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(nothing_has_happened_yet, begin),
        cmocka_unit_test_setup(it_ends_with_the_frame_that_shows_it, begin),
        cmocka_unit_test_setup(one_frame_may_show_several, begin),
        cmocka_unit_test_setup(what_is_not_shown_does_not_count, begin),
        cmocka_unit_test_setup(the_median_is_of_late_and_the_worst_of_all, begin),
        cmocka_unit_test_setup(too_many_are_left_out, begin),
    };
    return RUN(tests);
}
