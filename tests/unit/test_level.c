/* Levels of detail: fewer triangles, an error that holds, edges that stay. What is checked of
 * errors is computed here without a grid, in all triangles. */
#include <cglm/cglm.h>
#include <stdlib.h>

#include "scene/gltf/meshopt.h"
#include "scene/level.h"
#include "scene/pose.h"
#include "unit/scene_help.h"

enum { SIDE = 65, VERTICES = SIDE * SIDE, CORNERS = 6 * (SIDE - 1) * (SIDE - 1), TIMES = 10 };
#define OFF_MOST 4.0 /* times a level's error (scene/level.h) */

static float positions[VERTICES][3], normals[VERTICES][3], uv[VERTICES][2], weights[VERTICES][4];
static uint16_t joints[VERTICES][4];
static uint32_t corners[CORNERS];

/* A ground of waves, 8 m wide, finer than it needs to be. */
static void make_ground(float height_m) {
    for (int i = 0; i < VERTICES; i++) {
        const float u = (float)(i % SIDE) / (SIDE - 1), v = (float)(i / SIDE) / (SIDE - 1);
        const float x = 8 * u, z = 8 * v;
        positions[i][0] = x;
        positions[i][1] = height_m * sinf(x) * sinf(z);
        positions[i][2] = z;
        vec3 normal = {-height_m * cosf(x) * sinf(z), 1, -height_m * sinf(x) * cosf(z)};
        glm_vec3_normalize_to(normal, normals[i]);
        uv[i][0] = u;
        uv[i][1] = v;
        joints[i][1] = 1;
        weights[i][1] = glm_clamp_zo(2 * u - .5f);
        weights[i][0] = 1 - weights[i][1];
    }
    uint32_t *c = corners;
    for (uint32_t z = 0; z + 1 < SIDE; z++)
        for (uint32_t x = 0; x + 1 < SIDE; x++, c += 6) {
            const uint32_t a = z * SIDE + x;
            memcpy(c, (uint32_t[]){a, a + SIDE, a + 1, a + 1, a + SIDE, a + SIDE + 1},
                   6 * sizeof *c);
        }
}

static int put(const char *type, int component, size_t count, const void *data, size_t size) {
    return gn_maker_accessor(&maker, type, component, count, data, size, NULL);
}

/* skin: a bend of the ground's right half; count: corners of its triangles. */
static void add_ground(bool skin, size_t count, const char *material) {
    static const float times[] = {0, 1}, turns[] = {0, 0, 0, 1, 0, 0, .6f, .8f};
    const int p = put("VEC3", 5126, VERTICES, positions, sizeof positions),
              n = put("VEC3", 5126, VERTICES, normals, sizeof normals),
              t = put("VEC2", 5126, VERTICES, uv, sizeof uv),
              i = put("SCALAR", 5125, count, corners, count * sizeof *corners);
    char more[80] = "", json[300];
    if (skin)
        snprintf(more, sizeof more, ",'JOINTS_0':%d,'WEIGHTS_0':%d",
                 put("VEC4", 5123, VERTICES, joints, sizeof joints),
                 put("VEC4", 5126, VERTICES, weights, sizeof weights));
    snprintf(json, sizeof json,
             "{'primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d,'TEXCOORD_0':%d%s},"
             "'indices':%d%s}]}",
             p, n, t, more, i, material);
    gn_maker_add(&maker, "meshes", json);
    gn_maker_add(&maker, "nodes", skin ? "{'mesh':0,'skin':0}" : "{'mesh':0}");
    gn_maker_add(&maker, "scenes", skin ? "{'nodes':[0,1,2]}" : "{'nodes':[0]}");
    if (!skin) return;
    gn_maker_add(&maker, "nodes", "{}");
    gn_maker_add(&maker, "nodes", "{}");
    gn_maker_add(&maker, "skins", "{'joints':[1,2]}");
    snprintf(json, sizeof json,
             "{'channels':[{'sampler':0,'target':{'node':2,'path':'rotation'}}],"
             "'samplers':[{'input':%d,'output':%d}]}",
             put("SCALAR", 5126, 2, times, sizeof times),
             put("VEC4", 5126, 2, turns, sizeof turns));
    gn_maker_add(&maker, "animations", json);
}

