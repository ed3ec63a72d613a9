/* The scene at a time. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/arena.h"
#include "core/clock.h"
#include "gltf_maker.h"
#include "scene/pose.h"
#include "unit/check.h"

static struct gn_maker maker;
static struct gn_err err;
static struct gn_warnings warnings;
static struct gn_scene *scene;
static struct gn_pose pose;

enum { TIMES = 2, MOVE, TURN, SPLINE }; /* accessors */

static int setup(void **state) {
    (void)state;
    static const float times[] = {0, 1, 2}, moves[] = {0, 0, 0, 4, 0, 0, 0, 0, 8};
    static const float turns[] = {0, 0, 0, 1, 0, .70710678f, 0, .70710678f, 0, -1, 0, 0};
    static const float spline[] = {0, 0, 0, 0, 0, 0, 2, 0, 0, 4, 0, 0, 1, 0,
                                   0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
    memset(&warnings, 0, sizeof warnings);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_accessor(&maker, "SCALAR", 5126, 3, times, sizeof times, NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, 3, moves, sizeof moves, NULL);
    gn_maker_accessor(&maker, "VEC4", 5126, 3, turns, sizeof turns, NULL);
    gn_maker_accessor(&maker, "VEC3", 5126, 9, spline, sizeof spline, NULL);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'children':[1]},{'mesh':0,'translation':[0,1,0]},{'mesh':0}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,2]}]");
    return 0;
}

static int teardown(void **state) {
    (void)state;
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
    scene = NULL;
    return 0;
}

static void animate(const char *path, int output, const char *interpolation) {
    char json[300];
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d,'interpolation':'%s'}],"
             "'channels':[{'sampler':0,'target':{'node':0,'path':'%s'}}]}",
             TIMES, output, interpolation, path);
    gn_maker_add(&maker, "animations", json);
}

static void load(int clips) {
    scene = gn_maker_load(&maker, &warnings, &err);
    if (!scene) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, clips);
}

static void assert_at(double time_s, uint32_t node, float x, float y, float z) {
    gn_pose_step(&pose, (int64_t)(time_s * 1e9));
    const float *p = pose.world_from_node[node][3];
    if (fabsf(p[0] - x) > 1e-5f || fabsf(p[1] - y) > 1e-5f || fabsf(p[2] - z) > 1e-5f)
        fail_msg("at %g s: (%g %g %g), not (%g %g %g)", time_s, (double)p[0], (double)p[1],
                 (double)p[2], (double)x, (double)y, (double)z);
}

static void test_linear_and_children(void **state) {
    (void)state;
    animate("translation", MOVE, "LINEAR");
    load(GN_POSE_DEFAULT);
    assert_true(pose.animated);
    assert_true(pose.node_moves[0] && pose.node_moves[1] && !pose.node_moves[2]);
    assert_at(.5, 0, 2, 0, 0);
    assert_at(.5, 1, 2, 1, 0);
    assert_at(1.5, 0, 2, 0, 4);
    assert_at(2.5, 0, 2, 0, 0); /* loops */
    assert_at(-.5, 0, 2, 0, 4); /* before 0, too */
}

static void test_step(void **state) {
    (void)state;
    animate("translation", MOVE, "STEP");
    load(GN_POSE_DEFAULT);
    assert_at(.999, 0, 0, 0, 0);
    assert_at(1, 0, 4, 0, 0);
    assert_at(1.999, 0, 4, 0, 0);
}

/* Hermite between 0 (tangent 2) and 0 (tangent 1) over 1 s: at .5, (2 - 1) / 8... with values 0 and
 * 0 of x. */
static void test_cubic(void **state) {
    (void)state;
    animate("translation", SPLINE, "CUBICSPLINE");
    load(GN_POSE_DEFAULT);
    /* key 0: value 0, out-tangent 2; key 1: in-tangent 4, value 1 */
    assert_at(.5, 0, .5f * 1 + .125f * 2 - .125f * 4, 0, 0);
    assert_at(0, 0, 0, 0, 0);
    assert_at(1, 0, 1, 0, 0);
}

