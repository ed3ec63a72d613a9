/* What clips move beside nodes. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gltf_maker.h"
#include "scene/pose.h"
#include "unit/check.h"

static struct gn_maker maker;
static struct gn_err err;
static struct gn_warnings warnings;
static struct gn_scene *scene;
static struct gn_pose pose;

#define LIGHT(name) "/extensions/KHR_lights_punctual/lights/0/" name

static int setup(void **state) {
    (void)state;
    memset(&warnings, 0, sizeof warnings);
    memset(&err, 0, sizeof err);
    memset(&pose, 0, sizeof pose);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "materials",
                 "[{'emissiveFactor':[0.5,0,0]},{'extensions':{"
                 "'KHR_materials_pbrSpecularGlossiness':{}}}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':1,'znear':0.1}}]");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'spot','intensity':10,'color':[1,0.5,0]"
                 ",'spot':{'innerConeAngle':0.2,'outerConeAngle':0.4}}]}}");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'children':[1]},{'mesh':0,'extensions':{'KHR_lights_punctual':{"
                 "'light':0}}},{'camera':0,'extensions':{'KHR_lights_punctual':{'light':0}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,2]}]");
    return 0;
}

static int teardown(void **state) {
    (void)state;
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    scene = NULL;
    return 0;
}

/* A clip of two keys, at 0 and 2 s. */
static void animate(const char *pointer, const char *type, const float *values, size_t bytes,
                    const char *interpolation) {
    static const float times[] = {0, 2};
    const size_t each = sizeof(float) * (strcmp(type, "VEC3") == 0   ? 3
                                         : strcmp(type, "VEC4") == 0 ? 4
                                                                     : 1);
    char json[500];
    const int input = gn_maker_accessor(&maker, "SCALAR", 5126, 2, times, sizeof times, NULL),
              output = gn_maker_accessor(&maker, type, 5126, bytes / each, values, bytes, NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d,'interpolation':'%s'}],'channels':[{'sampler':0,"
             "'target':{'path':'pointer','extensions':{'KHR_animation_pointer':{'pointer':'%s'}}}}"
             "]}",
             input, output, interpolation, pointer);
    gn_maker_add(&maker, "animations", json);
}
#define ANIMATE(pointer, type, interpolation, ...)                                                 \
    animate(pointer, type, (const float[]){__VA_ARGS__}, sizeof((float[]){__VA_ARGS__}),           \
            interpolation)

static void load(int clips) {
    scene = gn_maker_load(&maker, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, clips);
}

static void step(double time_s) { gn_pose_step(&pose, (int64_t)(time_s * 1e9)); }

static void assert_near(float is, float should) {
    if (!(fabsf(is - should) <= 1e-5f * fmaxf(1, fabsf(should))))
        fail_msg("%g, not %g", (double)is, (double)should);
}

static void test_without_pointers_a_pose_has_the_things_of_the_scene(void **state) {
    (void)state;
    load(GN_POSE_DEFAULT);
    assert_ptr_equal(pose.lights, scene->lights);
    assert_ptr_equal(pose.cameras, scene->cameras);
    assert_ptr_equal(pose.materials, scene->materials);
    assert_null(pose.node_hidden);
}

static void test_all_lights_of_a_definition_move_and_rest_as_in_the_file(void **state) {
    (void)state;
    ANIMATE(LIGHT("intensity"), "SCALAR", "LINEAR", 0, 40);
    load(GN_POSE_DEFAULT);
    assert_int_equal(warnings.count, 0);
    assert_ptr_equal(pose.materials, scene->materials);
    for (int i = 0; i < 2; i++) {
        step(.5);
        assert_near(pose.lights[i].color[0], 10);
        assert_near(pose.lights[i].color[1], 5);
        step(1.5);
        assert_near(pose.lights[i].color[0], 30);
    }
    gn_pose_choose(&pose, GN_POSE_NONE);
    assert_memory_equal(&pose.lights[0].color, &scene->lights[0].color, sizeof(vec3));
    assert_near(pose.lights[0].color[0], 10);
}

