/* The open benchmark: names of scenes, the truth of one as a picture, scores of known pictures. */
#include "truth/benchmark.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "truth/sight.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

static void test_names_are_a_class_and_a_light(void **state) {
    (void)state;
    static const char *const wrong[] = {
        "",           "field",        "field-",      "field-moon-1", "soft-sun.", "field-sun-../",
        "fields-sun", "field-spotty", "field-sun\n", "field-SUN"};
    struct gn_benchmark_name name;
    assert_true(gn_benchmark_name_parse("field-spot-03", &name));
    assert_int_equal(name.kind, GN_BENCHMARK_FIELD);
    assert_string_equal(name.light, "spot");
    assert_true(gn_benchmark_name_parse("contact-sun", &name));
    assert_int_equal(name.kind, GN_BENCHMARK_CONTACT);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        if (gn_benchmark_name_parse(wrong[i], &name)) fail_msg("\"%s\" is a name", wrong[i]);
}

/* All lit, away from edges and safely lit. */
static float *make_plain(enum gn_benchmark_class kind) {
    const size_t pixels = gn_benchmark_pixels(kind);
    float *rgb = gn_xalloc(pixels, 3 * sizeof *rgb);
    for (size_t i = 0; i < pixels; i++) {
        rgb[3 * i] = 1;
        rgb[3 * i + 1] = 2;
        rgb[3 * i + 2] = 10;
    }
    return rgb;
}

static struct gn_benchmark_score score_of(enum gn_benchmark_class kind, const float *truth,
                                          const float *shot, double reach) {
    struct gn_benchmark_score score;
    gn_benchmark_compare(kind, truth, shot, reach, &score);
    return score;
}

static void test_the_truth_itself_has_no_error(void **state) {
    (void)state;
    for (int k = 0; k < GN_BENCHMARK_CLASS_COUNT; k++) {
        float *truth = make_plain(k);
        truth[0] = truth[300] = 0;
        for (size_t i = 0; gn_benchmark_classes[k].soft && i < 20000; i++)
            truth[3 * i] = (float)i / 20000;
        const struct gn_benchmark_score s = score_of(k, truth, truth, 3);
        for (int m = 0; m < GN_BENCHMARK_MEASURE_COUNT; m++)
            assert_true(isnan(s.of[m]) ==
                            (gn_benchmark_classes[k].soft == (m < GN_BENCHMARK_PENUMBRA)) &&
                        !(s.of[m] > 0));
        free(truth);
    }
}

static void test_faults_of_a_known_picture(void **state) {
    (void)state;
    const double pixels = (double)gn_benchmark_pixels(GN_BENCHMARK_FIELD);
    float *truth = make_plain(GN_BENCHMARK_FIELD), *shot = make_plain(GN_BENCHMARK_FIELD);
    for (size_t i = 0; i < 1000; i++) truth[3 * i] = shot[3 * i] = 0; /* the shadow */
    for (size_t i = 0; i < 100; i++) truth[3 * i + 1] = 1;            /* not away from its edge */
    shot[3 * 5] = .5f;                                                /* a gap on the edge */
    shot[3 * 500] = 1;                                                /* a leak, and a gap */
    shot[3 * 2000] = NAN;                                             /* acne, safely lit */
    shot[3 * 3000] = .9f;                                             /* darkened */
    shot[3 * 4000] = .96f; /* darkened by less than 5 % */
    truth[3 * 4000 + 2] = 3;
    const struct gn_benchmark_score s = score_of(GN_BENCHMARK_FIELD, truth, shot, 3);
    assert_float_equal(s.of[GN_BENCHMARK_ACNE], 100 / (pixels - 1000), 1e-12);
    assert_float_equal(s.of[GN_BENCHMARK_LEAK], 100 / 900.0, 1e-12);
    assert_float_equal(s.of[GN_BENCHMARK_GAP], 200 / 1000.0, 1e-12);
    assert_float_equal(s.of[GN_BENCHMARK_WRONG], 300 / pixels, 1e-12);
    assert_float_equal(s.of[GN_BENCHMARK_DARKENED], 200 / (pixels - 1000), 1e-12);
    assert_float_equal(s.of[GN_BENCHMARK_DARKENING], 114 / (pixels - 1000), 1e-7);
    /* a wider filter: that pixel is no longer safely lit */
    const struct gn_benchmark_score wide = score_of(GN_BENCHMARK_FIELD, truth, shot, 3.5);
    assert_float_equal(wide.of[GN_BENCHMARK_DARKENING], 110 / (pixels - 1001), 1e-7);
    free(truth);
    free(shot);
}

static void test_errors_of_a_known_penumbra(void **state) {
    (void)state;
    const double pixels = (double)gn_benchmark_pixels(GN_BENCHMARK_SOFT);
    float *truth = make_plain(GN_BENCHMARK_SOFT), *shot = make_plain(GN_BENCHMARK_SOFT);
    const size_t middle = 180 * 480 + 240; /* grown by 2: 25 pixels of penumbra */
    truth[3 * middle] = .5f;
    shot[3 * middle] = 1;
    shot[3 * (middle + 1)] = 1e9f; /* 1 */
    shot[3 * (middle + 2)] = NAN;  /* 0 */
    shot[0] = -3;                  /* 0, far from it */
    const struct gn_benchmark_score s = score_of(GN_BENCHMARK_SOFT, truth, shot, 3);
    assert_float_equal(s.of[GN_BENCHMARK_PENUMBRA], sqrt(1.25 / 25), 1e-12);
    assert_float_equal(s.of[GN_BENCHMARK_BIAS], -.5 / 25, 1e-12);
    assert_float_equal(s.of[GN_BENCHMARK_REST], sqrt(1 / (pixels - 25)), 1e-12);
    free(truth);
    free(shot);
}

