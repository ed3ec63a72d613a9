/* Skins and morph targets: what the loader makes of them, and where the pose has each vertex. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/pose.h"
#include "unit/scene_help.h"

static struct gn_scene *scene;
static struct gn_pose pose;

static int start(void **state) {
    (void)state;
    memset(&warnings, 0, sizeof warnings);
    gn_maker_init(&maker);
    gn_maker_posed_square(&maker);
    return 0;
}

static int end(void **state) {
    (void)state;
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    scene = NULL;
    return 0;
}

static void open_scene(int clips) {
    scene = load();
    gn_pose_init(&pose, scene, clips);
}

static void set_in(const char *array, size_t index, const char *key, const char *json) {
    json_t *object = json_array_get(json_object_get(maker.root, array), index);
    gn_maker_set(&maker, "scratch", json);
    json_object_set(object, key, json_object_get(maker.root, "scratch"));
    json_object_del(maker.root, "scratch");
}

/* The vertex of an item that the file has at x, z. */
static uint32_t vertex_at(uint32_t item, float x, float z) {
    const struct gn_geometry *g = &scene->geometries[scene->items[item].geometry];
    for (uint32_t v = g->first_vertex; v < g->first_vertex + g->vertex_count; v++)
        if (scene->buffers.positions[3 * v] == x && scene->buffers.positions[3 * v + 2] == z)
            return v;
    fail_msg("no vertex at %g %g", (double)x, (double)z);
    return 0;
}

static void assert_posed(uint32_t item, float x, float z, double px, double py, double pz) {
    double p[3];
    gn_pose_vertex(&pose, item, vertex_at(item, x, z), p, NULL);
    if (fabs(p[0] - px) > 1e-5 || fabs(p[1] - py) > 1e-5 || fabs(p[2] - pz) > 1e-5)
        fail_msg("(%g %g %g), not (%g %g %g)", p[0], p[1], p[2], px, py, pz);
}

static void animate(const char *path, int node, const float *values, size_t count, const char *type,
                    const char *how) {
    static const float times[] = {0, 1};
    char json[300];
    const int input = gn_maker_accessor(&maker, "SCALAR", 5126, 2, times, sizeof times, NULL);
    const size_t width = strcmp(type, "SCALAR") == 0 ? 1 : type[3] == '4' ? 4 : 3;
    const int output =
        gn_maker_accessor(&maker, type, 5126, count / width, values, count * sizeof *values, NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d,'interpolation':'%s'}],'channels':[{'sampler':0,"
             "'target':{'node':%d,'path':'%s'}}]}",
             input, output, how, node, path);
    gn_maker_add(&maker, "animations", json);
}

static void test_vertices_follow_their_joints(void **state) {
    (void)state;
    /* joint 1 turns by 90 degrees about y within its second: x goes to -z */
    static const float turn[] = {0, 0, 0, 1, 0, .70710678f, 0, .70710678f};
    animate("rotation", 2, turn, 8, "VEC4", "LINEAR");
    open_scene(0);
    assert_int_equal(scene->deformation.skin_count, 1);
    assert_posed(0, 1, 1, 1, 0, 1); /* as bound; the node's own place is not used */
    gn_pose_step(&pose, 999999999);
    assert_posed(0, -1, 1, -1, 0, 1);
    assert_posed(0, 1, 1, 2, 0, 0); /* 1 before its joint at x = 1 */
    assert_true(pose.animated && pose.items[0].moves);
}

static void test_a_vertex_lies_between_its_joints(void **state) {
    (void)state;
    static const float weights[] = {3, 1, 0, 0, 3, 1, 0, 0, 3, 1, 0, 0, 3, 1, 0, 0};
    static const uint8_t joints[] = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    char json[200];
    const int w = gn_maker_accessor(&maker, "VEC4", 5126, 4, weights, sizeof weights, NULL);
    const int j = gn_maker_accessor(&maker, "VEC4", 5121, 4, joints, sizeof joints, NULL);
    snprintf(json, sizeof json,
             "[{'primitives':[{'indices':1,'attributes':{'POSITION':0,'JOINTS_0':%d,"
             "'WEIGHTS_0':%d}}]}]",
             j, w);
    gn_maker_set(&maker, "meshes", json);
    set_in("nodes", 2, "translation", "[2,4,0]");
    open_scene(GN_POSE_NONE);
    double p[3];
    gn_pose_vertex(&pose, 0, vertex_at(0, 1, 1), p, NULL);
    assert_true(fabs(p[1] - 1) < 1e-4); /* a quarter of 4 */
}