static void test_step_and_cubic(void **state) {
    (void)state;
    ANIMATE(LIGHT("range"), "SCALAR", "STEP", 3, 7);
    ANIMATE("/cameras/0/perspective/yfov", "SCALAR", "CUBICSPLINE", 0, .5f, 1, 1, .9f, 0);
    load(GN_POSE_DEFAULT);
    step(1.9);
    assert_near(pose.lights[0].range_m, 3);
    step(1);
    /* u = 1/2 of 2 s: (.5 + .9) / 2 + 2 (1/8 - -1/8 x -1): tangents cancel */
    assert_near(pose.cameras[0].yfov_rad, .7f);
}

static void test_programs_are_those_of_all_that_a_material_may_become(void **state) {
    (void)state;
    ANIMATE("/materials/0/pbrMetallicRoughness/metallicFactor", "SCALAR", "LINEAR", 0, 1);
    ANIMATE("/materials/0/emissiveFactor", "VEC3", "LINEAR", 0, 0, 0, 0, 2, 0);
    gn_maker_set(&maker, "materials", "[{'pbrMetallicRoughness':{'metallicFactor':0}}]");
    load(GN_POSE_DEFAULT);
    assert_true(gn_material_is_metal(&scene->materials[0]));
    assert_true(gn_material_is_emissive(&scene->materials[0]));
    assert_near(scene->materials[0].metalness, 0);
    step(.5);
    assert_near(pose.materials[0].metalness, .25f);
    assert_near(pose.materials[0].emissive[1], .5f);
    assert_near(pose.materials[0].roughness, 1);
}

/* What lets light through casts as much as it is metal, and so its shadow moves with that; glass
 * that becomes opaque casts. */
static void test_a_shadow_follows_what_is_transmitted(void **state) {
    (void)state;
    ANIMATE("/materials/0/pbrMetallicRoughness/metallicFactor", "SCALAR", "LINEAR", 0, 1);
    ANIMATE("/materials/1/extensions/KHR_materials_transmission/transmissionFactor", "SCALAR",
            "LINEAR", 1, 0);
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'metallicFactor':0},'extensions':{"
                 "'KHR_materials_transmission':{'transmissionFactor':0.4}}},"
                 "{'extensions':{'KHR_materials_transmission':{'transmissionFactor':1}}},"
                 "{'extensions':{'KHR_materials_transmission':{'transmissionFactor':1}}}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    load(GN_POSE_DEFAULT);
    assert_false(gn_material_is_clear(&scene->materials[1]));
    assert_true(gn_material_is_clear(&scene->materials[2]));
    assert_true(pose.items[0].moves);
    step(0);
    const uint64_t before = pose.items[0].hash;
    step(1);
    assert_true(pose.items[0].hash != before);
}

static void test_a_hidden_node_hides_what_is_below_it(void **state) {
    (void)state;
    ANIMATE("/nodes/0/extensions/KHR_node_visibility/visible", "SCALAR", "STEP", 1, 0);
    load(GN_POSE_DEFAULT);
    for (uint32_t i = 0; i < scene->item_count; i++) assert_true(pose.items[i].moves);
    step(1.9);
    assert_true(pose.items[0].visible && pose.items[1].visible);
    assert_near(pose.lights[0].color[0], 10);
    gn_pose_choose(&pose, 0);
    pose.at.run.turns = GN_POSE_ONCE;
    step(2);
    assert_false(pose.items[0].visible || pose.items[1].visible);
    const float dark = pose.lights[0].color[0] + pose.lights[1].color[0];
    assert_near(dark, 10); /* one of the two lights is below the node */
    step(0);
    assert_true(pose.items[0].visible && pose.items[1].visible);
}