static int begin(void **state) {
    (void)state;
    memset(&warnings, 0, sizeof warnings);
    gn_maker_init(&maker);
    return 0;
}

static struct gn_scene *load_ground(float height_m, bool skin, size_t count, const char *material) {
    if (!gn_meshopt_is_read()) skip();
    make_ground(height_m);
    add_ground(skin, count, material);
    return load();
}

/* Squared distance to a triangle, by its planes: another way than that of level_error.c. */
static double distance2_to(const double p[3], double c[3][3]) {
    double least = INFINITY, n[3], e[3][3], d[3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) e[i][k] = c[(i + 1) % 3][k] - c[i][k];
    for (int k = 0; k < 3; k++)
        n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        double along = 0, length2 = 0, across = 0, off2 = 0;
        for (int k = 0; k < 3; k++) d[k] = p[k] - c[i][k];
        for (int k = 0; k < 3; k++) {
            along += d[k] * e[i][k];
            length2 += e[i][k] * e[i][k];
            across +=
                n[k] * (e[i][(k + 1) % 3] * d[(k + 2) % 3] - e[i][(k + 2) % 3] * d[(k + 1) % 3]);
        }
        inside &= across >= 0;
        const double share = length2 > 0 ? fmin(fmax(along / length2, 0), 1) : 0;
        for (int k = 0; k < 3; k++) off2 += pow(d[k] - share * e[i][k], 2);
        least = fmin(least, off2);
    }
    double up = 0, n2 = 0;
    for (int k = 0; k < 3; k++) {
        up += n[k] * d[k];
        n2 += n[k] * n[k];
    }
    return inside && n2 > 0 ? fmin(least, up * up / n2) : least;
}

/* Of every `step`th vertex of the whole mesh, the largest distance from a level, as it is posed. */
static double farthest(const struct gn_scene *scene, const struct gn_pose *pose,
                       const struct gn_detail *detail, const struct gn_level *level,
                       uint32_t step) {
    double most = 0;
    for (uint32_t v = 0; v < scene->buffers.vertex_count; v += step) {
        double p[3], c[3][3], least = INFINITY;
        gn_pose_vertex(pose, 0, v, p, NULL);
        for (uint32_t i = 0; i < level->index_count; i += 3) {
            for (uint32_t k = 0; k < 3; k++)
                gn_pose_vertex(pose, 0, detail->indices[level->first_index + i + k], c[k], NULL);
            least = fmin(least, distance2_to(p, c));
        }
        most = fmax(most, least);
    }
    return sqrt(most);
}

static struct gn_detail *make(const struct gn_scene *scene) {
    struct gn_detail *detail = gn_detail_make(scene, NULL);
    assert_non_null(detail);
    assert_true(detail->geometries[0].count > 1);
    return detail;
}

static void a_level_has_fewer_triangles_and_a_larger_error(void **state) {
    (void)state;
    struct gn_scene *scene = load_ground(.3f, false, CORNERS, "");
    struct gn_detail *detail = make(scene);
    const struct gn_levels *levels = &detail->geometries[0];
    uint32_t count = CORNERS;
    float error_m = 0;
    for (uint32_t i = 0; i < levels->count; i++) {
        const struct gn_level *level = &levels->at[i];
        assert_true(level->index_count < count && level->error_m > error_m);
        assert_true(level->vertex_count < VERTICES);
        count = level->index_count;
        error_m = level->error_m;
    }
    gn_detail_destroy(detail);
    gn_scene_destroy(scene);
}

