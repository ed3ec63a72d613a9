/* Parts of a file that are odd and cost nothing else. */
#include <string.h>

#include "scene/pose.h"
#include "unit/scene_help.h"

static struct gn_scene *load_square(void) {
    struct gn_scene *scene = gn_maker_load(&maker, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

/* Of a clip that was cut from a longer one. */
static void test_keys_before_zero_are_played_from_zero_on(void **state) {
    (void)state;
    static const float times[] = {-1, 1, 3}, moves[] = {0, 0, 0, 4, 0, 0, 0, 0, 8};
    char json[200];
    const int input = gn_maker_accessor(&maker, "SCALAR", 5126, 3, times, sizeof times, NULL),
              output = gn_maker_accessor(&maker, "VEC3", 5126, 3, moves, sizeof moves, NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d}],"
             "'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}]}",
             input, output);
    gn_maker_add(&maker, "animations", json);
    struct gn_scene *scene = load_square();
    struct gn_pose pose;
    assert_int_equal(warnings.count, 0);
    assert_int_equal(scene->animation.clips[0].duration_ns, 3 * INT64_C(1000000000));
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, 0);
    assert_float_equal(pose.world_from_node[0][3][0], 2, 1e-6);
    gn_pose_step(&pose, INT64_C(1000000000));
    assert_float_equal(pose.world_from_node[0][3][0], 4, 1e-6);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

static void test_a_scene_without_anything_to_see_is_named(void **state) {
    (void)state;
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'scale':[0,0,0]}]");
    struct gn_scene *scene = load_square();
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], "nothing can be seen"));
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_keys_before_zero_are_played_from_zero_on, setup),
        cmocka_unit_test_setup(test_a_scene_without_anything_to_see_is_named, setup),
    };
    return RUN(tests);
}
