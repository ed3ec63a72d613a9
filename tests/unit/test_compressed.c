/* Buffer views that are compressed with meshoptimizer. */
#include <stdio.h>

#include "scene/gltf/meshopt.h"
#include "unit/meshopt_bytes.h"
#include "unit/scene_help.h"

/* The square again, of compressed views over a placeholder buffer. %s: members of the extension. */
static void compress_square(const char *positions, const char *indices) {
    char json[400];
    snprintf(json, sizeof json,
             "{'buffer':1,'byteLength':48,'extensions':{'EXT_meshopt_compression':{%s}}}",
             positions);
    const int square = gn_maker_add(&maker, "bufferViews", json);
    snprintf(json, sizeof json,
             "{'buffer':1,'byteOffset':48,'byteLength':12,'extensions':{'EXT_meshopt_compression':{"
             "%s}}}",
             indices);
    gn_maker_add(&maker, "bufferViews", json);
    gn_maker_add(&maker, "buffers",
                 "{'byteLength':60,'extensions':{'EXT_meshopt_compression':{'fallback':true}}}");
    snprintf(json, sizeof json,
             "[{'bufferView':%d,'type':'VEC3','componentType':5126,'count':4,'min':[-1,0,-1],'max':"
             "[1,0,1]},"
             "{'bufferView':%d,'type':'SCALAR','componentType':5123,'count':6}]",
             square, square + 1);
    gn_maker_set(&maker, "accessors", json);
    gn_maker_set(&maker, "extensionsRequired", "['EXT_meshopt_compression']");
}

/* Members of the extension for bytes that are put into buffer 0. */
static const char *stream(char text[200], const void *data, size_t size, const char *more) {
    const int view = gn_maker_view(&maker, data, size);
    json_t *views = json_object_get(maker.root, "bufferViews"),
           *at = json_array_get(views, (size_t)view);
    snprintf(text, 200, "'buffer':0,'byteOffset':%d,'byteLength':%d,%s",
             (int)json_integer_value(json_object_get(at, "byteOffset")), (int)size, more);
    return text;
}
#define OF_SQUARE    "'byteStride':12,'count':4,'mode':'ATTRIBUTES'"
#define OF_TRIANGLES "'byteStride':2,'count':6,'mode':'TRIANGLES'"

static void expect_square(void) {
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 0);
    assert_int_equal(scene->geometry_count, 1);
    const struct gn_geometry *geometry = &scene->geometries[0];
    assert_int_equal(geometry->index_count, 6);
    for (int i = 0; i < 3; i++) {
        assert_near(geometry->box.min[i], i == 1 ? 0 : -1);
        assert_near(geometry->box.max[i], i == 1 ? 0 : 1);
    }
    gn_scene_destroy(scene);
}

static void test_attributes_and_triangles(void **state) {
    (void)state;
    char a[200], b[200];
    compress_square(stream(a, gn_meshopt_square, sizeof gn_meshopt_square, OF_SQUARE),
                    stream(b, gn_meshopt_triangles, sizeof gn_meshopt_triangles, OF_TRIANGLES));
    expect_square();
}

static void test_an_index_sequence_and_exponents(void **state) {
    (void)state;
    char a[200], b[200];
    compress_square(stream(a, gn_meshopt_exponential, sizeof gn_meshopt_exponential,
                           OF_SQUARE ",'filter':'EXPONENTIAL'"),
                    stream(b, gn_meshopt_sequence, sizeof gn_meshopt_sequence,
                           "'byteStride':2,'count':6,'mode':'INDICES'"));
    expect_square();
}

/* Octahedral normals of 8 bits: within half a step of 1/127. */
static void test_octahedral_normals(void **state) {
    (void)state;
    const struct gn_meshopt_stream of = {.data = gn_meshopt_normals,
                                         .size = sizeof gn_meshopt_normals,
                                         .count = 4,
                                         .stride = 4,
                                         .filter = GN_MESHOPT_OCTAHEDRAL};
    int8_t normals[16];
    assert_true(gn_meshopt_decode(&of, normals, &err));
    for (int i = 0; i < 16; i += 4) {
        assert_true(fabs(normals[i] / 127.0) < 0.01);
        assert_true(fabs(normals[i + 1] / 127.0 - (i < 12 ? 1 : 0.6)) < 0.01);
        assert_true(fabs(normals[i + 2] / 127.0 - (i < 12 ? 0 : 0.8)) < 0.01);
    }
}

