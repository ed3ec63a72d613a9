/* The whole way of the oracle, from the bytes of a file to a mask, against formulas. */
#include <math.h>

#include "image/truth.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* A ground of 20 m, a unit cube standing on it, a camera on (0, 6, 0) that looks straight down, a
 * sun from +X, 45 degrees high. */
static struct gn_scene *load_cube(void) {
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[10,1,10]},"
                 "{'mesh':1,'translation':[0,0.5,0],'scale':[0.5,0.5,0.5]},"
                 "{'camera':0,'translation':[0,6,0],'rotation':[-0.70710678,0,0,0.70710678]},"
                 "{'rotation':[-0.27059805,0.65328148,0.27059805,0.65328148],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.9272952180016122,'znear':0.1}}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional'}]}}");
    struct gn_scene *scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* From above, 6 m up with a tangent of .5 at the top of the picture: the cube's roof is 1 m wide at
 * 5 m, its shadow reaches 1 m out to -X; everything else is lit. */
static void test_truth_of_a_cube_from_a_file(void **state) {
    (void)state;
    struct gn_scene *scene = load_cube();
    struct gn_truth truth;
    struct gn_err err = {0};
    struct gn_truth_opts opts = {.width_px = 320, .height_px = 240};
    assert_true(gn_truth_make(&truth, scene, &opts, &err));
    int dark = 0;
    for (int i = 0; i < 320 * 240; i++) {
        double sx = (i % 320 + .5 - 160) / 240, sy = (119.5 - i / 320) / 240;
        double x = 6 * sx, z = -6 * sy; /* on the ground */
        bool roof = fabs(5 * sx) < .5 && fabs(5 * sy) < .5;
        bool shadow = !roof && x > -1.5 && x < -.5 && fabs(z) < .5;
        double margin = fmin(fabs(fabs(z) - .5), fmin(fabs(x + 1.5), fabs(x + .5)));
        if (margin < 1e-3) continue;
        assert_int_equal(truth.mask.lit[i], !shadow);
        double away = (roof ? 5 : 6) * sqrt(1 + sx * sx + sy * sy);
        assert_true(fabs(truth.mask.distance_m[i] - away) < 1e-4);
        assert_true(fabs(truth.mask.normal_ws[3 * i + 1] - 1) < 1e-6);
        dark += shadow;
    }
    assert_true(dark > 500);
    /* Casters: the ground, 20 m. Seen: 8 x 6 m of ground, a little more by the roof. As the sun
     * sees it, 8 m lie in 8 sin 45 = 5.7 m, across them 6 m (5 for the roof): the square is 6 m. */
    assert_true(fabs(truth.frame.extent - 6) < .05);
    gn_truth_finish(&truth);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_truth_of_a_cube_from_a_file),
    };
    return cmocka_run_group_tests_name("cube", tests, NULL, NULL);
}
