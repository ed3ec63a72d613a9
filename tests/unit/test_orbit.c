/* The eye moved by hand. */
#include <cglm/cglm.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "core/embedded.h"
#include "frame/frame.h"
#include "gltf_maker.h"

enum { NEAR_CAMERA, FLAT_CAMERA, TOP_CAMERA };
static const float YFOV = 1.0f;
static const struct gn_framing_opts SHAPE = {.aspect = 1.5f};

static struct gn_scene *scene;
static struct gn_pose pose;
static struct gn_frame *frame;

/* A cube of 2 m round the origin; cameras 10 m in front of it and above it. */
static int setup(void **state) {
    (void)state;
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':1,'znear':0.5,'zfar':12}},"
                 "{'type':'orthographic','orthographic':{'xmag':2,'ymag':2,'znear':9,'zfar':11}}]");
    gn_maker_set(
        &maker, "nodes",
        "[{'mesh':1},{'camera':0,'translation':[0,0,10]},{'camera':1,'translation':[0,0,10]},"
        "{'camera':0,'translation':[0,10,0],'rotation':[-0.70710678,0,0,0.70710678]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    const struct gn_caps caps = {.max_texture_px = 4096};
    frame = gn_frame_create(scene, &caps);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    return 0;
}

static void assert_near(float a, float b, float tolerance) {
    if (!(fabsf(a - b) <= tolerance)) fail_msg("%g is not %g", (double)a, (double)b);
}

/* Where the eye is, and where it sees the origin. */
static void assert_eye(const struct gn_orbit *o, uint32_t camera, float x, float y, float z) {
    struct gn_framing at;
    vec3 origin = {0, 0, 0}, seen;
    gn_orbit_view(o, &pose, camera, &SHAPE, &at);
    const float expected[3] = {x, y, z};
    for (int k = 0; k < 3; k++) assert_near(at.eye_ws[k], expected[k], 1e-4f);
    glm_mat4_mulv3(at.view_from_world, origin, 1, seen);
    assert_near(seen[0], 0, 1e-4f);
    assert_near(seen[1], 0, 1e-4f);
    assert_near(seen[2], -sqrtf(x * x + y * y + z * z), 1e-4f);
}

static struct gn_orbit step(struct gn_orbit o, struct gn_orbit_hand hand, uint32_t camera) {
    return gn_orbit_step(&o, &hand, &pose, camera, &SHAPE);
}

static void test_no_orbit_is_the_camera_itself(void **state) {
    (void)state;
    const struct gn_orbit none = {0};
    mat4 view;
    vec3 eye;
    struct gn_framing same;
    assert_true(gn_orbit_is_zero(&none));
    gn_pose_view(&pose, NEAR_CAMERA, view, eye);
    gn_orbit_view(&none, &pose, NEAR_CAMERA, &SHAPE, &same);
    assert_memory_equal(view, same.view_from_world, sizeof view);
    assert_memory_equal(eye, same.eye_ws, sizeof eye);
    const struct gn_orbit still = step(none, (struct gn_orbit_hand){0}, NEAR_CAMERA);
    assert_true(gn_orbit_is_zero(&still));
}

static void test_the_eye_goes_round_what_it_looks_at(void **state) {
    (void)state;
    const float s = 10 * sqrtf(0.5f);
    assert_eye(&(struct gn_orbit){.yaw_rad = GLM_PI_2f}, NEAR_CAMERA, 10, 0, 0);
    assert_eye(&(struct gn_orbit){.yaw_rad = -GLM_PIf}, NEAR_CAMERA, 0, 0, -10);
    assert_eye(&(struct gn_orbit){.pitch_rad = GLM_PI_4f}, NEAR_CAMERA, 0, s, s);
    assert_eye(&(struct gn_orbit){.yaw_rad = GLM_PI_2f, .pitch_rad = GLM_PI_4f}, NEAR_CAMERA, s, s,
               0);
}

