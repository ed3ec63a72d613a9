/* gnomon bake: what it makes of made files, vertex by vertex. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bake/bake.h"
#include "core/arena.h"
#include "image/read.h"
#include "image/scale.h"
#include "scene/document.h"
#include "scene/pose.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { SIDE = 16, CORNERS = SIDE * SIDE * 6, VERTICES = (SIDE + 1) * (SIDE + 1) };
#define LEAST_X 100.3f /* of the sheet, which is 3.7 wide */
#define WIDTH   3.7f

static float height_at(int x, int z) { return .5f * sinf(.7f * (float)x) * cosf(.4f * (float)z); }

static void put_corner(int x, int z, float position[3], float normal[3], float uv[2]) {
    memcpy(position,
           (float[]){LEAST_X + WIDTH * (float)x / SIDE, height_at(x, z), WIDTH * (float)z / SIDE},
           3 * sizeof(float));
    memcpy(normal, (float[]){.6f, .8f, 0}, 3 * sizeof(float));
    memcpy(uv, (float[]){(float)x / SIDE, (float)z / SIDE}, 2 * sizeof(float));
}

/* A sheet of triangles without indices as mesh 0, and nodes and scenes of these texts. */
static void make_sheet(struct gn_maker *m, const char *nodes, const char *primitive) {
    static const int quad[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
    static float positions[CORNERS][3], normals[CORNERS][3], uvs[CORNERS][2];
    char mesh[400];
    for (int i = 0; i < CORNERS; i++)
        put_corner(i / 6 % SIDE + quad[i % 6][0], i / 6 / SIDE + quad[i % 6][1], positions[i],
                   normals[i], uvs[i]);
    gn_maker_init(m);
    const int p = gn_maker_accessor(m, "VEC3", 5126, CORNERS, positions, sizeof positions, NULL),
              n = gn_maker_accessor(m, "VEC3", 5126, CORNERS, normals, sizeof normals, NULL),
              t = gn_maker_accessor(m, "VEC2", 5126, CORNERS, uvs, sizeof uvs, NULL);
    snprintf(mesh, sizeof mesh,
             "{'name':'sheet','primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d,"
             "'TEXCOORD_0':%d}%s}]}",
             p, n, t, primitive);
    gn_maker_add(m, "meshes", mesh);
    gn_maker_set(m, "nodes", nodes);
    gn_maker_set(m, "scenes", "[{'nodes':[0]}]");
}

struct baked {
    struct gn_bytes bytes;
    struct gn_bake_report report;
    struct gn_warnings warnings;
    struct gn_err err;
    struct gn_document *document;
    const json_t *json;
};

/* Finishes the maker. */
static bool bake_with(struct gn_maker *m, double share, int limit_px, struct baked *out) {
    struct gn_made made = gn_maker_glb(m);
    const struct gn_bake_opts opts = {.path = "t", .share = share, .texture_limit_px = limit_px};
    *out = (struct baked){0};
    const bool done =
        gn_bake(&opts, made.data, made.size, &out->bytes, &out->report, &out->warnings, &out->err);
    gn_alloc_fail_at(0);
    free(made.data);
    gn_maker_finish(m);
    if (!done) return false;
    out->document =
        gn_document_open("b", out->bytes.data, out->bytes.size, NULL, &out->warnings, &out->err);
    assert_non_null(out->document);
    out->json = gn_document_json(out->document);
    return true;
}

static void bake_sheet(const char *nodes, const char *primitive, struct baked *out) {
    struct gn_maker m;
    make_sheet(&m, nodes, primitive);
    if (!bake_with(&m, 1, 2048, out)) fail_msg("%s", out->err.text);
}

static struct gn_scene *load_baked(struct baked *b) {
    struct gn_scene *scene =
        gn_scene_load_bytes("b", b->bytes.data, b->bytes.size, NULL, &b->warnings, &b->err);
    if (!scene) fail_msg("%s", b->err.text);
    return scene;
}

static void finish(struct baked *b) {
    gn_document_close(b->document);
    gn_bytes_finish(&b->bytes);
}

static const json_t *item(const struct baked *b, const char *list, size_t index) {
    return json_array_get(json_object_get(b->json, list), index);
}

static int number(const json_t *object, const char *key) {
    return (int)json_number_value(json_object_get(object, key));
}

/* ---- the tests ---- */

static void test_equal_vertices_become_one(void **state) {
    (void)state;
    struct baked b;
    bake_sheet("[{'mesh':0}]", "", &b);
    struct gn_scene *scene = load_baked(&b);
    assert_int_equal(b.report.vertices_before, CORNERS);
    assert_int_equal(b.report.vertices_after, VERTICES);
    assert_int_equal(b.report.triangles_after, CORNERS / 3);
    assert_int_equal(scene->buffers.vertex_count, VERTICES);
    assert_int_equal(b.warnings.count, 0);
    gn_scene_destroy(scene);
    finish(&b);
}

/* The vertices of node and matrix, as the file's own, to half a step of a 65536th of the size. */
static void check_places(const char *nodes, double scale, const double offset[3]) {
    struct baked b;
    bake_sheet(nodes, "", &b);
    struct gn_scene *scene = load_baked(&b);
    struct gn_pose pose = {0};
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    gn_pose_step(&pose, 0);
    size_t found = 0;
    for (uint32_t v = 0; v < scene->buffers.vertex_count; v++) {
        double world[3];
        gn_pose_vertex(&pose, 0, v, world, NULL);
        const double x = (world[0] - offset[0]) / scale, z = (world[2] - offset[2]) / scale,
                     column = (x - (double)LEAST_X) * SIDE / (double)WIDTH,
                     row = z * SIDE / (double)WIDTH;
        const double y = (double)height_at((int)lrint(column), (int)lrint(row));
        assert_true(fabs(column - rint(column)) * (double)WIDTH / SIDE < 1e-4);
        assert_true(fabs(row - rint(row)) * (double)WIDTH / SIDE < 1e-4);
        assert_true(fabs((world[1] - offset[1]) / scale - y) < 1e-4);
        found++;
    }
    assert_int_equal(found, VERTICES);
    const int position = number(
        json_object_get(json_array_get(json_object_get(item(&b, "meshes", 0), "primitives"), 0),
                        "attributes"),
        "POSITION");
    assert_int_equal(number(item(&b, "accessors", (size_t)position), "componentType"),
                     GN_COMPONENT_U16);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    finish(&b);
}

static void test_quantized_vertices_stay_in_their_places(void **state) {
    (void)state;
    check_places("[{'mesh':0}]", 1, (double[]){0, 0, 0});
    check_places("[{'mesh':0,'translation':[1,2,3],'scale':[2,2,2]}]", 2, (double[]){1, 2, 3});
    check_places("[{'mesh':0,'matrix':[2,0,0,0, 0,2,0,0, 0,0,2,0, 4,5,6,1]}]", 2,
                 (double[]){4, 5, 6});
    check_places("[{'children':[1],'translation':[1,0,0]},{'mesh':0,'children':[2]},{}]", 1,
                 (double[]){1, 0, 0});
}

static void test_what_artists_say_goes_with_the_mesh(void **state) {
    (void)state;
    struct baked b;
    bake_sheet("[{'name':'a','mesh':0,'children':[1],'extras':{'gnomon_cast':false,'mine':7}},"
               "{'name':'b'}]",
               "", &b);
    const json_t *parent = item(&b, "nodes", 0), *child = item(&b, "nodes", 2);
    assert_null(json_object_get(parent, "mesh"));
    assert_int_equal(number(json_object_get(parent, "extras"), "mine"), 7);
    assert_string_equal(json_string_value(json_object_get(parent, "name")), "a");
    assert_int_equal(number(child, "mesh"), 0);
    assert_true(json_is_false(json_object_get(json_object_get(child, "extras"), "gnomon_cast")));
    struct gn_scene *scene = load_baked(&b);
    assert_false(scene->items[0].casts);
    gn_scene_destroy(scene);
    finish(&b);
}

static void test_all_other_json_stays(void **state) {
    (void)state;
    struct gn_maker m;
    struct baked b;
    make_sheet(&m, "[{'mesh':0}]", ",'material':0,'extras':{'x':0.1}");
    gn_maker_set(&m, "extensionsUsed", "['X_mine']");
    gn_maker_set(&m, "extras", "{'exact':0.12345678901234567,'list':[1,2,{'y':-5}]}");
    gn_maker_add(&m, "materials", "{'name':'paint','extensions':{'X_mine':{'view':1}}}");
    assert_true(bake_with(&m, 1, 2048, &b));
    const json_t *extras = json_object_get(b.json, "extras");
    assert_true(json_number_value(json_object_get(extras, "exact")) == 0.12345678901234567);
    assert_int_equal(number(json_array_get(json_object_get(extras, "list"), 2), "y"), -5);
    assert_string_equal(b.report.unknown, "X_mine");
    /* view 1 is still that of the file: its normals */
    const uint8_t *data;
    size_t size, stride;
    float normal[3];
    gn_document_view(b.document, 1, &data, &size, &stride);
    assert_int_equal(size, CORNERS * sizeof normal);
    memcpy(normal, data, sizeof normal);
    assert_true(normal[1] == .8f);
    const json_t *primitive =
        json_array_get(json_object_get(item(&b, "meshes", 0), "primitives"), 0);
    assert_int_equal(number(primitive, "material"), 0);
    assert_non_null(json_object_get(primitive, "extras"));
    finish(&b);
}

static void test_skins_and_targets_stay_floats(void **state) {
    (void)state;
    struct gn_maker m;
    struct baked b;
    gn_maker_init(&m);
    gn_maker_posed_square(&m);
    assert_true(bake_with(&m, 1, 2048, &b));
    struct gn_scene *scene = load_baked(&b);
    assert_int_equal(b.warnings.count, 0);
    assert_int_equal(scene->deformation.skin_count, 1);
    const json_t *primitive =
        json_array_get(json_object_get(item(&b, "meshes", 0), "primitives"), 0);
    const json_t *attributes = json_object_get(primitive, "attributes");
    struct gn_elements e;
    assert_true(gn_document_accessor(b.document, (size_t)number(attributes, "POSITION"), &e));
    assert_int_equal(e.component, GN_COMPONENT_F32);
    assert_true(gn_document_accessor(b.document, (size_t)number(attributes, "WEIGHTS_0"), &e));
    for (size_t i = 0; i < e.count; i++) {
        uint16_t w[4];
        memcpy(w, e.data + i * e.stride, sizeof w);
        assert_int_equal(w[0] + w[1] + w[2] + w[3], 65535);
    }
    const json_t *target = json_array_get(json_object_get(primitive, "targets"), 0);
    float lifted[4][3];
    gn_document_accessor(b.document, (size_t)number(target, "POSITION"), &e);
    gn_document_floats(b.document, (size_t)number(target, "POSITION"), 3, lifted[0]);
    for (int v = 0; v < 4; v++) assert_true(lifted[v][0] == 0 && lifted[v][1] == 1);
    gn_scene_destroy(scene);
    finish(&b);
}

/* All triangles look up, in a strip every second one by its winding. */
static void test_strips_and_fans_face_as_before(void **state) {
    static const float zigzag[6][3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0},
                                       {1, 0, 1}, {2, 0, 0}, {2, 0, 1}},
                       ring[6][3] = {{0, 0, 0},  {1, 0, 0},       {.7f, 0, -.7f},
                                     {0, 0, -1}, {-.7f, 0, -.7f}, {-1, 0, 0}};
    (void)state;
    for (int mode = 5; mode <= 6; mode++) {
        struct gn_maker m;
        struct baked b;
        gn_maker_init(&m);
        gn_maker_accessor(&m, "VEC3", 5126, 6, mode == 5 ? zigzag : ring, sizeof ring, NULL);
        gn_maker_add(&m, "meshes",
                     mode == 5 ? "{'primitives':[{'attributes':{'POSITION':0},'mode':5}]}"
                               : "{'primitives':[{'attributes':{'POSITION':0},'mode':6}]}");
        gn_maker_set(&m, "nodes", "[{'mesh':0}]");
        gn_maker_set(&m, "scenes", "[{'nodes':[0]}]");
        assert_true(bake_with(&m, 1, 2048, &b));
        struct gn_scene *scene = load_baked(&b);
        assert_int_equal(scene->geometries[0].index_count, 12);
        for (uint32_t i = 0; i < 12; i += 3) {
            const float *p[3];
            for (uint32_t k = 0; k < 3; k++)
                p[k] = scene->buffers.positions + 3 * (size_t)scene->buffers.indices[i + k];
            const float up = (p[1][2] - p[0][2]) * (p[2][0] - p[0][0]) -
                             (p[1][0] - p[0][0]) * (p[2][2] - p[0][2]);
            assert_true(up > 0);
        }
        gn_scene_destroy(scene);
        finish(&b);
    }
}