static void test_weights_that_are_none(void **state) {
    (void)state;
    static const float weights[] = {0, 0, 0, 0, NAN, 1, 0, 0, -2, 1, 0, 0, INFINITY, 1, 0, 0};
    static const uint8_t joints[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    char json[200];
    const int w = gn_maker_accessor(&maker, "VEC4", 5126, 4, weights, sizeof weights, NULL);
    const int j = gn_maker_accessor(&maker, "VEC4", 5121, 4, joints, sizeof joints, NULL);
    snprintf(json, sizeof json,
             "[{'primitives':[{'indices':1,'attributes':{'POSITION':0,'JOINTS_0':%d,"
             "'WEIGHTS_0':%d}}]}]",
             j, w);
    gn_maker_set(&maker, "meshes", json);
    set_in("nodes", 2, "translation", "[2,4,0]");
    open_scene(GN_POSE_NONE);
    for (int i = 0; i < 4; i++) { /* the first joint of the first, joint 1 of all others */
        double p[3];
        gn_pose_vertex(&pose, 0, vertex_at(0, i & 1 ? 1 : -1, i & 2 ? 1 : -1), p, NULL);
        assert_true(fabs(p[1] - 4) < 1e-4);
    }
}

static void test_one_mesh_in_two_poses(void **state) {
    (void)state;
    gn_maker_set(&maker, "skins", "[{'joints':[1,2],'inverseBindMatrices':6},{'joints':[4,4]}]");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'skin':0},{'children':[2],'translation':[-1,0,0]},"
                 "{'translation':[2,0,0]},{'mesh':0,'skin':1},{'translation':[0,7,0]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,3,4]}]");
    open_scene(GN_POSE_NONE);
    assert_int_equal(scene->geometry_count, 1);
    assert_int_equal(scene->item_count, 2);
    assert_int_equal(scene->items[0].batch, scene->items[1].batch);
    const uint32_t second = scene->items[1].skin == 1;
    assert_posed(second, 1, 1, 1, 7, 1);
    assert_posed(1 - second, 1, 1, 1, 0, 1);
    assert_true(pose.items[0].hash != pose.items[1].hash);
}

static void test_bounds_hold_all_vertices(void **state) {
    (void)state;
    static const float turn[] = {0, 0, 0, 1, 0, 0, .70710678f, .70710678f};
    static const float weights[] = {0, 0, 1.5f, -1};
    animate("rotation", 2, turn, 8, "VEC4", "LINEAR");
    animate("weights", 0, weights, 4, "SCALAR", "LINEAR");
    open_scene(GN_POSE_DEFAULT);
    uint64_t last = 0;
    for (int i = 0; i < 20; i++) {
        gn_pose_step(&pose, i * INT64_C(50000000));
        const struct gn_box *box = &pose.items[0].box_ws;
        for (uint32_t v = 0; v < scene->geometries[0].vertex_count; v++) {
            double p[3];
            gn_pose_vertex(&pose, 0, scene->geometries[0].first_vertex + v, p, NULL);
            for (int k = 0; k < 3; k++)
                assert_true(p[k] > (double)box->min[k] - 1e-5 && p[k] < (double)box->max[k] + 1e-5);
        }
        assert_true(pose.items[0].hash != last);
        last = pose.items[0].hash;
        gn_pose_step(&pose, i * INT64_C(50000000));
        assert_true(pose.items[0].hash == last);
    }
}

static void test_weights_of_the_mesh_and_of_the_node(void **state) {
    (void)state;
    set_in("meshes", 0, "weights", "[0.5,0]");
    open_scene(GN_POSE_NONE);
    assert_posed(0, 1, 1, 1, .5, 1);
    end(NULL);
    start(NULL);
    set_in("meshes", 0, "weights", "[0.5,0]");
    set_in("nodes", 0, "weights", "[2,0]");
    open_scene(GN_POSE_NONE);
    assert_posed(0, 1, 1, 1, 2, 1);
}

static void test_targets_without_a_skin(void **state) {
    (void)state;
    static const float weights[] = {0, 0, 1, 0};
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'scale':[1,3,1],'translation':[0,0,5]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0]}]");
    animate("weights", 0, weights, 4, "SCALAR", "LINEAR");
    open_scene(0);
    gn_pose_step(&pose, 500000000);
    assert_true(scene->items[0].skin < 0 && scene->items[0].morph == 0);
    assert_posed(0, 1, 1, 1, 1.5, 6); /* half of 1, times 3 */
    assert_int_equal(pose.list_counts[0], 1);
}

