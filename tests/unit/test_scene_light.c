/* Lights, cameras, extras, the plane, and what is made where the file has none. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scene/pose.h"
#include "unit/scene_help.h"

static void assert_warned(const char *text) {
    for (int i = 0; i < warnings.count; i++)
        if (strcmp(warnings.text[i], text) == 0) return;
    fail_msg("no warning '%s'; the first is '%s'", text, warnings.text[0]);
}

/* One light, on node 1. */
static void set_light(const char *definition, const char *node_extras) {
    char json[600];
    snprintf(json, sizeof json, "{'KHR_lights_punctual':{'lights':[%s]}}", definition);
    gn_maker_set(&maker, "extensions", json);
    snprintf(
        json, sizeof json,
        "[{'mesh':0},{'name':'n','extensions':{'KHR_lights_punctual':{'light':0}},'extras':%s}]",
        node_extras);
    gn_maker_set(&maker, "nodes", json);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
}

/* ---- lights ---- */

static void test_light(void **state) {
    (void)state;
    set_light(
        "{'type':'spot','color':[1,0.5,0],'intensity':10,'range':7,'spot':{'innerConeAngle':0.2,"
        "'outerConeAngle':0.5}}",
        "{}");
    struct gn_scene *scene = load();
    const struct gn_light *light = &scene->lights[0];
    assert_false(scene->added.light);
    assert_string_equal(light->name, "n");
    assert_near(light->color[1], 5);
    assert_near(light->range_m, 7);
    assert_near(light->inner_rad, .2f);
    assert_near(light->radius, .05f);
    assert_near(light->shadow_strength, 1);
    assert_true(light->slide == -1 && light->technique == NULL && light->map_px == 0);
    gn_scene_destroy(scene);
}

static void test_light_repairs(void **state) {
    (void)state;
    set_light("{'type':'spot','intensity':-1,'range':0,'spot':{'innerConeAngle':0.9,'"
              "outerConeAngle':0.5}}",
              "{}");
    struct gn_scene *scene = load();
    assert_true(scene->lights[0].inner_rad < scene->lights[0].outer_rad);
    assert_warned(
        "t: extensions.KHR_lights_punctual.lights[0].spot: innerConeAngle is not between 0 and "
        "outerConeAngle; clamped");
    assert_warned("t: extensions.KHR_lights_punctual.lights[0].range: must be greater than 0; "
                  "taken as unlimited");
    assert_warned(
        "t: extensions.KHR_lights_punctual.lights[0]: negative colour or intensity; taken as 0");
    gn_scene_destroy(scene);
}

static void test_light_order_is_depth_first(void **state) {
    (void)state;
    gn_maker_set(
        &maker, "extensions",
        "{'KHR_lights_punctual':{'lights':[{'type':'point','name':'a'},{'type':'point','name':'b'},"
        "{'type':'point'}]}}");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0},{'extensions':{'KHR_lights_punctual':{'light':2}}},"
                 "{'extensions':{'KHR_lights_punctual':{'light':0}},'children':[3]},"
                 "{'extensions':{'KHR_lights_punctual':{'light':1}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,2,1]}]");
    struct gn_scene *scene = load();
    assert_string_equal(scene->lights[0].name, "a");
    assert_string_equal(scene->lights[1].name, "b");
    assert_string_equal(scene->lights[2].name, "light 2"); /* it has no name, nor has its node */
    gn_scene_destroy(scene);
}

static void test_light_extras(void **state) {
    (void)state;
    set_light(
        "{'type':'spot','extras':{'gnomon_radius':0.3,'gnomon_shadow':'pcss','gnomon_map_px':512}}",
        "{'gnomon_radius':0.7,'gnomon_shadow_strength':0.5,'gnomon_shadow_specular':0.25,'gnomon_"
        "map_px':'big','gnomon_slide':0,'"
        "other':1}");
    struct gn_scene *scene = load();
    assert_near(scene->lights[0].radius, .7f); /* the node wins */
    assert_near(scene->lights[0].shadow_strength, .5f);
    assert_near(scene->lights[0].shadow_specular, .25f);
    assert_string_equal(scene->lights[0].technique, "pcss");
    assert_int_equal(scene->lights[0].map_px, 512);
    assert_warned(
        "t: nodes[1].extras.gnomon_map_px: must be a whole number from 16 to 16384; ignored");
    assert_warned("t: nodes[1].extras: gnomon_slide: the file has no textures; ignored");
    assert_int_equal(warnings.count, 2);
    gn_scene_destroy(scene);
}