static void test_rotation_takes_the_short_way(void **state) {
    static const float none[3][4] = {{0, 0, 0, -1}, {0, 0, 0, -1}, {0, 0, 0, -1}};
    (void)state;
    animate("rotation", TURN, "LINEAR");
    animate("rotation", gn_maker_accessor(&maker, "VEC4", 5126, 3, none, sizeof none, NULL),
            "LINEAR");
    load(0);
    gn_pose_step(&pose, GN_NS_PER_S / 2); /* 45 degrees about y: x goes to (c, 0, -s) */
    assert_true(fabsf(pose.world_from_node[0][0][0] - .70710678f) < 1e-5f);
    assert_true(fabsf(pose.world_from_node[0][0][2] + .70710678f) < 1e-5f);
    gn_pose_step(&pose, GN_NS_PER_S * 3 / 2); /* 90 to 180, the second given by its negative */
    assert_true(fabsf(pose.world_from_node[0][0][0] + .70710678f) < 1e-5f);
    gn_pose_choose_fading(&pose, 1, -1); /* to none, given by its negative */
    pose.at.fade = .5f;
    gn_pose_step(&pose, GN_NS_PER_S * 3 / 2);
    assert_float_equal(pose.world_from_node[0][0][0], cos(3 * M_PI / 8), 1e-5);
}

static void test_time_is_exact_after_years(void **state) {
    (void)state;
    animate("translation", MOVE, "LINEAR");
    load(GN_POSE_DEFAULT);
    gn_pose_step(&pose, INT64_C(2) * GN_NS_PER_S * 200000000 + GN_NS_PER_S / 4); /* 12 years */
    assert_true(pose.world_from_node[0][3][0] == 1);
}

static void test_clips(void **state) {
    (void)state;
    animate("translation", MOVE, "LINEAR");
    animate("translation", SPLINE, "CUBICSPLINE");
    animate("scale", SPLINE, "CUBICSPLINE");
    load(GN_POSE_NONE);
    assert_true(scene->animation.clips[0].on_by_default &&
                !scene->animation.clips[1].on_by_default &&
                scene->animation.clips[2].on_by_default);
    assert_int_equal(scene->animation.clips[0].duration_ns, 2 * GN_NS_PER_S);
    assert_false(pose.animated);
    assert_at(.5, 0, 0, 0, 0);
    gn_pose_finish(&pose);
    gn_pose_init(&pose, scene, 0);
    assert_at(.5, 0, 2, 0, 0);
    assert_int_equal(gn_scene_find_clip(scene, "2", &err), 2);
    assert_int_equal(gn_scene_find_clip(scene, "Walk", &err), -1);
    assert_int_equal(err.status, GN_EXIT_USAGE);
}

/* A clip over others: its own time, what both move follows it, and the others hold theirs. */
static void test_a_clip_over_others(void **state) {
    (void)state;
    animate("translation", MOVE, "LINEAR");
    animate("translation", SPLINE, "CUBICSPLINE");
    animate("scale", SPLINE, "CUBICSPLINE");
    load(2);
    gn_pose_step(&pose, 3 * GN_NS_PER_S / 2);
    mat4 before;
    glm_mat4_copy(pose.world_from_node[0], before);
    gn_pose_choose_over(&pose, 2, 0);
    pose.at.over_ns = GN_NS_PER_S / 2;
    gn_pose_step(&pose, 3 * GN_NS_PER_S / 2);
    assert_true(pose.world_from_node[0][3][0] == 2); /* half a second of clip 0 */
    for (int k = 0; k < 3; k++)
        assert_true(pose.world_from_node[0][k][k] == before[k][k]); /* clip 2 at 1.5 s */
    gn_pose_choose_over(&pose, 1, 0);                               /* both move the same */
    pose.at.over_ns = GN_NS_PER_S / 2;
    gn_pose_step(&pose, 3 * GN_NS_PER_S / 2);
    assert_true(pose.world_from_node[0][3][0] == 2);
    gn_pose_choose(&pose, 2);
    gn_pose_step(&pose, 3 * GN_NS_PER_S / 2);
    assert_memory_equal(before, pose.world_from_node[0], sizeof before);
}

