/* Cameras in pictures of any shape. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>

#include "framing_help.h"
#include "unit/scene_help.h"

static const float SHAPES[] = {9.0f / 16, 1, 16.0f / 9, 32.0f / 9};
enum { SHAPE_COUNT = 4 };

/* All of the clips is in the picture, and fills it: nothing could be nearer. */
static void assert_framed(const struct gn_scene *scene, int clips, bool turns) {
    for (int i = 0; i < SHAPE_COUNT; i++) {
        const struct gn_framing_opts opts = {.aspect = SHAPES[i], .turns = turns};
        const float reach = help_framing_reach(scene, clips, &opts);
        if (!(reach <= .95f && reach > (turns ? .7f : .87f)))
            fail_msg("clips %d, picture of %.3g: reaches to %g", clips, (double)SHAPES[i],
                     (double)reach);
    }
}

static void load_framed(int clips, bool turns) {
    struct gn_scene *scene = load();
    assert_true(scene->added.camera);
    assert_framed(scene, clips, turns);
    gn_scene_destroy(scene);
}

/* A cube as a thing of any size at any place; returns its node. */
static int add_box(const char *node) {
    gn_maker_cube(&maker);
    const int at = gn_maker_add(&maker, "nodes", node);
    gn_maker_set(&maker, "scenes", "[{'nodes':[1]}]");
    return at;
}

/* A clip of that node; values: count times 3, or 4 for rotations. */
static void add_clip(int node, const char *path, size_t count, const float *times,
                     const float *values) {
    const bool turns = strcmp(path, "rotation") == 0;
    const int input =
        gn_maker_accessor(&maker, "SCALAR", 5126, count, times, count * sizeof *times, NULL);
    const int output = gn_maker_accessor(&maker, turns ? "VEC4" : "VEC3", 5126, count, values,
                                         count * (turns ? 4 : 3) * sizeof *values, NULL);
    char json[200];
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d}],"
             "'channels':[{'sampler':0,'target':{'node':%d,'path':'%s'}}]}",
             input, output, node, path);
    gn_maker_add(&maker, "animations", json);
}

static void test_things_of_every_form_fill_pictures_of_every_form(void **state) {
    (void)state;
    static const char *const nodes[] = {
        "{'mesh':1}",
        "{'mesh':1,'scale':[10,0.2,0.2]}",
        "{'mesh':1,'scale':[0.2,10,0.2]}",
        "{'mesh':1,'scale':[0.2,0.2,10]}",
        "{'mesh':1,'scale':[6,0.01,6],'translation':[1000,-500,20]}",
        "{'mesh':1,'scale':[1e-4,3e-4,1e-4]}",
        "{'mesh':1,'scale':[5,1,1],'rotation':[0.3,0.2,0.7,0.6164414]}",
    };
    for (size_t i = 0; i < sizeof nodes / sizeof nodes[0]; i++)
        for (int turns = 0; turns < 2; turns++) {
            if (i > 0 || turns > 0) setup(NULL);
            add_box(nodes[i]);
            load_framed(GN_POSE_DEFAULT, turns);
        }
}

/* Far away in the middle of the clip, and nowhere near at its ends. */
static void test_a_clip_is_in_the_picture_at_all_its_times(void **state) {
    (void)state;
    const float times[] = {0, 3.1f, 3.15f, 3.2f, 20};
    const float moves[] = {0, 0, 0, 0, 0, 0, 30, 12, 0, 0, 0, 0, 0, 0, 0};
    add_clip(add_box("{'mesh':1}"), "translation", 5, times, moves);
    struct gn_scene *scene = load();
    assert_framed(scene, 0, false);
    assert_framed(scene, GN_POSE_DEFAULT, false);
    assert_framed(scene, GN_POSE_NONE, false); /* which stands, and is seen from near */
    gn_scene_destroy(scene);
}

static float depth_of(const struct gn_pose *pose) {
    const struct gn_framing_opts opts = {.aspect = 1};
    struct gn_framing framing;
    gn_framing_build(pose, 0, &opts, &framing);
    return framing.eye_ws[2];
}

/* From a pose that stands to a clip that goes far and back: the camera goes as the fade does,
 * without a jump at its ends nor where another choice breaks it off. */