static void test_what_is_dragged_follows_the_hand(void **state) {
    (void)state;
    const struct gn_orbit none = {0};
    struct gn_orbit o = step(none, (struct gn_orbit_hand){.turn = {.5f, 0}}, NEAR_CAMERA);
    assert_eye(&o, NEAR_CAMERA, -10, 0, 0); /* its front went to the right */
    o = step(none, (struct gn_orbit_hand){.turn = {0, -.25f}}, NEAR_CAMERA);
    assert_eye(&o, NEAR_CAMERA, 0, 10 * sqrtf(.5f), 10 * sqrtf(.5f)); /* its top came nearer */
}

/* The origin is seen a quarter of the picture's height to the right and an eighth up, then. */
static void test_a_pan_is_as_long_as_the_hand_moves(void **state) {
    (void)state;
    for (uint32_t camera = NEAR_CAMERA; camera <= FLAT_CAMERA; camera++) {
        struct gn_orbit o = {.yaw_rad = .7f, .pitch_rad = .3f, .zoom = .4f};
        struct gn_framing at;
        vec3 origin = {0, 0, 0}, seen;
        o = step(o, (struct gn_orbit_hand){.pan = {.25f, .125f}}, camera);
        gn_orbit_view(&o, &pose, camera, &SHAPE, &at);
        glm_mat4_mulv3(at.view_from_world, origin, 1, seen);
        const float d = 10 * expf(-.4f);
        const float height = camera == FLAT_CAMERA ? 4 * expf(-.4f) : 2 * d * tanf(YFOV / 2);
        assert_near(seen[0], .25f * height, 1e-4f);
        assert_near(seen[1], .125f * height, 1e-4f);
        assert_near(seen[2], camera == FLAT_CAMERA ? -10 : -d, 1e-4f);
    }
}

static void test_the_eye_stays_below_the_pole(void **state) {
    (void)state;
    struct gn_orbit o = {0};
    struct gn_framing at;
    for (int i = 0; i < 100; i++)
        o = step(o, (struct gn_orbit_hand){.turn = {.01f, -.1f}}, NEAR_CAMERA);
    gn_orbit_view(&o, &pose, NEAR_CAMERA, &SHAPE, &at);
    assert_true(at.eye_ws[1] > 9.99f && at.eye_ws[1] < 10);
    assert_true(at.view_from_world[1][1] > 0);                           /* its up is up */
    o = step(o, (struct gn_orbit_hand){.turn = {0, .25f}}, NEAR_CAMERA); /* no way back wasted */
    gn_orbit_view(&o, &pose, NEAR_CAMERA, &SHAPE, &at);
    assert_near(at.eye_ws[1], 10 * sinf(1.56f - GLM_PI_4f), 1e-3f);
    o = step((struct gn_orbit){0}, (struct gn_orbit_hand){.turn = {0, -.1f}}, TOP_CAMERA);
    assert_near(o.pitch_rad, 0, 1e-6f); /* which is on it, and stays as it stands */
}

static void test_zoom_has_its_ends(void **state) {
    (void)state;
    struct gn_orbit o =
        step((struct gn_orbit){0}, (struct gn_orbit_hand){.zoom = logf(2)}, NEAR_CAMERA);
    assert_eye(&o, NEAR_CAMERA, 0, 0, 5);
    o = step(o, (struct gn_orbit_hand){.zoom = 100}, NEAR_CAMERA);
    assert_eye(&o, NEAR_CAMERA, 0, 0, 1); /* twice the near plane */
    o = step(o, (struct gn_orbit_hand){.zoom = -1000}, NEAR_CAMERA);
    assert_near(o.zoom, -3.9f, 1e-6f);
    o = step(o, (struct gn_orbit_hand){.zoom = 1000}, FLAT_CAMERA);
    float half[2];
    gn_orbit_ortho_half(&o, &scene->cameras[FLAT_CAMERA], 2, half);
    assert_near(half[1], 2 * expf(-6.9f), 1e-6f);
    assert_near(half[0], 2 * half[1], 1e-6f);
}