static void test_turns_and_speed_of_clips(void **state) {
    (void)state;
    const int64_t S = GN_NS_PER_S, years = 10 * 365 * INT64_C(86400) * S;
    const struct {
        struct gn_pose_run run;
        int64_t length_ns, time_ns, expected_ns;
    } cases[] = {
        {{GN_POSE_LOOP, 0, 0}, 2 * S, 5 * S, S},
        {{GN_POSE_LOOP, 0, 0}, 2 * S, 2 * S, 0},
        {{GN_POSE_LOOP, 0, 0}, 2 * S, -S / 2, 3 * S / 2},
        {{GN_POSE_LOOP, 0, 0}, 7 * S, years + 1, years % (7 * S) + 1},
        {{GN_POSE_LOOP, 0, 0}, 0, 5 * S, 0},
        {{GN_POSE_LOOP, .5, 0}, 2 * S, 3 * S, S / 2},
        {{GN_POSE_LOOP, -1, 0}, 2 * S, 3 * S, 0},
        {{GN_POSE_LOOP, 99, 0}, 2 * S, 3 * years / 10 + 2048000, 204800000}, /* 300 years on */
        {{GN_POSE_LOOP, 99, 0}, 2 * S, -3 * years / 10 - 2048000, 2 * S - 204800000},
        {{GN_POSE_ONCE, 99, 0}, 2 * S, 3 * years / 10, 2 * S},
        {{GN_POSE_ONCE, 99, 0}, 2 * S, -3 * years / 10, 0},
        {{GN_POSE_LOOP, 0, 3 * S / 2}, 2 * S, S, S / 2},
        {{GN_POSE_LOOP, -1, 3 * S}, 2 * S, 7 * S, S},
        {{GN_POSE_LOOP, 1, S}, 2 * S, S / 4, 3 * S / 2},
        {{GN_POSE_LOOP, 0, S}, 2 * S, -S / 2, S / 2},
        {{GN_POSE_LOOP, 0, INT64_MAX}, INT64_MAX, INT64_MAX - 1, INT64_MAX - 1},
        {{GN_POSE_ONCE, 0, S}, 2 * S, S / 2, 3 * S / 2},
        {{GN_POSE_ONCE, 0, 3 * S}, 2 * S, -2 * S, S},
        {{GN_POSE_ONCE, 0, S}, 2 * S, INT64_MAX, 2 * S},
        {{GN_POSE_ONCE, 0, S}, 2 * S, INT64_MIN, 0},
        {{GN_POSE_PING_PONG, 0, 3 * S}, 2 * S, 0, S},
        {{GN_POSE_ONCE, 0, 0}, 2 * S, S, S},
        {{GN_POSE_ONCE, 0, 0}, 2 * S, 5 * S, 2 * S},
        {{GN_POSE_ONCE, 0, 0}, 2 * S, -S, 0},
        {{GN_POSE_ONCE, 1, 0}, 2 * S, S / 2, S},
        {{GN_POSE_PING_PONG, 0, 0}, 2 * S, S, S},
        {{GN_POSE_PING_PONG, 0, 0}, 2 * S, 2 * S, 2 * S},
        {{GN_POSE_PING_PONG, 0, 0}, 2 * S, 3 * S, S},
        {{GN_POSE_PING_PONG, 0, 0}, 2 * S, 4 * S, 0},
        {{GN_POSE_PING_PONG, 0, 0}, 2 * S, -S, S},
        {{GN_POSE_PING_PONG, 0, 0}, 2 * S, 9 * S, S},
        {{GN_POSE_PING_PONG, 0, 0}, INT64_MAX, 9 * S, 9 * S},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        if (gn_pose_clip_ns(&cases[i].run, cases[i].length_ns, cases[i].time_ns) !=
            cases[i].expected_ns)
            fail_msg("case %zu", i);
    animate("translation", MOVE, "LINEAR");
    load(0);
    pose.at.run = (struct gn_pose_run){.turns = GN_POSE_PING_PONG};
    gn_pose_step(&pose, 7 * S / 2); /* as at half a second */
    assert_true(pose.world_from_node[0][3][0] == 2);
}

/* Nothing has to be drawn again: at the end of a clip that plays once, and at no speed. */
static void test_clips_that_stand(void **state) {
    (void)state;
    animate("translation", MOVE, "LINEAR");
    animate("rotation", TURN, "LINEAR");
    load(0);
    gn_pose_step(&pose, 9 * GN_NS_PER_S);
    assert_false(gn_pose_stands(&pose));
    pose.at.run = (struct gn_pose_run){.turns = GN_POSE_ONCE};
    gn_pose_step(&pose, 2 * GN_NS_PER_S - 1);
    assert_false(gn_pose_stands(&pose));
    gn_pose_step(&pose, 2 * GN_NS_PER_S);
    assert_true(gn_pose_stands(&pose));
    gn_pose_choose_fading(&pose, 0, -1);
    gn_pose_step(&pose, 2 * GN_NS_PER_S);
    assert_false(gn_pose_stands(&pose));
    gn_pose_choose_over(&pose, 0, 1);
    gn_pose_step(&pose, 2 * GN_NS_PER_S);
    assert_false(gn_pose_stands(&pose));
    gn_pose_choose(&pose, 0);
    pose.at.run = (struct gn_pose_run){.speed_less_1 = -1};
    assert_true(gn_pose_stands(&pose));
}

static float x_of(int node) { return pose.world_from_node[node][3][0]; }

/* From one clip to another: what was shown, half of each, the other. Allocates nothing. */
static void test_a_fade_between_clips(void **state) {
    const int64_t half_ns = GN_NS_PER_S / 2;
    (void)state;
    animate("translation", MOVE, "LINEAR");
    animate("rotation", TURN, "LINEAR");
    load(0);
    gn_pose_step(&pose, half_ns);
    assert_true(x_of(0) == 2);
    const unsigned long allocations = gn_alloc_count();
    gn_pose_choose_fading(&pose, 1, -1);
    gn_pose_step(&pose, half_ns);
    assert_float_equal(x_of(0), 2, 1e-5);
    assert_float_equal(pose.world_from_node[0][0][0], 1, 1e-5); /* no turn yet */
    pose.at.fade = .25f;
    gn_pose_step(&pose, GN_NS_PER_S); /* clip 1 there: a quarter turn */
    assert_float_equal(x_of(0), 1.5, 1e-5);
    const double w = .75 + .25 * sqrt(.5), y = .25 * sqrt(.5); /* by hand, before the length is 1 */
    assert_float_equal(pose.world_from_node[0][0][0], 1 - 2 * y * y / (w * w + y * y), 1e-5);
    gn_pose_choose_fading(&pose, 0, -1); /* back, in the midst of it */
    gn_pose_step(&pose, GN_NS_PER_S);
    assert_float_equal(x_of(0), 1.5, 1e-5);
    assert_float_equal(pose.world_from_node[0][0][0], 1 - 2 * y * y / (w * w + y * y), 1e-5);
    gn_pose_choose_over(&pose, 0, -1);
    gn_pose_step(&pose, half_ns);
    assert_true(x_of(0) == 2 && pose.world_from_node[0][0][0] == 1);
    assert_int_equal(gn_alloc_count(), allocations);
}

static void test_items_follow_and_nothing_is_allocated(void **state) {
    (void)state;
    animate("translation", MOVE, "LINEAR");
    load(GN_POSE_DEFAULT);
    unsigned long before = gn_alloc_count();
    gn_pose_step(&pose, 0);
    uint64_t still = 0, moved = 0;
    for (uint32_t i = 0; i < scene->item_count; i++)
        *(scene->items[i].node == 2 ? &still : &moved) = pose.items[i].hash;
    gn_pose_step(&pose, GN_NS_PER_S);
    assert_true(pose.box_ws.max[0] == 5 && pose.box_ws.min[0] == -1);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        if (scene->items[i].node == 2)
            assert_true(pose.items[i].hash == still);
        else
            assert_true(pose.items[i].hash != moved);
    }
    assert_int_equal(gn_alloc_count(), before);
}

