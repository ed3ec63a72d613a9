/* Torn and grainy shadows against closed forms, and what must not count. */
#include "truth/tear.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "image/dice.h"
#include "unit/check.h"

enum { W = 240, H = 160, PIXELS = W * H };
static const double pi = 3.14159265358979;

/* A picture's truth and shot; ramps run along x. */
struct pair {
    float truth[PIXELS], shot[PIXELS], facing[PIXELS], normal[3 * PIXELS], distance[PIXELS];
    struct gn_tear_view view;
};

static int setup(void **state) {
    struct pair *p = gn_xalloc(1, sizeof *p);
    for (int i = 0; i < PIXELS; i++) {
        p->truth[i] = p->shot[i] = .5f;
        p->facing[i] = p->normal[3 * i + 1] = 1;
        p->distance[i] = 10;
    }
    p->view = (struct gn_tear_view){.width_px = W, .height_px = H, .truth = p->truth};
    *state = p;
    return 0;
}
static int teardown(void **state) {
    free(*state);
    return 0;
}

static void score_parts(const struct pair *p, struct gn_tear_score score[GN_TEAR_PARTS]) {
    struct gn_tear tear;
    gn_tear_init(&tear, &p->view);
    gn_tear_compare(&tear, p->shot, 1, score);
    gn_tear_finish(&tear);
}
static struct gn_tear_score score_of(const struct pair *p) {
    struct gn_tear_score score[GN_TEAR_PARTS];
    score_parts(p, score);
    return score[GN_TEAR_ALL];
}

/* From dark to lit between two columns, without corners. */
static float rise(double x, double from, double to) {
    const double t = fmin(fmax((x - from) / (to - from), 0), 1);
    return (float)(t * t * (3 - 2 * t));
}

static void test_the_truth_itself_is_not_torn(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) p->truth[i] = p->shot[i] = rise(i % W, 100, 140);
    const struct gn_tear_score s = score_of(p);
    assert_true(s.pixels > 40 * (H - 2) && s.pixels < 60 * H);
    assert_true(s.tear == 0 && s.grain == 0 && s.rmse == 0);
}

static void test_a_steeper_ramp_counts_by_what_it_is_steeper(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) {
        p->truth[i] = .5f + .002f * (float)(i % W - W / 2);
        p->shot[i] = .5f + .003f * (float)(i % W - W / 2);
    }
    struct gn_tear_score s = score_of(p);
    assert_float_equal(s.tear, .1, .005); /* less beside the picture's borders */
    assert_float_equal(s.grain, .1, .005);
    p->view.facing = p->facing;
    for (int i = 0; i < PIXELS; i++) p->facing[i] = .5f;
    const struct gn_tear_score half = score_of(p);
    assert_float_equal(half.tear, s.tear / 2, 1e-6);
    assert_float_equal(half.rmse, s.rmse / 2, 1e-6);
}

/* Mean over a period of max(slope of blurred steps - slope of the ramp, 0), per cent. */
static double steps_slope(double height, int period, double sigma) {
    double sum = 0;
    for (int x = 0; x < period; x++) {
        double slope = 0;
        for (int k = -4; k <= 4; k++) {
            const double d = (x - k * period + .5) / sigma / sqrt(2), one = 1 / sigma / sqrt(2);
            slope += height * .25 * (erf(d + one) - erf(d - one));
        }
        sum += fmax(slope - height / period, 0);
    }
    return 100 * sum / period;
}

static void test_steps_count_by_their_slope(void **state) {
    enum { PERIOD = 20 };
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) {
        p->truth[i] = .1f + .8f * (float)(i % W) / W;
        p->shot[i] = .1f + .8f * (float)(i % W / PERIOD * PERIOD + PERIOD / 2) / W;
    }
    const struct gn_tear_score s = score_of(p);
    const double height = .8 * PERIOD / W; /* the first and the last step are the borders */
    assert_float_equal(s.tear, steps_slope(height, PERIOD, 2.5), .1 * s.tear);
    assert_float_equal(s.grain, steps_slope(height, PERIOD, 1), .1 * s.grain);
    assert_true(s.tear > .1);
}

