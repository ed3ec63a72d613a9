/* Containers, JSON, buffers, URIs, versions, limits: what comes in, and what is said about it when
 * it cannot. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"
#include "core/memory.h"
#include "gltf_maker.h"
#include "scene/scene.h"
#include "unit/check.h"

static struct gn_err err;
static struct gn_warnings warnings;

static int reset(void **state) {
    (void)state;
    memset(&err, 0, sizeof err);
    memset(&warnings, 0, sizeof warnings);
    return 0;
}

static void refuse_bytes(const void *data, size_t size, const char *message) {
    reset(NULL);
    assert_null(gn_scene_load_bytes("t", data, size, NULL, NULL, &err));
    assert_string_equal(err.text, message);
    assert_int_equal(err.status, GN_EXIT_RUNTIME);
}

static void refuse_text(const char *text, const char *message) {
    refuse_bytes(text, strlen(text), message);
}

/* ---- containers ---- */

static void test_not_gltf(void **state) {
    (void)state;
    refuse_bytes("", 0, "t: byte 0: the file is empty");
    refuse_text("  hello",
                "t: byte 2: neither .glb ('glTF') nor .gltf ('{'); what can be read is .glb and "
                ".gltf, and .obj .fbx .stl .ply .dae through gnomon-import: export it as .glb");
    refuse_text("BLENDER-v400",
                "t: a Blender file; what can be read is .glb and .gltf, and .obj .fbx .stl .ply "
                ".dae through gnomon-import: open it in Blender and choose File > Export > glTF "
                "2.0, format .glb");
    refuse_text("#usda 1.0", "t: USD; what can be read is .glb and .gltf, and .obj .fbx .stl .ply "
                             ".dae through gnomon-import: import it into Blender and export glTF "
                             "2.0 (.glb)");
    refuse_text("glTF", "t: byte 4: the file ends within the .glb header");
    refuse_text("{\"a\":[}", "t: byte 7 (line 1): JSON: unexpected token near '}'");
    refuse_text("{\"a\":\"\xff\"}",
                "t: byte 6 (line 1): JSON: unable to decode byte 0xff near '\"'");
}

static struct gn_made square_glb(void) {
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    struct gn_made made = gn_maker_glb(&maker);
    gn_maker_finish(&maker);
    return made;
}

static void refuse_changed(size_t at, uint8_t value, const char *message) {
    struct gn_made made = square_glb();
    made.data[at] = value;
    refuse_bytes(made.data, made.size, message);
    free(made.data);
}

static void test_glb_header(void **state) {
    (void)state;
    struct gn_made made = square_glb();
    char message[160];
    snprintf(message, sizeof message,
             "t: byte 8: length %zu, but the file has %zu bytes: it is truncated, copy it again",
             made.size, made.size - 1);
    refuse_bytes(made.data, made.size - 1, message);
    free(made.data);
    refuse_changed(
        4, 1, "t: byte 4: .glb version 1; only version 2 is read: export it again as glTF 2.0");
    refuse_changed(16, 'X', "t: byte 16: the first chunk must be JSON");
    refuse_changed(15, 1, "t: byte 12: a chunk of 16777692 bytes, but 544 are left");
}

static void test_a_cancelled_load_fails(void **state) {
    (void)state;
    static atomic_bool cancel;
    const struct gn_scene_limits limits = {.cancel = &cancel};
    struct gn_scene *scene = gn_scene_load("assets/bench/s1.glb", &limits, &warnings, &err);
    assert_non_null(scene);
    gn_scene_destroy(scene);
    cancel = true;
    assert_null(gn_scene_load("assets/bench/s1.glb", &limits, &warnings, &err));
    assert_string_equal(err.text, "assets/bench/s1.glb: no longer wanted");
}

static void test_trailing_data_is_a_warning(void **state) {
    (void)state;
    struct gn_made made = square_glb();
    made.data = realloc(made.data, made.size + 5);
    memset(made.data + made.size, 7, 5);
    struct gn_scene *scene =
        gn_scene_load_bytes("t", made.data, made.size + 5, NULL, &warnings, &err);
    assert_non_null(scene);
    assert_string_equal(warnings.text[0], "t: 5 bytes after the end ignored");
    gn_scene_destroy(scene);
    free(made.data);
}

