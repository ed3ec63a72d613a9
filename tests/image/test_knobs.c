/* What options that are automatic by default do to the figures, on the field of 5 to 400 m: README
 * of src/shadow has these figures. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "image/truth.h"
#include "plan/field_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH_PX = 640, HEIGHT_PX = 360, PIXELS = WIDTH_PX * HEIGHT_PX };

static struct help_stage stage;
static struct gn_truth truth;
static float *aov;

static int open_all(void **state) {
    const struct gn_truth_opts opts = {.width_px = WIDTH_PX, .height_px = HEIGHT_PX};
    struct gn_err err = {0};
    (void)state;
    help_stage_open(&stage, gn_field_scene_make, "egl", NULL, NULL);
    if (!gn_truth_make(&truth, stage.scene, &opts, &err)) fail_msg("%s", err.text);
    gn_truth_band(&truth, 1024);
    aov = gn_xalloc(4 * PIXELS, sizeof *aov);
    return 0;
}

static int close_all(void **state) {
    (void)state;
    free(aov);
    gn_truth_finish(&truth);
    help_stage_close(&stage);
    return 0;
}

static struct gn_frame_opts opts_of(enum gn_technique technique) {
    return (struct gn_frame_opts){
        .output.width_px = WIDTH_PX,
        .output.height_px = HEIGHT_PX,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                       .technique = technique,
                       .map_px = 1024},
        .debug.aov = GN_AOV_VISIBILITY};
}

/* Into aov, four floats a pixel. */
static const struct gn_plan *draw(const struct gn_frame_opts *opts) {
    struct gn_err err = {0};
    const struct gn_plan *plan = help_stage_draw(&stage, opts, NULL);
    if (!gn_gl_read_f32(stage.gl, aov, &err)) fail_msg("%s", err.text);
    return plan;
}

static double wrong_with(uint32_t cascades) {
    struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF);
    struct gn_picture shot;
    struct gn_mask_score score;
    GN_LIGHT_SET(&opts.shadow.any, cascades, cascades);
    const uint32_t got = draw(&opts)->shadows[0].map.cascade_count;
    gn_picture_init(&shot, WIDTH_PX, HEIGHT_PX, 1);
    for (int i = 0; i < PIXELS; i++) shot.data[i] = aov[4 * i];
    gn_mask_compare(&truth.mask, shot.data, shot.channels, &score);
    gn_picture_finish(&shot);
    const double wrong = gn_mask_wrong(&score), gap = gn_mask_gap(&score);
    printf("cascades %u (%u): wrong %.3f %%, gap %.2f %%\n", cascades, got, wrong, gap);
    if (cascades) assert_int_equal(got, cascades == 1 ? 0 : cascades);
    return wrong;
}

static void test_more_cascades_are_nearer_to_truth(void **state) {
    (void)state;
    const double one = wrong_with(1), two = wrong_with(2), four = wrong_with(4);
    const double automatic = wrong_with(0);
    assert_true(one > 2 * two);
    assert_true(two > 1.2 * four);
    assert_true(automatic <= four);
}

/* Of thick bodies the faces away from the light throw the same shadow, but at contacts. */
static void test_which_faces_cast(void **state) {
    (void)state;
    static const int words[] = {0, 1 + GN_CAST_BOTH, 1 + GN_CAST_FRONT, 1 + GN_CAST_BACK,
                                1 + GN_CAST_MIDDLE};
    static const char *const names[] = {"auto", "both", "front", "back", "middle"};
    struct gn_mask_score scores[5];
    for (int faces = 0; faces < 5; faces++) {
        struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF);
        struct gn_picture shot;
        GN_LIGHT_SET(&opts.shadow.any, faces, words[faces]);
        draw(&opts);
        gn_picture_init(&shot, WIDTH_PX, HEIGHT_PX, 1);
        for (int i = 0; i < PIXELS; i++) shot.data[i] = aov[4 * i];
        gn_mask_compare(&truth.mask, shot.data, shot.channels, &scores[faces]);
        gn_picture_finish(&shot);
        printf("faces %s: acne %.4f %%, leak %.4f %%, gap %.2f %%, wrong %.3f %%\n", names[faces],
               gn_mask_acne(&scores[faces]), gn_mask_leak(&scores[faces]),
               gn_mask_gap(&scores[faces]), gn_mask_wrong(&scores[faces]));
    }
    for (int faces = 1; faces < 3; faces++) /* the same faces of closed bodies */
        assert_true(gn_mask_wrong(&scores[faces]) == gn_mask_wrong(&scores[0]));
    assert_true(gn_mask_gap(&scores[3]) > gn_mask_gap(&scores[0]));
    assert_true(gn_mask_gap(&scores[3]) < 1.1 * gn_mask_gap(&scores[0]));
    assert_true(gn_mask_gap(&scores[4]) < gn_mask_gap(&scores[3]));
    assert_true(gn_mask_gap(&scores[4]) <= 1.01 * gn_mask_gap(&scores[0]));
}