/* ---- other extras ---- */

static void test_scene_extras(void **state) {
    (void)state;
    gn_maker_set(&maker, "scenes",
                 "[{'nodes':[0],'extras':{'gnomon_sky':[1,2,3,1],'gnomon_ground':0.5}}]");
    struct gn_scene *scene = load();
    assert_near(scene->environment.sky[2], 3);
    assert_near(scene->environment.ground[0], .5f);
    assert_near(scene->environment.background[1], 1.25f); /* the horizon */
    gn_scene_destroy(scene);
    setup(NULL);
    gn_maker_set(&maker, "scenes",
                 "[{'nodes':[0],'extras':{'gnomon_sky':'blue','gnomon_background':[0,0,1]}}]");
    scene = load();
    assert_near(scene->environment.sky[0], .08f);
    assert_near(scene->environment.background[2], 1);
    assert_warned(
        "t: scenes[0].extras.gnomon_sky: must be a colour: [r, g, b], linear, 0 or more; ignored");
    gn_scene_destroy(scene);
}

static void test_node_extras(void **state) {
    (void)state;
    gn_maker_set(
        &maker, "nodes",
        "[{'mesh':0,'extras':{'gnomon_cast':0,'gnomon_receive':false,'gnomon_cast_faces':'front',"
        "'gnomon_plane':'yes'}}]");
    struct gn_scene *scene = load();
    assert_true(!scene->items[0].casts && !scene->items[0].receives);
    assert_int_equal(scene->items[0].cast_faces, GN_CAST_FRONT);
    assert_warned("t: nodes[0].extras.gnomon_plane: must be true or false; ignored");
    gn_scene_destroy(scene);
}

/* ---- the plane ---- */

static const char *plane_of(const char *nodes, const char *list) {
    static char name[20];
    char json[80];
    setup(NULL);
    gn_maker_set(&maker, "nodes", nodes);
    snprintf(json, sizeof json, "[{'nodes':%s}]", list);
    gn_maker_set(&maker, "scenes", json);
    struct gn_scene *scene = load();
    strcpy(name, "none");
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].plane) strcpy(name, scene->nodes[scene->items[i].node].name);
    gn_scene_destroy(scene);
    return name;
}

static void test_plane(void **state) {
    (void)state;
    gn_maker_finish(&maker);
    assert_string_equal(
        plane_of("[{'mesh':0,'name':'s'},{'mesh':0,'name':'large','scale':[3,1,3]}]", "[0,1]"),
        "large");
    assert_string_equal(plane_of("[{'mesh':0,'name':'s','extras':{'gnomon_plane':true}},"
                                 "{'mesh':0,'name':'large','scale':[3,1,3]}]",
                                 "[0,1]"),
                        "s");
    assert_string_equal(plane_of("[{'mesh':0,'name':'s','extras':{'gnomon_plane':false}}]", "[0]"),
                        "none");
    assert_string_equal(
        plane_of("[{'mesh':0,'name':'a'},{'mesh':0,'name':'b','translation':[9,0,9]}]", "[0,1]"),
        "none");
    assert_string_equal(
        plane_of("[{'mesh':0,'name':'wall','scale':[5,1,5],'rotation':[0.70710678,0,0,0.70710678]},"
                 "{'mesh':0,'name':'s'}]",
                 "[0,1]"),
        "wall");
}

#define NAMED_PLANE "'extras':{'gnomon_plane':true}}"

/* b lies in the plane of a, the ceiling too, from its other side; of five planes the last is
 * ignored. */
static void test_planes_named_apart_are_several(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int plane;
    } expected[] = {{"a", 1},    {"b", 1},     {"ceiling", 1}, {"step", 2},
                    {"wall", 3}, {"shelf", 4}, {"roof", 0}};
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'name':'a'," NAMED_PLANE
                 ",{'mesh':0,'name':'b','translation':[3,0,0]," NAMED_PLANE
                 ",{'mesh':0,'name':'step','translation':[0,1,0]," NAMED_PLANE
                 ",{'mesh':0,'name':'ceiling','rotation':[1,0,0,0]," NAMED_PLANE
                 ",{'mesh':0,'name':'wall','rotation':[0.70710678,0,0,0.70710678]," NAMED_PLANE
                 ",{'mesh':0,'name':'shelf','translation':[0,2,0]," NAMED_PLANE
                 ",{'mesh':0,'name':'roof','translation':[0,3,0]," NAMED_PLANE "]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3,4,5,6]}]");
    struct gn_scene *scene = load();
    for (uint32_t i = 0; i < scene->item_count; i++)
        for (size_t k = 0; k < sizeof expected / sizeof *expected; k++)
            if (!strcmp(scene->nodes[scene->items[i].node].name, expected[k].name))
                assert_int_equal(scene->items[i].plane, expected[k].plane);
    assert_warned("t: gnomon_plane: node 'roof' lies in plane 5, of at most 4; ignored");
    gn_scene_destroy(scene);
}