static void test_the_camera_fades_with_the_pose(void **state) {
    (void)state;
    const float times[] = {0, 1, 2}, moves[] = {0, 0, 0, 30, 12, 0, 0, 0, 0};
    add_clip(add_box("{'mesh':1}"), "translation", 3, times, moves);
    struct gn_scene *scene = load();
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    const float near_m = depth_of(&pose);
    gn_pose_choose_fading(&pose, 0, -1);
    assert_float_equal(depth_of(&pose), near_m, 1e-4);
    float last_m = near_m;
    for (int i = 1; i < 8; i++) {
        pose.at.fade = (float)i / 8;
        assert_true(depth_of(&pose) > last_m);
        last_m = depth_of(&pose);
    }
    for (int i = 0; i < 20; i++) {
        gn_pose_choose_fading(&pose, i % 2 ? 0 : GN_POSE_NONE, i % 3 ? -1 : 0);
        assert_float_equal(depth_of(&pose), last_m, 1e-3);
        pose.at.fade = .25f;
        last_m = depth_of(&pose);
    }
    gn_pose_choose_over(&pose, GN_POSE_NONE, 0);
    const float over_m = depth_of(&pose); /* as far as the clip over the others goes */
    gn_pose_choose(&pose, 0);
    assert_float_equal(over_m, depth_of(&pose), 1e-4);
    assert_true(over_m > near_m + 1);
    gn_pose_choose(&pose, GN_POSE_NONE);
    assert_true(depth_of(&pose) == near_m);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

static void test_what_turns_between_keys_stays_in_the_picture(void **state) {
    (void)state;
    const float times[] = {0, 1, 2}, turns[] = {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, -1};
    add_clip(add_box("{'mesh':1,'scale':[9,0.1,0.1]}"), "rotation", 3, times, turns);
    load_framed(GN_POSE_DEFAULT, false);
}

/* The second moves what the first moves, at another pace. */
static void test_clips_of_two_lengths_meet_in_the_picture(void **state) {
    (void)state;
    const float times[] = {0, .7f, 1.4f}, moves[] = {0, 0, 0, 9, 0, 0, 0, 0, 0};
    const float slow[] = {0, 2, 4}, up[] = {0, 0, 0, 0, 9, 0, 0, 0, 0};
    const int child = add_box("{'mesh':1}");
    char parent[60];
    snprintf(parent, sizeof parent, "{'children':[%d]}", child);
    const int node = gn_maker_add(&maker, "nodes", parent);
    snprintf(parent, sizeof parent, "[{'nodes':[%d]}]", node);
    gn_maker_set(&maker, "scenes", parent);
    add_clip(node, "translation", 3, times, moves);
    add_clip(child, "translation", 3, slow, up);
    load_framed(GN_POSE_DEFAULT, false);
}

/* Of a sphere, whose farthest points lie between the directions that are looked at. */
static void test_round_things_do_not_touch_the_border(void **state) {
    (void)state;
    enum { RINGS = 40, SIDES = 80, COUNT = (RINGS + 1) * SIDES };
    static float points[COUNT][3];
    static uint16_t indices[RINGS * SIDES * 6];
    size_t used = 0;
    for (int i = 0; i < COUNT; i++) {
        const float up = GLM_PIf * (float)(i / SIDES) / RINGS;
        const float round = 2 * GLM_PIf * (float)(i % SIDES) / SIDES;
        points[i][0] = sinf(up) * cosf(round);
        points[i][1] = cosf(up);
        points[i][2] = sinf(up) * sinf(round);
    }
    for (int i = 0; i < RINGS * SIDES; i++) {
        const int next = i / SIDES * SIDES + (i + 1) % SIDES;
        const int corners[] = {i, next, i + SIDES, next, next + SIDES, i + SIDES};
        for (int k = 0; k < 6; k++) indices[used++] = (uint16_t)corners[k];
    }
    const int at = gn_maker_accessor(&maker, "VEC3", 5126, COUNT, points, sizeof points, NULL);
    const int by = gn_maker_accessor(&maker, "SCALAR", 5123, used, indices, sizeof indices, NULL);
    char json[120];
    snprintf(json, sizeof json, "[{'primitives':[{'attributes':{'POSITION':%d},'indices':%d}]}]",
             at, by);
    gn_maker_set(&maker, "meshes", json);
    load_framed(GN_POSE_DEFAULT, false);
}

static void test_a_scene_with_nothing_to_see_has_a_camera_too(void **state) {
    (void)state;
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'scale':[0,0,0]}]");
    struct gn_scene *scene = load();
    assert_true(
        help_framing_reach(scene, GN_POSE_DEFAULT, &(struct gn_framing_opts){.aspect = 1}) == 0);
    assert_int_equal(scene->extents[0].count, 8);
    gn_scene_destroy(scene);
}