/* The mean length of the gradient of white noise of deviation a after a Gaussian: of each central
 * difference the variance is (R(0) - R(2)) / 2, R(d) = a^2 / (4 pi s^2) exp(-d^2 / 4 s^2). */
static double noise_slope(double a, double s) {
    return 100 * sqrt(pi / 2) * a * sqrt((1 - exp(-1 / (s * s))) / (8 * pi * s * s));
}

static void test_noise_of_pixels_is_grain_and_hardly_tear(void **state) {
    struct pair *p = *state;
    struct gn_dice dice = {5};
    for (int i = 0; i < PIXELS; i++) p->shot[i] += (float)gn_dice_between(&dice, -.3, .3);
    const struct gn_tear_score s = score_of(p);
    const double a = .6 / sqrt(12);
    assert_float_equal(s.grain, noise_slope(a, 1), .03 * s.grain);
    assert_float_equal(s.tear, noise_slope(a, 2.5), .1 * s.tear);
    assert_true(s.grain > 4 * s.tear && s.grain > 3);
    assert_float_equal(s.rmse, a, .01 * a);
}

/* A grid of dots, each fourth pixel. */
static void test_a_screen_door_is_grain_and_hardly_tear(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) {
        p->truth[i] = p->shot[i] = rise(i % W, 60, 180);
        p->shot[i] += i % W % 4 == 0 && i / W % 4 == 0 ? .5f : -.03f;
    }
    const struct gn_tear_score s = score_of(p);
    assert_true(s.grain > .5);
    assert_true(s.tear < .005);
}

static void test_a_torn_edge_is_both(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) {
        const int by = i / W / 16 % 2 ? 8 : -8;
        p->truth[i] = rise(i % W, 90, 150);
        p->shot[i] = rise(i % W, 90 + by, 150 + by);
    }
    const struct gn_tear_score s = score_of(p);
    assert_true(s.tear > .2);
    assert_true(s.grain < 3 * s.tear);
}

static void test_moved_and_blurred_shadows_are_not_torn(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) {
        p->truth[i] = rise(i % W, 100, 124);
        p->shot[i] = rise(i % W - 1, 100, 124);
    }
    struct gn_tear_score s = score_of(p);
    assert_true(s.tear < 1e-4 && s.grain < 1e-4 && s.rmse > .01);
    for (int i = 0; i < PIXELS; i++) p->shot[i] = rise(i % W, 90, 134);
    s = score_of(p);
    assert_true(s.tear < .001 && s.grain < .02 && s.rmse > .05);         /* where truth is level */
    for (int i = 0; i < PIXELS; i++) p->shot[i] = rise(i % W, 109, 115); /* sharp */
    s = score_of(p);
    assert_true(s.tear > .3 && s.grain > s.tear);
}

/* What runs along x counts as what runs along y. */
static void test_rows_and_columns_are_alike(void **state) {
    struct pair *p = *state, *turned = gn_xalloc(1, sizeof *turned);
    struct gn_dice dice = {9};
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            const int i = y * W + x, j = x * H + y;
            turned->truth[j] = p->truth[i] = rise(x, 100, 140);
            turned->shot[j] = p->shot[i] = p->truth[i] + (float)gn_dice_between(&dice, -.2, .2);
        }
    turned->view = (struct gn_tear_view){.width_px = H, .height_px = W, .truth = turned->truth};
    const struct gn_tear_score a = score_of(p), b = score_of(turned);
    assert_int_equal(a.pixels, b.pixels);
    assert_float_equal(a.tear, b.tear, 1e-4 * a.tear);
    assert_float_equal(a.grain, b.grain, 1e-4 * a.grain);
    free(turned);
}

/* Right of column 120 a surface 1 m behind the other, or one that is turned: truth is smooth there,
 * on the left it has a hard edge close by. */
static void cross_edge(struct pair *p) {
    for (int i = 0; i < PIXELS; i++) {
        p->truth[i] = i % W < 118 ? 0 : i % W < 120 ? 1 : .2f + .6f * (float)(i % W) / W;
        p->shot[i] = i % W < 120 ? p->truth[i] : p->truth[i] - .2f;
    }
}

