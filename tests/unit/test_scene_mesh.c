/* Accessors to vertices: formats, sharing, triangles, normals, bounds, nodes, copies. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/pose.h"
#include "unit/scene_help.h"

/* ---- sharing ---- */

static void test_same_accessors_share_a_geometry(void **state) {
    (void)state;
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'baseColorFactor':[1,0,0,1]}},{}]");
    gn_maker_add(&maker, "meshes",
                 "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0},"
                 "{'attributes':{'POSITION':0},'indices':1,'material':1}]}");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0},{'mesh':1},{'mesh':1,'extras':{'gnomon_plane':true}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->geometry_count, 1);
    assert_int_equal(scene->item_count, 5);
    assert_int_equal(scene->triangle_count, 10);
    assert_int_equal(scene->batch_count,
                     2); /* the materials differ in factors only; a plane stands alone */
    assert_true(!scene->items[2].plane && scene->items[3].plane && scene->items[4].plane);
    gn_scene_destroy(scene);
}

static void test_same_vertices_are_shared(void **state) {
    (void)state;
    static const float normals[12] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    static const uint8_t half[] = {0, 1, 2};
    gn_maker_accessor(&maker, "VEC3", 5126, 4, normals, sizeof normals, NULL);
    gn_maker_accessor(&maker, "SCALAR", 5121, 3, half, sizeof half, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':2},'indices':1},"
                 "{'attributes':{'POSITION':0,'NORMAL':2},'indices':3}]}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->geometry_count, 2);
    assert_int_equal(scene->buffers.vertex_count, 4);
    assert_true(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_NORMAL));
    gn_scene_destroy(scene);
}

/* ---- triangles ---- */

static void load_primitive(const char *primitive, uint32_t triangles, const char *warning) {
    setup(NULL);
    char json[400];
    snprintf(json, sizeof json, "[{'primitives':[%s,{'attributes':{'POSITION':0},'indices':1}]}]",
             primitive);
    gn_maker_set(&maker, "meshes", json);
    struct gn_scene *scene = load();
    assert_int_equal(scene->triangle_count, 2 + triangles);
    if (warning)
        assert_string_equal(warnings.text[0], warning);
    else
        assert_int_equal(warnings.count, 0);
    gn_scene_destroy(scene);
}

static void test_modes(void **state) {
    (void)state;
    gn_maker_finish(&maker);
    load_primitive("{'attributes':{'POSITION':0},'mode':5}", 2, NULL);
    load_primitive("{'attributes':{'POSITION':0},'mode':6}", 2, NULL);
    load_primitive("{'attributes':{'POSITION':0},'mode':0}", 0,
                   "t: meshes[0].primitives[0]: points and lines are not shown");
    load_primitive("{'attributes':{'POSITION':0}}", 1,
                   "t: meshes[0].primitives[0]: 4 indices are not a multiple of 3; the "
                   "last 1 ignored");
    load_primitive("{'attributes':{}}", 0,
                   "t: meshes[0].primitives[0]: has no POSITION; not shown");
}

static void test_strips_keep_their_winding(void **state) {
    (void)state;
    static const float strip[] = {0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1}; /* all look up */
    gn_maker_accessor(&maker, "VEC3", 5126, 4, strip, sizeof strip, NULL);
    gn_maker_set(&maker, "meshes", "[{'primitives':[{'attributes':{'POSITION':2},'mode':5}]}]");
    struct gn_scene *scene = load();
    for (uint32_t i = 0; i < scene->buffers.vertex_count; i++)
        assert_near(scene->buffers.normals[3 * i + 1], 1);
    assert_true(scene->geometries[0].flat);
    assert_near(scene->geometries[0].plane[1], 1);
    gn_scene_destroy(scene);
}

