/* The near and far planes of a picture: as near as the file's camera or beyond it, and never beyond
 * a surface in view, for cameras of both kinds, wherever they stand. */
#include <cglm/cglm.h>
#include <math.h>
#include <string.h>

#include "frame/frame.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { CUBES = 12, CAMERAS = 400, POINTS = 9 };

static uint32_t seed;

static float random_between(float a, float b) {
    seed = seed * 1664525u + 1013904223u;
    return a + (b - a) * (float)(seed >> 8) / 16777216.0f;
}

/* Turned cubes of all sizes about the origin, over a floor of the file or an unseen one; a camera
 * in node 0. */
static struct gn_scene *load_cubes(const char *camera, bool unseen) {
    const struct gn_scene_limits limits = {.floor.kind = unseen ? GN_FLOOR_AUTO : GN_FLOOR_NONE};
    struct gn_maker maker;
    struct gn_err err = {0};
    char text[300], roots[200];
    snprintf(roots, sizeof roots, "[{'nodes':[0%s", unseen ? "" : ",1");
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_add(&maker, "cameras", camera);
    gn_maker_set(&maker, "nodes", "[{'camera':0},{'mesh':0,'scale':[9,1,9]}]");
    for (int i = 0; i < CUBES; i++) {
        const float size = expf(random_between(-4, 0)), turn = random_between(-1, 1);
        snprintf(text, sizeof text,
                 "{'mesh':1,'translation':[%g,%g,%g],'scale':[%g,%g,%g],'rotation':[0,%g,%g,%g]}",
                 (double)random_between(-5, 5), (double)random_between(0, 3),
                 (double)random_between(-5, 5), (double)size, (double)size, (double)(3 * size), 0.6,
                 (double)(0.8f * turn), (double)(0.8f * sqrtf(1 - turn * turn)));
        snprintf(roots + strlen(roots), sizeof roots - strlen(roots), ",%d", i + 2);
        gn_maker_add(&maker, "nodes", text);
    }
    strcat(roots, "]}]");
    gn_maker_set(&maker, "scenes", roots);
    struct gn_made glb = gn_maker_glb(&maker);
    struct gn_scene *scene = gn_scene_load_bytes("t", glb.data, glb.size, &limits, NULL, &err);
    free(glb.data);
    gn_maker_finish(&maker);
    if (!scene) fail_msg("%s", err.text);
    assert_true(scene->added.floor == unseen);
    return scene;
}

/* The least and the greatest depth of the points of surfaces that are in the picture. */
static void find_depths(const struct gn_pose *pose, const struct gn_framing *at, float aspect,
                        float depths_m[2]) {
    const struct gn_scene *scene = pose->scene;
    const struct gn_camera *c = &at->camera;
    depths_m[0] = INFINITY;
    depths_m[1] = 0;
    for (uint32_t i = 0; i < scene->item_count; i++) {
        const struct gn_geometry *g = &scene->geometries[scene->items[i].geometry];
        for (uint32_t k = 0; k < g->index_count; k += 3)
            for (int p = 0; p < POINTS * POINTS; p++) {
                const float u = (float)(p % POINTS) / (POINTS - 1),
                            v = (float)(p / POINTS) / (POINTS - 1);
                vec3 corner, sum = {0, 0, 0}, seen;
                const float weight[3] = {1 - u, u * (1 - v), u * v};
                for (int n = 0; n < 3; n++) {
                    gn_pose_corner(
                        pose, i, scene->buffers.indices[g->first_index + k + (uint32_t)n], corner);
                    glm_vec3_muladds(corner, weight[n], sum);
                }
                glm_mat4_mulv3((vec4 *)at->view_from_world, sum, 1, seen);
                const float depth = -seen[2], half = tanf(c->yfov_rad / 2) * depth;
                const float high = c->orthographic ? c->ymag_m : half,
                            wide = c->orthographic ? c->xmag_m : half * aspect;
                if (fabsf(seen[0]) > wide || fabsf(seen[1]) > high) continue;
                if (depth < pose->cameras[0].near_m) continue;
                depths_m[0] = fminf(depths_m[0], depth);
                depths_m[1] = fmaxf(depths_m[1], depth);
            }
    }
}

