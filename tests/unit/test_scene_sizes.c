/* What a scene's own size decides, in scenes of 10 um to 10 km: planes, framing, the added floor;
 * and what is in them. */
#include "scene/framing.h"
#include "scene/pose.h"
#include "unit/scene_help.h"

#include <cglm/cglm.h>

#define LIGHT "'extensions':{'KHR_lights_punctual':{'light':0}}"

static struct gn_scene *load_nodes(const char *light, const char *nodes, const char *list) {
    char text[200];
    setup(NULL);
    gn_maker_cube(&maker);
    if (light) {
        snprintf(text, sizeof text, "{'KHR_lights_punctual':{'lights':[{'type':'%s'}]}}", light);
        gn_maker_set(&maker, "extensions", text);
    }
    gn_maker_set(&maker, "nodes", nodes);
    snprintf(text, sizeof text, "[{'nodes':%s}]", list);
    gn_maker_set(&maker, "scenes", text);
    return load();
}

/* Does the floor, node "f", catch planar shadows, rather than a larger one below, whose back is
 * lit? */
static bool catches(const char *light, double floor_m, double cube_m, double lamp_m) {
    char nodes[600];
    snprintf(nodes, sizeof nodes,
             "[{'mesh':0,'name':'f','scale':[%g,1,%g]},"
             "{'mesh':1,'scale':[%g,%g,%g],'translation':[0,%g,0]},"
             "{'translation':[0,%g,0],'rotation':[-0.70710678,0,0,0.70710678]," LIGHT "},"
             "{'mesh':0,'name':'w','scale':[%g,1,%g],'translation':[0,%g,0],'rotation':[1,0,0,0]}]",
             floor_m / 2, floor_m / 2, cube_m / 2, cube_m / 2, cube_m / 2, cube_m / 2, lamp_m,
             .65 * floor_m, .65 * floor_m, -.1 * floor_m);
    struct gn_scene *scene = load_nodes(light, nodes, "[0,1,2,3]");
    bool plane = false;
    for (uint32_t i = 0; i < scene->item_count; i++)
        plane |= scene->items[i].plane && !strcmp(scene->nodes[scene->items[i].node].name, "f");
    gn_scene_destroy(scene);
    return plane;
}

static void test_a_floor_of_any_size_catches_shadows(void **state) {
    (void)state;
    assert_true(catches("directional", 1, .1, 1));
    assert_true(catches("directional", 1e4, 10, 1)); /* low on a large floor */
    assert_true(catches("directional", 1e-3, 1e-4, 1));
    assert_true(catches("point", 1, .1, .5));
    assert_true(catches("point", 1e-3, 1e-4, 5e-4)); /* a lamp under 1 cm up */
    assert_true(catches("point", 1e4, 2, 5));
    assert_false(catches("point", 1, .1, 0)); /* in the floor's plane */
}

static void test_a_terrace_is_another_plane_than_a_large_ground(void **state) {
    (void)state;
    static const char nodes[] =
        "[{'mesh':0,'name':'ground','scale':[5000,1,5000],'extras':{'gnomon_plane':true}},"
        "{'mesh':0,'name':'terrace','scale':[9,1,9],'translation':[0,1.2,0],"
        "'extras':{'gnomon_plane':true}},"
        "{'mesh':0,'name':'road','scale':[9,1,9],'translation':[900,0,0],"
        "'extras':{'gnomon_plane':true}}]";
    struct gn_scene *scene = load_nodes(NULL, nodes, "[0,1,2]");
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const char *name = scene->nodes[scene->items[i].node].name;
        if (name[0] == 'g' || name[0] == 'r') assert_int_equal(scene->items[i].plane, 1);
        if (name[0] == 't') assert_int_equal(scene->items[i].plane, 2);
    }
    gn_scene_destroy(scene);
}

/* How far off the made camera is, in sizes of the cube. */
static double find_distance(double size_m) {
    char nodes[100];
    struct gn_pose pose;
    struct gn_framing framing;
    const struct gn_framing_opts opts = {.aspect = 1};
    snprintf(nodes, sizeof nodes, "[{'mesh':1,'scale':[%g,%g,%g]}]", size_m / 2, size_m / 2,
             size_m / 2);
    struct gn_scene *scene = load_nodes(NULL, nodes, "[0]");
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_framing_build(&pose, scene->camera_count - 1, &opts, &framing);
    const double distance_m = glm_vec3_norm(framing.eye_ws);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    return distance_m / size_m;
}

static void test_a_model_fills_the_picture_whatever_its_size(void **state) {
    (void)state;
    const double expected = find_distance(1);
    static const double sizes_m[] = {1e-5, 1e-4, 1e-3, 1e4};
    for (int i = 0; i < 4; i++) {
        const double distance = find_distance(sizes_m[i]);
        if (!(fabs(distance - expected) < .01 * expected))
            fail_msg("a cube of %g m is seen from %g of its sizes, not %g", sizes_m[i], distance,
                     expected);
    }
}

static bool is_warned(const char *text) {
    for (int i = 0; i < warnings.count; i++)
        if (strstr(warnings.text[i], text)) return true;
    return false;
}

static void test_numbers_out_of_their_range_are_named(void **state) {
    (void)state;
    setup(NULL);
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'metallicFactor':1.5},'extensions':{"
                 "'KHR_materials_specular':{'specularFactor':-0.5},"
                 "'KHR_materials_volume':{'attenuationColor':[2,1,1]}}},"
                 "{'pbrMetallicRoughness':{'metallicFactor':1,'baseColorFactor':[0,1,0,1]}}]");
    gn_scene_destroy(load());
    assert_true(
        is_warned("materials[0].pbrMetallicRoughness.metallicFactor: outside 0 to 1; clamped"));
    assert_true(is_warned("KHR_materials_specular.specularFactor: outside 0 to 1; clamped"));
    assert_true(is_warned("KHR_materials_volume.attenuationColor: outside 0 to 1; clamped"));
    assert_false(is_warned("materials[1]"));
}

static void test_a_matrix_beside_a_translation_is_named(void **state) {
    (void)state;
    setup(NULL);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'translation':[9,0,0],'matrix':[1,0,0,0,0,1,0,0,0,0,1,0,2,0,0,1]}]");
    struct gn_scene *scene = load();
    assert_true(is_warned("nodes[0]: has a matrix, and translation, rotation or scale"));
    assert_near(scene->box.max[0], 3);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_floor_of_any_size_catches_shadows),
        cmocka_unit_test(test_a_terrace_is_another_plane_than_a_large_ground),
        cmocka_unit_test(test_a_model_fills_the_picture_whatever_its_size),
        cmocka_unit_test(test_numbers_out_of_their_range_are_named),
        cmocka_unit_test(test_a_matrix_beside_a_translation_is_named),
    };
    return cmocka_run_group_tests_name("scene_sizes", tests, NULL, NULL);
}