/* Of every `step`th vertex, at so many times of the clip, or at rest. */
static void expect_near(bool skin, int times_count, uint32_t step) {
    struct gn_scene *scene = load_ground(.3f, skin, CORNERS, "");
    struct gn_detail *detail = make(scene);
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    for (int t = 0; t < times_count; t++) {
        if (skin) gn_pose_step(&pose, (int64_t)t * 107000000);
        for (uint32_t i = 0; i < detail->geometries[0].count; i++) {
            const struct gn_level *level = &detail->geometries[0].at[i];
            const double off_m = farthest(scene, &pose, detail, level, step);
            if (off_m > OFF_MOST * (double)level->error_m)
                fail_msg("level %u, time %d: %g m, it states %g", i, t, off_m,
                         (double)level->error_m);
        }
    }
    gn_pose_finish(&pose);
    gn_detail_destroy(detail);
    gn_scene_destroy(scene);
}

static void no_vertex_is_further_off_than_its_level_states(void **state) {
    (void)state;
    expect_near(false, 1, 29);
}

static void a_skin_is_as_near_at_ten_times_of_its_clip(void **state) {
    (void)state;
    expect_near(true, TIMES, 131);
}

/* The ground is flat at rest: without its poses it would be two triangles at an error of 0. */
static void what_a_skin_bends_is_not_flat(void **state) {
    (void)state;
    struct gn_scene *scene = load_ground(0, true, CORNERS, "");
    struct gn_detail *detail = gn_detail_make(scene, NULL);
    for (uint32_t i = 0; detail && i < detail->geometries[0].count; i++)
        assert_true(detail->geometries[0].at[i].error_m > .01f);
    gn_detail_destroy(detail);
    gn_scene_destroy(scene);
}

static void open_edges_stay_whole(void **state) {
    (void)state;
    struct gn_scene *scene = load_ground(.3f, false, CORNERS, "");
    struct gn_detail *detail = make(scene);
    for (uint32_t i = 0; i < detail->geometries[0].count; i++) {
        const struct gn_level *level = &detail->geometries[0].at[i];
        bool used[VERTICES] = {false};
        for (uint32_t k = 0; k < level->index_count; k++)
            used[detail->indices[level->first_index + k]] = true;
        for (uint32_t v = 0; v < VERTICES; v++)
            if (v % SIDE == 0 || v % SIDE == SIDE - 1 || v < SIDE || v >= VERTICES - SIDE)
                assert_true(used[v]);
    }
    gn_detail_destroy(detail);
    gn_scene_destroy(scene);
}

static void a_mesh_of_few_triangles_is_whole(void **state) {
    (void)state;
    struct gn_scene *scene = load_ground(.3f, false, 3 * (GN_LEVEL_TRIANGLES - 1), "");
    assert_null(gn_detail_make(scene, NULL));
    gn_scene_destroy(scene);
}

static void what_is_blended_keeps_its_triangles(void **state) {
    (void)state;
    gn_maker_set(&maker, "materials",
                 "[{'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.5]}}]");
    struct gn_scene *scene = load_ground(.3f, false, CORNERS, ",'material':0");
    assert_null(gn_detail_make(scene, NULL));
    gn_scene_destroy(scene);
}

static void work_that_is_cancelled_makes_nothing(void **state) {
    (void)state;
    const atomic_bool cancel = true;
    struct gn_scene *scene = load_ground(.3f, false, CORNERS, "");
    assert_null(gn_detail_make(scene, &cancel));
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_level_has_fewer_triangles_and_a_larger_error, begin),
        cmocka_unit_test_setup(no_vertex_is_further_off_than_its_level_states, begin),
        cmocka_unit_test_setup(a_skin_is_as_near_at_ten_times_of_its_clip, begin),
        cmocka_unit_test_setup(what_a_skin_bends_is_not_flat, begin),
        cmocka_unit_test_setup(open_edges_stay_whole, begin),
        cmocka_unit_test_setup(a_mesh_of_few_triangles_is_whole, begin),
        cmocka_unit_test_setup(what_is_blended_keeps_its_triangles, begin),
        cmocka_unit_test_setup(work_that_is_cancelled_makes_nothing, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
