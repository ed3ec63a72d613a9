/* Tangents for normal maps: those of the file, and those made at load. */
#include <cglm/cglm.h>
#include <stdlib.h>

#include "unit/scene_help.h"

/* A grid of 4 x 3 vertices over an uneven ground, whose u is mirrored at two columns; vertex 12
 * equals 5; triangle 12 has no area, 13 none in the picture. */
static const float grid_positions[] = {0, 0, 0, 1, 0, 0.2f,  2, 0, 0.1f,  3, 0, 0.3f, 0, 1, 0.1f,
                                       1, 1, 0, 2, 1, 0.25f, 3, 1, 0.05f, 0, 2, 0.2f, 1, 2, 0.15f,
                                       2, 2, 0, 3, 2, 0.1f,  1, 1, 0,     1, 3, 0.1f, 2, 3, 0};
static const float grid_normals[] = {
    0,    0,    1,    0.6f, 0,    0.8f, 0,    0.6f, 0.8f, 0, 0,    1,    0.6f, 0, 0.8f,
    0,    0.6f, 0.8f, 0,    0,    1,    0.6f, 0,    0.8f, 0, 0.6f, 0.8f, 0,    0, 1,
    0.6f, 0,    0.8f, 0,    0.6f, 0.8f, 0,    0.6f, 0.8f, 0, 0,    1,    0,    0, 1};
static const float grid_uv[] = {0.125f, 0,     0.5f, 0,     0.125f, 0,     0.75f, 0,
                                0.125f, 0.25f, 0.5f, 0.25f, 0.125f, 0.25f, 0.75f, 0.25f,
                                0.125f, 0.5f,  0.5f, 0.5f,  0.125f, 0.5f,  0.75f, 0.5f,
                                0.5f,   0.25f, 0.5f, 0.5f,  0.125f, 0.5f};
static const uint8_t grid_corners[] = {0, 1, 4,  1, 5,  4,  1, 2,  5, 2, 6,  5,  2, 3,  6,
                                       3, 7, 6,  4, 5,  8,  5, 9,  8, 5, 6,  9,  6, 10, 9,
                                       6, 7, 10, 7, 11, 10, 5, 12, 6, 9, 10, 14, 9, 14, 13};
enum { GRID_VERTICES = 15, GRID_CORNERS = sizeof grid_corners };

/* Of each corner, as mikktspace.c makes them: by its package for npm, 1.1.1, with w negated, since
 * v points down in glTF. */
