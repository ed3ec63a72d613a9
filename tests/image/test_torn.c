/* Of soft shadows those that look torn or grainy measure so: on the default picture of a model,
 * against rays. */
#include "image/compare.h"
#include "image/shot.h"
#include "image/soft.h"
#include "unit/check.h"

enum { CONE, PCSS, VSSM, SMSM, TECHNIQUES };
static const char *const names[TECHNIQUES] = {"cone", "pcss", "vssm", "smsm"};

static struct gn_soft made;
static struct gn_picture shots[TECHNIQUES];
static struct gn_tear_score scores[TECHNIQUES][GN_TEAR_PARTS];

static int make_default(void **state) {
    (void)state;
    struct gn_err err = {0};
    if (!gn_soft_init(&made, GN_SOFT_DEFAULT, 480, 360, &err)) fail_msg("%s", err.text);
    for (int t = 0; t < TECHNIQUES; t++) {
        if (!gn_soft_shoot(&made, names[t], &shots[t], &err)) fail_msg("%s", err.text);
        gn_soft_compare(&made, &shots[t], scores[t]);
        for (int p = GN_TEAR_FLOOR; p < GN_TEAR_PARTS; p++)
            print_message("%s %s: tear %.4f grain %.4f rmse %.4f, %ld px\n", names[t],
                          p == GN_TEAR_FLOOR ? "floor" : "model", scores[t][p].tear,
                          scores[t][p].grain, scores[t][p].rmse, scores[t][p].pixels);
        if (gn_shot_full()) gn_compare_save(NULL, names[t], &shots[t], &made.truth);
    }
    return 0;
}
static int finish_default(void **state) {
    (void)state;
    for (int t = 0; t < TECHNIQUES; t++) gn_picture_finish(&shots[t]);
    gn_soft_finish(&made);
    return 0;
}

static const struct gn_tear_score *floor_of(int technique) {
    return &scores[technique][GN_TEAR_FLOOR];
}

/* Whatever the technique of the model: it is gathered from points of the lamp (frame/floor.c). */
static void test_the_floor_is_neither_torn_nor_grainy(void **state) {
    (void)state;
    for (int t = 0; t < TECHNIQUES; t++) {
        assert_true(floor_of(t)->tear <= .003 && floor_of(t)->grain <= .03);
        assert_true(floor_of(t)->rmse <= .013);
    }
}

/* As over nine published models at 800x600. */
static void test_of_models_pcss_is_torn_most(void **state) {
    (void)state;
    const struct gn_tear_score *pcss = &scores[PCSS][GN_TEAR_SURFACE];
    for (int t = 0; t < TECHNIQUES; t++) {
        const struct gn_tear_score *other = &scores[t][GN_TEAR_SURFACE];
        if (t == PCSS) continue;
        assert_true(other->tear < .8 * pcss->tear);
        assert_true(other->grain < (t == VSSM ? 1. : .8) * pcss->grain);
    }
}

static void test_turned_taps_are_rather_grain(void **state) {
    (void)state;
    for (int t = CONE; t <= PCSS; t++)
        assert_true(scores[t][GN_TEAR_SURFACE].grain > 2.5 * scores[t][GN_TEAR_SURFACE].tear);
}

/* A picture with something added to each pixel that is neither lit nor dark; blurs: then the mean
 * of 7 x 7 pixels. */
static struct gn_tear_score spoil(float (*add)(int x, int y), bool blurs) {
    struct gn_tear_score score[GN_TEAR_PARTS];
    struct gn_picture spoilt, mean;
    const struct gn_picture *from = &shots[SMSM];
    gn_picture_init(&spoilt, from->width_px, from->height_px, 1);
    gn_picture_init(&mean, from->width_px, from->height_px, 1);
    for (int y = 0; y < from->height_px; y++)
        for (int x = 0; x < from->width_px; x++) {
            const float seen = *gn_picture_at(from, x, y);
            const bool soft = seen > .05f && seen < .95f;
            *gn_picture_at(&spoilt, x, y) = seen + (soft ? add(x, y) : 0);
        }
    for (int y = 3; y + 3 < from->height_px; y++)
        for (int x = 3; x + 3 < from->width_px; x++)
            for (int i = 0; i < 49; i++)
                *gn_picture_at(&mean, x, y) +=
                    *gn_picture_at(&spoilt, x - 3 + i % 7, y - 3 + i / 7) / 49;
    gn_soft_compare(&made, blurs ? &mean : &spoilt, score);
    gn_picture_finish(&spoilt);
    gn_picture_finish(&mean);
    return score[GN_TEAR_FLOOR];
}
static float hatch(int x, int y) { return (x + y) % 4 < 2 ? .08f : -.08f; }
static float steps(int x, int y) { return (x + y) / 16 % 2 ? .04f : -.04f; }
static float both(int x, int y) { return hatch(x, y) + steps(x, y); }

static void test_a_hatch_is_grain(void **state) {
    (void)state;
    const struct gn_tear_score *before = floor_of(SMSM), after = spoil(hatch, false);
    print_message("hatch: tear %.4f grain %.4f rmse %.4f\n", after.tear, after.grain, after.rmse);
    assert_true(after.grain > 5 * before->grain);
    assert_true(after.tear < .1 * after.grain);
}

static void test_steps_are_torn_though_they_are_a_small_error(void **state) {
    (void)state;
    const struct gn_tear_score *before = floor_of(SMSM), after = spoil(steps, false);
    print_message("steps: tear %.4f grain %.4f rmse %.4f\n", after.tear, after.grain, after.rmse);
    assert_true(after.rmse < .04);
    assert_true(after.tear > 20 * before->tear);
}

static void test_a_blurred_picture_is_torn_without_grain(void **state) {
    (void)state;
    const struct gn_tear_score sharp = spoil(both, false), after = spoil(both, true);
    print_message("blur: tear %.4f grain %.4f rmse %.4f, of %.4f %.4f %.4f\n", after.tear,
                  after.grain, after.rmse, sharp.tear, sharp.grain, sharp.rmse);
    assert_true(after.grain < .8 * sharp.grain);
    assert_true(after.tear > .9 * sharp.tear);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_floor_is_neither_torn_nor_grainy),
        cmocka_unit_test(test_of_models_pcss_is_torn_most),
        cmocka_unit_test(test_turned_taps_are_rather_grain),
        cmocka_unit_test(test_a_hatch_is_grain),
        cmocka_unit_test(test_steps_are_torn_though_they_are_a_small_error),
        cmocka_unit_test(test_a_blurred_picture_is_torn_without_grain),
    };
    return cmocka_run_group_tests_name("torn", tests, make_default, finish_default);
}