static void test_blended_triangles_keep_their_order(void **state) {
    (void)state;
    struct gn_maker m;
    struct baked b;
    make_sheet(&m, "[{'mesh':0}]", ",'material':0");
    gn_maker_add(&m, "materials", "{'alphaMode':'BLEND'}");
    assert_true(bake_with(&m, 1, 2048, &b));
    struct gn_scene *scene = load_baked(&b);
    for (int t = 0; t < CORNERS / 3; t++) { /* triangle t is of quad t / 2 */
        float low[3] = {INFINITY, INFINITY, INFINITY};
        for (int k = 0; k < 3; k++) {
            const uint32_t v = scene->buffers.indices[3 * t + k];
            for (int i = 0; i < 3; i++)
                low[i] = fminf(low[i], scene->buffers.positions[3 * (size_t)v + (size_t)i]);
        }
        const json_t *scale = json_object_get(item(&b, "nodes", 0), "scale");
        const double step = json_number_value(json_array_get(scale, 0));
        assert_int_equal(lrint((double)low[2] * step * SIDE / (double)WIDTH), t / 2 / SIDE);
        assert_int_equal(lrint((double)low[0] * step * SIDE / (double)WIDTH), t / 2 % SIDE);
    }
    gn_scene_destroy(scene);
    finish(&b);
}