static void test_weights_by_a_spline(void **state) {
    (void)state;
    /* in-tangents, values, out-tangents: from 0 with slope 2 to 1 with slope 4 */
    static const float weights[] = {0, 0, 0, 0, 2, 0, 4, 0, 1, 0, 0, 0};
    animate("weights", 0, weights, 12, "SCALAR", "CUBICSPLINE");
    open_scene(0);
    gn_pose_step(&pose, 500000000);
    assert_posed(0, 1, 1, 1, .5 + .125 * 2 - .125 * 4, 1);
}

static void test_sixteen_bit_joints_of_the_second_four(void **state) {
    (void)state;
    static const uint16_t joints[16] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    static const uint8_t second[16] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0};
    char json[300];
    const int j = gn_maker_accessor(&maker, "VEC4", 5123, 4, joints, sizeof joints, NULL);
    const int w =
        gn_maker_accessor(&maker, "VEC4", 5121, 4, second, sizeof second, "'normalized':true");
    snprintf(json, sizeof json,
             "[{'primitives':[{'indices':1,'attributes':{'POSITION':0,'JOINTS_0':2,'WEIGHTS_0':3,"
             "'JOINTS_1':%d,'WEIGHTS_1':%d}}]}]",
             j, w);
    gn_maker_set(&maker, "meshes", json);
    set_in("nodes", 2, "translation", "[2,4,0]");
    open_scene(GN_POSE_NONE);
    assert_true(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_JOINTS1));
    assert_int_equal(scene->buffers.weights1[0], 32768); /* half, and what is left of 65535: */
    assert_int_equal(scene->buffers.weights0[0], 32767);
    double p[3];
    gn_pose_vertex(&pose, 0, vertex_at(0, -1, 1), p, NULL);
    assert_true(fabs(p[1] - 2) < 1e-3);
}

static void test_a_skeleton_that_mirrors(void **state) {
    (void)state;
    set_in("nodes", 1, "scale", "[-1,1,1]");
    open_scene(GN_POSE_NONE);
    assert_true(pose.items[0].mirrored);
}

static void test_flat_normals_follow_a_target(void **state) {
    (void)state;
    /* a target that tilts the square: the file has no normals */
    static const float tilt[] = {0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 2, 0};
    char json[200];
    const int t = gn_maker_accessor(&maker, "VEC3", 5126, 4, tilt, sizeof tilt, NULL);
    snprintf(json, sizeof json,
             "[{'primitives':[{'indices':1,'attributes':{'POSITION':0},'targets':"
             "[{'POSITION':%d}]}]}]",
             t);
    gn_maker_set(&maker, "meshes", json);
    gn_maker_set(&maker, "nodes", "[{'mesh':0}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0]}]");
    open_scene(GN_POSE_NONE);
    const struct gn_targets *targets = scene->geometries[0].targets;
    const uint32_t n = scene->geometries[0].vertex_count;
    assert_int_equal(targets->parts, 2);
    for (uint32_t v = 0; v < n; v++) {
        vec3 whole;
        glm_vec3_add(targets->deltas[n + v], scene->buffers.normals + 3 * v, whole);
        assert_near(glm_vec3_norm(whole), 1);
        assert_true(whole[1] < .99f); /* no longer straight up */
    }
}

/* ---- what is shown without ----------------------------------------------------------------- */

static void assert_said(const char *message) {
    bool said = false;
    for (int i = 0; i < warnings.count; i++) said |= strstr(warnings.text[i], message) != NULL;
    if (!said) fail_msg("%s", message);
}

/* The mesh stands where its node is, and a warning says this. */
static void shown_unskinned(const char *message) {
    open_scene(GN_POSE_NONE);
    assert_said(message);
    assert_int_equal(scene->items[0].skin, -1);
    assert_posed(0, 1, 1, 10, 9, 10);
    end(NULL);
}

static void test_a_joint_that_the_skin_lacks(void **state) {
    (void)state;
    gn_maker_set(&maker, "skins", "[{'joints':[1]}]");
    shown_unskinned("nodes[0]: a vertex of its mesh is of joint 1, but its skin has 1 joints");
}

static void test_too_many_joints(void **state) {
    (void)state;
    json_t *joints = json_array();
    for (int i = 0; i < 65536; i++) json_array_append_new(joints, json_integer(1));
    json_object_set_new(json_array_get(json_object_get(maker.root, "skins"), 0), "joints", joints);
    shown_unskinned("skins[0].joints: 65536 are more than 1024 joints");
}