static void test_mirrored_and_invisible(void **state) {
    (void)state;
    gn_maker_set(
        &maker, "nodes",
        "[{'mesh':0,'scale':[-1,1,1]},{'mesh':0,'scale':[0,0,0]},{'mesh':0,'scale':[1,0,1]},"
        "{'children':[4],'scale':[1e30,1,1]},{'mesh':0,'scale':[1e30,1,1]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    load(GN_POSE_DEFAULT);
    for (uint32_t i = 0; i < scene->item_count; i++) {
        uint32_t node = scene->items[i].node;
        assert_int_equal(pose.items[i].mirrored && pose.items[i].visible, node == 0);
        assert_int_equal(pose.items[i].visible,
                         node == 0 || node == 2); /* flat is still to be seen */
    }
    assert_true(pose.box_ws.max[0] == 1);
}

static void test_unusable_channels_are_left_out(void **state) {
    (void)state;
    animate("translation", TURN, "LINEAR");      /* four numbers for three */
    animate("translation", MOVE, "CUBICSPLINE"); /* a third of the values */
    animate("weights", MOVE, "LINEAR");
    load(GN_POSE_DEFAULT);
    assert_int_equal(scene->animation.clip_count, 3);
    assert_int_equal(scene->animation.channel_count, 0);
    assert_false(pose.animated);
    assert_string_equal(warnings.text[0],
                        "t: animations[0].samplers[0]: input and output do not fit each other; "
                        "channel not played");
    assert_int_equal(warnings.count, 2); /* the third has nothing to change */
}

static void test_a_matrix_that_is_animated(void **state) {
    (void)state;
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'matrix':[0,0,-2,0,0,2,0,0,2,0,0,0,1,2,3,1]},{},{}]");
    animate("translation", MOVE, "LINEAR");
    load(GN_POSE_NONE);
    assert_false(scene->nodes[0].has_matrix);
    static const float wanted[16] = {0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 2, 3, 1};
    for (int i = 0; i < 16; i++)
        assert_true(fabsf(pose.world_from_node[0][i / 4][i % 4] - wanted[i]) < 1e-5f);
}