static void expect_refused(const char *positions, const char *indices, const char *why) {
    compress_square(positions, indices);
    assert_null(gn_maker_load(&maker, &warnings, &err));
    if (!strstr(err.text, why)) fail_msg("'%s', not '%s'", err.text, why);
    setup(NULL);
}

static int finish(void **state) {
    (void)state;
    gn_maker_finish(&maker);
    return 0;
}

static void test_wrong_streams_are_refused_by_name(void **state) {
    (void)state;
    static const struct {
        const char *more, *why;
    } rows[] = {
        {"'byteStride':13,'count':4,'mode':'ATTRIBUTES'",
         "byteStride 13 is not possible in mode ATTRIBUTES"},
        {"'byteStride':0,'count':4,'mode':'ATTRIBUTES'", "byteStride 0"},
        {"'byteStride':260,'count':4,'mode':'ATTRIBUTES'", "byteStride 260"},
        {"'byteStride':12,'count':4", "mode: missing"},
        {"'byteStride':12,'count':4,'mode':'COLORS'", "mode: 'COLORS' is not known"},
        {"'byteStride':12,'count':4,'mode':'ATTRIBUTES','filter':'OCTAHEDRAL'",
         "filter OCTAHEDRAL"},
        {"'byteStride':4,'count':4,'mode':'TRIANGLES'", "count 4 is not a multiple of 3"},
        {"'byteStride':4,'count':3,'mode':'TRIANGLES'", "version 0 of the codec is not read"},
        {"'byteStride':12,'count':4096,'mode':'ATTRIBUTES'", "damaged"},
        {"'byteStride':12,'count':3,'mode':'ATTRIBUTES'", "byteLength 48, but 36 bytes"},
        {"'byteStride':256,'count':9007199254740992,'mode':'ATTRIBUTES'", "memory_mb"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char a[200], b[200];
        stream(a, gn_meshopt_square, sizeof gn_meshopt_square, rows[i].more);
        stream(b, gn_meshopt_triangles, sizeof gn_meshopt_triangles, OF_TRIANGLES);
        expect_refused(a, b, rows[i].why);
    }
}

static void test_damaged_data_is_refused(void **state) {
    (void)state;
    char a[200], b[200];
    stream(a, gn_meshopt_square, sizeof gn_meshopt_square - 9, OF_SQUARE);
    stream(b, gn_meshopt_triangles, sizeof gn_meshopt_triangles, OF_TRIANGLES);
    expect_refused(a, b, "the compressed data is damaged");
    uint8_t later[sizeof gn_meshopt_square];
    memcpy(later, gn_meshopt_square, sizeof later);
    later[0] = 0xa1;
    stream(a, later, sizeof later, OF_SQUARE);
    stream(b, gn_meshopt_triangles, sizeof gn_meshopt_triangles, OF_TRIANGLES);
    expect_refused(a, b, "version 1 of the codec is not read");
    stream(b, gn_meshopt_triangles, sizeof gn_meshopt_triangles, OF_TRIANGLES);
    expect_refused("'buffer':1,'byteLength':9," OF_SQUARE, b, "holds no data");
    stream(b, gn_meshopt_triangles, sizeof gn_meshopt_triangles, OF_TRIANGLES);
    expect_refused("'buffer':0,'byteOffset':9,'byteLength':4096," OF_SQUARE, b,
                   "passes the end of buffer 0");
}

int main(void) {
    if (!gn_meshopt_is_read()) return puts("SKIP: built without libmeshoptimizer"), 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_attributes_and_triangles, setup),
        cmocka_unit_test_setup(test_an_index_sequence_and_exponents, setup),
        cmocka_unit_test(test_octahedral_normals),
        cmocka_unit_test_setup_teardown(test_wrong_streams_are_refused_by_name, setup, finish),
        cmocka_unit_test_setup_teardown(test_damaged_data_is_refused, setup, finish),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
