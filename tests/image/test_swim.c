/* Shadows hardly swim while the camera or the sun moves slowly: small pictures of a few techniques,
 * with limits a tenth above what was measured; make swim has all. And the measure itself. */
#include "image/swim.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"
#include "unit/check.h"

enum { W = 240, H = 180 };

static struct gn_swim make(enum gn_swim_place place, bool soft, bool sun, int frames) {
    struct gn_err err = {0};
    struct gn_swim swim;
    const struct gn_swim_opts opts = {.place = place,
                                      .soft = soft,
                                      .sun = sun,
                                      .width_px = W,
                                      .height_px = H,
                                      .frames = frames,
                                      .pace = soft ? 4 : 1};
    if (!gn_swim_init(&swim, &opts, &err)) fail_msg("%s", err.text);
    return swim;
}

/* No limit is under .002 and .01, for the rounding of other processors. */
static void limit(const struct gn_swim *swim, const char *technique, double mean, double p99) {
    struct gn_err err = {0};
    struct gn_swim_score score;
    if (!gn_swim_measure(swim, technique, NULL, &score, &err)) fail_msg("%s", err.text);
    print_message("%s: mean %.5f, 99 %% under %.4f, of %ld\n", technique, score.mean, score.p99,
                  score.changes);
    assert_true(score.changes > 5000);
    assert_true(score.mean <= mean && score.p99 <= p99);
}

static void test_the_measure_sees_what_flickers_alone(void **state) {
    (void)state;
    struct gn_swim swim = make(GN_SWIM_YARD, false, true, 3);
    struct gn_swim_score score;
    const size_t count = (size_t)W * H * 3;
    float *shots = gn_xalloc(count, sizeof *shots);
    gn_swim_compare(&swim, swim.truth, &score); /* it moves */
    assert_true(score.changes > 5000 && score.mean == 0 && score.p99 == 0);
    for (size_t i = 0; i < count; i++) shots[i] = .5f * swim.truth[i] + (i % W % 2 ? .3f : 0);
    gn_swim_compare(&swim, shots, &score); /* wrong, but not from frame to frame */
    assert_true(score.mean == 0 && score.p99 == 0);
    for (size_t i = 0; i < count; i++)
        shots[i] = swim.truth[i] + (i / W / H == 1 && i % 50 == 0 ? .25f : 0);
    gn_swim_compare(&swim, shots, &score); /* a fiftieth of the pixels goes up and down */
    assert_float_equal(score.mean, .5, .05);
    assert_true(score.p99 > 20 && score.p99 <= 25.001);
    free(shots);
    gn_swim_finish(&swim);
}

static void test_hard_edges_while_the_camera_walks(void **state) {
    (void)state;
    struct gn_swim swim = make(GN_SWIM_YARD, false, false, 12);
    limit(&swim, "hard", 0.103, 0.01);
    limit(&swim, "pcf", 0.0155, 0.0699);
    gn_swim_finish(&swim);
    swim = make(GN_SWIM_FIELD, false, false, 12);
    limit(&swim, "hard", 0.187, 0.01);
    limit(&swim, "pcf2", 0.002, 0.01);
    gn_swim_finish(&swim);
}

static void test_hard_edges_while_the_sun_turns(void **state) {
    (void)state;
    struct gn_swim swim = make(GN_SWIM_YARD, false, true, 12);
    limit(&swim, "pcf", 0.0687, 1.57);
    gn_swim_finish(&swim);
    swim = make(GN_SWIM_FIELD, false, true, 12);
    limit(&swim, "pcf", 0.0897, 0.664);
    gn_swim_finish(&swim);
}

static void test_penumbrae(void **state) {
    (void)state;
    struct gn_swim swim = make(GN_SWIM_YARD, true, true, 4);
    limit(&swim, "cone", 0.041, 0.898);
    limit(&swim, "smsm", 0.0254, 0.0903);
    gn_swim_finish(&swim);
    swim = make(GN_SWIM_YARD, true, false, 4);
    limit(&swim, "cone", 0.0347, 0.935);
    limit(&swim, "vssm", 0.002, 0.01);
    gn_swim_finish(&swim);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_measure_sees_what_flickers_alone),
        cmocka_unit_test(test_hard_edges_while_the_camera_walks),
        cmocka_unit_test(test_hard_edges_while_the_sun_turns),
        cmocka_unit_test(test_penumbrae),
    };
    return cmocka_run_group_tests_name("swim", tests, NULL, NULL);
}
