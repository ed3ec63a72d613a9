/* glTF files whose meshes are compressed by Draco, through gnomon-import into a scene. Skipped (77)
 * where that program was not built. */
#include "check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draco_help.h"
#include "import_help.h"
#include "stage/stage.h"

static struct gn_maker maker;
static const struct gn_scene_limits limits;

static struct gn_scene *read_scene(const char *name, struct gn_err *err) {
    struct gn_warnings warnings = {0};
    struct gn_scene *scene = gn_stage_read(help_import_path(name), &limits, &warnings, err);
    if (!scene && strstr(err->text, "built without libdraco")) skip();
    if (scene) assert_int_equal(warnings.count, 0);
    return scene;
}

static void expect_square(const char *name) {
    struct gn_err err = {0};
    struct gn_scene *scene = read_scene(name, &err);
    if (!scene) fail_msg("%s", err.text);
    assert_int_equal(scene->geometries[0].index_count, 6);
    const struct gn_box *box = &scene->geometries[0].box;
    for (int i = 0; i < 3; i++) {
        help_import_near(box->min[i], i == 1 ? 0 : -1);
        help_import_near(box->max[i], i == 1 ? 0 : 1);
    }
    for (uint32_t i = 0; i < scene->buffers.vertex_count; i++)
        assert_true(scene->buffers.normals[3 * i + 1] > 0.99f);
    gn_scene_destroy(scene);
}

static void put_glb(const char *name) {
    struct gn_made glb = gn_maker_glb(&maker);
    help_import_put_bytes(name, glb.data, glb.size);
    free(glb.data);
    gn_maker_finish(&maker);
}

static void test_a_glb_that_requires_draco_is_shown(void **state) {
    (void)state;
    gn_maker_init(&maker);
    gn_maker_draco(&maker, true);
    put_glb("a.glb");
    expect_square("a.glb");
}

static void test_so_is_one_that_only_uses_it(void **state) {
    (void)state;
    gn_maker_init(&maker);
    gn_maker_draco(&maker, false);
    put_glb("a.glb");
    expect_square("a.glb");
}

static void test_a_gltf_with_a_data_uri(void **state) {
    (void)state;
    gn_maker_init(&maker);
    gn_maker_draco(&maker, true);
    struct gn_made gltf = gn_maker_gltf(&maker);
    help_import_put_bytes("a.gltf", gltf.data, gltf.size);
    free(gltf.data);
    gn_maker_finish(&maker);
    expect_square("a.gltf");
}

static void test_a_gltf_beside_its_buffer_and_picture(void **state) {
    (void)state;
    gn_maker_init(&maker);
    gn_maker_draco(&maker, true);
    gn_maker_set(&maker, "images", "[{'uri':'a%20b.png'}]");
    gn_maker_set(&maker, "textures", "[{'source':0}]");
    gn_maker_set(&maker, "materials", "[{'emissiveTexture':{'index':0},'emissiveFactor':[1,1,1]}]");
    help_import_put_picture("a b.png", 255, 255, 255, 255);
    json_t *primitive = json_array_get(
        json_object_get(json_array_get(json_object_get(maker.root, "meshes"), 0), "primitives"), 0);
    json_object_set_new(primitive, "material", json_integer(0));
    help_import_put_bytes("a b.bin", maker.bin, maker.size);
    char json[80];
    snprintf(json, sizeof json, "[{'uri':'a%%20b.bin','byteLength':%zu}]", maker.size);
    gn_maker_set(&maker, "buffers", json);
    char *text = json_dumps(maker.root, 0);
    help_import_put("a.gltf", text);
    free(text);
    gn_maker_finish(&maker);
    expect_square("a.gltf");
    struct gn_err err = {0};
    struct gn_scene *scene = read_scene("a.gltf", &err);
    assert_int_equal(scene->pictures.image_count, 1);
    gn_scene_destroy(scene);
}

static void expect_refused(const char *why) {
    put_glb("a.glb");
    struct gn_err err = {0};
    assert_null(read_scene("a.glb", &err));
    if (!strstr(err.text, why)) fail_msg("'%s', not '%s'", err.text, why);
    gn_maker_init(&maker);
    gn_maker_draco(&maker, true);
}

static json_t *compressed_of(void) {
    json_t *primitive = json_array_get(
        json_object_get(json_array_get(json_object_get(maker.root, "meshes"), 0), "primitives"), 0);
    return json_object_get(json_object_get(primitive, "extensions"), "KHR_draco_mesh_compression");
}

static void test_bad_data_is_refused_by_one_line(void **state) {
    (void)state;
    gn_maker_init(&maker);
    gn_maker_draco(&maker, true);
    maker.bin[0] = 'X';
    expect_refused("a.glb: meshes[0]: the Draco-compressed data is damaged");
    json_object_set_new(compressed_of(), "bufferView", json_integer(9));
    expect_refused("a.glb: meshes[0]: no Draco-compressed data");
    json_object_set_new(json_object_get(compressed_of(), "attributes"), "NORMAL", json_integer(7));
    expect_refused("a.glb: meshes[0]: an attribute is not in the Draco-compressed data");
    json_object_set_new(json_object_get(compressed_of(), "attributes"), "COLOR_0", json_integer(0));
    expect_refused("a.glb: meshes[0]: an attribute is not in the Draco-compressed data");
    gn_maker_finish(&maker);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_glb_that_requires_draco_is_shown),
        cmocka_unit_test(test_so_is_one_that_only_uses_it),
        cmocka_unit_test(test_a_gltf_with_a_data_uri),
        cmocka_unit_test(test_a_gltf_beside_its_buffer_and_picture),
        cmocka_unit_test(test_bad_data_is_refused_by_one_line),
    };
    return help_import_run(tests, sizeof tests / sizeof tests[0]);
}
