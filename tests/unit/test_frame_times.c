#include "unit/check.h"

#include "core/clock.h"
#include "kiosk/stats.h"

static struct gn_frame_times times;

static void frames_of_the_last_second_are_counted(void **state) {
    const int64_t begun_ns = 5000 * GN_NS_PER_S;
    (void)state;
    times = (struct gn_frame_times){0};
    assert_int_equal(gn_frame_times_fps(&times, begun_ns), 0);
    for (int i = 0; i < 300; i++) gn_frame_times_add(&times, begun_ns + (i + 1) * GN_NS_PER_S / 60);
    const int64_t end_ns = begun_ns + 5 * GN_NS_PER_S;
    assert_int_equal(gn_frame_times_fps(&times, end_ns), 60);
    assert_int_equal(gn_frame_times_fps(&times, end_ns + GN_NS_PER_S / 2), 30);
    assert_int_equal(gn_frame_times_fps(&times, end_ns + GN_NS_PER_S), 0);
}

static void more_than_it_can_hold_is_the_most_it_says(void **state) {
    (void)state;
    times = (struct gn_frame_times){0};
    for (int i = 0; i < 1000; i++)
        gn_frame_times_add(&times, 2 * GN_NS_PER_S + i * GN_NS_PER_S / 1000);
    assert_int_equal(gn_frame_times_fps(&times, 3 * GN_NS_PER_S - 1), GN_FRAME_TIMES);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_of_the_last_second_are_counted),
        cmocka_unit_test(more_than_it_can_hold_is_the_most_it_says),
    };
    return RUN(tests);
}