/* A file's camera: its own picture is whole in every other. */
static void test_a_narrow_picture_keeps_the_horizontal_angle(void **state) {
    (void)state;
    static const char *const cameras[] = {
        "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'aspectRatio':1.5}}]",
        "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1}}]"};
    for (int own = 0; own < 2; own++) {
        if (own > 0) setup(NULL);
        gn_maker_set(&maker, "cameras", cameras[own]);
        gn_maker_set(&maker, "nodes", "[{'mesh':0},{'camera':0,'translation':[0,1,9]}]");
        gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
        struct gn_scene *scene = load();
        struct gn_pose pose;
        struct gn_framing framing;
        gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
        for (int i = 0; i < SHAPE_COUNT; i++) {
            gn_framing_build(&pose, 0, &(struct gn_framing_opts){.aspect = SHAPES[i]}, &framing);
            const float shape = own == 0 ? 1.5f : SHAPES[i] < 1 ? 16.0f / 9 : 0;
            const float wide = tanf(.4f) * shape / SHAPES[i], high = tanf(.4f);
            assert_near(tanf(framing.camera.yfov_rad / 2), fmaxf(wide, high));
            assert_near(framing.eye_ws[2], 9);
        }
        gn_framing_build(&pose, 0, &(struct gn_framing_opts){.aspect = 1.5f}, &framing);
        assert_true(framing.camera.yfov_rad == .8f); /* to the bit */
        gn_pose_finish(&pose);
        gn_scene_destroy(scene);
    }
}

static void frame_at(struct gn_scene *scene, const struct gn_framing_opts *opts,
                     struct gn_framing *framing) {
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_framing_build(&pose, scene->camera_count - 1, opts, framing);
    gn_pose_finish(&pose);
}

/* The camera that was made goes with the fade, from what frames a still scene to what frames its
 * clip. */
static void test_a_fade_between_clips_takes_the_camera_along(void **state) {
    (void)state;
    const float times[] = {0, 1, 2}, moves[] = {0, 0, 0, 0, 30, 12, 0, 0, 0};
    add_clip(add_box("{'mesh':1}"), "translation", 3, times, moves);
    struct gn_scene *scene = load();
    const struct gn_framing_opts opts = {.aspect = 1};
    const float fades[] = {0, .25f, .5f, .75f, 1};
    float away[5];
    struct gn_pose pose;
    struct gn_framing still, framing;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    gn_framing_build(&pose, scene->camera_count - 1, &opts, &still);
    gn_pose_choose_fading(&pose, 0, -1);
    for (int i = 0; i < 5; i++) {
        pose.at.fade = fades[i];
        gn_framing_build(&pose, scene->camera_count - 1, &opts, &framing);
        away[i] = glm_vec3_distance(framing.eye_ws, still.eye_ws);
        vec3 back; /* the view is that of the eye */
        glm_mat4_mulv3(framing.view_from_world, framing.eye_ws, 1, back);
        assert_true(glm_vec3_norm(back) < 1e-4f);
    }
    assert_true(away[0] < 1e-5f && away[4] > 1);
    for (int i = 1; i < 5; i++) assert_true(away[i] > away[i - 1]);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

static void assert_at(const struct gn_framing *framing, float x, float y, float z) {
    const float expected[] = {x, y, z};
    for (int k = 0; k < 3; k++)
        if (!(fabsf(framing->eye_ws[k] - expected[k]) < 1e-3f))
            fail_msg("%d: %g is not %g", k, (double)framing->eye_ws[k], (double)expected[k]);
}

/* A camera of a file 9 m before the square, and one that is added. */
static void test_a_given_place_takes_that_of_the_camera(void **state) {
    (void)state;
    struct gn_framing f;
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1}}]");
    gn_maker_set(&maker, "nodes", "[{'mesh':0},{'camera':0,'translation':[0,0,9]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    struct gn_scene *scene = load();
    frame_at(scene, &(struct gn_framing_opts){.given = GN_FRAMING_THETA, .theta_rad = GLM_PI_2f},
             &f);
    assert_at(&f, 9, 0, 0); /* its distance and its height stay */
    frame_at(scene,
             &(struct gn_framing_opts){.given = GN_FRAMING_PHI | GN_FRAMING_DISTANCE,
                                       .phi_rad = GLM_PI_4f,
                                       .distance_m = 2},
             &f);
    assert_at(&f, 0, sqrtf(2), sqrtf(2));
    const float target[3] = {1, 2, 3};
    struct gn_framing_opts opts = {.given = GN_FRAMING_TARGET | GN_FRAMING_FOV, .yfov_rad = .5f};
    memcpy(opts.target_ws, target, sizeof target);
    frame_at(scene, &opts, &f);
    assert_at(&f, 1, 2, 12);
    assert_near(f.camera.yfov_rad, .5f);
    vec3 seen;
    glm_mat4_mulv3(f.view_from_world, (float *)target, 1, seen);
    assert_true(fabsf(seen[0]) < 1e-4f && fabsf(seen[1]) < 1e-4f && fabsf(seen[2] + 9) < 1e-4f);
    gn_scene_destroy(scene);
}