static void test_positions_that_are_no_place(void **state) {
    (void)state;
    float *positions = (float *)maker.bin;
    positions[9] = INFINITY; /* vertex 3: the second triangle */
    struct gn_scene *scene = load();
    assert_int_equal(scene->triangle_count, 1);
    assert_string_equal(
        warnings.text[0],
        "t: meshes[0].primitives[0]: 1 triangles with positions that are not finite "
        "are not shown");
    assert_near(scene->box.max[0], 1);
    assert_near(scene->geometries[0].box.max[2], 1);
    gn_scene_destroy(scene);
}

static void test_index_beyond_the_vertices(void **state) {
    (void)state;
    maker.bin[48] = 4;
    assert_null(gn_maker_load(&maker, NULL, &err));
    assert_string_equal(
        err.text,
        "t: meshes[0].primitives[0].indices: element 0 is vertex 4, but there are 4 vertices");
}

/* ---- normals ---- */

/* A roof of two faces over a ridge: the ridge's two vertices are made twice, others stay. */
static void test_flat_normals_unweld_where_needed(void **state) {
    (void)state;
    static const float roof[] = {-1, 0, 1, 0, 1, 1, 0, 1, -1, -1, 0, -1, 1, 0, 1, 1, 0, -1};
    static const uint8_t corners[] = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
    gn_maker_accessor(&maker, "VEC3", 5126, 6, roof, sizeof roof, NULL);
    gn_maker_accessor(&maker, "SCALAR", 5121, 12, corners, sizeof corners, NULL);
    gn_maker_set(&maker, "meshes", "[{'primitives':[{'attributes':{'POSITION':2},'indices':3}]}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->buffers.vertex_count, 8);
    assert_false(scene->geometries[0].flat);
    assert_false(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_NORMAL));
    gn_scene_destroy(scene);
}

static void test_normals_without_length(void **state) {
    (void)state;
    static const float normals[12] = {0};
    gn_maker_accessor(&maker, "VEC3", 5126, 4, normals, sizeof normals, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':2},'indices':1}]}]");
    struct gn_scene *scene = load();
    assert_near(scene->buffers.normals[1], 1);
    assert_string_equal(
        warnings.text[0],
        "t: meshes[0].primitives[0]: normals without length; those of the faces are used");
    gn_scene_destroy(scene);
}

/* The same roof with normals: those of the ridge point up, 45 degrees from both faces. */
static void test_spread_is_the_sine_to_the_faces(void **state) {
    (void)state;
    static const float roof[] = {-1, 0, 1, 0, 1, 1, 0, 1, -1, -1, 0, -1, 1, 0, 1, 1, 0, -1};
    static const float normals[] = {-1, 1, 0, 0, 1, 0, 0, 1, 0, -1, 1, 0, 1, 1.01f, 0, 1, 1, 0};
    static const uint8_t corners[] = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
    gn_maker_accessor(&maker, "VEC3", 5126, 6, roof, sizeof roof, NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, 6, normals, sizeof normals, NULL);
    gn_maker_accessor(&maker, "SCALAR", 5121, 12, corners, sizeof corners, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':2,'NORMAL':3},'indices':4}]}]");
    struct gn_scene *scene = load();
    static const double sines[] = {0, .70711, .70711, 0, 0, 0}; /* 4: a rounding error */
    for (int i = 0; i < 6; i++)
        assert_true(fabs(scene->buffers.spreads[i] / 32767.0 - sines[i]) < 1e-4);
    gn_scene_destroy(scene);
}

/* ---- formats ---- */

static void test_formats(void **state) {
    (void)state;
    static const struct {
        int component;
        const char *more;
        float wanted[2];
        uint8_t bytes[8];
    } rows[] = {
        {5120, "'normalized':true", {1, -1}, {127, 0x80}},
        {5121, "'normalized':true", {1, 0}, {255, 0}},
        {5122, "'normalized':true", {1, -1}, {0xff, 0x7f, 0x00, 0x80}},
        {5123, "'normalized':true", {1, 0}, {0xff, 0xff, 0, 0}},
        {5120, NULL, {127, -128}, {127, 0x80}},
        {5121, NULL, {255, 1}, {255, 1}},
        {5122, NULL, {-2, 258}, {0xfe, 0xff, 2, 1}},
        {5123, NULL, {65534, 258}, {0xfe, 0xff, 2, 1}},
        {5126, NULL, {1, -2}, {0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0}},
    };
    gn_maker_finish(&maker);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        setup(NULL);
        uint8_t four[32] = {0};
        size_t size = rows[i].component < 5122 ? 2 : rows[i].component < 5126 ? 4 : 8;
        for (size_t k = 0; k < 4; k++) memcpy(four + k * size, rows[i].bytes, size);
        gn_maker_accessor(&maker, "VEC2", rows[i].component, 4, four, 4 * size, rows[i].more);
        gn_maker_set(&maker, "meshes",
                     "[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':2},'indices':1}]}]");
        struct gn_scene *scene = load();
        assert_non_null(scene->buffers.uv0);
        assert_null(scene->buffers.uv1);
        assert_near(scene->buffers.uv0[2], rows[i].wanted[0]);
        assert_near(scene->buffers.uv0[3], rows[i].wanted[1]);
        gn_scene_destroy(scene);
    }
}

static void test_colors(void **state) {
    (void)state;
    static const float rgb[] = {0, .5f, 2, 0, .5f, 2, 0, .5f, 2, 0, .5f, NAN};
    gn_maker_accessor(&maker, "VEC3", 5126, 4, rgb, sizeof rgb, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'COLOR_0':2},'indices':1},"
                 "{'attributes':{'POSITION':0},'indices':1}]}]");
    struct gn_scene *scene = load();
    assert_memory_equal(scene->buffers.colors, ((uint8_t[]){0, 128, 255, 255}), 4);
    assert_true(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_COLOR));
    assert_false(gn_geometry_has(&scene->geometries[1], GN_ATTRIBUTE_COLOR));
    assert_memory_equal(scene->buffers.colors + 4 * scene->geometries[1].first_vertex,
                        "\xff\xff\xff\xff", 4);
    gn_scene_destroy(scene);
}