static void test_gltf_with_bom_and_data_uri(void **state) {
    (void)state;
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    struct gn_made made = gn_maker_gltf(&maker);
    char *text = malloc(made.size + 3);
    memcpy(text, "\xef\xbb\xbf", 3);
    memcpy(text + 3, made.data, made.size);
    struct gn_scene *scene = gn_scene_load_bytes("t", text, made.size + 3, NULL, NULL, &err);
    assert_non_null(scene);
    assert_int_equal(scene->triangle_count, 2);
    gn_scene_destroy(scene);
    free(text);
    free(made.data);
    gn_maker_finish(&maker);
}

/* ---- JSON ---- */

static void refuse_key(const char *key, const char *json, const char *message) {
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, key, json);
    reset(NULL);
    assert_null(gn_maker_load(&maker, &warnings, &err));
    assert_string_equal(err.text, message);
}

static void test_wrong_json(void **state) {
    (void)state;
    static const struct {
        const char *key, *json, *message;
    } refused[] = {
        {"asset", "{}", "t: asset.version: missing; only glTF 2.0 is read"},
        {"asset", "{'version':'1.0'}",
         "t: asset.version: '1.0'; only glTF 2.0 is read: export it again"},
        {"asset", "{'version':'2.1','minVersion':'2.1'}",
         "t: asset.minVersion: '2.1'; only glTF 2.0 is read"},
        {"extensionsRequired", "['KHR_draco_mesh_compression']",
         "t: extensionsRequired[0]: KHR_draco_mesh_compression is not supported; decompress it "
         "first "
         "(gltf-transform can)"},
        {"extensionsRequired", "['EXT_x']",
         "t: extensionsRequired[0]: EXT_x is not supported; export the scene without it"},
        {"nodes", "{}", "t: nodes: must be an array, is an object"},
        {"nodes", "[7]", "t: nodes[0]: must be an object, is a number"},
        {"nodes", "[{'mesh':9}]", "t: nodes[0].mesh: index 9, but there are 1 meshes"},
        {"nodes", "[{'mesh':-1}]", "t: nodes[0].mesh: index -1, but there are 1 meshes"},
        {"nodes", "[{'mesh':0.5}]", "t: nodes[0].mesh: must be an index, is 0.5"},
        {"nodes", "[{'mesh':'0'}]", "t: nodes[0].mesh: must be an index, is a string"},
        {"nodes", "[]", "t: scenes[0].nodes[0]: index 0, but there are 0 nodes"},
        {"scenes", "[{}]", "t: scenes[0]: the scene is empty: there is no node"},
        {"meshes", "[{'primitives':[{'attributes':{'POSITION':0},'mode':1}]}]",
         "t: nodes: the scene is empty: no node of it has a mesh with triangles"},
        {"meshes", "[{'primitives':[{'attributes':{'POSITION':0},'mode':7}]}]",
         "t: meshes[0].primitives[0].mode: 7 is not in 0..6"},
        {"meshes", "[{'primitives':[{'attributes':{'POSITION':1}}]}]",
         "t: meshes[0].primitives[0].attributes.POSITION: accessor 1 has 1 components, "
         "must be VEC3"},
        {"meshes", "[{'primitives':[{'attributes':{'POSITION':0},'indices':0}]}]",
         "t: meshes[0].primitives[0].indices: must be SCALAR of unsigned bytes, shorts or ints"},
        {"bufferViews", "[{'buffer':0,'byteLength':48,'byteOffset':4611686018427387904}]",
         "t: bufferViews[0]: byteOffset 4611686018427387904 + byteLength 48 passes the end of "
         "buffer 0 (60 bytes)"},
        {"accessors",
         "[{'componentType':5126,'type':'VEC3','count':4611686018427387904,'bufferView':0}]",
         "t: meshes[0].primitives[0].indices: index 1, but there are 1 accessors"},
        {"accessors",
         "[{'componentType':5126,'type':'VEC3','count':4611686018427387904,'bufferView':0},{}]",
         "t: accessors[0]: 4611686018427387904 elements from byte 0 pass the end of bufferView "
         "0 (48 bytes)"},
        {"accessors", "[{'componentType':5126,'type':'VEC3','count':1099511627776},{}]",
         "t: accessors[0].count: 1099511627776 is more than the limit vertices=20000000"},
        {"accessors", "[{'componentType':5124,'type':'VEC3','count':4},{}]",
         "t: accessors[0].componentType: 5124 is none of 5120-5123, 5125, 5126"},
        {"accessors", "[{'componentType':5126,'type':'VEC5','count':4},{}]",
         "t: accessors[0].type: 'VEC5' is none of SCALAR, VEC2-4, MAT2-4"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++)
        refuse_key(refused[i].key, refused[i].json, refused[i].message);
}

static void test_integral_reals_are_integers(void **state) {
    (void)state;
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "nodes", "[{'mesh':0.0}]");
    gn_maker_set(&maker, "scene", "0.0");
    struct gn_scene *scene = gn_maker_load(&maker, NULL, &err);
    assert_non_null(scene);
    gn_scene_destroy(scene);
}