static void test_the_hand_stays_within_limits(void **state) {
    (void)state;
    const struct gn_framing_opts limits = {.aspect = 1.5f,
                                           .phi_min_rad = GLM_PI_4f,
                                           .phi_max_rad = GLM_PI_2f,
                                           .distance_min_m = 5,
                                           .distance_max_m = 20};
    struct gn_orbit o = {0};
    struct gn_framing at;
    for (int end = -1; end <= 1; end += 2) {
        const struct gn_orbit_hand hand = {.turn = {0, -(float)end}, .zoom = (float)end * 100};
        o = gn_orbit_step(&o, &hand, &pose, NEAR_CAMERA, &limits);
        gn_orbit_view(&o, &pose, NEAR_CAMERA, &limits, &at);
        assert_near(at.eye_ws[1], end < 0 ? 0 : 5 * sqrtf(.5f), 1e-3f);
        assert_near(at.eye_ws[2], end < 0 ? 20 : 5 * sqrtf(.5f), 1e-3f);
    }
}

static void test_a_hand_gone_wild_leaves_numbers(void **state) {
    (void)state;
    struct gn_orbit o = {0};
    const struct gn_orbit_hand wild = {{1e30f, -1e30f}, {1e30f, 1e30f}, -1e30f};
    struct gn_framing at;
    for (int i = 0; i < 3; i++) o = step(o, wild, NEAR_CAMERA);
    gn_orbit_view(&o, &pose, NEAR_CAMERA, &SHAPE, &at);
    for (int k = 0; k < 3; k++) assert_true(fabsf(at.eye_ws[k]) < 1e6f);
}

/* From where the camera's own planes would cut the cube off. */
static void test_all_of_the_scene_is_seen_from_everywhere(void **state) {
    (void)state;
    static const struct gn_orbit orbits[] = {{.yaw_rad = 1.2f, .pitch_rad = .5f, .zoom = -3},
                                             {.yaw_rad = 2.5f, .shift_m = {0, .3f, 0}}};
    for (uint32_t camera = NEAR_CAMERA; camera <= FLAT_CAMERA; camera++)
        for (int i = 0; i < 2; i++) {
            const struct gn_frame_opts opts = {.view.camera = (int)camera, .view.orbit = orbits[i]};
            const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
            const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
            for (int corner = 0; corner < 8; corner++) {
                vec4 at = {corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1, 1}, clip;
                glm_mat4_mulv((vec4 *)last->constants, at, clip); /* PASS_CLIP stands first */
                assert_true(fabsf(clip[2]) <= clip[3]);
            }
        }
}

/* Of a scene with a lawn of 200 m, a box at its rim and one in front of the other side of that. */
static void load_lawn(const char *nodes) {
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':1,'znear':0.1,'zfar':500}}]");
    gn_maker_set(&maker, "nodes", nodes);
    json_t *list = json_object_get(maker.root, "nodes"), *all = json_array();
    for (size_t i = 0; i < json_array_size(list); i++)
        json_array_append_new(all, json_integer((json_int_t)i));
    json_object_set_new(json_array_get(json_object_get(maker.root, "scenes"), 0), "nodes", all);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    scene = gn_maker_load(&maker, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, GN_POSE_NONE);
}

/* How far off a camera turns about, once it is moved. */
static float turns_about_m(uint32_t camera) {
    const struct gn_orbit o =
        step((struct gn_orbit){0}, (struct gn_orbit_hand){.turn = {.01f, 0}}, camera);
    struct gn_framing at;
    return gn_orbit_view(&o, &pose, camera, &SHAPE, &at);
}