static void test_outlines_do_not_count_and_excuse_nothing(void **state) {
    struct pair *p = *state;
    cross_edge(p);
    assert_true(score_of(p).tear < 1e-3); /* a steep truth is near */
    for (int i = 0; i < PIXELS; i++) {
        p->shot[i] = i % W < 120 ? p->truth[i] : p->truth[i] + (i / W / 16 % 2 ? .1f : -.1f);
        p->distance[i] = i % W < 120 ? 10 : 11;
        p->normal[3 * i + (i % W < 120)] = 1;
        p->normal[3 * i + (i % W >= 120)] = 0;
    }
    p->view.distance_m = p->distance;
    const struct gn_tear_score by_depth = score_of(p);
    p->view.distance_m = NULL;
    p->view.normal_ws = p->normal;
    const struct gn_tear_score by_fold = score_of(p);
    p->view.normal_ws = NULL;
    const struct gn_tear_score without = score_of(p);
    assert_true(by_depth.tear == by_fold.tear && by_depth.pixels == by_fold.pixels);
    assert_true(by_depth.pixels < without.pixels);
    for (int i = 0; i < PIXELS; i++)
        if (i % W >= 120) p->shot[i] = p->truth[i];
    p->view.distance_m = p->distance;
    cross_edge(p);
    assert_true(score_of(p).tear < 1e-3); /* nor across it: darker, and parallel to the truth */
    assert_true(by_depth.tear > .1);
    /* close to the outline the tearing counts, whatever the truth is on the other side */
    for (int i = 0; i < PIXELS; i++)
        p->shot[i] =
            i % W < 121 || i % W > 124 ? p->truth[i] : p->truth[i] + (i / W / 16 % 2 ? .1f : -.1f);
    const double beside = score_of(p).tear;
    p->view.distance_m = NULL;
    assert_true(beside > 5 * score_of(p).tear && beside > .01);
}

static void test_a_steep_plane_is_no_edge(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) p->distance[i] = 1 / (.005f + .001f * (float)(i % W));
    p->view.distance_m = p->distance; /* up to 17 % from pixel to pixel */
    struct gn_tear_score score[GN_TEAR_PARTS];
    score_parts(p, score);
    assert_int_equal(score[GN_TEAR_SURFACE].pixels, (W - 2) * (H - 2));
    assert_int_equal(score[GN_TEAR_FLOOR].pixels, 0);
}

static void test_floor_and_surfaces_have_their_own_figures(void **state) {
    struct pair *p = *state;
    struct gn_dice dice = {5};
    for (int i = 0; i < PIXELS; i++) {
        p->distance[i] = i % W < 80 ? INFINITY : 10;
        p->shot[i] += i % W < 80 ? 0 : (float)gn_dice_between(&dice, -.3, .3);
    }
    p->view.distance_m = p->distance;
    struct gn_tear_score s[GN_TEAR_PARTS];
    score_parts(p, s);
    assert_int_equal(s[GN_TEAR_FLOOR].pixels, (78 - 1) * (H - 2));
    assert_int_equal(s[GN_TEAR_SURFACE].pixels, (W - 82 - 1) * (H - 2));
    assert_int_equal(s[GN_TEAR_ALL].pixels, s[GN_TEAR_FLOOR].pixels + s[GN_TEAR_SURFACE].pixels);
    assert_true(s[GN_TEAR_FLOOR].grain == 0 && s[GN_TEAR_SURFACE].grain > 3);
    assert_float_equal(s[GN_TEAR_ALL].grain * (double)s[GN_TEAR_ALL].pixels,
                       s[GN_TEAR_SURFACE].grain * (double)s[GN_TEAR_SURFACE].pixels, 1);
}

static void test_what_is_not_lit_is_not_measured(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) {
        p->facing[i] = i % W < 40 ? .01f : i % W < 60 ? NAN : 1;
        p->shot[i] = i % W < 50 && i / W % 9 < 4 ? 1 : .5f;
    }
    p->view.facing = p->facing;
    const struct gn_tear_score s = score_of(p);
    assert_int_equal(s.pixels, (W - 60 - 1) * (H - 2));
    assert_true(s.grain == 0);
}