/* Without a bias surfaces shadow themselves, but not where the map has their middle or far side. */
static void test_a_middle_needs_no_bias(void **state) {
    (void)state;
    static const int words[] = {1 + GN_CAST_BOTH, 1 + GN_CAST_BACK, 1 + GN_CAST_MIDDLE};
    static const char *const names[] = {"both", "back", "middle"};
    struct gn_mask_score scores[3];
    for (int i = 0; i < 3; i++) {
        struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF);
        GN_LIGHT_SET(&opts.shadow.any, faces, words[i]);
        GN_LIGHT_SET(&opts.shadow.any, bias_texels, 0);
        draw(&opts);
        gn_mask_compare(&truth.mask, aov, 4, &scores[i]);
        printf("no bias, faces %s: acne %.4f %%, gap %.2f %%, wrong %.3f %%\n", names[i],
               gn_mask_acne(&scores[i]), gn_mask_gap(&scores[i]), gn_mask_wrong(&scores[i]));
    }
    assert_true(gn_mask_wrong(&scores[0]) > 2);
    assert_true(gn_mask_wrong(&scores[2]) < .2);
    assert_true(gn_mask_gap(&scores[2]) <= gn_mask_gap(&scores[1]));
}

/* Over 850 m a step of 16 bits is as large as a texel of the first cascade: the bias covers it, at
 * the price of light at contacts. */
static void test_sixteen_bits(void **state) {
    (void)state;
    static const enum gn_encoding encodings[] = {GN_ENCODING_DEPTH, GN_ENCODING_DEPTH16};
    struct gn_mask_score scores[2];
    float bias_m[2];
    for (int i = 0; i < 2; i++) {
        struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF);
        struct gn_picture shot;
        GN_LIGHT_SET(&opts.shadow.any, map_format, GN_MAP_FORMAT(encodings[i], GN_MOMENTS_NONE));
        const struct gn_shadow_view *view = draw(&opts)->shadows;
        assert_int_equal(view->encoding, encodings[i]);
        bias_m[i] = view->code.ulp_m;
        gn_picture_init(&shot, WIDTH_PX, HEIGHT_PX, 1);
        for (int k = 0; k < PIXELS; k++) shot.data[k] = aov[4 * k];
        gn_mask_compare(&truth.mask, shot.data, shot.channels, &scores[i]);
        gn_picture_finish(&shot);
        printf("%s: bias of the encoding %.1f mm, acne %.4f %%, leak %.4f %%, gap %.2f %%, wrong "
               "%.3f %%\n",
               gn_encodings[encodings[i]].name, 1000 * (double)bias_m[i], gn_mask_acne(&scores[i]),
               gn_mask_leak(&scores[i]), gn_mask_gap(&scores[i]), gn_mask_wrong(&scores[i]));
    }
    assert_true(bias_m[1] > 10 * bias_m[0]);
    assert_true(gn_mask_acne(&scores[1]) <= .02);
    assert_true(gn_mask_gap(&scores[1]) < 2);
}