static void test_weights_too_many_or_too_few_cost_a_warning(void **state) {
    (void)state;
    static const struct {
        const char *json, *said;
        float weights[2];
    } cases[] = {
        {"[1,2,3]", "3 weights, but there are 2 morph targets; the others are ignored", {1, 2}},
        {"[1]", "1 weights, but there are 2 morph targets; 0 for the others", {1, 0}},
    };
    for (int i = 0; i < 2; i++) {
        if (i > 0) start(NULL);
        warnings.count = 0;
        set_in("nodes", 0, "weights", cases[i].json);
        struct gn_scene *scene = gn_maker_load(&maker, &warnings, &err);
        assert_non_null(scene);
        assert_non_null(strstr(warnings.text[0], cases[i].said));
        assert_memory_equal(scene->deformation.weights, cases[i].weights, 8);
        gn_scene_destroy(scene);
    }
}

static void test_counts_that_do_not_match(void **state) {
    (void)state;
    static const float binds[16] = {1};
    char json[100];
    const int one = gn_maker_accessor(&maker, "MAT4", 5126, 1, binds, sizeof binds, NULL);
    snprintf(json, sizeof json, "[{'joints':[1,2],'inverseBindMatrices':%d}]", one);
    gn_maker_set(&maker, "skins", json);
    shown_unskinned("skins[0].inverseBindMatrices: 1 matrices, but there are 2 joints");
    start(NULL);
    gn_maker_set(&maker, "skins", "[{'joints':[1,7]}]");
    shown_unskinned("skins[0].joints[1]: index 7, but there are 3 nodes");
    start(NULL);
    set_in("nodes", 0, "skin", "4");
    shown_unskinned("nodes[0].skin: index 4, but there are 1 skins");
    start(NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'indices':1,'attributes':{'POSITION':0},'targets':"
                 "[{'POSITION':1}]}]}]");
    struct gn_scene *scene = gn_maker_load(&maker, &warnings, &err);
    assert_non_null(scene);
    assert_string_equal(warnings.text[warnings.count - 1],
                        "t: meshes[0].primitives[0].targets[0].POSITION: accessor 1 has 1 "
                        "components, must be VEC3; shown without it");
    gn_scene_destroy(scene);
    start(NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'targets':[{'POSITION':4}]},"
                 "{'attributes':{'POSITION':0},'targets':[{'POSITION':4},{'POSITION':5}]}]}]");
    scene = load();
    assert_said("primitives[1].targets: 2, but another primitive has 1; shown without its morph "
                "targets");
    assert_true(scene->geometries[0].targets && !scene->geometries[1].targets);
    gn_scene_destroy(scene);
    start(NULL);
    gn_maker_set(&maker, "skins", "[{'joints':[]}]");
    shown_unskinned("skins[0]: has no joints");
}

static void test_a_mesh_without_joints_is_shown_without_its_skin(void **state) {
    (void)state;
    gn_maker_set(&maker, "meshes", "[{'primitives':[{'indices':1,'attributes':{'POSITION':0}}]}]");
    open_scene(GN_POSE_NONE);
    assert_int_equal(scene->items[0].skin, -1);
    assert_posed(0, 1, 1, 10, 9, 10); /* where its node is */
    assert_non_null(strstr(warnings.text[0], "no JOINTS_0"));
}

static void test_joints_outside_of_the_scene_do_not_move(void **state) {
    (void)state;
    gn_maker_set(&maker, "scenes", "[{'nodes':[0]}]");
    open_scene(GN_POSE_NONE);
    assert_posed(0, 1, 1, 1, 0, 1);
    assert_non_null(strstr(warnings.text[0], "not in the scene"));
}

/* 100 km off in the mesh's own coordinates, brought back by the bind matrices: shown where it
 * should be, to the steps of floats there, and that is said once. */