/* Positions and normals in one view, as most engines write them. */
static void test_interleaved(void **state) {
    (void)state;
    static const float vertices[] = {0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 1, 0, 3, 0, 0, 0, 1};
    int view = gn_maker_view(&maker, vertices, sizeof vertices);
    json_object_set_new(json_array_get(json_object_get(maker.root, "bufferViews"), (size_t)view),
                        "byteStride", json_integer(24));
    gn_maker_add(&maker, "accessors",
                 "{'bufferView':2,'componentType':5126,'type':'VEC3','count':3}");
    gn_maker_add(&maker, "accessors",
                 "{'bufferView':2,'byteOffset':12,'componentType':5126,'type':'VEC3','count':3}");
    gn_maker_set(&maker, "meshes", "[{'primitives':[{'attributes':{'POSITION':2,'NORMAL':3}}]}]");
    struct gn_scene *scene = load();
    assert_near(scene->buffers.positions[3], 2);
    assert_near(scene->buffers.positions[7], 3);
    assert_near(scene->buffers.normals[8], 1);
    gn_scene_destroy(scene);
}

static void load_sparse(const char *base) {
    setup(NULL);
    static const uint16_t at[] = {2};
    static const float values[] = {5, 6, 7};
    char more[200];
    gn_maker_view(&maker, at, sizeof at);
    gn_maker_view(&maker, values, sizeof values);
    snprintf(more, sizeof more,
             "%s'sparse':{'count':1,'indices':{'bufferView':2,'componentType':5123},'values':{'"
             "bufferView':3}}",
             base);
    gn_maker_accessor(&maker, "VEC3", 5126, 4, NULL, 0, more);
    gn_maker_set(&maker, "meshes", "[{'primitives':[{'attributes':{'POSITION':2},'indices':1}]}]");
}