static void test_a_close_up_goes_round_what_it_shows(void **state) {
    (void)state;
    static const char rest[] = "{'mesh':0,'scale':[100,1,100]},"
                               "{'camera':0,'translation':[80,1,6]},"
                               "{'camera':0,'translation':[80,90,6],"
                               "'rotation':[0.70710678,0,0,0.70710678]}]";
    char nodes[400];
    static const struct {
        const char *first;
        float distance_m;
    } cases[] = {
        {"{'mesh':1,'translation':[80,1,0]}", 5},
        {"{'mesh':1,'translation':[80,1,0],'scale':[1,1,-1]}", 5}, /* mirrored */
        {"{'mesh':1,'translation':[80,1,0],'rotation':[0,1,0,0]}", 5},
        {"{'mesh':0,'translation':[80,1,3],'rotation':[-0.70710678,0,0,0.70710678]},"
         "{'mesh':1,'translation':[80,1,0]}",
         5}, /* the back of a wall is not seen */
        {"{'mesh':0,'translation':[80,1,3],'rotation':[0.70710678,0,0,0.70710678]},"
         "{'mesh':1,'translation':[80,1,0]}",
         3},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(nodes, sizeof nodes, "[%s,%s", cases[i].first, rest);
        load_lawn(nodes);
        assert_near(turns_about_m(0), cases[i].distance_m, 1e-3f);
    }
    assert_near(turns_about_m(1), .5f * glm_vec3_distance(scene->box.min, scene->box.max),
                1e-3f); /* the sky */

    /* what is in the middle of the picture stays there */
    const struct gn_orbit o =
        step((struct gn_orbit){0}, (struct gn_orbit_hand){.turn = {.3f, .1f}}, 0);
    struct gn_framing at;
    vec3 middle = {80, 1, 3}, seen;
    gn_orbit_view(&o, &pose, 0, &SHAPE, &at);
    glm_mat4_mulv3(at.view_from_world, middle, 1, seen);
    assert_near(seen[0], 0, 1e-3f);
    assert_near(seen[1], 0, 1e-3f);
    assert_near(seen[2], -3, 1e-3f);
    const struct gn_orbit further = step(o, (struct gn_orbit_hand){.turn = {.4f, 0}}, 0);
    assert_true(further.distance_m == o.distance_m);
}

/* Both cameras look at the dial, and go round it, by hand and by a given angle. */
static void test_the_default_scene_turns_about_its_dial(void **state) {
    (void)state;
    const struct gn_embedded *file = gn_embedded_find("sundial.glb");
    struct gn_err err = {0};
    if (!file) skip();
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    scene = gn_scene_load_bytes("sundial", file->data, file->size, NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    const int garden = gn_scene_find_camera(scene, "Garden", &err),
              dial = gn_scene_find_camera(scene, "Dial", &err);
    assert_true(turns_about_m((uint32_t)dial) < 4); /* the scene's radius is 100 times as long */
    assert_near(turns_about_m((uint32_t)garden), 7.67f, .01f);
    for (int i = 0; i < 2; i++) {
        const struct gn_framing_opts opts = {.aspect = 16.0f / 9, .given = GN_FRAMING_THETA};
        struct gn_framing at;
        gn_framing_build(&pose, (uint32_t)(i ? dial : garden), &opts, &at);
        assert_in_range((uint32_t)(100 * at.distance_m), 200, 850);
        vec3 forward = {-at.view_from_world[0][2], -at.view_from_world[1][2],
                        -at.view_from_world[2][2]};
        glm_vec3_muladds(forward, at.distance_m, at.eye_ws);
        assert_true(hypotf(at.eye_ws[0], at.eye_ws[2]) < 1.42f); /* the plate's radius */
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_orbit_is_the_camera_itself),
        cmocka_unit_test(test_the_eye_goes_round_what_it_looks_at),
        cmocka_unit_test(test_what_is_dragged_follows_the_hand),
        cmocka_unit_test(test_a_pan_is_as_long_as_the_hand_moves),
        cmocka_unit_test(test_the_eye_stays_below_the_pole),
        cmocka_unit_test(test_zoom_has_its_ends),
        cmocka_unit_test(test_the_hand_stays_within_limits),
        cmocka_unit_test(test_a_hand_gone_wild_leaves_numbers),
        cmocka_unit_test(test_all_of_the_scene_is_seen_from_everywhere),
        cmocka_unit_test(test_a_close_up_goes_round_what_it_shows),
        cmocka_unit_test(test_the_default_scene_turns_about_its_dial),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