static void test_few_pixels_are_not_measured(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) p->truth[i] = i % W < 100; /* a hard edge */
    struct gn_tear_score s = score_of(p);
    assert_true(s.pixels == 0 && isnan(s.tear) && isnan(s.grain) && isnan(s.rmse));
    for (int size = 1; size < 20; size++) {
        p->view.width_px = size;
        p->view.height_px = size / 2 + 1;
        s = score_of(p);
        assert_true(isnan(s.tear));
    }
    for (int i = 0; i < PIXELS; i++) p->truth[i] = .5f;
    p->view.height_px = 3;
    for (int inner = 199; inner <= 200; inner++) {
        p->view.width_px = inner + 2;
        s = score_of(p);
        assert_int_equal(s.pixels, inner);
        assert_true(isnan(s.tear) == (inner < 200));
    }
}

static void test_what_is_no_number_is_dark_and_no_truth(void **state) {
    struct pair *p = *state;
    for (int i = 0; i < PIXELS; i++) {
        p->truth[i] = i % 64 == 0 ? NAN : .5f;
        p->shot[i] = i % W < 80 ? NAN : i % W < 100 ? -INFINITY : INFINITY;
    }
    struct gn_tear_score s = score_of(p);
    assert_true(s.pixels > PIXELS / 2 && s.pixels < PIXELS - PIXELS / 64);
    assert_true(isfinite(s.tear) && s.grain > 0);
    assert_float_equal(s.rmse, .5, 1e-6);
    const double dark = s.tear;
    for (int i = 0; i < PIXELS; i++) p->shot[i] = i % W < 100 ? 0 : 1;
    s = score_of(p);
    assert_true(s.tear == dark);
    for (int i = 0; i < PIXELS; i++) p->distance[i] = p->normal[3 * i] = i % 2 ? NAN : 1;
    p->view.distance_m = p->distance;
    p->view.normal_ws = p->normal;
    assert_true(score_of(p).pixels == 0);
}

static void test_facing_is_the_share_of_what_a_floor_gets(void **state) {
    (void)state;
    const float normals[] = {0, 1, 0, 0, 0, 1, .6f, .8f, 0, 0, -1, 0, 0, 0, 0, NAN, NAN, NAN};
    const float distances[] = {1, 2, 3, 4, INFINITY, 5};
    float f[6];
    gn_tear_face(normals, distances, (const double[]){0, 2, 1}, 6, f); /* of any length */
    assert_true(f[0] == 1 && f[1] == .5f && f[3] == 0 && f[4] == 1 && f[5] == 0);
    assert_float_equal(f[2], .8, 1e-6);
    gn_tear_face(normals, distances, (const double[]){0, .5, 1}, 6, f);
    assert_true(f[0] == 1 && f[1] == 1 && f[4] == 1);              /* at most 1 */
    gn_tear_face(normals, NULL, (const double[]){0, -3, 4}, 6, f); /* from below: N.L */
    assert_true(f[0] == 0 && f[4] == 0);
    assert_float_equal(f[1], .8, 1e-6);
    assert_float_equal(f[3], .6, 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
        TEST(test_the_truth_itself_is_not_torn),
        TEST(test_a_steeper_ramp_counts_by_what_it_is_steeper),
        TEST(test_steps_count_by_their_slope),
        TEST(test_noise_of_pixels_is_grain_and_hardly_tear),
        TEST(test_a_screen_door_is_grain_and_hardly_tear),
        TEST(test_a_torn_edge_is_both),
        TEST(test_moved_and_blurred_shadows_are_not_torn),
        TEST(test_rows_and_columns_are_alike),
        TEST(test_outlines_do_not_count_and_excuse_nothing),
        TEST(test_a_steep_plane_is_no_edge),
        TEST(test_floor_and_surfaces_have_their_own_figures),
        TEST(test_what_is_not_lit_is_not_measured),
        TEST(test_few_pixels_are_not_measured),
        TEST(test_what_is_no_number_is_dark_and_no_truth),
        cmocka_unit_test(test_facing_is_the_share_of_what_a_floor_gets),
    };
    return cmocka_run_group_tests_name("tear", tests, NULL, NULL);
}