/* A square in a scene whose extras are {key: value}; what jansson cannot write may be in both. */
static struct gn_scene *load_with_extra(const char *key, const char *value) {
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0],'extras':{'@':0}}]");
    struct gn_made made = gn_maker_gltf(&maker);
    char *text = malloc(made.size + strlen(key) + strlen(value) + 1);
    const char *at = strstr((const char *)made.data, "\"@\"");
    const int before = (int)(at - (const char *)made.data), after = before + (int)strlen("'@':0");
    const int size = sprintf(text, "%.*s\"%s\":%s%.*s", before, (const char *)made.data, key, value,
                             (int)made.size - after, (const char *)made.data + after);
    reset(NULL);
    struct gn_scene *scene = gn_scene_load_bytes("t", text, (size_t)size, NULL, &warnings, &err);
    free(text);
    free(made.data);
    gn_maker_finish(&maker);
    return scene;
}

static void test_extras_may_have_any_number_and_any_escape(void **state) {
    (void)state;
    static const char *const values[] = {
        "18446744073709551615",
        "-99999999999999999999",
        "1e400",
        "[-1E+400]",
        "123.5e99999999999",
        "0.0000001e99999",
        "0e99999999",
        "1e-99999",
        "9.99e307",
        "\"a\\u0000b\"",
        "\"\\ud800\"",
        "\"\\udc00\\ud800x\"",
        "{\"a\\u0000b\":1}",
        "\"\\\\u0000 1e400\"",
        "\"\\uD83D\\uDE00\"",
    };
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        struct gn_scene *scene = load_with_extra("x", values[i]);
        if (!scene || warnings.count > 0)
            fail_msg("%s: %s", values[i], scene ? warnings.text[0] : err.text);
        gn_scene_destroy(scene);
    }
    struct gn_scene *scene = load_with_extra("a\\u0000b", "1");
    assert_non_null(scene);
    gn_scene_destroy(scene);
    assert_null(load_with_extra("x", "1e400x"));
    assert_null(load_with_extra("x", "\"\\u000g\""));
}

static void test_numbers_beyond_a_double_are_no_values(void **state) {
    (void)state;
    gn_scene_destroy(load_with_extra("gnomon_sky", "1e400"));
    assert_string_equal(warnings.text[0], "t: scenes[0].extras.gnomon_sky: must be a colour: "
                                          "[r, g, b], linear, 0 or more; ignored");
    gn_scene_destroy(load_with_extra("gnomon_sky", "0e400"));
    assert_int_equal(warnings.count, 0);
}

static void test_deep_nesting(void **state) {
    (void)state;
    char text[4000] = "{\"a\":";
    memset(text + 5, '[', sizeof text - 6);
    refuse_bytes(text, sizeof text - 1, "t: byte 516: JSON nested deeper than json_depth=512");
}

