/* The places that a picture passes through against burn-in. */
#include "unit/check.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "kiosk/shift.h"

enum { MOST = 64, SIDE = 2 * MOST + 1 };

static void it_passes_through_all_places_by_single_pixels(void **state) {
    (void)state;
    static bool seen[SIDE][SIDE];
    for (int most = 1; most <= MOST; most++) {
        int at[2] = {0, 0}, next[2], places = 0;
        memset(seen, 0, sizeof seen);
        gn_shift_at(0, most, next);
        assert_true(next[0] == 0 && next[1] == 0);
        for (int64_t minute = 0; minute < 16L * most * most; minute++) {
            gn_shift_at(minute, most, next);
            for (int k = 0; k < 2; k++) {
                assert_true(abs(next[k]) <= most);
                assert_true(abs(next[k] - at[k]) <= 1);
                at[k] = next[k];
            }
            bool *place = &seen[at[1] + most][at[0] + most];
            places += !*place;
            *place = true;
        }
        assert_int_equal(places, (2 * most + 1) * (2 * most + 1));
    }
}

static void it_stays_where_nothing_is_asked_for_and_after_a_century(void **state) {
    (void)state;
    int at[2] = {1, 1};
    gn_shift_at(1000, 0, at);
    assert_true(at[0] == 0 && at[1] == 0);
    gn_shift_at(100L * 366 * 24 * 60, 8, at);
    assert_true(abs(at[0]) <= 8 && abs(at[1]) <= 8);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_passes_through_all_places_by_single_pixels),
        cmocka_unit_test(it_stays_where_nothing_is_asked_for_and_after_a_century),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