static void test_a_skinned_mesh_far_off_in_its_own_coordinates(void **state) {
    (void)state;
    static const float far[] = {99999, 0, -1, 99999, 0, 1, 100001, 0, 1, 100001, 0, -1};
    static const float binds[2][16] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -99999, 0, 0, 1},
                                       {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -100001, 0, 0, 1}};
    static const uint8_t joints[4][4] = {{0}, {0}, {1}, {1}};
    char json[200];
    const int p = gn_maker_accessor(&maker, "VEC3", 5126, 4, far, sizeof far, NULL);
    const int j = gn_maker_accessor(&maker, "VEC4", 5121, 4, joints, sizeof joints, NULL);
    const int b = gn_maker_accessor(&maker, "MAT4", 5126, 2, binds, sizeof binds, NULL);
    snprintf(json, sizeof json,
             "[{'primitives':[{'indices':1,'attributes':{'POSITION':%d,'JOINTS_0':%d,"
             "'WEIGHTS_0':3}}]}]",
             p, j);
    gn_maker_set(&maker, "meshes", json);
    snprintf(json, sizeof json, "[{'joints':[1,2],'inverseBindMatrices':%d}]", b);
    gn_maker_set(&maker, "skins", json);
    open_scene(GN_POSE_NONE);
    for (uint32_t v = 0; v < 4; v++) {
        double at[3];
        gn_pose_vertex(&pose, 0, scene->geometries[0].first_vertex + v, at, NULL);
        assert_true(fabs(fabs(at[0]) - 1) < .01 && fabs(fabs(at[2]) - 1) < .01);
    }
    assert_true(scene->box.max[0] < 1.1f);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], "lies 1e+05 m off in its own coordinates"));
}

static void test_copies_of_a_skinned_mesh_are_one(void **state) {
    (void)state;
    static const float places[] = {0, 0, 0, 5, 0, 0, 9, 0, 0};
    char json[200];
    const int t = gn_maker_accessor(&maker, "VEC3", 5126, 3, places, sizeof places, NULL);
    snprintf(json, sizeof json, "{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':%d}}}", t);
    set_in("nodes", 0, "extensions", json);
    gn_maker_set(&maker, "extensionsUsed", "['EXT_mesh_gpu_instancing']");
    open_scene(GN_POSE_NONE);
    assert_int_equal(scene->item_count, 1);
    assert_posed(0, 1, 1, 1, 0, 1);
    assert_int_equal(warnings.count, 1);
    assert_non_null(strstr(warnings.text[0], "nodes[0]: has a skin"));
}

/* As many joints as there may be, each of which moves vertices of its own; one more is refused. */
static void test_1024_joints(void **state) {
    (void)state;
    enum { COUNT = 1024 };
    static float positions[COUNT][3][3], weights[COUNT][3][4];
    static uint16_t joints[COUNT][3][4];
    char json[200];
    gn_maker_finish(&maker);
    gn_maker_init(&maker);
    for (int i = 0; i < COUNT; i++) {
        snprintf(json, sizeof json, "{'translation':[0,%d,0]}", i);
        gn_maker_add(&maker, "nodes", json);
        for (int c = 0; c < 3; c++) {
            positions[i][c][0] = (float)(i + (c == 1));
            positions[i][c][2] = (float)(c == 2);
            joints[i][c][0] = (uint16_t)i;
            weights[i][c][0] = 1;
        }
    }
    gn_maker_skinned(&maker, COUNT, 3 * COUNT, positions[0], joints[0], weights[0]);
    open_scene(GN_POSE_NONE);
    assert_int_equal(scene->deformation.skins[0].joint_count, COUNT);
    for (int i = 0; i < COUNT; i += 31) assert_posed(0, (float)i, 1, i, i, 1);
    assert_posed(0, COUNT - 1, 1, COUNT - 1, COUNT - 1, 1);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, start, end)
int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_vertices_follow_their_joints),
        TEST(test_a_vertex_lies_between_its_joints),
        TEST(test_weights_that_are_none),
        TEST(test_one_mesh_in_two_poses),
        TEST(test_bounds_hold_all_vertices),
        TEST(test_weights_of_the_mesh_and_of_the_node),
        TEST(test_targets_without_a_skin),
        TEST(test_weights_by_a_spline),
        TEST(test_sixteen_bit_joints_of_the_second_four),
        TEST(test_a_skeleton_that_mirrors),
        TEST(test_flat_normals_follow_a_target),
        TEST(test_a_joint_that_the_skin_lacks),
        TEST(test_too_many_joints),
        TEST(test_weights_too_many_or_too_few_cost_a_warning),
        TEST(test_counts_that_do_not_match),
        TEST(test_a_mesh_without_joints_is_shown_without_its_skin),
        TEST(test_joints_outside_of_the_scene_do_not_move),
        TEST(test_a_skinned_mesh_far_off_in_its_own_coordinates),
        TEST(test_copies_of_a_skinned_mesh_are_one),
        TEST(test_1024_joints),
    };
    return RUN(tests);
}
