/* Smaller pictures of a mask cover as much as the whole one. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl/coverage.h"
#include "unit/check.h"

enum { SIDE = 256 };

static uint32_t seed;

static float random_unit(void) {
    seed = seed * 1664525u + 1013904223u;
    return (float)(seed >> 8) / 16777216.0f;
}

static uint8_t *halve(const uint8_t *rgba, uint32_t side) {
    uint8_t *out = malloc((size_t)side * side);
    for (uint32_t i = 0; i < side * side / 4; i++) {
        const uint8_t *p = rgba + 8ul * (i / (side / 2) * side + i % (side / 2)) + 3;
        memset(out + 4ul * i, 0, 3);
        out[4ul * i + 3] = (uint8_t)((p[0] + p[4] + p[4ul * side] + p[4ul * side + 4] + 2) / 4);
    }
    return out;
}

/* What is over the cutoff of the surface between texels, sampled finely and evenly. */
static double share_of(const uint8_t *rgba, uint32_t side, const uint8_t alpha[256], float cutoff) {
    const int fine = side < 64 ? 8 : 6;
    uint32_t over = 0;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++) {
            const uint32_t u = (x + 1) % side, v = (y + 1) % side;
            const double at[4] = {
                alpha[rgba[4ul * (y * side + x) + 3]], alpha[rgba[4ul * (y * side + u) + 3]],
                alpha[rgba[4ul * (v * side + x) + 3]], alpha[rgba[4ul * (v * side + u) + 3]]};
            for (int k = 0; k < fine * fine; k++) {
                const double s = (k % fine + .5) / fine, t = (k / fine + .5) / fine;
                const double a = at[0] + s * (at[1] - at[0]), b = at[2] + s * (at[3] - at[2]);
                over += a + t * (b - a) >= 255 * (double)cutoff;
            }
        }
    return (double)over / ((double)side * side * fine * fine);
}

enum mask { LEAVES, STRIPES, NOISE, SOFT, MASKS };

static uint8_t *make_mask(enum mask mask) {
    uint8_t *rgba = calloc(SIDE * SIDE, 4);
    seed = 3;
    for (int i = 0; mask == LEAVES && i < 350; i++) {
        const int cx = (int)(random_unit() * SIDE), cy = (int)(random_unit() * SIDE);
        for (int y = -4; y <= 4; y++)
            for (int x = -4; x <= 4; x++)
                if (x * x * 4 + y * y < 17)
                    rgba[4 * (((cy + y) & (SIDE - 1)) * SIDE + ((cx + x) & (SIDE - 1))) + 3] = 255;
    }
    for (int i = 0; mask != LEAVES && i < SIDE * SIDE; i++) {
        const int x = i % SIDE, y = i / SIDE;
        const float wave = sinf((float)x * .0736f) * sinf((float)y * .0491f);
        rgba[4 * i + 3] = mask == STRIPES ? (x % 11 < 2 || y % 13 < 2) * 255
                          : mask == NOISE ? (random_unit() < .3f) * 255
                                          : (uint8_t)(127 + 127 * wave);
    }
    return rgba;
}

static void check_levels(enum mask mask, float cutoff) {
    uint8_t same[256], *rgba = make_mask(mask);
    for (int i = 0; i < 256; i++) same[i] = (uint8_t)i;
    const struct gn_coverage_level whole = {.rgba = rgba, .px = {SIDE, SIDE}};
    const struct gn_coverage cover = gn_coverage_measure(cutoff, &whole);
    assert_float_equal(cover.share, share_of(rgba, SIDE, same, cutoff), .02);
    for (uint32_t side = SIDE / 2; side >= 16; side /= 2) {
        uint8_t alpha[256], *half = halve(rgba, 2 * side);
        const struct gn_coverage_level level = {.rgba = half, .px = {side, side}};
        gn_coverage_fit(&cover, NULL, &level, alpha);
        const double share = share_of(half, side, alpha, cutoff), asked = (double)cover.share;
        print_message("mask %d, cutoff %g, %u texels: %.3f of %.3f, %.3f without\n", mask,
                      (double)cutoff, side, share, asked, share_of(half, side, same, cutoff));
        for (int i = 1; i < 256; i++) assert_true(alpha[i] >= alpha[i - 1]);
        /* a picture of few alphas has shares by leaps */
        assert_true(fabs(share - asked) < (side < SIDE / 4 ? .1 : .2) * asked);
        free(rgba);
        rgba = half;
    }
    free(rgba);
}

static void test_levels_cover_as_much_as_the_picture(void **state) {
    (void)state;
    static const float cutoffs[] = {.2f, .5f, .85f};
    for (int mask = 0; mask < MASKS; mask++)
        for (int i = 0; i < 3; i++) check_levels(mask, cutoffs[i]);
}

/* The mean of a level and of what is halfway to the one before has the share. */
static void test_what_is_between_levels_counts(void **state) {
    (void)state;
    uint8_t alone[256], mixed[256], *rgba = make_mask(LEAVES);
    const struct gn_coverage_level whole = {.rgba = rgba, .px = {SIDE, SIDE}};
    const struct gn_coverage cover = gn_coverage_measure(.8f, &whole);
    uint8_t *half = halve(rgba, SIDE), *quarter = halve(half, SIDE / 2);
    const struct gn_coverage_level larger = {.rgba = half, .px = {SIDE / 2, SIDE / 2}},
                                   level = {.rgba = quarter, .px = {SIDE / 4, SIDE / 4}};
    gn_coverage_fit(&cover, NULL, &level, alone);
    gn_coverage_fit(&cover, &larger, &level, mixed);
    assert_true(share_of(quarter, SIDE / 4, mixed, .8f) > share_of(quarter, SIDE / 4, alone, .8f));
    free(rgba);
    free(half);
    free(quarter);
}

/* All over the cutoff, or nothing: no scale could change that, and none does. */
static void test_what_is_whole_or_empty_stays(void **state) {
    (void)state;
    uint8_t rgba[64], alpha[256];
    for (int full = 0; full < 2; full++) {
        const struct gn_coverage_level level = {.rgba = rgba, .px = {4, 4}};
        memset(rgba, full ? 200 : 9, sizeof rgba);
        const struct gn_coverage cover = gn_coverage_measure(.5f, &level);
        assert_true(cover.share == (float)full);
        gn_coverage_fit(&cover, NULL, &level, alpha);
        for (int i = 0; i < 256; i++) assert_int_equal(alpha[i], i);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_levels_cover_as_much_as_the_picture),
        cmocka_unit_test(test_what_is_between_levels_counts),
        cmocka_unit_test(test_what_is_whole_or_empty_stays),
    };
    return RUN(tests);
}
