/* Small files whose work would grow with the square of their size, or with what they only claim.
 * Each took between five seconds and hours. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "core/file.h"
#include "core/hash.h"
#include "fuzz/bomb_pictures.h"
#include "image/read.h"
#include "unit/scene_help.h"

static double start_s;

static double cpu_s(void) { return (double)clock() / CLOCKS_PER_SEC; }

static int begin(void **state) {
    start_s = cpu_s();
    return setup(state);
}

static void assert_quick(void) {
    const double took_s = cpu_s() - start_s;
    if (took_s > 3) fail_msg("%g s", took_s);
}

static void test_a_primitive_costs_its_own_size_not_that_of_its_accessor(void **state) {
    (void)state;
    static const uint8_t indices[3] = {0, 1, 2};
    gn_maker_add(&maker, "accessors", "{'componentType':5126,'count':19000000,'type':'VEC3'}");
    enum { COUNT = 100, SIZE = 60 * COUNT };
    char *json = malloc(SIZE);
    size_t used = (size_t)sprintf(json, "[{'primitives':[{'attributes':{'POSITION':0}}");
    for (int i = 0; i < COUNT; i++) {
        const int accessor =
            gn_maker_accessor(&maker, "SCALAR", 5121, 3, indices, sizeof indices, NULL);
        used += (size_t)snprintf(json + used, SIZE - used,
                                 ",{'attributes':{'POSITION':2},'indices':%d}", accessor);
    }
    snprintf(json + used, SIZE - used, "]}]");
    gn_maker_set(&maker, "meshes", json);
    free(json);
    struct gn_scene *scene = load();
    assert_int_equal(scene->geometry_count, COUNT + 1);
    gn_scene_destroy(scene);
    assert_quick();
}

static void test_a_part_of_the_vertices_keeps_its_attributes(void **state) {
    (void)state;
    static const uint8_t indices[6] = {3, 2, 1, 3, 2, 1};
    static const float uv[8] = {0, .125f, .25f, .375f, .5f, .625f, .75f, .875f};
    gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    gn_maker_accessor(&maker, "SCALAR", 5121, 3, indices, sizeof indices, NULL);
    gn_maker_accessor(&maker, "SCALAR", 5121, 6, indices, sizeof indices, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':2},'indices':3},"
                 "{'attributes':{'POSITION':0,'TEXCOORD_0':2},'indices':4}]}]");
    struct gn_scene *scene = load();
    const struct gn_geometry *part = &scene->geometries[0], *whole = &scene->geometries[1];
    assert_int_equal(part->vertex_count, 3);
    assert_int_equal(whole->vertex_count, 3);
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t a = part->first_vertex + i, b = whole->first_vertex + i;
        assert_memory_equal(scene->buffers.positions + 3 * a, scene->buffers.positions + 3 * b, 12);
        assert_near(scene->buffers.uv0[2 * a], uv[2 * indices[i]]);
        assert_near(scene->buffers.uv0[2 * a + 1], uv[2 * indices[i] + 1]);
    }
    gn_scene_destroy(scene);
}

/* ---- positions that collide under gn_hash() ---- */

/* x such that x ^ x >> bits is y. */
static uint64_t undo_shift(uint64_t y, int bits) {
    uint64_t x = y;
    for (int done = bits; done < 64; done += bits) x = y ^ x >> bits;
    return x;
}

/* The word that takes the hash from `from` to `to`: core/hash.c, backwards. */
static uint64_t word_between(uint64_t from, uint64_t to) {
    uint64_t inverse = 1; /* of the factor, modulo 2^64, by Newton's iteration */
    const uint64_t factor = UINT64_C(0xd6e8feb86659fd93);
    for (int i = 0; i < 6; i++) inverse *= 2 - factor * inverse;
    return undo_shift(undo_shift(to, 29) * inverse, 32) * inverse ^ from;
}

