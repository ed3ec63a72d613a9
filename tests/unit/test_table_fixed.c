/* The fixed point of summed-area tables (TABLE_SCALE, shaders_es/blocks.glsl) against sums in
 * double precision. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "blocks.glsl"
#include "core/arena.h"
#include "shadow/fit.h"
#include "unit/check.h"

enum { SIDE = 1024, WINDOW = 9 };

struct table { /* of two moments of a code: the code, and 4 (code - code^2) */
    uint32_t *sums[2];
    double *codes;
    uint64_t total; /* of the first, without wrapping round */
};

static uint32_t fixed(float value) {
    return (uint32_t)(value * TABLE_SCALE((float)GN_TABLE_REACH_PX) + 0.5f);
}

static double moment(double code, int which) { return which ? 4 * (code - code * code) : code; }

static void build(struct table *t, double (*code_at)(int x, int y)) {
    t->codes = gn_xalloc((size_t)SIDE * SIDE, sizeof *t->codes);
    t->total = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            t->codes[y * SIDE + x] = code_at(x, y);
            t->total += fixed((float)code_at(x, y));
        }
    for (int m = 0; m < 2; m++) {
        t->sums[m] = gn_xalloc((size_t)SIDE * SIDE, sizeof *t->sums[m]);
        for (int y = 0; y < SIDE; y++) {
            uint32_t before = 0; /* of whole blocks, each rounded */
            float block = 0;
            for (int x = 0; x < SIDE; x++) {
                block += (float)moment(t->codes[y * SIDE + x], m);
                const uint32_t row = before + fixed(block);
                t->sums[m][y * SIDE + x] = row + (y > 0 ? t->sums[m][(y - 1) * SIDE + x] : 0);
                if (x % TABLE_BLOCK == TABLE_BLOCK - 1) before = row, block = 0;
            }
        }
    }
}

static void finish(struct table *t) {
    free(t->codes);
    for (int m = 0; m < 2; m++) free(t->sums[m]);
}

/* Of the square of so many texels above and to the right of an edge, 1 at least. */
static double mean_of(const struct table *t, int m, int x, int y, int side) {
    const uint32_t *s = t->sums[m];
    const int left = x - 1, right = left + side, low = (y - 1) * SIDE, high = low + side * SIDE;
    const uint32_t sum = s[high + right] - s[high + left] - s[low + right] + s[low + left];
    return sum / (double)TABLE_SCALE((float)GN_TABLE_REACH_PX) / side / side;
}

static double true_mean(const struct table *t, int power, int x, int y, int side) {
    double sum = 0;
    for (int j = y; j < y + side; j++)
        for (int i = x; i < x + side; i++) sum += pow(t->codes[j * SIDE + i], power);
    return sum / side / side;
}

static double random_code(int x, int y) { /* of this texel always the same */
    uint32_t h = (uint32_t)(y * SIDE + x) * 2654435761u;
    h = (h ^ h >> 15) * 2246822519u;
    return (h ^ h >> 13) / 4294967295.0;
}

/* Near, far and what is between, in blocks: as a map looks. */
static double block_code(int x, int y) {
    return random_code(x / 7, y / 5) < 0.4 ? 1 : random_code(x / 7, y / 5 + 500);
}

static double far_code(int x, int y) {
    (void)x, (void)y;
    return 1;
}

static void check_variance(double (*code_at)(int, int)) {
    struct table t;
    double worst = 0, sum = 0;
    build(&t, code_at);
    assert_true(t.total >> 32 > 10); /* it has wrapped round */
    enum { COUNT = 20000 };
    for (int i = 0; i < COUNT; i++) {
        const int x = 1 + (int)(random_code(i, 1) * (SIDE - WINDOW - 1)),
                  y = 1 + (int)(random_code(i, 2) * (SIDE - WINDOW - 1));
        const double m = mean_of(&t, 0, x, y, WINDOW),
                     v = m * (1 - m) - 0.25 * mean_of(&t, 1, x, y, WINDOW);
        const double expected = true_mean(&t, 1, x, y, WINDOW),
                     variance = true_mean(&t, 2, x, y, WINDOW) - expected * expected;
        worst = fmax(worst, fabs(v - variance));
        sum += fabs(v - variance) / COUNT;
    }
    print_message("window %d of %d: variance is %.2g off on average, %.2g at most\n", WINDOW, SIDE,
                  sum, worst);
    assert_true(worst < 1e-6);
    finish(&t);
}

static void test_variance_is_right_to_a_millionth(void **state) {
    (void)state;
    check_variance(random_code);
    check_variance(block_code);
}

/* All texels the largest, the square as large as any: still it fits. */
static void test_the_largest_square_fits(void **state) {
    (void)state;
    struct table t;
    build(&t, far_code);
    for (int side = 2 * GN_TABLE_REACH_PX; side <= 2 * GN_TABLE_REACH_PX + 2; side++)
        for (int at = 1; at + side < SIDE; at += 37) {
            const double m = mean_of(&t, 0, at, SIDE - side - at, side);
            assert_true(fabs(m - 1) < 1e-6);
        }
    finish(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_variance_is_right_to_a_millionth),
        cmocka_unit_test(test_the_largest_square_fits),
    };
    return cmocka_run_group_tests_name("fixed point of tables", tests, NULL, NULL);
}
