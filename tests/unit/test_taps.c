#include "shadow/taps.h"

#include <math.h>

#include "unit/check.h"

static const int counts[] = {8, 12, 16, 32};

/* Within the disk, of its mean square radius, none on top of another. */
static void check_taps(enum gn_taps kind, int count, double apart) {
    float taps[GN_TAPS_MAX / 2][2];
    double square = 0, least = 2;
    gn_taps_build(kind, count, taps);
    for (int i = 0; i < count / 2; i++) {
        double r = hypot((double)taps[i][0], (double)taps[i][1]);
        assert_true(r <= 1.1);
        square += r * r / (count / 2);
        least = fmin(least, 2 * r);
        for (int k = 0; k < i; k++)
            for (int side = -1; side <= 1; side += 2)
                least = fmin(least, hypot((double)taps[i][0] - side * (double)taps[k][0],
                                          (double)taps[i][1] - side * (double)taps[k][1]));
    }
    assert_float_equal(square, .5, .001);
    assert_true(least >= apart / sqrt(count));
}

static void test_disk(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) check_taps(GN_TAPS_DISK, counts[i], .9);
}

static void test_poisson(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) check_taps(GN_TAPS_POISSON, counts[i], 1.3);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_disk), cmocka_unit_test(test_poisson)};
    return cmocka_run_group_tests_name("taps", tests, NULL, NULL);
}