/* The step of the grid of a sheet whose accessor has one vertex more, at x. */
static double step_with_stray(float x) {
    static float positions[CORNERS + 1][3], normal[3], uv[2];
    static uint16_t indices[CORNERS];
    struct gn_maker m;
    struct baked b;
    char mesh[200];
    for (int i = 0; i < CORNERS; i++) {
        indices[i] = (uint16_t)i;
        put_corner(i / 6 % SIDE + (i % 3 == 1), i / 6 / SIDE + (i % 3 == 2), positions[i], normal,
                   uv);
    }
    positions[CORNERS][0] = x;
    gn_maker_init(&m);
    const int p = gn_maker_accessor(&m, "VEC3", 5126, CORNERS + 1, positions, sizeof positions,
                                    NULL),
              n = gn_maker_accessor(&m, "SCALAR", 5123, CORNERS, indices, sizeof indices, NULL);
    snprintf(mesh, sizeof mesh, "{'primitives':[{'attributes':{'POSITION':%d},'indices':%d}]}", p,
             n);
    gn_maker_add(&m, "meshes", mesh);
    gn_maker_set(&m, "nodes", "[{'mesh':0}]");
    gn_maker_set(&m, "scenes", "[{'nodes':[0]}]");
    assert_true(bake_with(&m, 1, 2048, &b));
    const double step =
        json_number_value(json_array_get(json_object_get(item(&b, "nodes", 0), "scale"), 0));
    finish(&b);
    return step;
}