static void test_positions_cannot_be_made_to_collide(void **state) {
    (void)state;
    enum { COUNT = 99999, BYTES = 12 };
    float(*positions)[3] = malloc(COUNT * sizeof *positions);
    uint32_t bits = 0x49800000;
    for (int n = 0; n < COUNT; bits -= 37) {
        const uint64_t last = bits ^ ((uint64_t)BYTES << 56 | (uint64_t)BYTES << 24);
        const uint64_t middle = word_between(last, UINT64_C(0x123456789abcdef0));
        const uint64_t first = word_between(GN_HASH_INIT, middle);
        float *p = positions[n];
        memcpy(p, &first, sizeof first);
        memcpy(p + 2, &bits, sizeof bits);
        assert_true(n > 0 || gn_hash(GN_HASH_INIT, p, BYTES) == UINT64_C(0x123456789abcdef0));
        n += fabsf(p[0]) > 1e-9f && fabsf(p[0]) < 1e6f && fabsf(p[1]) > 1e-9f && fabsf(p[1]) < 1e6f;
    }
    gn_maker_accessor(&maker, "VEC3", 5126, COUNT, positions, COUNT * sizeof *positions, NULL);
    gn_maker_set(&maker, "meshes", "[{'primitives':[{'attributes':{'POSITION':2}}]}]");
    struct gn_scene *scene = load();
    assert_false(scene->geometries[0].flat); /* else nothing is looked up */
    assert_false(scene->geometries[0].closed);
    gn_scene_destroy(scene);
    free(positions);
    assert_quick();
}

/* ---- --limit seconds ---- */

/* Many primitives read the same indices: their work is far more than their bytes. */
static void test_a_load_ends_at_its_limit_of_processor_time(void **state) {
    (void)state;
    struct gn_scene_limits limits = {.seconds = 1, .vertices = 1000000000, .memory_mb = 1 << 20};
    enum { COUNT = 400, CORNERS = 300000 };
    uint16_t *indices = calloc(CORNERS, sizeof *indices);
    for (int i = 0; i < CORNERS; i++) indices[i] = (uint16_t)(i * 7919);
    gn_maker_add(&maker, "accessors", "{'componentType':5126,'count':65536,'type':'VEC3'}");
    gn_maker_set(&maker, "meshes", "[]");
    gn_maker_set(&maker, "nodes", "[{'mesh':0}]");
    const int view = gn_maker_view(&maker, indices, CORNERS * sizeof *indices);
    char *json = malloc(100 * COUNT);
    size_t used = (size_t)sprintf(json, "{'primitives':[");
    for (int i = 0; i < COUNT; i++) {
        char accessor[120];
        snprintf(accessor, sizeof accessor,
                 "{'bufferView':%d,'componentType':5123,'count':%d,'type':'SCALAR'}", view,
                 CORNERS);
        used += (size_t)snprintf(json + used, 100 * COUNT - used,
                                 "%s{'attributes':{'POSITION':2},'indices':%d}", i ? "," : "",
                                 gn_maker_add(&maker, "accessors", accessor));
    }
    snprintf(json + used, 100 * COUNT - used, "]}");
    gn_maker_add(&maker, "meshes", json);
    struct gn_made glb = gn_maker_glb(&maker);
    assert_null(gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err));
    assert_string_equal(err.text, "t: takes longer to load than the limit seconds=1");
    free(json);
    free(indices);
    free(glb.data);
    gn_maker_finish(&maker);
    assert_quick();
}

/* ---- pictures ---- */

static char folder[] = "/tmp/gnomon-seconds-XXXXXX";