static int count_partly_lit(void) {
    int count = 0;
    for (int i = 0; i < PIXELS; i++)
        count += aov[4 * i] > .02f && aov[4 * i] < .98f && truth.mask.item[i] >= 0;
    return count;
}

static void test_a_larger_light_has_wider_penumbrae(void **state) {
    (void)state;
    struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCSS);
    draw(&opts);
    const int own = count_partly_lit();
    float *before = gn_xalloc(4 * PIXELS, sizeof *before);
    memcpy(before, aov, 4 * PIXELS * sizeof *aov);
    opts.shadow.lights[0] = (struct gn_light_opts){.given = GN_LIGHT_GIVEN(radius),
                                                   .radius = stage.scene->lights[0].radius};
    opts.shadow.light_count = 1;
    draw(&opts);
    assert_memory_equal(before, aov, 4 * PIXELS * sizeof *aov); /* the same one */
    free(before);
    opts.shadow.lights[0].radius = 0.0465f;
    draw(&opts);
    const int large = count_partly_lit();
    printf("pixels in penumbrae: %d, radius times ten: %d\n", own, large);
    assert_true(large > 2 * own);
}

/* The field is of metal: all its light is highlights. */
static void test_highlights_stay_in_shadow_as_told(void **state) {
    (void)state;
    struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF);
    double sums[3] = {0}; /* red of all pixels in shadow: as the rest, .302, none */
    float *lit = gn_xalloc(4 * PIXELS, sizeof *lit);
    opts.debug.aov = GN_AOV_COLOR;
    opts.output.linear = opts.output.floats = true;
    opts.exposure_given = true;
    GN_LIGHT_SET(&opts.shadow.any, strength, 0.0f);
    draw(&opts);
    memcpy(lit, aov, 4 * PIXELS * sizeof *aov);
    GN_LIGHT_SET(&opts.shadow.any, strength, 1.0f - 77.0f / 255.0f);
    for (int i = 0; i < 3; i++) {
        if (i > 0) GN_LIGHT_SET(&opts.shadow.any, specular, i == 1 ? 0.302f : 0.0f);
        draw(&opts);
        for (int p = 0; p < PIXELS; p++) {
            assert_true(aov[4 * p] <= lit[4 * p] * 1.0001f + 1e-5f);
            sums[i] += (double)(lit[4 * p] - aov[4 * p]);
        }
    }
    free(lit);
    printf("taken by shadows: %.3f as of the rest, %.3f with .302, %.3f with 0\n", sums[0], sums[1],
           sums[2]);
    assert_true(sums[0] > 0);
    assert_true(fabs(sums[1] - sums[0]) < 1e-3 * sums[0]);
    assert_true(fabs(sums[2] * (1 - 77.0 / 255) - sums[0]) < .01 * sums[0]);
}

/* A light sees nothing that is in its own shadow. */
static void test_what_a_light_sees_is_lit(void **state) {
    (void)state;
    struct gn_frame_opts opts = opts_of(GN_TECHNIQUE_PCF);
    opts.view.light_plus_1 = 1;
    draw(&opts);
    int dark = 0;
    for (int i = 0; i < PIXELS; i++) dark += aov[4 * i] < .5f;
    printf("as the sun sees it: %d of %d pixels in shadow\n", dark, PIXELS);
    assert_true(dark <= PIXELS / 1000);
    opts.debug.aov = GN_AOV_DISTANCE;
    draw(&opts);
    int seen = 0;
    for (int i = 0; i < PIXELS; i++) seen += isfinite(aov[4 * i]);
    assert_true(seen > PIXELS / 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_more_cascades_are_nearer_to_truth),
        cmocka_unit_test(test_which_faces_cast),
        cmocka_unit_test(test_a_middle_needs_no_bias),
        cmocka_unit_test(test_sixteen_bits),
        cmocka_unit_test(test_a_larger_light_has_wider_penumbrae),
        cmocka_unit_test(test_highlights_stay_in_shadow_as_told),
        cmocka_unit_test(test_what_a_light_sees_is_lit),
    };
    return cmocka_run_group_tests_name("knobs", tests, open_all, close_all);
}