static void test_vertices_of_no_triangle_do_not_widen_the_grid(void **state) {
    (void)state;
    const double step = step_with_stray(0);
    assert_true(step > 0);
    assert_true(step_with_stray(1e6f) == step);
    assert_true(step_with_stray(NAN) == step);
}

static void test_simplified_surfaces_move_less_than_is_said(void **state) {
    (void)state;
    struct gn_maker m;
    struct baked b;
    make_sheet(&m, "[{'mesh':0}]", "");
    assert_true(bake_with(&m, .5, 2048, &b));
    assert_in_range(b.report.triangles_after, 1, CORNERS / 3 - 1);
    assert_true(b.report.error > 0 && b.report.error <= .02);
    finish(&b);
}

static void test_only_pictures_over_the_limit_change(void **state) {
    (void)state;
    struct gn_maker m;
    struct baked b;
    static uint8_t rgba[64 * 32 * 4];
    for (size_t i = 0; i < sizeof rgba; i++) rgba[i] = (uint8_t)(i % 4 == 3 ? 255 : 200);
    struct gn_made large = gn_maker_png(64, 32, rgba), small = gn_maker_png(16, 16, rgba);
    char image[80];
    make_sheet(&m, "[{'mesh':0}]", ",'material':0");
    gn_maker_add(&m, "materials",
                 "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}},"
                 "'normalTexture':{'index':1}}");
    for (int i = 0; i < 2; i++) {
        const struct gn_made *png = i ? &small : &large;
        snprintf(image, sizeof image, "{'mimeType':'image/png','bufferView':%d}",
                 gn_maker_view(&m, png->data, png->size));
        gn_maker_add(&m, "images", image);
        snprintf(image, sizeof image, "{'source':%d}", i);
        gn_maker_add(&m, "textures", image);
    }
    assert_true(bake_with(&m, 1, 16, &b));
    const uint8_t *data;
    size_t size, stride;
    uint32_t px[2];
    gn_document_view(b.document, (size_t)number(item(&b, "images", 0), "bufferView"), &data, &size,
                     &stride);
    assert_true(gn_png_size(data, size, px, NULL));
    assert_true(px[0] == 16 && px[1] == 8);
    uint8_t out[16 * 8 * 4];
    assert_true(gn_png_read(data, size, px, 0, out, NULL));
    assert_memory_equal(out, rgba, sizeof out);
    gn_document_view(b.document, (size_t)number(item(&b, "images", 1), "bufferView"), &data, &size,
                     &stride);
    assert_int_equal(size, small.size);
    assert_memory_equal(data, small.data, size);
    free(large.data);
    free(small.data);
    finish(&b);
}