static const char *path_of(const char *name) {
    static char path[80];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

/* A scene in the folder, with a material for each of the images. */
static struct gn_scene *load_images(const char *const *uris, int uri_count, int count) {
    gn_maker_set(&maker, "meshes", "[]");
    for (int i = 0; i < count; i++) {
        char json[200];
        snprintf(json, sizeof json, "{'uri':'%s'}", uris[i % uri_count]);
        gn_maker_add(&maker, "images", json);
        snprintf(json, sizeof json, "{'source':%d}", i);
        gn_maker_add(&maker, "textures", json);
        snprintf(json, sizeof json, "{'emissiveTexture':{'index':%d}}", i);
        gn_maker_add(&maker, "materials", json);
        snprintf(json, sizeof json,
                 "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':%d}]}", i);
        gn_maker_add(&maker, "meshes", json);
        snprintf(json, sizeof json, "{'mesh':%d}", i);
        gn_maker_add(&maker, "nodes", json);
    }
    json_object_del(maker.root, "scenes");
    json_object_del(maker.root, "scene");
    assert_true(gn_maker_write(&maker, path_of("a.glb"), &err));
    struct gn_scene *scene = gn_scene_load(path_of("a.glb"), NULL, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

static void test_a_large_file_that_is_no_picture_is_not_read(void **state) {
    (void)state;
    static const char *const uris[] = {"zeros.png"};
    assert_non_null(mkdtemp(folder));
    FILE *file = fopen(path_of("zeros.png"), "w");
    assert_non_null(file);
    assert_int_equal(ftruncate(fileno(file), 400 << 20), 0);
    fclose(file);
    struct gn_scene *scene = load_images(uris, 1, 60);
    assert_non_null(
        strstr(warnings.text[0], "images[0]: neither PNG, JPEG, WebP nor KTX2; shown without"));
    assert_non_null(strstr(warnings.text[1], "images[1]: the same picture as images[0]; shown"));
    gn_scene_destroy(scene);
    unlink(path_of("zeros.png"));
    assert_quick();
}

static void test_a_file_is_one_picture_whatever_it_is_called(void **state) {
    (void)state;
    static const char *const uris[] = {"b.png", "./b.png", "%62.png", "c.png"};
    static const uint8_t red[4] = {255, 0, 0, 255};
    struct gn_made png = gn_maker_png(1, 1, red);
    assert_true(gn_file_write(path_of("b.png"), png.data, png.size, &err));
    free(png.data);
    assert_int_equal(symlink("b.png", path_of("c.png")), 0);
    struct gn_scene *scene = load_images(uris, 4, 8);
    assert_int_equal(scene->pictures.image_count, 1);
    assert_int_equal(scene->pictures.texture_count, 8);
    assert_int_equal(warnings.count, 0);
    gn_scene_destroy(scene);
    unlink(path_of("b.png"));
    unlink(path_of("c.png"));
    unlink(path_of("a.glb"));
    rmdir(folder);
}

static void test_scans_of_a_jpeg_are_bounded(void **state) {
    (void)state;
    for (int many = 0; many < 2; many++) {
        struct gn_made jpeg = gn_bomb_jpeg_scans(many ? 8192 : 64, many ? 498 : 62);
        uint32_t px[2];
        const bool ok = gn_jpeg_size(jpeg.data, jpeg.size, px, &err);
        if (many) {
            assert_false(ok);
            assert_string_equal(err.text, "JPEG: 499 scans, at most 64 are read: save it again, "
                                          "not progressive");
        } else {
            uint8_t *rgba = calloc(64 * 64, 4);
            if (!ok || !gn_jpeg_read(jpeg.data, jpeg.size, px, 0, rgba, &err))
                fail_msg("%s", err.text);
            assert_true(rgba[0] == 128 && rgba[3] == 255);
            free(rgba);
        }
        free(jpeg.data);
    }
}

/* 1 x 999999 in a few kB: few texels, but many rows. */
static void test_narrow_pictures_cannot_take_minutes(void **state) {
    (void)state;
    enum { HEIGHT = 999999, COUNT = 40 };
    uint8_t *grey = calloc(HEIGHT, 4);
    struct gn_made png = gn_maker_png(1, HEIGHT, grey);
    free(grey);
    gn_maker_set(&maker, "meshes", "[{'primitives':[]}]");
    json_t *primitives =
        json_object_get(json_array_get(json_object_get(maker.root, "meshes"), 0), "primitives");
    for (int i = 0; i < COUNT; i++) {
        char json[100];
        snprintf(json, sizeof json, "{'bufferView':%d,'mimeType':'image/png'}",
                 gn_maker_view(&maker, png.data, png.size));
        gn_maker_add(&maker, "images", json);
        snprintf(json, sizeof json, "{'source':%d}", i);
        gn_maker_add(&maker, "textures", json);
        snprintf(json, sizeof json, "{'emissiveTexture':{'index':%d}}", i);
        gn_maker_add(&maker, "materials", json);
        json_array_append_new(primitives, json_pack("{s:{s:i},s:i,s:i}", "attributes", "POSITION",
                                                    0, "indices", 1, "material", i));
    }
    free(png.data);
    struct gn_scene *scene = load();
    assert_int_equal(scene->pictures.image_count, COUNT);
    assert_non_null(strstr(warnings.text[0], "of 999999 rows, and their mean below"));
    gn_scene_destroy(scene);
    assert_quick();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_a_primitive_costs_its_own_size_not_that_of_its_accessor, begin),
        cmocka_unit_test_setup(test_a_part_of_the_vertices_keeps_its_attributes, begin),
        cmocka_unit_test_setup(test_positions_cannot_be_made_to_collide, begin),
        cmocka_unit_test_setup(test_a_load_ends_at_its_limit_of_processor_time, begin),
        cmocka_unit_test_setup(test_narrow_pictures_cannot_take_minutes, begin),
        cmocka_unit_test(test_scans_of_a_jpeg_are_bounded),
        cmocka_unit_test_setup(test_a_large_file_that_is_no_picture_is_not_read, begin),
        cmocka_unit_test_setup(test_a_file_is_one_picture_whatever_it_is_called, begin),
    };
    return RUN(tests);
}