static void test_view_and_light(void **state) {
    (void)state;
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':1,'znear':0.1}}]");
    gn_maker_set(&maker, "extensions", "{'KHR_lights_punctual':{'lights':[{'type':'spot'}]}}");
    gn_maker_set(
        &maker, "nodes",
        "[{'mesh':0},{'camera':0,'translation':[0,0,5],'scale':[2,3,4]},{'translation':[0,4,0],"
        "'rotation':[-0.70710678,0,0,0.70710678],'extensions':{'KHR_lights_punctual':{'light':0}}}"
        "]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2]}]");
    load(GN_POSE_NONE);
    mat4 view;
    vec3 eye, position, direction;
    gn_pose_view(&pose, 0, view, eye);
    assert_true(eye[2] == 5 && view[3][2] == -5 && view[0][0] == 1 && view[2][2] == 1);
    gn_pose_light(&pose, 0, position, direction);
    assert_true(position[1] == 4 && fabsf(direction[1] + 1) < 1e-6f);
    gn_pose_view(&pose, 0, view, NULL);
}

static void animate_by_pointer(const char *pointer, int output) {
    char json[400];
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':{'path':"
             "'pointer','extensions':{'KHR_animation_pointer':{'pointer':'%s'}}}}]}",
             TIMES, output, pointer);
    gn_maker_add(&maker, "animations", json);
}

static void test_a_pointer_to_a_node_is_a_channel(void **state) {
    (void)state;
    gn_maker_set(&maker, "extensionsRequired", "['KHR_animation_pointer']");
    animate_by_pointer("/nodes/0/translation", MOVE);
    load(GN_POSE_DEFAULT);
    assert_int_equal(warnings.count, 0);
    assert_at(.5, 0, 2, 0, 0);
    assert_at(1.5, 1, 2, 1, 4);
}

static void test_other_pointers_are_named_and_not_played(void **state) {
    (void)state;
    static const char *const pointers[] = {"/materials/0/emissiveFactor",
                                           "/nodes/0/name",
                                           "/nodes/3/scale",
                                           "/nodes/99999999999999999999/scale",
                                           "/nodes//scale",
                                           "/nodes/0/scale/0",
                                           ""};
    enum { COUNT = sizeof pointers / sizeof pointers[0] };
    for (int i = 0; i < COUNT; i++) animate_by_pointer(pointers[i], MOVE);
    load(GN_POSE_DEFAULT);
    assert_int_equal(scene->animation.channel_count, 0);
    assert_int_equal(warnings.count, COUNT + 1);
    for (int i = 0; i < COUNT; i++) {
        char text[160];
        snprintf(text, sizeof text, "animation of '%s' is not supported", pointers[i]);
        assert_non_null(strstr(warnings.text[i], text));
    }
    assert_string_equal(scene->missing, "animation of some properties");
}