static void test_a_node_that_is_not_visible_is_not_posed_as_such(void **state) {
    (void)state;
    gn_maker_set(&maker, "extensionsRequired", "['KHR_node_visibility']");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0},{'mesh':0,'translation':[0,9,0],'extensions':{"
                 "'KHR_node_visibility':{'visible':false}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    load(GN_POSE_NONE);
    assert_true(pose.items[0].visible != pose.items[1].visible);
    assert_near(pose.box_ws.max[1], 0);
    assert_near(scene->box.max[1], 0);
}

static void test_a_fade_mixes_values(void **state) {
    (void)state;
    ANIMATE(LIGHT("intensity"), "SCALAR", "LINEAR", 100, 100);
    ANIMATE(LIGHT("intensity"), "SCALAR", "LINEAR", 20, 20);
    load(0);
    step(0);
    assert_near(pose.lights[0].color[0], 100);
    gn_pose_choose_fading(&pose, 1, -1);
    assert_near(pose.lights[0].color[0], 100);
    pose.at.fade = .25f;
    step(.1);
    assert_near(pose.lights[0].color[0], 80);
    gn_pose_choose_fading(&pose, GN_POSE_NONE, -1);
    assert_near(pose.lights[0].color[0], 80);
    pose.at.fade = .5f;
    step(.1);
    assert_near(pose.lights[0].color[0], 45); /* between 80 and the file's 10 */
}

static void test_values_out_of_range_are_clamped_and_said(void **state) {
    (void)state;
    ANIMATE(LIGHT("intensity"), "SCALAR", "LINEAR", -5, 10);
    ANIMATE(LIGHT("range"), "SCALAR", "LINEAR", -1, -1);
    ANIMATE(LIGHT("spot/outerConeAngle"), "SCALAR", "LINEAR", 3, .1f);
    ANIMATE("/cameras/0/perspective/znear", "SCALAR", "LINEAR", -1, -1);
    load(GN_POSE_DEFAULT);
    assert_int_equal(warnings.count, 4);
    assert_non_null(strstr(warnings.text[0], "outside 0 to 1e+18; clamped"));
    step(0);
    assert_near(pose.lights[0].color[0], 0);
    assert_true(pose.lights[0].range_m > 0 && pose.cameras[0].near_m > 0);
    assert_near(pose.lights[0].outer_rad, GLM_PI_2f);
    step(1.999);
    assert_true(pose.lights[0].inner_rad < pose.lights[0].outer_rad);
}

static void test_what_cannot_be_played_is_named(void **state) {
    (void)state;
    static const char *const pointers[] = {
        "/materials/2/emissiveFactor",
        LIGHT("name"),
        "/cameras/1/perspective/yfov",
        "/extensions/KHR_lights_punctual/lights/1/intensity",
        "/materials/1/pbrMetallicRoughness/metallicFactor", /* a glossy one has none, */
        "/materials/1/emissiveTexture/extensions/KHR_texture_transform/rotation", /* or others */
        "/materials/1/extensions/KHR_materials_transmission/transmissionFactor",
        "/materials/00/emissiveFactor",
        "/materials/0/emissiveFactor/0"};
    enum { COUNT = sizeof pointers / sizeof *pointers };
    for (int i = 0; i < COUNT; i++) ANIMATE(pointers[i], "SCALAR", "LINEAR", 1, 2);
    load(GN_POSE_DEFAULT);
    assert_int_equal(scene->animation.channel_count, 0);
    for (int i = 0; i < COUNT; i++) assert_non_null(strstr(warnings.text[i], pointers[i]));
}

static void test_samplers_that_do_not_fit_are_refused(void **state) {
    (void)state;
    ANIMATE(LIGHT("color"), "SCALAR", "LINEAR", 1, 2);
    ANIMATE(LIGHT("intensity"), "VEC3", "LINEAR", 1, 2, 3, 4, 5, 6);
    ANIMATE(LIGHT("intensity"), "SCALAR", "LINEAR", NAN, 2);
    ANIMATE("/nodes/0/extensions/KHR_node_visibility/visible", "SCALAR", "CUBICSPLINE", 1, 1, 1, 0,
            0, 0);
    load(GN_POSE_DEFAULT);
    assert_int_equal(scene->animation.channel_count, 0);
    assert_int_equal(warnings.count, 4);
    assert_non_null(strstr(warnings.text[2], "not finite"));
    step(1);
    assert_near(pose.lights[0].color[0], 10);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_without_pointers_a_pose_has_the_things_of_the_scene),
        TEST(test_all_lights_of_a_definition_move_and_rest_as_in_the_file),
        TEST(test_step_and_cubic),
        TEST(test_programs_are_those_of_all_that_a_material_may_become),
        TEST(test_a_shadow_follows_what_is_transmitted),
        TEST(test_a_hidden_node_hides_what_is_below_it),
        TEST(test_a_node_that_is_not_visible_is_not_posed_as_such),
        TEST(test_a_fade_mixes_values),
        TEST(test_values_out_of_range_are_clamped_and_said),
        TEST(test_what_cannot_be_played_is_named),
        TEST(test_samplers_that_do_not_fit_are_refused),
    };
    return RUN(tests);
}