static void test_duplicate_keys_are_tolerated(void **state) {
    (void)state;
    refuse_text("{\"asset\":{\"version\":\"1.0\",\"version\":\"2.0\"}}",
                "t: nodes: the scene is empty: there is no node");
}

/* ---- files ---- */

static char folder[PATH_MAX];

static void put(const char *name, const void *data, size_t size) {
    char path[PATH_MAX + 80];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_true(gn_file_write(path, data, size, &err));
}

/* A model in folder/in whose buffer is at uri; the scene or NULL with the message after the URI's
 * path in err. */
static struct gn_scene *load_with_uri(const char *uri) {
    struct gn_maker maker;
    char json[PATH_MAX], path[PATH_MAX + 20];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    put("in/some bin.bin", maker.bin, maker.size);
    put("in/50%25 off.bin", maker.bin, maker.size);
    put("outside.bin", maker.bin, maker.size);
    snprintf(json, sizeof json, "[{'byteLength':%zu,'uri':'%s'}]", maker.size, uri);
    gn_maker_set(&maker, "buffers", json);
    char *text = json_dumps(maker.root, 0);
    put("in/a.gltf", text, strlen(text));
    free(text);
    gn_maker_finish(&maker);
    reset(NULL);
    snprintf(path, sizeof path, "%s/in/a.gltf", folder);
    return gn_scene_load(path, NULL, NULL, &err);
}

static void refuse_uri(const char *uri, const char *message) {
    assert_null(load_with_uri(uri));
    if (!strstr(err.text, message)) fail_msg("'%s' does not contain '%s'", err.text, message);
}

static int make_folder(void **state) {
    (void)state;
    char path[PATH_MAX + 40], outside[PATH_MAX + 40];
    snprintf(folder, sizeof folder, "%s/gn-scene-XXXXXX",
             getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    if (!mkdtemp(folder)) return -1;
    snprintf(path, sizeof path, "%s/in", folder);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/in/sub", folder);
    mkdir(path, 0777);
    snprintf(path, sizeof path, "%s/in/link.bin", folder);
    snprintf(outside, sizeof outside, "%s/outside.bin", folder);
    if (symlink(outside, path) != 0) return -1;
    snprintf(path, sizeof path, "%s/in/pipe", folder);
    return mkfifo(path, 0666);
}

static int remove_folder(void **state) {
    (void)state;
    static const char *const names[] = {
        "in/a.gltf", "in/50%25 off.bin", "in/some bin.bin", "in/link.bin",
        "in/pipe",   "in/sub",           "outside.bin",     "in",
        "."};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[PATH_MAX + 40];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        if (i + 1 < sizeof names / sizeof names[0]) remove(path);
    }
    return rmdir(folder);
}

static void test_uris(void **state) {
    (void)state;
    static const char *const good[] = {"some%20bin.bin",
                                       "some bin.bin",
                                       "./some bin.bin",
                                       "sub/../some%20bin.bin",
                                       "sub\\\\..\\\\some bin.bin",
                                       "some%20bin.bin?v=3",
                                       "some bin.bin#part",
                                       "Some%20Bin.BIN",
                                       "50%25 off.bin"};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct gn_scene *scene = load_with_uri(good[i]);
        if (!scene) fail_msg("%s: %s", good[i], err.text);
        gn_scene_destroy(scene);
    }
    refuse_uri("../outside.bin",
               "buffers[0].uri: '../outside.bin' lies outside the model's folder");
    refuse_uri("%2e%2e/outside.bin", "lies outside the model's folder");
    refuse_uri("sub/../../outside.bin", "lies outside the model's folder");
    refuse_uri("/etc/passwd", "lies outside the model's folder");
    refuse_uri("link.bin", "buffers[0].uri: 'link.bin' leads outside the model's folder");
    refuse_uri("file:///etc/passwd", "only files beside the model are read");
    refuse_uri("http://example.com/a.bin", "only files beside the model are read");
    refuse_uri("a%00.bin", "cannot contain a zero byte");
    refuse_uri("", "empty URI");
    refuse_uri("pipe", "in/pipe");
    refuse_uri("sub", "in/sub");
    refuse_uri("missing.bin", "missing.bin");
    refuse_uri("data:;base64,AAA!", "not valid base64");
    refuse_uri("data:;base64,AAAA", "buffers[0].byteLength: 60, but the data has 3 bytes");
}

