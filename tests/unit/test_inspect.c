/* What inspect finds in a scene: amounts, bytes, and each fault with its cure. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jansson.h>

#include "cli/inspect.h"
#include "stage/lights.h"
#include "unit/scene_help.h"

static struct gn_scene *scene;
static struct gn_inspection in;

static int teardown(void **state) {
    (void)state;
    gn_scene_destroy(scene);
    scene = NULL;
    return 0;
}

static void inspect(void) {
    scene = gn_maker_load(&maker, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_inspect_build(&in, "t", scene, NULL, &warnings);
}

static json_t *report(void) {
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_true(gn_inspect_print_json(&in, file, &err));
    rewind(file);
    json_t *all = json_loadf(file, 0, NULL);
    fclose(file);
    assert_non_null(all);
    return all;
}

static char *print(void) {
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    gn_inspect_print(&in, file);
    fclose(file);
    return text;
}

static void assert_advice(const char *part) {
    for (uint32_t i = 0; i < in.advice.count; i++)
        if (strstr(in.advice.items[i].what, part)) {
            assert_true(in.advice.items[i].cure[0]);
            return;
        }
    fail_msg("no advice with '%s'", part);
}

static void assert_no_advice(const char *part) {
    for (uint32_t i = 0; i < in.advice.count; i++)
        if (strstr(in.advice.items[i].what, part)) fail_msg("advice '%s'", in.advice.items[i].what);
}

/* Lights, each on a node of its own beside the square; its side in metres. */
static void set_lights(int count, const char *light, float side) {
    char list[4000] = "", nodes[6000], roots[200] = "0";
    snprintf(nodes, sizeof nodes, "[{'mesh':0,'scale':[%g,%g,%g]}", (double)side / 2,
             (double)side / 2, (double)side / 2);
    for (int i = 0; i < count; i++) {
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i ? "," : "", light);
        snprintf(
            nodes + strlen(nodes), sizeof nodes - strlen(nodes),
            ",{'name':'light %d','translation':[0,3,0],'rotation':[-0.70710678,0,0,0.70710678],"
            "'extensions':{'KHR_lights_punctual':{'light':%d}}}",
            i, i);
        snprintf(roots + strlen(roots), sizeof roots - strlen(roots), ",%d", i + 1);
    }
    char json[6000];
    snprintf(json, sizeof json, "{'KHR_lights_punctual':{'lights':[%s]}}", list);
    gn_maker_set(&maker, "extensions", json);
    snprintf(nodes + strlen(nodes), sizeof nodes - strlen(nodes), "]");
    gn_maker_set(&maker, "nodes", nodes);
    snprintf(json, sizeof json, "[{'nodes':[%s]}]", roots);
    gn_maker_set(&maker, "scenes", json);
}

static void set_material(const char *material) {
    gn_maker_add(&maker, "materials", material);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
}

/* ---- amounts ---- */

static void test_a_square_costs_what_it_weighs(void **state) {
    (void)state;
    inspect();
    assert_int_equal(scene->triangle_count, 2);
    assert_int_equal(in.cost.vertex_bytes, (12 + 8) * scene->buffers.vertex_count);
    assert_int_equal(in.cost.index_bytes, 6 * 2);
    assert_int_equal(in.cost.draws, 1);
    assert_int_equal(in.cost.triangles, 2);
    assert_int_equal(in.cost.texture_bytes, 0);
    assert_int_equal(in.cost.target_bytes, 1280 * 720 * (4 + 4));
}

/* 16 x 8, as texture 0. */
static void add_texture(void) {
    uint8_t rgba[16 * 8 * 4];
    memset(rgba, 255, sizeof rgba);
    struct gn_made png = gn_maker_png(16, 8, rgba);
    char json[80];
    snprintf(json, sizeof json, "{'mimeType':'image/png','bufferView':%d}",
             gn_maker_view(&maker, png.data, png.size));
    free(png.data);
    gn_maker_add(&maker, "images", json);
    gn_maker_add(&maker, "textures", "{'source':0}");
}

static void test_a_picture_costs_its_mipmaps_once_a_use(void **state) {
    (void)state;
    add_texture();
    set_material("{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}},"
                 "'occlusionTexture':{'index':0}}");
    inspect();
    assert_int_equal(gn_scene_image_bytes(&scene->pictures.images[0]), 2 * (16 * 8 * 4 * 4 / 3));
    assert_int_equal(in.cost.texture_bytes, gn_scene_image_bytes(&scene->pictures.images[0]));
}

static void test_a_slide_costs_what_a_picture_does(void **state) {
    (void)state;
    add_texture();
    set_lights(1, "{'type':'spot','extras':{'gnomon_slide':0}}", 2);
    inspect();
    assert_int_equal(in.cost.texture_bytes, 16 * 8 * 4 * 4 / 3);
}

