/* Parts of a file that are odd and cost nothing else. */
#include <stdio.h>
#include <stdlib.h>
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

/* Of n elements, where the square has 4 corners; values: 4 floats each, or 4 bytes of joints. */
static void add_attributes(int n) {
    static const float values[5 * 4] = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    static const uint8_t joints[5 * 4];
    char json[400];
    const int normals =
                  gn_maker_accessor(&maker, "VEC3", 5126, (size_t)n, values, (size_t)n * 12, NULL),
              uv = gn_maker_accessor(&maker, "VEC2", 5126, (size_t)n, values, (size_t)n * 8, NULL),
              of_joints =
                  gn_maker_accessor(&maker, "VEC4", 5121, (size_t)n, joints, (size_t)n * 4, NULL),
              weights =
                  gn_maker_accessor(&maker, "VEC4", 5126, (size_t)n, values, (size_t)n * 16, NULL);
    snprintf(json, sizeof json,
             "[{'primitives':[{'indices':1,'material':0,'attributes':{'POSITION':0,'NORMAL':%d,"
             "'TEXCOORD_0':%d,'COLOR_0':%d,'JOINTS_0':%d,'WEIGHTS_0':%d}}]}]",
             normals, uv, weights, of_joints, weights);
    gn_maker_set(&maker, "meshes", json);
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'skin':0},{}]");
    gn_maker_set(&maker, "skins", "[{'joints':[1]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    gn_maker_set(&maker, "materials", "[{}]");
}

static bool has_warning(const char *part) {
    bool found = false;
    for (int i = 0; i < warnings.count; i++) found |= strstr(warnings.text[i], part) != NULL;
    return found;
}

/* One short, one too many, and right. */
static void test_an_attribute_that_is_short_is_left_out_and_named(void **state) {
    (void)state;
    static const char *const names[] = {"NORMAL", "TEXCOORD_0", "COLOR_0", "JOINTS_0", "WEIGHTS_0"};
    for (int n = 3; n <= 5; n++) {
        char said[200];
        if (n > 3) setup(NULL);
        add_attributes(n);
        struct gn_scene *scene = load_square();
        for (int i = 0; i < 5; i++) {
            snprintf(said, sizeof said, ".attributes.%s: %d elements, but POSITION has 4; %s",
                     names[i], n, n < 4 ? "shown without it" : "the others are ignored");
            if (has_warning(said) != (n != 4)) fail_msg("%d elements: %s", n, said);
        }
        assert_int_equal(scene->geometries[0].vertex_count, 4);
        assert_int_equal(scene->geometries[0].index_count, 6);
        assert_int_equal(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_JOINTS0), n >= 4);
        assert_true(scene->buffers.normals[1] == 1); /* of the faces, if not of the file */
        gn_scene_destroy(scene);
    }
}

/* The accessor claims what its view has not; and one that is not there at all. */
static void test_an_attribute_past_the_end_of_its_view_is_left_out(void **state) {
    (void)state;
    add_attributes(4);
    json_t *accessor = json_array_get(json_object_get(maker.root, "accessors"), 3);
    json_object_set_new(accessor, "byteOffset", json_integer(8));
    json_t *mesh = json_array_get(json_object_get(maker.root, "meshes"), 0);
    json_t *primitive = json_array_get(json_object_get(mesh, "primitives"), 0);
    json_object_set_new(json_object_get(primitive, "attributes"), "COLOR_0", json_integer(99));
    struct gn_scene *scene = load_square();
    assert_true(has_warning("pass the end of bufferView 3 (32 bytes); shown without it"));
    assert_true(has_warning("COLOR_0: index 99, but there are 6 accessors; shown without it"));
    assert_null(scene->buffers.colors);
    gn_scene_destroy(scene);
}

static void test_positions_and_limits_are_not_done_without(void **state) {
    (void)state;
    json_object_set_new(json_array_get(json_object_get(maker.root, "accessors"), 0), "count",
                        json_integer(5));
    assert_null(gn_maker_load(&maker, &warnings, &err));
    assert_non_null(strstr(err.text, "pass the end of bufferView 0"));
    err = (struct gn_err){0};
    setup(NULL);
    add_attributes(4);
    struct gn_made glb = gn_maker_glb(&maker);
    atomic_bool cancel = true;
    const struct gn_scene_limits cancelled = {.cancel = &cancel};
    assert_null(gn_scene_load_bytes("t", glb.data, glb.size, &cancelled, &warnings, &err));
    assert_non_null(strstr(err.text, "no longer wanted"));
    free(glb.data);
    gn_maker_finish(&maker);
}

static void test_copies_lose_the_attribute_that_is_short(void **state) {
    (void)state;
    static const float moves[2][3] = {{0}, {3, 0, 0}}, turns[1][4] = {{0, 1, 0, 0}};
    char json[300];
    const int t = gn_maker_accessor(&maker, "VEC3", 5126, 2, moves, sizeof moves, NULL),
              r = gn_maker_accessor(&maker, "VEC4", 5126, 1, turns, sizeof turns, NULL);
    snprintf(json, sizeof json,
             "[{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':"
             "{'TRANSLATION':%d,'ROTATION':%d}}}}]",
             t, r);
    gn_maker_set(&maker, "nodes", json);
    struct gn_scene *scene = load_square();
    assert_int_equal(scene->instance_count, 2);
    assert_true(scene->instances[1][3][0] == 3 && scene->instances[1][0][0] == 1);
    assert_true(has_warning("ROTATION: 1 elements, but another attribute has 2; shown without it"));
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_keys_before_zero_are_played_from_zero_on, setup),
        cmocka_unit_test_setup(test_a_scene_without_anything_to_see_is_named, setup),
        cmocka_unit_test_setup(test_an_attribute_that_is_short_is_left_out_and_named, setup),
        cmocka_unit_test_setup(test_an_attribute_past_the_end_of_its_view_is_left_out, setup),
        cmocka_unit_test_setup(test_positions_and_limits_are_not_done_without, setup),
        cmocka_unit_test_setup(test_copies_lose_the_attribute_that_is_short, setup),
    };
    return RUN(tests);
}