static const float grid_tangents[][4] = {{1, 0, 0, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {0.998718f, 0.040503f, -0.030377f, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {-0.8f, 0, 0.6f, 1},
                                         {-0.998736f, 0.040211f, -0.030158f, 1},
                                         {-0.995787f, 0.07336f, -0.05502f, 1},
                                         {-0.998736f, 0.040211f, -0.030158f, 1},
                                         {-1, 0, 0, 1},
                                         {-0.995787f, 0.07336f, -0.05502f, 1},
                                         {0.992877f, -0.095316f, 0.071487f, -1},
                                         {1, 0, 0, -1},
                                         {1, 0, 0, -1},
                                         {1, 0, 0, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {1, 0, 0, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {0.998718f, 0.040503f, -0.030377f, -1},
                                         {0.998839f, 0.038545f, -0.028908f, -1},
                                         {0.998718f, 0.040503f, -0.030377f, -1},
                                         {1, 0, 0, -1},
                                         {0.998839f, 0.038545f, -0.028908f, -1},
                                         {-0.995787f, 0.07336f, -0.05502f, 1},
                                         {-1, 0, 0, 1},
                                         {-1, 0, 0, 1},
                                         {-1, 0, 0, 1},
                                         {-0.8f, 0, 0.6f, 1},
                                         {-1, 0, 0, 1},
                                         {1, 0, 0, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {0.998205f, -0.047914f, 0.035935f, -1},
                                         {0.8f, 0, -0.6f, -1},
                                         {0.998718f, 0.040503f, -0.030377f, -1},
                                         {0.998718f, 0.040503f, -0.030377f, -1},
                                         {-1, 0, 0, 1},
                                         {-1, 0, 0, 1},
                                         {-0.8f, 0, 0.6f, 1},
                                         {1, 0, 0, 1},
                                         {-1, 0, 0, 1},
                                         {1, 0, 0, 1},
                                         {1, 0, 0, 1}};

static void add_normal_map(const char *material) {
    static const uint8_t flat[] = {128, 128, 255, 255};
    char json[80];
    struct gn_made png = gn_maker_png(1, 1, flat);
    snprintf(json, sizeof json, "[{'bufferView':%d}]", gn_maker_view(&maker, png.data, png.size));
    free(png.data);
    gn_maker_set(&maker, "images", json);
    gn_maker_set(&maker, "textures", "[{'source':0}]");
    gn_maker_set(&maker, "materials", material);
}

static void add_grid(const char *material) {
    add_normal_map(material);
    gn_maker_accessor(&maker, "VEC3", 5126, GRID_VERTICES, grid_positions, sizeof grid_positions,
                      NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, GRID_VERTICES, grid_normals, sizeof grid_normals, NULL);
    gn_maker_accessor(&maker, "VEC2", 5126, GRID_VERTICES, grid_uv, sizeof grid_uv, NULL);
    gn_maker_accessor(&maker, "SCALAR", 5121, GRID_CORNERS, grid_corners, sizeof grid_corners,
                      NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':2,'NORMAL':3,'TEXCOORD_0':4},"
                 "'indices':5,'material':0}]}]");
}

#define NORMAL_MAP "[{'normalTexture':{'index':0}}]"

static const float *tangent_of(const struct gn_scene *scene, uint32_t corner) {
    return scene->buffers.tangents + 4 * (size_t)scene->buffers.indices[corner];
}

/* ---- made at load ---- */

static void test_tangents_are_those_of_the_reference(void **state) {
    (void)state;
    add_grid(NORMAL_MAP);
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 0);
    assert_true(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_TANGENT));
    assert_int_equal(scene->geometries[0].index_count, GRID_CORNERS);
    for (uint32_t i = 0; i < GRID_CORNERS; i++)
        for (int k = 0; k < 4; k++)
            assert_true(fabsf(tangent_of(scene, i)[k] - grid_tangents[i][k]) < 2e-5f);
    gn_scene_destroy(scene);
}

static void test_vertices_of_two_orientations_are_split(void **state) {
    (void)state;
    add_grid(NORMAL_MAP);
    struct gn_scene *scene = load();
    const struct gn_geometry *geometry = &scene->geometries[0];
    assert_true(geometry->vertex_count > GRID_VERTICES);
    assert_true(geometry->vertex_count <= GRID_CORNERS);
    for (uint32_t i = 0; i < GRID_CORNERS; i++) { /* all else is kept */
        const uint32_t from = grid_corners[i], vertex = scene->buffers.indices[i];
        assert_memory_equal(scene->buffers.positions + 3 * (size_t)vertex,
                            grid_positions + 3 * (size_t)from, 12);
        assert_memory_equal(scene->buffers.uv0 + 2 * (size_t)vertex, grid_uv + 2 * (size_t)from, 8);
    }
    gn_scene_destroy(scene);
}

/* A square in y = 0 whose picture is turned by 90 degrees: u runs along what was v. */
static void test_coordinates_are_transformed_first(void **state) {
    (void)state;
    static const float uv[] = {0, 0, 1, 0, 1, 1, 0, 1};
    add_normal_map("[{'normalTexture':{'index':0,'extensions':{'KHR_texture_transform':"
                   "{'rotation':1.5707963}}}},{'normalTexture':{'index':0}}]");
    gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':2},'indices':1,"
                 "'material':0},{'attributes':{'POSITION':0,'TEXCOORD_0':2},'indices':1,"
                 "'material':1}]}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->geometry_count, 2); /* the same accessors, but other tangents */
    const float *turned = tangent_of(scene, 0), *plain = tangent_of(scene, 6);
    assert_near(turned[0] * plain[0] + turned[1] * plain[1] + turned[2] * plain[2], 0);
    gn_scene_destroy(scene);
}

static void test_only_materials_with_a_normal_map_get_tangents(void **state) {
    (void)state;
    add_grid("[{}]");
    struct gn_scene *scene = load();
    assert_null(scene->buffers.tangents);
    assert_int_equal(scene->buffers.vertex_count, GRID_VERTICES);
    gn_scene_destroy(scene);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    add_grid("[{'normalTexture':{'index':0},'extensions':{'KHR_materials_unlit':{}}}]");
    scene = load();
    assert_null(scene->buffers.tangents);
    gn_scene_destroy(scene);
}

static void test_a_mesh_without_coordinates_gets_by_without(void **state) {
    (void)state;
    add_normal_map(NORMAL_MAP);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    struct gn_scene *scene = load();
    assert_false(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_TANGENT));
    assert_string_equal(warnings.text[0], "t: meshes[0].primitives[0]: has no TEXCOORD_0; shown "
                                          "without its normal map");
    gn_scene_destroy(scene);
}

/* One corner more than triangles, one unused vertex more than corners: all within what is
 * allocated. */
static void test_odd_counts(void **state) {
    (void)state;
    static const uint8_t corners[] = {0, 1, 2, 0, 2, 1, 3, 3};
    static const float uv[] = {0, 0, 1, 0, 1, 1, 0, 1},
                       normals[] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    add_normal_map(NORMAL_MAP);
    gn_maker_accessor(&maker, "SCALAR", 5121, 8, corners, sizeof corners, NULL);
    gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, 4, normals, sizeof normals, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':3,'NORMAL':4},"
                 "'indices':2,'material':0},{'attributes':{'POSITION':0,'TEXCOORD_0':3,"
                 "'NORMAL':4},'mode':5,'material':0}]}]");
    struct gn_scene *scene = load();
    assert_int_equal(scene->geometries[0].index_count, 6);
    assert_int_equal(scene->geometries[1].index_count, 6);
    gn_scene_destroy(scene);
}

/* ---- of the file ---- */

static void add_tangents(const char *type, int component, const void *data, size_t size) {
    static const float uv[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const float normals[] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    gn_maker_accessor(&maker, type, component, 4, data, size, NULL);
    gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, 4, normals, sizeof normals, NULL);
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0,'TANGENT':2,'TEXCOORD_0':3,"
                 "'NORMAL':4},'indices':1,'material':0}]}]");
}