/* A square of 800 m to the horizon, and over it the dome of a sky: the camera is turned about what
 * it looks at, which is near the middle. The dome does not count; a shadow on it would. */
static void test_a_scene_to_the_horizon_is_turned_about_its_middle(void **state) {
    (void)state;
    static const char *const extras[] = {"'gnomon_cast':false,'gnomon_receive':false",
                                         "'gnomon_cast':false"};
    for (int is_seen = 0; is_seen < 2; is_seen++) {
        char nodes[400];
        struct gn_framing f;
        if (is_seen) setup(NULL);
        snprintf(nodes, sizeof nodes,
                 "[{'mesh':0,'scale':[400,1,400]},"
                 "{'camera':0,'translation':[0,1,9]},"
                 "{'mesh':0,'scale':[400,1,400],'translation':[0,300,0],'extras':{%s}}]",
                 extras[is_seen]);
        gn_maker_set(&maker, "cameras",
                     "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1}}]");
        gn_maker_set(&maker, "nodes", nodes);
        gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
        struct gn_scene *scene = load();
        assert_true((scene->box.max[1] > 100) == (is_seen > 0));
        frame_at(scene,
                 &(struct gn_framing_opts){.given = GN_FRAMING_THETA, .theta_rad = GLM_PI_2f}, &f);
        if (is_seen)
            assert_true(f.distance_m > 100);
        else
            assert_at(&f, 9, 1, 0);
        gn_scene_destroy(scene);
    }
}

/* The cube of 2 m through a camera at that node. */
static struct gn_scene *load_seen(const char *camera, const char *node) {
    char json[300];
    snprintf(json, sizeof json, "[%s]", camera);
    gn_maker_set(&maker, "cameras", json);
    gn_maker_cube(&maker);
    snprintf(json, sizeof json, "[{'mesh':1},%s]", node);
    gn_maker_set(&maker, "nodes", json);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    return load();
}

