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

/* Numbers that a file may have are no places. */
static void test_copies_that_are_nowhere_are_not_shown(void **state) {
    (void)state;
    static const float moves[3][3] = {{0}, {NAN, 0, 0}, {3, INFINITY, 0}};
    char json[300];
    const int t = gn_maker_accessor(&maker, "VEC3", 5126, 3, moves, sizeof moves, NULL);
    snprintf(json, sizeof json,
             "[{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':"
             "{'TRANSLATION':%d}}}}]",
             t);
    gn_maker_set(&maker, "nodes", json);
    struct gn_scene *scene = load_square();
    assert_string_equal(warnings.text[0],
                        "t: nodes[0]: 2 copies with numbers that are not finite are not shown");
    assert_true(scene->box.max[0] == 1 && scene->box.min[0] == -1);
    assert_true(scene->instances[1][0][0] == 0 && scene->instances[1][3][0] == 0);
    gn_scene_destroy(scene);
}

/* The square is shown, and a warning begins so. */
static void spare_key(const char *key, const char *json, const char *message) {
    setup(NULL);
    gn_maker_set(&maker, key, json);
    struct gn_scene *scene = load_square();
    assert_int_equal(scene->triangle_count, 2);
    if (!strstr(warnings.text[0], message)) fail_msg("%s, not %s", warnings.text[0], message);
    assert_string_equal(err.text, "");
    gn_scene_destroy(scene);
}

static void test_wrong_json_of_a_part_costs_that_part(void **state) {
    (void)state;
    static const struct {
        const char *key, *json, *message;
    } rows[] = {
        {"nodes", "[{'mesh':0,'translation':[1,2]}]",
         "t: nodes[0].translation: must have 3 numbers, has 2"},
        {"nodes", "[{'mesh':0,'scale':[1,1e300,2]}]", "t: nodes[0].scale[1]: 1e+300 is too large"},
        {"nodes", "[{'mesh':0,'children':[0]}]", "t: nodes[0]: is its own ancestor"},
        {"nodes", "[{'children':[1]},{'children':[0],'mesh':0}]",
         "t: nodes[0]: is its own ancestor"},
        {"scene", "3", "t: scene: index 3, but there are 1 scenes"},
        {"materials", "[{'pbrMetallicRoughness':[]}]",
         "t: materials[0].pbrMetallicRoughness: must be an object, is an array"},
        {"materials", "[{'doubleSided':1}]",
         "t: materials[0].doubleSided: must be true or false, is a number"},
        {"nodes", "[{'mesh':0,'camera':3}]",
         "t: nodes[0].camera: index 3, but there are 0 cameras"},
        {"nodes", "[{'mesh':0,'skin':3}]", "t: nodes[0].skin: index 3, but there are 0 skins"},
        {"nodes", "[{'mesh':0,'children':[null,7]}]",
         "t: nodes[0].children[0]: must be an index, is null"},
        {"nodes", "[{'mesh':0,'name':3}]", "t: nodes[0].name: must be a string, is a number"},
        {"nodes", "[{'mesh':0},[]]", "t: nodes[1]: must be an object, is an array"},
        {"samplers", "{}", "t: samplers: must be an array, is an object"},
        {"scenes", "[{'nodes':[8,0]}]", "t: scenes[0].nodes[0]: index 8, but there are 1 nodes"},
        {"meshes",
         "[{'primitives':[{'attributes':{'POSITION':0},'indices':1},"
         "{'attributes':{'POSITION':0},'indices':9}]}]",
         "t: meshes[0].primitives[1].indices: index 9, but there are 2 accessors; not shown"},
        {"meshes", "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':4},3]}]",
         "t: meshes[0].primitives[1]: must be an object, is a number; not shown"},
        {"animations", "[{'channels':[{'sampler':5,'target':{'node':0,'path':'scale'}}]}]",
         "t: animations[0].channels[0].sampler: index 5, but there are 0 samplers; not played"},
        {"images", "[{'uri':7}]", ""},
        {"extensions", "{'KHR_lights_punctual':{'lights':3}}",
         "t: extensions.KHR_lights_punctual.lights: must be an array, is a number; ignored"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        spare_key(rows[i].key, rows[i].json, rows[i].message);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_keys_before_zero_are_played_from_zero_on, setup),
        cmocka_unit_test_setup(test_a_scene_without_anything_to_see_is_named, setup),
        cmocka_unit_test_setup(test_an_attribute_that_is_short_is_left_out_and_named, setup),
        cmocka_unit_test_setup(test_an_attribute_past_the_end_of_its_view_is_left_out, setup),
        cmocka_unit_test_setup(test_positions_and_limits_are_not_done_without, setup),
        cmocka_unit_test_setup(test_copies_that_are_nowhere_are_not_shown, setup),
        cmocka_unit_test(test_wrong_json_of_a_part_costs_that_part),
        cmocka_unit_test_setup(test_copies_lose_the_attribute_that_is_short, setup),
    };
    return RUN(tests);
}