static void test_memory_names_no_files(void **state) {
    (void)state;
    refuse_text(
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"uri\":\"a.bin\",\"byteLength\":1}]}",
        "t: buffers[0].uri: 'a.bin': a model in memory cannot name other files");
}

/* ---- limits ---- */

static void test_limits(void **state) {
    (void)state;
    struct gn_scene_limits limits = {0};
    assert_true(gn_scene_limits_set(&limits, "vertices", 3, &err));
    assert_int_equal(limits.vertices, 3);
    assert_false(gn_scene_limits_set(&limits, "vertices", 0, &err));
    assert_int_equal(err.status, GN_EXIT_USAGE);
    assert_false(gn_scene_limits_set(&limits, "verts", 1, &err));
    assert_string_equal(
        err.text, "unknown limit 'verts'; limits are: file_mb memory_mb nodes instances vertices "
                  "texels keys json_depth seconds gpu_mb maps_mb triangles_per_frame "
                  "overdraw decoded_mb ahead_percent");
    struct gn_made made = square_glb();
    assert_null(gn_scene_load_bytes("t", made.data, made.size, &limits, NULL, &err));
    assert_string_equal(err.text, "t: meshes: 6 vertices are more than the limit vertices=3");
    free(made.data);
}

/* Of a small machine a share, of a large one no more than of a middling one. */
static void test_megabytes_fall_back_to_a_share_of_the_memory(void **state) {
    (void)state;
    char text[400];
    gn_memory_pretend_mb(960);
    struct gn_scene_limits limits = gn_scene_limits_or_default(NULL);
    assert_int_equal(limits.maps_mb, 120);
    assert_int_equal(limits.memory_mb, 480);
    assert_int_equal(limits.nodes, 100000);
    assert_true(gn_scene_limits_set(&limits, "maps_mb", 500, &err));
    gn_scene_limits_print(&limits, text, sizeof text);
    assert_non_null(strstr(text, "memory_mb=480,"));
    assert_non_null(strstr(text, "maps_mb=500,"));
    gn_memory_pretend_mb(64);
    assert_int_equal(gn_scene_limits_or_default(NULL).maps_mb, 32);
    gn_memory_pretend_mb(65536);
    assert_int_equal(gn_scene_limits_or_default(NULL).maps_mb, 384);
    assert_int_equal(gn_scene_limits_or_default(NULL).memory_mb, 1024);
    gn_memory_pretend_mb(0); /* read it again */
    assert_true(gn_memory_total_mb() > 0);
    assert_int_equal(gn_memory_of_meminfo("MemTotal:  2048 kB\nMemFree: 4096 kB\n", "MemFree:"), 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_not_gltf),
        cmocka_unit_test(test_glb_header),
        cmocka_unit_test_setup(test_a_cancelled_load_fails, reset),
        cmocka_unit_test_setup(test_trailing_data_is_a_warning, reset),
        cmocka_unit_test(test_gltf_with_bom_and_data_uri),
        cmocka_unit_test(test_wrong_json),
        cmocka_unit_test(test_integral_reals_are_integers),
        cmocka_unit_test(test_extras_may_have_any_number_and_any_escape),
        cmocka_unit_test(test_numbers_beyond_a_double_are_no_values),
        cmocka_unit_test(test_deep_nesting),
        cmocka_unit_test(test_duplicate_keys_are_tolerated),
        cmocka_unit_test_setup_teardown(test_uris, make_folder, remove_folder),
        cmocka_unit_test(test_memory_names_no_files),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_megabytes_fall_back_to_a_share_of_the_memory),
    };
    return RUN(tests);
}