static void test_tangents_of_the_file(void **state) {
    (void)state;
    static const float tangents[] = {3, 0, 4, 1, 0, 0, 0, -7, NAN, 0, 0, 1, 1, 0, 0, 0};
    add_normal_map(NORMAL_MAP);
    add_tangents("VEC4", 5126, tangents, sizeof tangents);
    struct gn_scene *scene = load();
    const float *t = scene->buffers.tangents;
    assert_int_equal(scene->buffers.vertex_count, 4);
    assert_near(t[0], .6f); /* of unit length; others become some direction in the surface */
    assert_near(t[2], .8f);
    assert_near(t[3], 1);
    assert_near(t[7], -1);
    for (int i = 0; i < 4; i++) {
        assert_near(t[4 * i + 1], 0);
        assert_near(glm_vec3_norm((float *)t + 4 * i), 1);
    }
    gn_scene_destroy(scene);
}

/* They are made from the texture coordinates instead. */
static void ignore_tangents(const char *type, int component, size_t size, const char *said) {
    static const float zeros[16];
    setup(NULL);
    add_normal_map(NORMAL_MAP);
    add_tangents(type, component, zeros, size);
    struct gn_scene *scene = load();
    assert_int_equal(warnings.count, 1);
    assert_string_equal(warnings.text[0], said);
    assert_true(gn_geometry_has(&scene->geometries[0], GN_ATTRIBUTE_TANGENT));
    gn_scene_destroy(scene);
}

static void test_tangents_of_a_wrong_type(void **state) {
    (void)state;
    gn_maker_finish(&maker);
    ignore_tangents("VEC3", 5126, 48,
                    "t: meshes[0].primitives[0].attributes.TANGENT: accessor 2 has 3 components, "
                    "must be VEC4; shown without it");
    ignore_tangents("VEC4", 5123, 32,
                    "t: meshes[0].primitives[0].attributes.TANGENT: accessor 2 has component type "
                    "5123, which is not allowed for it; shown without it");
    static const float zeros[16];
    setup(NULL); /* nobody reads them */
    gn_maker_set(&maker, "materials", "[{}]");
    add_tangents("VEC3", 5126, zeros, 48);
    gn_scene_destroy(load());
}

/* ---- materials ---- */

static void test_scale(void **state) {
    (void)state;
    add_grid("[{'normalTexture':{'index':0,'scale':0.5}},{'normalTexture':{'index':0,'scale':-2}},"
             "{}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':["
                 "{'attributes':{'POSITION':2,'NORMAL':3,'TEXCOORD_0':4},'indices':5,'material':0},"
                 "{'attributes':{'POSITION':2,'NORMAL':3,'TEXCOORD_0':4},'indices':5,'material':1}"
                 "]}]");
    struct gn_scene *scene = load();
    assert_near(scene->materials[0].normal_scale, .5f);
    assert_near(scene->materials[1].normal_scale, -2);
    assert_near(scene->materials[2].normal_scale, 1);
    assert_int_equal(scene->geometry_count, 1);
    assert_int_equal(scene->batch_count, 2); /* it is a uniform */
    gn_scene_destroy(scene);
}

static void test_normal_texture_out_of_range(void **state) {
    (void)state;
    add_grid("[{'normalTexture':{'index':1}}]");
    struct gn_scene *scene = load();
    assert_string_equal(warnings.text[0],
                        "t: materials[0].normalTexture.index: index 1, but there are 1 textures; "
                        "shown without this texture");
    assert_int_equal(scene->materials[0].textures[GN_TEXTURE_NORMAL].texture, -1);
    gn_scene_destroy(scene);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup(name, setup)
    const struct CMUnitTest tests[] = {
        TEST(test_tangents_are_those_of_the_reference),
        TEST(test_vertices_of_two_orientations_are_split),
        TEST(test_coordinates_are_transformed_first),
        TEST(test_only_materials_with_a_normal_map_get_tangents),
        TEST(test_a_mesh_without_coordinates_gets_by_without),
        TEST(test_odd_counts),
        TEST(test_tangents_of_the_file),
        TEST(test_tangents_of_a_wrong_type),
        TEST(test_scale),
        TEST(test_normal_texture_out_of_range),
    };
    return RUN(tests);
}
