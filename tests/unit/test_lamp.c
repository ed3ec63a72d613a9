/* Points of a lamp: seen from any side they are an even disk. */
#include <math.h>
#include <stdlib.h>

#include "shadow/lamp.h"
#include "unit/check.h"

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Root mean square of the error of the visible share behind half-planes in all directions across
 * the view, `tilt` radians from the axis, of the first `first` points. */
static double error_of(uint32_t first, uint32_t count, double tilt) {
    double sum = 0, at[GN_LAMP_POINTS_MAX];
    int cases = 0;
    for (int turn = 0; turn < 8; turn++)
        for (int edge = 0; edge < 24; edge++) {
            const double a = turn * M_PI / 4, b = edge * M_PI / 12;
            const double u[3] = {-sin(a), cos(a), 0},
                         v[3] = {-cos(tilt) * cos(a), -cos(tilt) * sin(a), sin(tilt)};
            for (uint32_t i = 0; i < first; i++) {
                float p[3];
                gn_lamp_point(i, count, p);
                at[i] = 0;
                for (int k = 0; k < 3; k++) at[i] += p[k] * (cos(b) * u[k] + sin(b) * v[k]);
            }
            qsort(at, first, sizeof *at, by_value);
            uint32_t before = 0;
            for (double x = -1; x <= 1; x += .05, cases++) {
                while (before < first && at[before] < x) before++;
                const double truth = .5 + (x * sqrt(fmax(1 - x * x, 0)) + asin(fmin(x, 1))) / M_PI;
                sum += pow((double)before / first - truth, 2);
            }
        }
    return sqrt(sum / cases);
}

static void test_points_are_an_even_disk_from_all_sides(void **state) {
    (void)state;
    static const struct {
        uint32_t count;
        double from_above, aside;
    } most[] = {
        {16, .04, .05}, {32, .025, .03}, {64, .014, .02}, {128, .009, .012}, {256, .006, .009}};
    for (size_t i = 0; i < sizeof most / sizeof *most; i++) {
        assert_true(gn_lamp_has_count(most[i].count));
        assert_true(error_of(most[i].count, most[i].count, 0) < most[i].from_above);
        for (double tilt = .2; tilt < 1.1; tilt += .3)
            assert_true(error_of(most[i].count, most[i].count, tilt) < most[i].aside);
        for (uint32_t first = 16; first < most[i].count; first *= 2)
            assert_true(error_of(first, most[i].count, 0) < .05 * sqrt(16. / first));
    }
    assert_false(gn_lamp_has_count(0) || gn_lamp_has_count(8) || gn_lamp_has_count(48));
}

static void test_points_lie_in_the_lamp(void **state) {
    (void)state;
    for (uint32_t i = 0; i < GN_LAMP_POINTS_MAX; i++) {
        float p[3];
        gn_lamp_point(i, GN_LAMP_POINTS_MAX, p);
        assert_true(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] <= 1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points_are_an_even_disk_from_all_sides),
        cmocka_unit_test(test_points_lie_in_the_lamp),
    };
    return cmocka_run_group_tests_name("lamp", tests, NULL, NULL);
}