static void scale_row(const uint8_t *rgba, uint32_t from, enum gn_scale_kind kind, uint8_t *out,
                      uint32_t to) {
    struct gn_scaler scaler;
    assert_true(gn_scaler_init(&scaler, (uint32_t[]){from, 1}, kind, out, (uint32_t[]){to, 1}));
    gn_scaler_row(&scaler, rgba);
    gn_scaler_finish(&scaler);
}

static void test_scaled_colours_are_averaged_in_linear_light(void **state) {
    (void)state;
    const uint8_t two[] = {0, 255, 128, 0, 255, 255, 128, 255};
    uint8_t one[4];
    scale_row(two, 2, GN_SCALE_COLOR, one, 1);
    assert_int_equal(one[0], 188); /* half of white's light */
    assert_true(one[1] == 255 && one[2] == 128 && one[3] == 128);
    scale_row(two, 2, GN_SCALE_DATA, one, 1);
    assert_int_equal(one[0], 128);
    /* x and y directions: their mean has length 1 */
    const uint8_t normals[] = {255, 128, 128, 255, 128, 255, 128, 255};
    scale_row(normals, 2, GN_SCALE_NORMALS, one, 1);
    assert_int_equal(one[0], 218); /* 127.5 + 127.5 sqrt(.5) */
    assert_int_equal(one[1], 218);
    /* 3 to 2: each is one and a half */
    const uint8_t three[] = {0, 0, 0, 255, 90, 90, 90, 255, 180, 180, 180, 255};
    uint8_t pair[8];
    scale_row(three, 3, GN_SCALE_DATA, pair, 2);
    assert_true(pair[0] == 30 && pair[4] == 150);
}

static void test_the_estimate_is_near(void **state) {
    (void)state;
    struct gn_maker m;
    struct gn_bake_estimate e;
    make_sheet(&m, "[{'mesh':0}]", "");
    struct gn_made made = gn_maker_glb(&m);
    const struct gn_bake_opts opts = {.path = "t"};
    assert_true(gn_bake_estimate(&opts, made.data, made.size, &e));
    assert_true(e.bytes == CORNERS * 32);
    assert_true(e.bytes_baked < .5 * e.bytes);
    free(made.data);
    struct baked b;
    assert_true(bake_with(&m, 1, 2048, &b)); /* compressed views are not counted again */
    assert_true(gn_bake_estimate(&opts, b.bytes.data, b.bytes.size, &e));
    assert_true(e.bytes < 1000);
    finish(&b);
}

static void test_failing_allocations_are_errors(void **state) {
    (void)state;
    struct gn_maker m;
    struct baked b;
    int failures = 0;
    for (unsigned long nth = 1; nth < 60; nth++) {
        make_sheet(&m, "[{'mesh':0}]", "");
        gn_alloc_fail_at(nth);
        const bool done = bake_with(&m, 1, 2048, &b);
        failures += !done;
        if (done)
            finish(&b);
        else {
            assert_true(b.err.text[0]);
            gn_bytes_finish(&b.bytes);
        }
    }
    assert_in_range(failures, 5, 59);
}

int main(void) {
    if (!gn_bake_is_built()) return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_vertices_become_one),
        cmocka_unit_test(test_quantized_vertices_stay_in_their_places),
        cmocka_unit_test(test_what_artists_say_goes_with_the_mesh),
        cmocka_unit_test(test_all_other_json_stays),
        cmocka_unit_test(test_skins_and_targets_stay_floats),
        cmocka_unit_test(test_strips_and_fans_face_as_before),
        cmocka_unit_test(test_blended_triangles_keep_their_order),
        cmocka_unit_test(test_vertices_of_no_triangle_do_not_widen_the_grid),
        cmocka_unit_test(test_simplified_surfaces_move_less_than_is_said),
        cmocka_unit_test(test_only_pictures_over_the_limit_change),
        cmocka_unit_test(test_scaled_colours_are_averaged_in_linear_light),
        cmocka_unit_test(test_the_estimate_is_near),
        cmocka_unit_test(test_failing_allocations_are_errors),
    };
    return RUN(tests);
}
