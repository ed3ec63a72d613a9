/* glTF files whose meshes are compressed by Draco, through gnomon-import into a scene. Skipped (77)
 * where that program was not built. */
#include "check.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/hash.h"
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
    json_t *ids = json_object_get(compressed_of(), "attributes");
    json_object_set_new(ids, "POSITION", json_integer(7));
    expect_refused("a.glb: meshes[0]: POSITION is not in the Draco-compressed data");
    gn_maker_finish(&maker);
}

/* An id that the data has not, one that is no number, and an attribute without an accessor. */
static void test_an_attribute_that_draco_lacks_is_left_out(void **state) {
    (void)state;
    static const struct {
        const char *name, *id;
    } cases[] = {{"NORMAL", "7"}, {"NORMAL", "null"}, {"COLOR_0", "0"}};
    for (int i = 0; i < 3; i++) {
        struct gn_err err = {0};
        struct gn_warnings warnings = {0};
        char said[120];
        gn_maker_init(&maker);
        gn_maker_draco(&maker, true);
        json_object_set_new(json_object_get(compressed_of(), "attributes"), cases[i].name,
                            json_loads(cases[i].id, JSON_DECODE_ANY, NULL));
        put_glb("a.glb");
        struct gn_scene *scene = gn_stage_read(help_import_path("a.glb"), &limits, &warnings, &err);
        if (!scene) fail_msg("%s", err.text);
        snprintf(said, sizeof said,
                 "a.glb: meshes[0]: %s is not in the Draco-compressed data; shown without it",
                 cases[i].name);
        assert_int_equal(warnings.count, 1);
        if (!strstr(warnings.text[0], said)) fail_msg("'%s'", warnings.text[0]);
        assert_int_equal(scene->geometries[0].index_count, 6);
        assert_true(scene->buffers.normals[1] > .99f); /* of the faces */
        gn_scene_destroy(scene);
    }
}

/* ---- what is kept ---- */

static char kept_path[600];

/* How many files are kept; kept_path becomes that of one. */
static int count_kept(void) {
    char pattern[300];
    glob_t found;
    snprintf(pattern, sizeof pattern, "%s/cache/gnomon/draco-*.glb", help_import_folder());
    const int status = glob(pattern, 0, NULL, &found);
    const int count = status == 0 ? (int)found.gl_pathc : 0;
    if (count) snprintf(kept_path, sizeof kept_path, "%s", found.gl_pathv[0]);
    if (status == 0) globfree(&found);
    return count;
}

/* Its nodes tell two scenes apart. */
static void put_square(const char *name, const char *nodes) {
    gn_maker_init(&maker);
    gn_maker_draco(&maker, true);
    gn_maker_set(&maker, "nodes", nodes);
    put_glb(name);
}

static uint32_t nodes_of(const char *name) {
    struct gn_err err = {0};
    struct gn_scene *scene = read_scene(name, &err);
    if (!scene) fail_msg("%s", err.text);
    const uint32_t count = scene->node_count;
    gn_scene_destroy(scene);
    return count;
}

/* Of its vertices. */
static uint64_t hash_of(const char *name) {
    struct gn_err err = {0};
    struct gn_scene *scene = read_scene(name, &err);
    if (!scene) fail_msg("%s", err.text);
    const struct gn_scene_buffers *b = &scene->buffers;
    const size_t bytes = b->vertex_count * 3 * sizeof *b->positions;
    const uint64_t hash = gn_hash(gn_hash(GN_HASH_INIT, b->positions, bytes), b->normals, bytes);
    gn_scene_destroy(scene);
    return hash;
}

static void begin_cache(const char *folder) {
    char path[300];
    snprintf(path, sizeof path, "%s%s", folder ? help_import_folder() : "",
             folder ? folder : "/dev/null");
    setenv("XDG_CACHE_HOME", path, 1);
    unsetenv("CACHE_DIRECTORY");
}

static void test_an_output_is_kept_by_the_content_of_its_file(void **state) {
    (void)state;
    begin_cache("/cache");
    put_square("one.glb", "[{'mesh':0}]");
    const uint32_t one = nodes_of("one.glb");
    assert_int_equal(count_kept(), 1);
    char of_one[600];
    snprintf(of_one, sizeof of_one, "%s", kept_path);
    put_square("two.glb", "[{'mesh':0},{},{}]");
    const uint32_t two = nodes_of("two.glb");
    assert_int_equal(two, one + 2);
    assert_int_equal(count_kept(), 2);
    nodes_of("two.glb");
    assert_int_equal(count_kept(), 2);

    /* what is read is the kept file: here that of another */
    glob_t found;
    char pattern[300];
    snprintf(pattern, sizeof pattern, "%s/cache/gnomon/draco-*.glb", help_import_folder());
    assert_int_equal(glob(pattern, 0, NULL, &found), 0);
    const char *of_two = found.gl_pathv[strcmp(found.gl_pathv[0], of_one) == 0];
    assert_int_equal(rename(of_two, of_one), 0);
    globfree(&found);
    assert_int_equal(nodes_of("one.glb"), two);
}

static void test_a_damaged_kept_file_is_made_again(void **state) {
    (void)state;
    begin_cache("/cache");
    put_square("three.glb", "[{'mesh':0},{},{},{}]");
    while (count_kept()) remove(kept_path);
    nodes_of("three.glb");
    const uint64_t whole = hash_of("three.glb");
    assert_int_equal(count_kept(), 1);
    struct stat info;
    assert_int_equal(stat(kept_path, &info), 0);
    for (long at = 0; at < info.st_size; at += 53) {
        FILE *file = fopen(kept_path, "r+b");
        fseek(file, at, SEEK_SET);
        const int byte = fgetc(file);
        fseek(file, at, SEEK_SET);
        fputc(byte ^ 0x40, file);
        fclose(file);
        assert_true(hash_of("three.glb") == whole);
    }
    for (int i = 0; i < 12; i += 4) {
        assert_int_equal(truncate(kept_path, i), 0);
        assert_true(hash_of("three.glb") == whole);
    }
}

static void test_without_a_folder_nothing_is_kept(void **state) {
    (void)state;
    begin_cache(NULL);
    put_square("four.glb", "[{'mesh':0}]");
    nodes_of("four.glb");
    begin_cache("/cache");
    while (count_kept()) remove(kept_path);
    gn_maker_init(&maker); /* another file may change what this one shows */
    gn_maker_draco(&maker, true);
    gn_maker_set(&maker, "images", "[{'uri':'absent.png'}]");
    put_glb("five.glb");
    nodes_of("five.glb");
    assert_int_equal(count_kept(), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_glb_that_requires_draco_is_shown),
        cmocka_unit_test(test_so_is_one_that_only_uses_it),
        cmocka_unit_test(test_a_gltf_with_a_data_uri),
        cmocka_unit_test(test_a_gltf_beside_its_buffer_and_picture),
        cmocka_unit_test(test_bad_data_is_refused_by_one_line),
        cmocka_unit_test(test_an_attribute_that_draco_lacks_is_left_out),
        cmocka_unit_test(test_an_output_is_kept_by_the_content_of_its_file),
        cmocka_unit_test(test_a_damaged_kept_file_is_made_again),
        cmocka_unit_test(test_without_a_folder_nothing_is_kept),
    };
    return help_import_run(tests, sizeof tests / sizeof tests[0]);
}