/* ---- faults ---- */

static void test_what_the_file_lacks_is_said(void **state) {
    (void)state;
    inspect();
    assert_advice("no light");
    assert_advice("no camera");
    assert_advice("1 mesh has no normals");
}

static void test_faults_of_a_light_are_named(void **state) {
    (void)state;
    set_lights(1,
               "{'type':'spot','intensity':0,'spot':{'outerConeAngle':1.5},'extras':"
               "{'gnomon_map_px':8192,'gnomon_shadow':'velvet'}}",
               2);
    inspect();
    assert_advice("'light 0' is dark");
    assert_advice("opens to 86 degrees");
    assert_advice("a map of 8192 pixels");
    assert_advice("'velvet'");
    assert_no_advice("no light");
}

/* A square counts as 100 triangles; the picture and the sides of a cube draw it seven times. */
static void test_a_light_over_triangles_per_frame_is_named(void **state) {
    (void)state;
    set_lights(1, "{'type':'point','intensity':9}", 2);
    inspect();
    gn_inspect_build(&in, "t", scene, &(struct gn_frame_shadow_opts){.triangles = 700}, &warnings);
    assert_int_equal(in.warnings->count, 0);
    gn_inspect_build(&in, "t", scene, &(struct gn_frame_shadow_opts){.triangles = 699}, &warnings);
    assert_int_equal(in.warnings->count, 1);
    assert_string_equal(in.warnings->text[0], "light 'light 0' casts no shadow: its maps are over "
                                              "the limit triangles_per_frame=699");
}

static void test_a_right_light_gets_no_advice(void **state) {
    (void)state;
    set_lights(1, "{'type':'spot','intensity':50,'spot':{'outerConeAngle':0.7}}", 2);
    inspect();
    assert_no_advice("light");
    assert_no_advice("spot");
}

static void test_too_many_lights_are_counted(void **state) {
    (void)state;
    set_lights(33, "{'type':'directional','intensity':1}", 2);
    inspect();
    assert_advice("33 lights want shadows: the 16 strongest");
    assert_advice("33 lights: the 32 strongest");
    assert_int_equal(in.cost.shadow_passes, 16);
}

static void test_a_map_of_a_point_light_has_six_tiles(void **state) {
    (void)state;
    set_lights(2, "{'type':'point','intensity':9,'extras':{'gnomon_map_px':2048}}", 2);
    inspect();
    assert_advice("'light 0' asks for a map of 2048 pixels");
    assert_no_advice("casts no shadow");
    assert_int_equal(in.cost.shadow_passes, 2 * 6);
    assert_int_equal(in.cost.map_bytes, 2 * 6 * 2048 * 2048 * 4);
}

static void test_millimetres_are_noticed(void **state) {
    (void)state;
    set_lights(1, "{'type':'directional'}", 9000);
    inspect();
    assert_advice("m across: shadow maps");
}

static void test_a_doll_house_is_noticed(void **state) {
    (void)state;
    set_lights(1, "{'type':'directional'}", 0.01f);
    inspect();
    assert_advice("only 0.0141 m across");
}

static void test_a_deep_camera_is_noticed(void **state) {
    (void)state;
    gn_maker_add(&maker, "cameras",
                 "{'type':'perspective','perspective':{'yfov':1,'znear':0.0001,'zfar':1000}}");
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':1,'scale':[20,20,20]},{'name':'eye','camera':0,'translation':[0,0,5]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    inspect();
    assert_advice("'eye' sees from 0.0001 to 1000 m");
    assert_no_advice("no camera");
}

/* With a floor where the scene has none. */
static void inspect_on_floor(void) {
    const struct gn_scene_limits limits = {.floor = {.kind = GN_FLOOR_AUTO}};
    struct gn_made glb = gn_maker_glb(&maker);
    scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    free(glb.data);
    gn_maker_finish(&maker);
    if (!scene) fail_msg("%s", err.text);
    gn_inspect_build(&in, "t", scene, NULL, &warnings);
}

/* A cube of 2 m, through one camera or two of the same kind, the first of them named. */
static void inspect_through(const char *cameras) {
    char json[400];
    gn_maker_add(&maker, "cameras",
                 "{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'zfar':100}}");
    gn_maker_cube(&maker);
    snprintf(json, sizeof json, "[{'mesh':1},%s]", cameras);
    gn_maker_set(&maker, "nodes", json);
    gn_maker_set(&maker, "scenes",
                 strstr(cameras, "},{") ? "[{'nodes':[0,1,2]}]" : "[{'nodes':[0,1]}]");
    inspect_on_floor();
}