static void test_sparse(void **state) {
    (void)state;
    gn_maker_finish(&maker);
    for (int base = 0; base < 2; base++) {
        load_sparse(base ? "'bufferView':0," : "");
        struct gn_scene *scene = load();
        assert_near(scene->geometries[0].box.max[1], 6);
        assert_near(scene->geometries[0].box.min[0], base ? -1 : 0);
        gn_scene_destroy(scene);
    }
    load_sparse("");
    maker.bin[60] = 9;
    assert_null(gn_maker_load(&maker, NULL, &err));
    assert_string_equal(
        err.text, "t: accessors[2].sparse.indices: element 0: index 9, but there are 4 elements");
}

/* ---- nodes ---- */

static void test_two_parents_and_non_roots(void **state) {
    (void)state;
    gn_maker_set(&maker, "nodes",
                 "[{'children':[1],'translation':[0,5,0]},{'mesh':0,'name':'kept'},{'children':[1]}"
                 ",{'mesh':0}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[1,2]}]");
    struct gn_scene *scene = load();
    assert_string_equal(warnings.text[0],
                        "t: nodes[2].children: node 1 has two parents; shown under the first, 0");
    assert_string_equal(warnings.text[1],
                        "t: scenes[0].nodes: node 1 has a parent; shown in its place under it");
    assert_int_equal(scene->item_count, 1);
    assert_near(scene->box.max[1], 5);
    gn_scene_destroy(scene);
}

