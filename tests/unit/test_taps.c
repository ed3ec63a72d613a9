#include "shadow/taps.h"

#include <math.h>

#include "unit/check.h"

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
    for (int count = 4; count <= GN_TAPS_MAX; count += 4) check_taps(GN_TAPS_DISK, count, .9);
}

static void test_poisson(void **state) {
    (void)state;
    for (int count = 4; count <= GN_TAPS_MAX; count += 4) check_taps(GN_TAPS_POISSON, count, 1.3);
}

/* The share of the unit disk to the left of x = at. */
static double disk_share(double at) { return 1 - (acos(at) - at * sqrt(1 - at * at)) / M_PI; }

/* Root mean square over straight edges and the turns of noise_quarter()
 * (shaders_es/lib/noise.glsl): the share of taps beyond an edge, less the disk's. Hardware compares
 * are a ramp a few hundredths of the radius wide. */
static double edge_error(int rings) {
    enum { TURNS = 48, EDGES = 12, STEPS = 80 };
    float points[GN_RINGS_MAX][2];
    double square = 0;
    gn_taps_rings(rings, points);
    for (int k = 0; k < TURNS * EDGES; k++) {
        const double turn =
            2 * atan((k / EDGES + .5) / TURNS) + (k % EDGES + .5) / EDGES * M_PI / 2;
        for (int t = 0; t <= STEPS; t++) {
            const double at = 2.0 * t / STEPS - 1;
            double share = 0;
            for (int i = 0; i < 4 * rings; i++) {
                const double x = (double)points[i / 4][0], y = (double)points[i / 4][1],
                             angle = turn + i % 4 * M_PI / 2;
                share += fmin(fmax(.5 + (at - (x * cos(angle) - y * sin(angle))) / .08, 0), 1);
            }
            share = share / (4 * rings) - disk_share(at);
            square += share * share / (TURNS * EDGES * (STEPS + 1));
        }
    }
    return sqrt(square);
}

static void test_rings_measure_edges(void **state) {
    (void)state;
    static const double most[] = {[2] = .0505, [3] = .034, [4] = .0265};
    for (int rings = 2; rings <= GN_RINGS_MAX; rings++) {
        const double error = edge_error(rings);
        if (!(error <= most[rings])) fail_msg("%d rings: %.4f", rings, error);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_disk), cmocka_unit_test(test_poisson),
                                       cmocka_unit_test(test_rings_measure_edges)};
    return cmocka_run_group_tests_name("taps", tests, NULL, NULL);
}