static void test_a_camera_that_misses_the_model_is_noticed(void **state) {
    (void)state;
    inspect_through("{'name':'eye','camera':0,'translation':[0,1,-9]}");
    assert_advice("camera 'eye' sees 0 % of the model");
    assert_no_advice("no camera");
}

static void test_a_camera_that_cuts_the_model_is_noticed(void **state) {
    (void)state;
    inspect_through("{'name':'eye','camera':0,'translation':[1,0.5,2.5]}");
    assert_advice("camera 'eye' cuts the model");
}

static void test_cameras_that_show_it_and_details_are_no_fault(void **state) {
    (void)state;
    inspect_through("{'name':'eye','camera':0,'translation':[0,1,9]}");
    assert_no_advice("camera 'eye'");
    teardown(NULL);
    setup(NULL);
    inspect_through("{'name':'eye','camera':0,'translation':[1,0.5,2.5]},"
                    "{'camera':0,'translation':[0,1,9]}");
    assert_no_advice("camera 'eye'");
}

static void test_a_camera_over_a_ground_of_the_file_is_no_fault(void **state) {
    (void)state;
    inspect_through("{'name':'eye','camera':0,'translation':[0,1,-9]},"
                    "{'mesh':1,'scale':[5,0.05,5],'translation':[0,-1,0]}");
    assert_false(scene->added.floor);
    assert_int_equal(scene->camera_count, 1);
    assert_no_advice("camera 'eye'");
}

static void test_a_mask_without_holes_is_noticed(void **state) {
    (void)state;
    set_material("{'name':'wall','alphaMode':'MASK'}");
    inspect();
    assert_advice("material 'wall' is masked, but nothing");
}

static void test_blend_without_transparency_is_opaque(void **state) {
    (void)state;
    set_material("{'name':'wall','alphaMode':'BLEND'}");
    inspect();
    assert_int_equal(scene->materials[0].alpha, GN_ALPHA_OPAQUE);
    assert_no_advice("casts no shadow");
}

static void test_glass_is_not_called_opaque(void **state) {
    (void)state;
    set_material("{'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.5]}}");
    inspect();
    assert_no_advice("nothing of it is transparent");
}

static void test_the_unseen_floor_is_nobodys_fault(void **state) {
    (void)state;
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'rotation':[0.5,0,0,0.8660254]}]");
    inspect_on_floor();
    assert_true(scene->added.floor);
    assert_no_advice("'floor'");

    /* nor does what is made count as the file's */
    static const char *const counts[] = {"nodes", "items", "batches", "geometries", NULL};
    json_t *all = report(), *of = json_object_get(all, "counts");
    for (int i = 0; counts[i]; i++)
        assert_int_equal(json_integer_value(json_object_get(of, counts[i])), 1);
    assert_int_equal(json_integer_value(json_object_get(of, "vertices")), 4);
    assert_int_equal(json_integer_value(json_object_get(of, "triangles")), 2);
    assert_int_equal(json_integer_value(json_object_get(of, "textures")), 0);
    assert_int_equal(json_array_size(json_object_get(all, "images")), 0);
    of = json_object_get(all, "materials");
    assert_int_equal(json_integer_value(json_object_get(of, "blend")), 0);
    assert_int_equal(json_integer_value(json_object_get(of, "count")), 1);
    assert_true(json_is_true(json_object_get(all, "floor_made")));
    json_decref(all);
    char *text = print();
    assert_non_null(strstr(text, "1 geometries, 4 vertices, 2 triangles in all items"));
    assert_non_null(strstr(text, "materials   1: 1 opaque, 0 mask, 0 blend"));
    assert_non_null(strstr(text, "floor       unseen"));
    assert_null(strstr(text, "Textures"));
    free(text);
}

/* ---- the report ---- */

static void test_json_has_its_fields(void **state) {
    (void)state;
    static const char *const fields[] = {
        "file",      "name",    "size_m",   "counts",           "materials",  "images",
        "lights",    "cameras", "clips",    "variants",         "hemisphere", "cost",
        "limits",    "missing", "warnings", "warnings_dropped", "advice",     "advice_dropped",
        "floor_made"};
    set_lights(1, "{'type':'spot','intensity':50}", 2);
    inspect();
    json_t *all = report();
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        if (!json_object_get(all, fields[i])) fail_msg("no %s", fields[i]);
    assert_int_equal(json_object_size(all), sizeof fields / sizeof *fields);
    json_t *light = json_array_get(json_object_get(all, "lights"), 0);
    assert_string_equal(json_string_value(json_object_get(light, "type")), "spot");
    assert_string_equal(json_string_value(json_object_get(light, "unit")), "candela");
    assert_true(json_real_value(json_object_get(light, "intensity")) == 50);
    json_decref(all);
}