/* ---- variants of materials ---- */

/* Square 0 is of material 0 and in variants 1 and 2 of material 1; a mapping to its own material
 * and a second one for a variant change nothing. */
static void use_variants(void) {
    gn_maker_set(&maker, "extensions",
                 "{'KHR_materials_variants':{'variants':[{'name':'red'},{'name':'blue'},{'name':"
                 "'night'}]}}");
    gn_maker_set(&maker, "materials", "[{'name':'a'},{'name':'b','alphaMode':'MASK'}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0,"
                 "'extensions':{'KHR_materials_variants':{'mappings':["
                 "{'material':0,'variants':[0]},{'material':1,'variants':[2,1]},"
                 "{'material':0,'variants':[1]}]}}}]}]");
    gn_maker_set(&maker, "nodes", "[{'mesh':0},{'mesh':0,'translation':[0,1,0]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
}

static void test_each_variant_shows_its_materials(void **state) {
    (void)state;
    use_variants();
    load(GN_POSE_DEFAULT);
    assert_int_equal(scene->variants.count, 3);
    assert_string_equal(scene->variants.names[2], "night");
    assert_int_equal(scene->item_count, 4 + scene->added.floor);
    assert_int_equal(scene->triangle_count, 4 + 2 * scene->added.floor);
    static const char *const shown[] = {"a", "a", "b", "b"};
    for (int variant = 2; variant >= -1; variant--) {
        const size_t before = gn_alloc_count();
        gn_pose_choose_variant(&pose, variant);
        assert_int_equal(gn_alloc_count(), before);
        for (uint32_t i = 0; i < scene->item_count; i++) {
            const struct gn_material *m = &scene->materials[scene->items[i].material];
            if (m->shadow_catcher) continue;
            assert_int_equal(pose.items[i].visible, strcmp(m->name, shown[variant + 1]) == 0);
        }
        assert_true(pose.box_ws.max[1] == 1 && pose.box_ws.min[1] == 0);
    }
    assert_int_equal(gn_scene_find_variant(scene, "blue", &err), 1);
    assert_int_equal(gn_scene_find_variant(scene, "green", &err), -1);
    assert_string_equal(err.text,
                        "no variant named 'green'; available: 0 'red', 1 'blue', 2 'night'");
}

static void test_variants_of_copies_lie_in_their_plane(void **state) {
    (void)state;
    use_variants();
    gn_maker_set(&maker, "nodes", "[{'mesh':0,'extras':{'gnomon_plane':true}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0]}]");
    load(GN_POSE_DEFAULT);
    assert_int_equal(scene->item_count, 2 + scene->added.floor);
    for (uint32_t i = 0; i < 2; i++) assert_int_equal(scene->items[i].plane, 1);
}

static void test_a_variant_that_is_not_there_is_ignored(void **state) {
    (void)state;
    use_variants();
    gn_maker_set(&maker, "extensions", "{'KHR_materials_variants':{'variants':[{'name':'red'}]}}");
    load(GN_POSE_DEFAULT);
    assert_non_null(strstr(warnings.text[0], "mappings[1].variants[0]: index 2, but there are 1 "
                                             "variants; ignored"));
    assert_int_equal(scene->variants.count, 1);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_linear_and_children),
        TEST(test_step),
        TEST(test_cubic),
        TEST(test_rotation_takes_the_short_way),
        TEST(test_time_is_exact_after_years),
        TEST(test_clips),
        TEST(test_a_clip_over_others),
        TEST(test_turns_and_speed_of_clips),
        TEST(test_clips_that_stand),
        TEST(test_a_fade_between_clips),
        TEST(test_items_follow_and_nothing_is_allocated),
        TEST(test_mirrored_and_invisible),
        TEST(test_unusable_channels_are_left_out),
        TEST(test_a_matrix_that_is_animated),
        TEST(test_view_and_light),
        TEST(test_a_pointer_to_a_node_is_a_channel),
        TEST(test_other_pointers_are_named_and_not_played),
        TEST(test_each_variant_shows_its_materials),
        TEST(test_variants_of_copies_lie_in_their_plane),
        TEST(test_a_variant_that_is_not_there_is_ignored),
    };
    return RUN(tests);
}