static void test_how_much_of_the_model_a_camera_sees(void **state) {
    (void)state;
    static const char eye[] = "{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1}}",
                      flat[] = "{'type':'orthographic','orthographic':"
                               "{'xmag':1.7,'ymag':0.5,'znear':0.1,'zfar':20}}",
                      near_sighted[] = "{'type':'perspective','perspective':"
                                       "{'yfov':0.8,'znear':0.1,'zfar':8.5}}";
    static const struct {
        const char *camera, *node;
        float least, most;
        bool cuts;
    } cases[] = {
        {eye, "{'camera':0,'translation':[0,0,9]}", 1, 1, false},
        {eye, "{'camera':0,'translation':[0,0,-9]}", 0, 0, true},
        {eye, "{'camera':0,'translation':[0,0,2]}", .2f, .8f, true},
        {eye, "{'camera':0,'translation':[0,0,0.9]}", .1f, .6f, false}, /* inside */
        {flat, "{'camera':0,'translation':[0,0,9]}", .9f, 1, true},     /* 1.9 m high, then */
        {near_sighted, "{'camera':0,'translation':[0,0,9]}", .2f, .3f, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bool cuts;
        struct gn_pose pose;
        if (i > 0) setup(NULL);
        struct gn_scene *scene = load_seen(cases[i].camera, cases[i].node);
        gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
        const float share = gn_framing_share(&pose, 0, &cuts);
        if (!(share >= cases[i].least && share <= cases[i].most) || cuts != cases[i].cuts)
            fail_msg("case %zu: %g, %d", i, (double)share, cuts);
        gn_pose_finish(&pose);
        gn_scene_destroy(scene);
    }
}

static void test_a_camera_that_is_replaced_shows_all(void **state) {
    (void)state;
    struct gn_scene *scene =
        load_seen("{'type':'orthographic','orthographic':{'xmag':1,'ymag':1,'znear':1,'zfar':2}}",
                  "{'camera':0,'translation':[0,0,-9]}");
    assert_false(scene->added.camera);
    for (int i = 0; i < SHAPE_COUNT; i++) {
        const struct gn_framing_opts opts = {.aspect = SHAPES[i], .made_plus_1 = 1};
        const float reach = help_framing_reach(scene, GN_POSE_DEFAULT, &opts);
        if (!(reach <= .95f && reach > .87f)) fail_msg("%g", (double)reach);
    }
    struct gn_framing f;
    frame_at(scene, &(struct gn_framing_opts){.made_plus_1 = 2}, &f); /* another one is */
    assert_at(&f, 0, 0, -9);
    gn_scene_destroy(scene);
}

static void test_an_added_camera_still_shows_all_from_a_given_side(void **state) {
    (void)state;
    add_box("{'mesh':1,'scale':[5,1,1],'translation':[3,2,1]}");
    struct gn_scene *scene = load();
    static const unsigned given[] = {GN_FRAMING_THETA, GN_FRAMING_PHI, GN_FRAMING_TARGET,
                                     GN_FRAMING_FOV,
                                     GN_FRAMING_THETA | GN_FRAMING_PHI | GN_FRAMING_TARGET};
    for (size_t i = 0; i < sizeof given / sizeof given[0]; i++)
        for (int k = 0; k < SHAPE_COUNT; k++) {
            const struct gn_framing_opts opts = {.aspect = SHAPES[k],
                                                 .given = given[i],
                                                 .theta_rad = -2,
                                                 .phi_rad = .4f,
                                                 .target_ws = {4, 2, 1},
                                                 .yfov_rad = 1.2f};
            const float reach = help_framing_reach(scene, GN_POSE_DEFAULT, &opts);
            if (!(reach <= .95f && reach > .87f)) fail_msg("%zu: reaches to %g", i, (double)reach);
        }
    struct gn_framing f; /* near, inside: the planes hold the rest */
    frame_at(scene, &(struct gn_framing_opts){.given = 7, .phi_rad = GLM_PI_2f, .distance_m = 3},
             &f);
    assert_at(&f, 3, 2, 4);
    assert_true(f.camera.near_m > 0 && f.camera.near_m < 2 && f.camera.far_m > 4);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_things_of_every_form_fill_pictures_of_every_form, setup),
        cmocka_unit_test_setup(test_a_clip_is_in_the_picture_at_all_its_times, setup),
        cmocka_unit_test_setup(test_the_camera_fades_with_the_pose, setup),
        cmocka_unit_test_setup(test_what_turns_between_keys_stays_in_the_picture, setup),
        cmocka_unit_test_setup(test_clips_of_two_lengths_meet_in_the_picture, setup),
        cmocka_unit_test_setup(test_round_things_do_not_touch_the_border, setup),
        cmocka_unit_test_setup(test_a_scene_with_nothing_to_see_has_a_camera_too, setup),
        cmocka_unit_test_setup(test_a_given_place_takes_that_of_the_camera, setup),
        cmocka_unit_test_setup(test_a_scene_to_the_horizon_is_turned_about_its_middle, setup),
        cmocka_unit_test_setup(test_how_much_of_the_model_a_camera_sees, setup),
        cmocka_unit_test_setup(test_a_camera_that_is_replaced_shows_all, setup),
        cmocka_unit_test_setup(test_an_added_camera_still_shows_all_from_a_given_side, setup),
        cmocka_unit_test_setup(test_a_fade_between_clips_takes_the_camera_along, setup),
        cmocka_unit_test_setup(test_a_narrow_picture_keeps_the_horizontal_angle, setup),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