/* Walls behind and to the left of a floor, one that is too small, and a part of the floor apart; a
 * thing, or none. The sun shines along -Z, as `sun` turns it. */
static void expect_room(const char *thing, const char *sun, const char *expected) {
    char nodes[1500], found[10] = "00000";
    setup(NULL);
    gn_maker_cube(&maker);
    snprintf(nodes, sizeof nodes,
             "[{'mesh':0,'name':'0','scale':[5,1,5]},"
             "{'mesh':0,'name':'1','translation':[0,2,-4],'scale':[5,1,2],"
             "'rotation':[0.7071068,0,0,0.7071068]},"
             "{'mesh':0,'name':'2','translation':[-4,2,0],'scale':[2,1,5],"
             "'rotation':[0,0,-0.7071068,0.7071068]},"
             "{'mesh':0,'name':'3','translation':[0,1,3],'scale':[1,1,1],"
             "'rotation':[0.7071068,0,0,0.7071068]},"
             "{'mesh':0,'name':'4','translation':[0,0,9],'scale':[4.5,1,4]},"
             "{'rotation':[%s],'extensions':{'KHR_lights_punctual':{'light':0}}}%s]",
             sun, thing);
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(&maker, "scenes",
                 thing[0] ? "[{'nodes':[0,1,2,3,4,5,6]}]" : "[{'nodes':[0,1,2,3,4,5]}]");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional'}]}}");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    struct gn_scene *scene = load();
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const char *name = scene->nodes[scene->items[i].node].name;
        if (name[0]) found[name[0] - '0'] = (char)('0' + scene->items[i].plane);
    }
    assert_string_equal(found, expected);
    assert_false(scene->planes_named);
    gn_scene_destroy(scene);
}

static void test_planes_are_found_where_shadows_fall(void **state) {
    (void)state;
    static const char thing[] = ",{'mesh':1,'translation':[-2.5,1,-2.5],'scale':[0.5,1,0.5]}";
    static const char far_off[] = ",{'mesh':1,'translation':[3,1,4],'scale':[0.5,1,0.5]}";
    static const char aslant[] = "-0.4082123,0.2886933,0.0000000,0.8660363";
    static const char right[] = "-0.4082123,-0.2886933,-0.0000000,0.8660363";
    static const char down[] = "-0.7071068,0,0,0.7071068";
    gn_maker_finish(&maker);
    expect_room(thing, aslant, "12300");
    expect_room(thing, right, "12000"); /* the left wall is not lit */
    expect_room(thing, down, "10000");
    expect_room(far_off, aslant, "10000"); /* its shadow ends on the floor */
    expect_room("", aslant, "10000");
}

/* ---- cameras, and what is made ---- */

static void test_cameras(void **state) {
    (void)state;
    gn_maker_set(&maker, "cameras",
                 "[{'name':'Front','type':'perspective','perspective':{'yfov':0.5,'znear':0.1}},"
                 "{'type':'orthographic','orthographic':{'xmag':-2,'ymag':1,'znear':0,'zfar':10}},"
                 "{'type':'perspective','perspective':{'yfov':0.5,'znear':1,'zfar':0.5}},"
                 "{'type':'perspective','perspective':{'yfov':0.5,'znear':1e20,'zfar':3e38}}]");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0},{'camera':0},{'camera':1,'name':'Top'},{'camera':2},{'camera':3}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3,4]}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->camera_count, 2);
    assert_near(scene->cameras[0].far_m, 0);
    assert_true(scene->cameras[1].orthographic && scene->cameras[1].xmag_m == 2);
    assert_warned("t: cameras[2]: invalid camera: zfar is not beyond znear; ignored");
    assert_warned(
        "t: cameras[3]: invalid camera: its field or near plane is out of range; ignored");
    assert_int_equal(gn_scene_find_camera(scene, "Top", &err), 1);
    assert_int_equal(gn_scene_find_camera(scene, "1", &err), 1);
    assert_int_equal(gn_scene_find_camera(scene, NULL, &err), 0);
    assert_int_equal(gn_scene_find_camera(scene, "Side", &err), -1);
    assert_string_equal(err.text, "no camera named 'Side'; available: 0 'Front', 1 'Top'");
    gn_scene_destroy(scene);
}