/* A made light shines as its environment has it, until the configuration says otherwise. */
static void test_a_made_light_is_printed_as_it_is_used(void **state) {
    (void)state;
    inspect();
    char *text = print();
    assert_non_null(strstr(text, "2.8 lux, shadow cone, radius 0.00465"));
    free(text);
    struct gn_frame_shadow_opts lights = {0};
    gn_stage_set_key(&lights, scene,
                     &(struct gn_environment_key){.color = {1, .5f, .25f}, .radius = .24f}, 2);
    gn_inspect_build(&in, "t", scene, &lights, &warnings);
    text = print();
    assert_non_null(strstr(text, "2 lux, shadow cone, radius 0.24"));
    free(text);
    json_t *all = report(), *light = json_array_get(json_object_get(all, "lights"), 0);
    assert_float_equal(json_real_value(json_object_get(light, "gnomon_radius")), .24, 1e-6);
    assert_float_equal(json_real_value(json_array_get(json_object_get(light, "color"), 1)), .5,
                       1e-6);
    json_decref(all);
}

static void test_a_light_of_the_file_is_printed_as_it_is_there(void **state) {
    (void)state;
    set_lights(1, "{'type':'directional','intensity':1}", 2);
    inspect();
    char *text = print();
    assert_non_null(strstr(text, "1 lux, shadow by mode, radius 0.00465"));
    free(text);
}

static void test_a_near_plane_that_goes_out_is_named(void **state) {
    (void)state;
    char *text = NULL;
    size_t size;
    gn_maker_add(&maker, "cameras",
                 "{'type':'perspective','perspective':{'yfov':1,'znear':0.0001,'zfar':1000}}");
    gn_maker_set(&maker, "nodes", "[{'mesh':0},{'name':'eye','camera':0,'translation':[0,0,5]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    inspect();
    assert_no_advice("far surfaces may flicker");
    FILE *file = open_memstream(&text, &size);
    gn_inspect_print(&in, file);
    fclose(file);
    assert_non_null(strstr(text, "from 0.0001 m to 1000 m, near plane at 3.277 m: nothing is"));
    free(text);
    json_t *all = report(), *camera = json_array_get(json_object_get(all, "cameras"), 0);
    const double near_m = json_real_value(json_object_get(camera, "drawn_near_m"));
    assert_true(near_m > 2.5 && near_m < 5);
    assert_true(json_real_value(json_object_get(camera, "near_m")) < 1.1e-4);
    json_decref(all);
}

static void test_warnings_stand_in_the_report(void **state) {
    (void)state;
    gn_warn(&warnings, "t: something was odd");
    inspect();
    json_t *all = report();
    json_t *list = json_object_get(all, "warnings");
    assert_string_equal(json_string_value(json_array_get(list, 0)), "t: something was odd");
    json_decref(all);
}

static void test_text_moves_no_cursor(void **state) {
    (void)state;
    set_material("{'name':'a\\u001b[2J\\u202eb','alphaMode':'MASK'}");
    inspect();
    char *text = print();
    for (const char *c = text; *c; c++) assert_true(*c == '\n' || (*c >= ' ' && *c < 0x7f));
    assert_non_null(strstr(text, "a\\u001b[2J\\u202eb"));
    assert_non_null(strstr(text, "2 triangles"));
    free(text);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_a_square_costs_what_it_weighs),
        TEST(test_a_picture_costs_its_mipmaps_once_a_use),
        TEST(test_a_slide_costs_what_a_picture_does),
        TEST(test_what_the_file_lacks_is_said),
        TEST(test_faults_of_a_light_are_named),
        TEST(test_a_light_over_triangles_per_frame_is_named),
        TEST(test_a_right_light_gets_no_advice),
        TEST(test_too_many_lights_are_counted),
        TEST(test_a_map_of_a_point_light_has_six_tiles),
        TEST(test_millimetres_are_noticed),
        TEST(test_a_doll_house_is_noticed),
        TEST(test_a_deep_camera_is_noticed),
        TEST(test_a_camera_that_misses_the_model_is_noticed),
        TEST(test_a_camera_that_cuts_the_model_is_noticed),
        TEST(test_cameras_that_show_it_and_details_are_no_fault),
        TEST(test_a_camera_over_a_ground_of_the_file_is_no_fault),
        TEST(test_a_near_plane_that_goes_out_is_named),
        TEST(test_a_mask_without_holes_is_noticed),
        TEST(test_blend_without_transparency_is_opaque),
        TEST(test_glass_is_not_called_opaque),
        TEST(test_the_unseen_floor_is_nobodys_fault),
        TEST(test_json_has_its_fields),
        TEST(test_a_made_light_is_printed_as_it_is_used),
        TEST(test_a_light_of_the_file_is_printed_as_it_is_there),
        TEST(test_warnings_stand_in_the_report),
        TEST(test_text_moves_no_cursor),
    };
    return RUN(tests);
}