static void test_no_scene_shows_all_roots(void **state) {
    (void)state;
    json_object_del(maker.root, "scenes");
    json_object_del(maker.root, "scene");
    gn_maker_set(&maker, "nodes", "[{'mesh':0},{'children':[2]},{'mesh':0}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->item_count, 2);
    assert_int_equal(scene->nodes[2].parent, 1);
    gn_scene_destroy(scene);
}

static void test_deep_chain(void **state) {
    (void)state;
    enum { DEPTH = 50000 };
    json_t *nodes = json_array();
    for (int i = 0; i < DEPTH; i++)
        json_array_append_new(
            nodes, json_pack("{s:[i],s:[f,f,f]}", "children", i + 1, "translation", 0., .001, 0.));
    json_array_append_new(nodes, json_pack("{s:i}", "mesh", 0));
    json_object_set_new(maker.root, "nodes", nodes);
    struct gn_scene *scene = load();
    assert_int_equal(scene->nodes[DEPTH].parent, DEPTH - 1);
    assert_true(fabsf(scene->box.max[1] - 50) < .1f);
    gn_scene_destroy(scene);
}

static void test_copies(void **state) {
    (void)state;
    static const float places[] = {0, 0, 0, 10, 0, 0};
    static const int16_t turns[] = {0, 0, 0, 32767, 0, 0, 23170, 23170};
    gn_maker_accessor(&maker, "VEC3", 5126, 2, places, sizeof places, NULL);
    gn_maker_accessor(&maker, "VEC4", 5122, 2, turns, sizeof turns, "'normalized':true");
    gn_maker_set(
        &maker, "nodes",
        "[{'mesh':0,'extras':{'gnomon_plane':false},"
        "'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':2,'ROTATION':3}}}}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->item_count, 2);
    assert_int_equal(scene->items[0].instance, 0);
    assert_int_equal(scene->items[1].batch, 0);
    assert_near(scene->box.max[0], 10); /* stands upright there: turned by 90 degrees about z */
    assert_near(scene->box.max[1], 1);
    gn_scene_destroy(scene);
}

/* ---- closed bodies ---- */

enum { CORNERS = 36 };

/* Of a cube whose corners and positions (x y z each, -1 or 1, in 24 vertices) are changed first. */
static bool cube_is_closed(void (*change)(uint16_t *corners, float *positions)) {
    struct gn_warnings none = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "nodes", "[{'mesh':1}]");
    uint16_t corners[CORNERS];
    float positions[3 * 24];
    uint8_t *at = maker.bin + maker.size - sizeof corners;
    memcpy(corners, at, sizeof corners);
    memcpy(positions, at - sizeof positions, sizeof positions);
    change(corners, positions);
    memcpy(at, corners, sizeof corners);
    memcpy(at - sizeof positions, positions, sizeof positions);
    struct gn_scene *scene = gn_maker_load(&maker, &none, &err);
    if (!scene) fail_msg("%s", err.text);
    bool closed = scene->geometries[0].closed;
    gn_scene_destroy(scene);
    return closed;
}

static void leave(uint16_t *corners, float *positions) { (void)corners, (void)positions; }

static void turn_triangle(uint16_t *corners) {
    uint16_t second = corners[1];
    corners[1] = corners[2];
    corners[2] = second;
}

static void turn_one(uint16_t *corners, float *positions) {
    (void)positions;
    turn_triangle(corners + 12);
}

static void turn_all(uint16_t *corners, float *positions) {
    (void)positions;
    for (int i = 0; i < CORNERS; i += 3) turn_triangle(corners + i);
}

static void take_out_one(uint16_t *corners, float *positions) {
    (void)positions;
    corners[4] = corners[3];
}

static void open_a_seam(uint16_t *corners, float *positions) {
    (void)corners;
    positions[0] += 1e-6f;
}

/* What was at x = -1 is at 0, with either sign. */
static void mix_zeros(uint16_t *corners, float *positions) {
    (void)corners;
    for (int i = 0; i < 24; i++)
        if (positions[3 * i] < 0) positions[3 * i] = i % 2 ? 0.0f : -0.0f;
}

static void test_only_what_is_whole_and_looks_out_is_closed(void **state) {
    (void)state;
    assert_true(cube_is_closed(leave));
    assert_true(cube_is_closed(mix_zeros));
    assert_false(cube_is_closed(turn_one));
    assert_false(cube_is_closed(turn_all));
    assert_false(cube_is_closed(take_out_one));
    assert_false(cube_is_closed(open_a_seam));
}

static void test_triangles_of_instances_are_bounded(void **state) {
    (void)state;
    const float at[9] = {0};
    const int translation = gn_maker_accessor(&maker, "VEC3", 5126, 3, at, sizeof at, NULL);
    char json[160];
    snprintf(
        json, sizeof json,
        "[{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':%d}}}}]",
        translation);
    gn_maker_set(&maker, "nodes", json);
    struct gn_made glb = gn_maker_glb(&maker);
    struct gn_scene_limits limits = {.triangles_per_frame = 6};
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_scene_destroy(scene);
    limits.triangles_per_frame = 5;
    assert_null(gn_scene_load_bytes("t", glb.data, glb.size, &limits, &warnings, &err));
    assert_string_equal(err.text, "t: nodes: more triangles than the limit triangles_per_frame=5");
    free(glb.data);
    gn_maker_finish(&maker);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_same_accessors_share_a_geometry, setup),
        cmocka_unit_test_setup(test_triangles_of_instances_are_bounded, setup),
        cmocka_unit_test_setup(test_same_vertices_are_shared, setup),
        cmocka_unit_test_setup(test_modes, setup),
        cmocka_unit_test_setup(test_strips_keep_their_winding, setup),
        cmocka_unit_test_setup(test_positions_that_are_no_place, setup),
        cmocka_unit_test_setup(test_index_beyond_the_vertices, setup),
        cmocka_unit_test_setup(test_flat_normals_unweld_where_needed, setup),
        cmocka_unit_test_setup(test_normals_without_length, setup),
        cmocka_unit_test_setup(test_spread_is_the_sine_to_the_faces, setup),
        cmocka_unit_test_setup(test_formats, setup),
        cmocka_unit_test_setup(test_colors, setup),
        cmocka_unit_test_setup(test_interleaved, setup),
        cmocka_unit_test_setup(test_sparse, setup),
        cmocka_unit_test_setup(test_two_parents_and_non_roots, setup),
        cmocka_unit_test_setup(test_no_scene_shows_all_roots, setup),
        cmocka_unit_test_setup(test_deep_chain, setup),
        cmocka_unit_test_setup(test_copies, setup),
        cmocka_unit_test(test_only_what_is_whole_and_looks_out_is_closed),
    };
    return RUN(tests);
}