/* All corners of the box are in a picture of 16:9, for which the node stands, between near and far.
 */
static void assert_framed(const struct gn_scene *scene) {
    struct gn_pose pose;
    mat4 view;
    const struct gn_camera *camera = &scene->cameras[scene->camera_count - 1];
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    gn_pose_view(&pose, scene->camera_count - 1, view, NULL);
    for (int i = 0; i < 8; i++) {
        vec4 p = {i & 1 ? scene->box.max[0] : scene->box.min[0],
                  i & 2 ? scene->box.max[1] : scene->box.min[1],
                  i & 4 ? scene->box.max[2] : scene->box.min[2], 1};
        glm_mat4_mulv(view, p, p);
        assert_true(-p[2] > camera->near_m && -p[2] < camera->far_m);
        assert_true(fabsf(p[1] / p[2]) < tanf(camera->yfov_rad / 2));
        assert_true(fabsf(p[0] / p[2]) < tanf(camera->yfov_rad / 2) * 16 / 9);
    }
    gn_pose_finish(&pose);
}

static void test_lights_may_stand_aside(void **state) {
    (void)state;
    static const float aside[2][3] = {{1, 2, 3}, {0.75f, 0, 9}}; /* metres; tangents */
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'spot'},{'type':'directional'}]}}");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0},{'translation':[0,4,0],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}},"
                 "{'extensions':{'KHR_lights_punctual':{'light':1}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    struct gn_scene *scene = load();
    struct gn_pose pose;
    vec3 position, direction;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    pose.lights_aside = aside;
    gn_pose_light(&pose, 0, position, direction);
    assert_true(position[0] == 1 && position[1] == 6 && position[2] == 3 && direction[2] == -1);
    gn_pose_light(&pose, 1, position, direction);
    assert_true(position[0] == 0 && position[1] == 0 && position[2] == 0);
    assert_true(fabsf(direction[2] + 0.8f) < 1e-6f && fabsf(glm_vec3_norm(direction) - 1) < 1e-6f);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

static void test_made_camera_and_light(void **state) {
    (void)state;
    static const char child[] =
        "[{'mesh':0,'scale':[0.001,0.001,0.001],'children':[1]},{'mesh':0,'translation':[0,9,0]}]";
    static const char *const nodes[] = {"[{'mesh':0}]", child, "[{'mesh':0,'scale':[0,0,0]}]",
                                        "[{'mesh':0,'scale':[1000,1,1],'translation':[5,6,7]}]"};
    gn_maker_finish(&maker);
    for (size_t i = 0; i < sizeof nodes / sizeof nodes[0]; i++) {
        setup(NULL);
        gn_maker_set(&maker, "nodes", nodes[i]);
        struct gn_scene *scene = load();
        assert_true(scene->added.light && scene->added.camera);
        assert_framed(scene);
        struct gn_pose pose;
        vec3 position, direction;
        gn_pose_init(&pose, scene, GN_POSE_NONE);
        gn_pose_light(&pose, 0, position, direction);
        /* the three sides of a box that the camera sees: lit, each differently */
        assert_true(direction[0] < -.1f && direction[2] < direction[0] - .1f &&
                    direction[1] < direction[2] - .1f);
        gn_pose_finish(&pose);
        gn_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_light, setup),
        cmocka_unit_test_setup(test_light_repairs, setup),
        cmocka_unit_test_setup(test_light_order_is_depth_first, setup),
        cmocka_unit_test_setup(test_light_extras, setup),
        cmocka_unit_test_setup(test_scene_extras, setup),
        cmocka_unit_test_setup(test_node_extras, setup),
        cmocka_unit_test_setup(test_plane, setup),
        cmocka_unit_test_setup(test_planes_are_found_where_shadows_fall, setup),
        cmocka_unit_test_setup(test_planes_named_apart_are_several, setup),
        cmocka_unit_test_setup(test_cameras, setup),
        cmocka_unit_test_setup(test_lights_may_stand_aside, setup),
        cmocka_unit_test_setup(test_made_camera_and_light, setup),
    };
    return RUN(tests);
}
