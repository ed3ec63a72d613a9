/* How large a picture may be for a GPU: by what its frames take, and by what it calls itself. */
#include <math.h>

#include "options/args.h"
#include "stage/time.h"
#include "unit/check.h"

static double scale_for(double fixed, double pixels, double scaling) {
    const struct gn_stage_parts parts = {fixed, pixels, scaling};
    return gn_stage_scale_for(&parts, 16);
}

static void test_what_is_in_time_stays_whole(void **state) {
    (void)state;
    assert_true(scale_for(2, 14, 3) == 1);
    assert_true(scale_for(0, 0, 0) == 1);
}

/* By hand: (16 - 2 - 2) / 20 is .6, its root .775. */
static void test_largest_step_that_takes_one_refresh(void **state) {
    (void)state;
    assert_float_equal(scale_for(2, 20, 2), 0.75, 1e-9);
    assert_float_equal(scale_for(0, 64, 0), 0.5, 1e-9);
    for (double pixels = 17; pixels < 64; pixels += 0.37) {
        const double scale = scale_for(0, pixels, 0), next = scale + 1.0 / GN_STAGE_SCALE_STEPS;
        assert_true(scale >= 0.5 && scale < 1);
        assert_true(scale * scale * pixels <= 16 + 1e-9 && next * next * pixels > 16);
    }
}

/* At half of the size it would take 17: so it is as large as two refreshes allow. */
static void test_two_refreshes_where_one_is_too_few(void **state) {
    (void)state;
    assert_float_equal(scale_for(0, 68, 0), 0.65, 1e-9); /* sqrt(32 / 68) is .686 */
    assert_true(scale_for(12, 19.9, 8) == 1);            /* takes two anyhow */
    assert_true(scale_for(30, 4, 20) == 1);              /* three, scaled or not */
    assert_true(scale_for(100, 100, 0) == 1);            /* more than four */
}

static void test_gpus_that_are_calibrated(void **state) {
    (void)state;
    assert_ptr_equal(gn_cost_gpu_of("V3D 4.2.14.0"), &gn_cost_gpus[GN_COST_PI4]);
    assert_ptr_equal(gn_cost_gpu_of("V3D 4.2"), &gn_cost_gpus[GN_COST_PI4]);
    assert_ptr_equal(gn_cost_gpu_of("V3D 7.1.7.0"), &gn_cost_gpus[GN_COST_PI5]);
    static const char *const others[] = {"",
                                         "V3D",
                                         "V3D 3.3",
                                         "llvmpipe (LLVM 15.0.6, 256 bits)",
                                         "Mali-G52 (Panfrost)",
                                         "FD618",
                                         "VideoCore V3D 4.2"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        assert_null(gn_cost_gpu_of(others[i]));
    assert_true(gn_cost_gpus[GN_COST_PI4].error > 0 && gn_cost_gpus[GN_COST_PI5].error > 0);
}

/* The default scene in Full HD takes a Pi 4 more than a refresh. Drawn at the share that was
 * chosen, it takes as many refreshes as were meant. */
static void test_of_the_default_scene(void **state) {
    (void)state;
    struct gn_stage stage;
    struct gn_err err = {0};
    struct gn_options options = {0};
    struct gn_warnings warnings = {0};
    char name[] = "gnomon", command[] = "inspect", *argv[] = {name, command, NULL};
    if (!gn_args_parse(&options, 2, argv, &warnings, &err) ||
        !gn_stage_load(&stage, options.settings, &warnings, &err))
        fail_msg("%s", err.text);
    stage.shown.opts.output.width_px = 1920, stage.shown.opts.output.height_px = 1080;
    const double scale = gn_stage_scale(&stage, &gn_cost_gpus[GN_COST_PI4], 1000.0 / 60);
    assert_true(scale >= 0.5 && scale < 1);
    struct gn_frame_opts opts = stage.shown.opts;
    double ms[4];
    for (int i = 0; i < 4; i++) {
        struct gn_stage_time time;
        opts.output.scale = i == 0   ? 0
                            : i == 3 ? 0.75f
                                     : (float)(scale + 2.0 * (i - 1) / GN_STAGE_SCALE_STEPS);
        if (!gn_stage_time_build(&time, &stage, &opts, &gn_cost_gpus[GN_COST_PI4], NULL, &err))
            fail_msg("%s", err.text);
        ms[i] = time.cost.ms[GN_COST_EACH_FRAME] + time.cost.ms[GN_COST_CAMERA_MOVES];
        gn_stage_time_finish(&time);
    }
    print_message("default scene, Pi 4, 1920x1080: %.1f ms; at %.2f %.1f ms, at .75 %.1f ms\n",
                  ms[0], scale, ms[1], ms[3]);
    const double refreshes = ceil(ms[1] * 60 / 1000);
    assert_true(ceil(ms[0] * 60 / 1000) > refreshes);
    assert_true(ms[2] > refreshes * 1000 / 60); /* two steps more; lanes are counted at half */
    gn_stage_close(&stage);
    gn_options_finish(&options);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_in_time_stays_whole),
        cmocka_unit_test(test_largest_step_that_takes_one_refresh),
        cmocka_unit_test(test_two_refreshes_where_one_is_too_few),
        cmocka_unit_test(test_gpus_that_are_calibrated),
        cmocka_unit_test(test_of_the_default_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