/* A grey picture in which pixels differ: what truth/tear.h measures of the first channel. */
static void test_grain_of_a_known_penumbra(void **state) {
    (void)state;
    float *truth = make_plain(GN_BENCHMARK_SOFT), *shot = make_plain(GN_BENCHMARK_SOFT);
    uint32_t seed = 1;
    for (size_t i = 0; i < gn_benchmark_pixels(GN_BENCHMARK_SOFT); i++) {
        seed = seed * 1664525 + 1013904223;
        truth[3 * i] = .5f;
        shot[3 * i] = .3f + .4f * (float)(seed >> 8) / (1 << 24);
    }
    const struct gn_benchmark_score s = score_of(GN_BENCHMARK_SOFT, truth, shot, 3);
    /* unit/test_tear.c has the formula: of white noise of deviation .4 / sqrt 12 */
    assert_float_equal(s.of[GN_BENCHMARK_PIXEL_GRAIN], 2.295, .06);
    assert_float_equal(s.of[GN_BENCHMARK_TEAR], .445, .03);
    free(truth);
    free(shot);
}

static void test_means_leave_out_what_is_not_measured(void **state) {
    (void)state;
    struct gn_benchmark_score a, b, mean;
    for (int m = 0; m < GN_BENCHMARK_MEASURE_COUNT; m++) a.of[m] = b.of[m] = (double)NAN;
    a.of[GN_BENCHMARK_GAP] = 1;
    b.of[GN_BENCHMARK_GAP] = 4;
    b.of[GN_BENCHMARK_LEAK] = 3;
    gn_benchmark_mean((const struct gn_benchmark_score[]){a, b}, 2, &mean);
    assert_true(mean.of[GN_BENCHMARK_GAP] == 2.5 && mean.of[GN_BENCHMARK_LEAK] == 3);
    assert_true(isnan(mean.of[GN_BENCHMARK_ACNE]));
}

/* A cube over a ground, lit from aside. */
static struct gn_scene *make_scene(void) {
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional'}]}}");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.7,'znear':0.1,'zfar':100}}]");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[5,1,5]},{'mesh':1,'translation':[0,1.1,0]},"
                 "{'camera':0,'translation':[0,7,9],'rotation':[-0.3584,0,0,0.9336]},"
                 "{'rotation':[-0.332,-0.4814,-0.2035,0.7852],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    struct gn_scene *scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* Scores by the truth's picture are those by the scene, with the distances of make truth. */
static void test_the_picture_of_a_truth_scores_as_the_scene_does(void **state) {
    (void)state;
    const size_t pixels = gn_benchmark_pixels(GN_BENCHMARK_FIELD);
    struct gn_scene *scene = make_scene();
    struct gn_err err = {0};
    struct gn_truth truth;
    float *rgb = gn_xalloc(pixels, 3 * sizeof *rgb), *shot = gn_xalloc(pixels, 3 * sizeof *shot);
    assert_true(gn_benchmark_make(scene, GN_BENCHMARK_FIELD, rgb, &err));
    assert_true(gn_truth_make(&truth, scene, NULL, &err));
    gn_truth_band(&truth, 1024);
    gn_truth_safe(&truth, 1024, 3);
    uint32_t seed = 1;
    for (size_t i = 0; i < pixels; i++) {
        seed = seed * 1664525 + 1013904223;
        shot[3 * i] = (float)(seed >> 8) / (1 << 24);
        assert_true(rgb[3 * i + 1] * 256 == floorf(rgb[3 * i + 1] * 256));
        assert_true(rgb[3 * i + 2] * 256 == floorf(rgb[3 * i + 2] * 256));
    }
    struct gn_mask_score expected;
    gn_mask_compare(&truth.mask, shot, 3, &expected);
    const struct gn_benchmark_score s = score_of(GN_BENCHMARK_FIELD, rgb, shot, 3);
    assert_true(expected.safe > 1000 && expected.away_dark > 1000);
    assert_true(s.of[GN_BENCHMARK_ACNE] == gn_mask_acne(&expected));
    assert_true(s.of[GN_BENCHMARK_LEAK] == gn_mask_leak(&expected));
    assert_true(s.of[GN_BENCHMARK_GAP] == gn_mask_gap(&expected));
    assert_true(s.of[GN_BENCHMARK_WRONG] == gn_mask_wrong(&expected));
    assert_true(s.of[GN_BENCHMARK_DARKENING] == gn_mask_darkening(&expected));
    assert_true(s.of[GN_BENCHMARK_DARKENED] == gn_mask_darkened(&expected));
    gn_truth_finish(&truth);
    gn_scene_destroy(scene);
    free(rgb);
    free(shot);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names_are_a_class_and_a_light),
        cmocka_unit_test(test_the_truth_itself_has_no_error),
        cmocka_unit_test(test_faults_of_a_known_picture),
        cmocka_unit_test(test_errors_of_a_known_penumbra),
        cmocka_unit_test(test_grain_of_a_known_penumbra),
        cmocka_unit_test(test_means_leave_out_what_is_not_measured),
        cmocka_unit_test(test_the_picture_of_a_truth_scores_as_the_scene_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