static void place_camera(struct gn_scene *scene, float distance_m) {
    struct gn_node *node = &scene->nodes[scene->cameras[0].node];
    const float pitch = random_between(-1.2f, 1.2f), yaw = random_between(-3, 3);
    vec3 to = {random_between(-2, 2), random_between(0, 2), random_between(-2, 2)};
    glm_vec3_muladds((vec3){sinf(yaw) * cosf(pitch), sinf(pitch), cosf(yaw) * cosf(pitch)},
                     distance_m, to);
    glm_vec3_copy(to, node->translation);
    versor a, b;
    glm_quat(a, yaw, 0, 1, 0);
    glm_quat(b, -pitch, 1, 0, 0);
    glm_quat_mul(a, b, node->rotation);
}

static void check_cameras(const char *camera, bool unseen, float least_gain) {
    const struct gn_frame_view_opts view = {0};
    const float aspect = 1.6f;
    int raised = 0, seen = 0;
    seed = 7;
    struct gn_scene *scene = load_cubes(camera, unseen);
    const float file_near_m = scene->cameras[0].near_m;
    for (int i = 0; i < CAMERAS; i++) {
        struct gn_pose pose;
        struct gn_framing at;
        float depths_m[2];
        place_camera(scene, expf(random_between(-2, 4)));
        gn_pose_init(&pose, scene, GN_POSE_NONE);
        gn_frame_camera(&pose, &view, aspect, &at);
        find_depths(&pose, &at, aspect, depths_m);
        assert_true(at.camera.near_m >= file_near_m);
        assert_true(at.camera.far_m > at.camera.near_m);
        if (isfinite(depths_m[0])) {
            if (!(at.camera.near_m <= depths_m[0])) fail_msg("camera %d: beyond a surface", i);
            if (!(at.camera.far_m >= depths_m[1])) fail_msg("camera %d: far plane cuts", i);
            raised += at.camera.orthographic
                          ? at.camera.far_m - at.camera.near_m < least_gain * depths_m[1]
                          : at.camera.near_m > least_gain * file_near_m;
            seen++;
        }
        gn_pose_finish(&pose);
    }
    print_message("%d of %d near planes well placed\n", raised, seen);
    assert_true(seen > CAMERAS / 2);
    assert_true(raised > seen / 2);
    gn_scene_destroy(scene);
}

static void test_a_near_plane_cuts_no_surface_in_view(void **state) {
    (void)state;
    check_cameras("{'type':'perspective','perspective':{'yfov':1,'znear':0.000001}}", false, 1e4f);
    check_cameras("{'type':'perspective','perspective':{'yfov':0.3,'znear':1e-12,'zfar':100}}",
                  false, 1e6f);
}

static void test_an_orthographic_range_holds_what_is_in_view(void **state) {
    (void)state;
    check_cameras(
        "{'type':'orthographic','orthographic':{'xmag':2,'ymag':2,'znear':0,'zfar':50000}}", false,
        4);
}

/* However near the file's far plane, if it has the model in its range. */
static void test_an_unseen_floor_is_not_cut(void **state) {
    (void)state;
    check_cameras("{'type':'perspective','perspective':{'yfov':1,'znear':0.000001}}", true, 1e4f);
    check_cameras("{'type':'perspective','perspective':{'yfov':1,'znear':0.000001,'zfar':80}}",
                  true, 1e4f);
    check_cameras("{'type':'orthographic','orthographic':{'xmag':9,'ymag':9,'znear':0,'zfar':80}}",
                  true, 16);
}

static void test_without_a_surface_in_view_planes_stay(void **state) {
    (void)state;
    seed = 7;
    struct gn_scene *scene = load_cubes(
        "{'type':'perspective','perspective':{'yfov':1,'znear':0.001,'zfar':50}}", false);
    const struct gn_frame_view_opts view = {0};
    struct gn_pose pose;
    struct gn_framing at;
    glm_vec3_copy((vec3){0, 0, 30}, scene->nodes[scene->cameras[0].node].translation);
    glm_quat(scene->nodes[scene->cameras[0].node].rotation, 3.14159f, 0, 1, 0);
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    gn_frame_camera(&pose, &view, 1, &at);
    assert_true(at.camera.near_m == 0.001f && at.camera.far_m == 50);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_near_plane_cuts_no_surface_in_view),
        cmocka_unit_test(test_an_orthographic_range_holds_what_is_in_view),
        cmocka_unit_test(test_an_unseen_floor_is_not_cut),
        cmocka_unit_test(test_without_a_surface_in_view_planes_stay),
    };
    return RUN(tests);
}
