/* Planar shadows: against ray-traced truth on their plane, with every kind of light and whichever
 * way the plane looks; and what must hold to the last pixel. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/plan.h"
#include "image/truth.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

enum { WIDTH = 640, HEIGHT = 480, PIXELS = WIDTH * HEIGHT };

static struct gn_display display;
static struct gn_gl *gl;
static float picture[4 * PIXELS];

static int open_gl(void **state) {
    (void)state;
    help_open(&display, "egl");
    gl = help_gl(&display, NULL, NULL);
    return 0;
}

static int close_gl(void **state) {
    (void)state;
    gn_gl_destroy(gl);
    gn_display_close(&display);
    return 0;
}

/* ---- scenes ---- */

/* Beside mesh 0, a square: mesh 1 is a cube, of 2 m as well, mesh 2 a square with square holes. */
static void add_meshes(struct gn_maker *m) {
    static const float uv[8] = {0, 0, 0, 1, 1, 1, 1, 0};
    gn_maker_cube(m);
    gn_maker_accessor(m, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    gn_maker_add(m, "meshes",
                 "{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':4},'indices':1,"
                 "'material':0}]}");
    gn_maker_set(m, "materials",
                 "[{'alphaMode':'MASK','doubleSided':true,'pbrMetallicRoughness':{"
                 "'metallicFactor':0,'baseColorTexture':{'index':0}}}]");
}

static void add_holes(struct gn_maker *m) {
    uint8_t texels[4 * 16];
    char image[80];
    memset(texels, 255, sizeof texels);
    for (int i = 0; i < 16; i++)
        if ((i + i / 4) % 2) texels[4 * i + 3] = 0;
    struct gn_made png = gn_maker_png(4, 4, texels);
    snprintf(image, sizeof image, "{'mimeType':'image/png','bufferView':%d}",
             gn_maker_view(m, png.data, png.size));
    free(png.data);
    gn_maker_add(m, "images", image);
    gn_maker_set(m, "samplers", "[{'magFilter':9728,'minFilter':9728}]");
    gn_maker_set(m, "textures", "[{'source':0,'sampler':0}]");
}

#define POINT "{'type':'point','intensity':100}"
#define SPOT  "{'type':'spot','intensity':100,'spot':{'outerConeAngle':0.7,'innerConeAngle':0.6}}"
#define SUN   "{'type':'directional','intensity':3}"

static const struct light {
    const char *name, *light, *node;
} lights[] = {
    {"sun", SUN, "'rotation':[-0.4334794,0.4272181,0.2454319,0.7545485]"},
    {"point", POINT, "'translation':[-1,4,1.5]"},
    {"spot", SPOT,
     "'translation':[-3,6,2],'rotation':[-0.4341391,-0.4106897,-0.2323442,0.7673808]"},
};

/* How the plane lies: quaternions that turn the whole scene. */
static const struct {
    const char *name, *turn;
} turns[] = {{"floor", "[0,0,0,1]"},
             {"tilted", "[0.2791983,0,0.1116793,0.953717]"},
             {"wall", "[0.7071068,0,0,0.7071068]"},
             {"ceiling", "[0,0,1,0]"}};

/* A ground of 10 m, the plane, with these things on it (nodes, a comma before each) and a light,
 * seen from 13 m away. */
static struct gn_scene *make(const char *turn, const struct light *light, const char *things) {
    struct gn_maker m;
    struct gn_err err = {0};
    char json[4000], children[80] = "0";
    gn_maker_init(&m);
    gn_maker_square(&m);
    add_meshes(&m);
    add_holes(&m);
    int count = 1;
    for (const char *p = things; (p = strstr(p, ",{'mesh'")); p++)
        snprintf(children + strlen(children), sizeof children - strlen(children), ",%d", count++);
    snprintf(json, sizeof json,
             "[{'mesh':0,'scale':[5,1,5],'extras':{'gnomon_plane':true}}%s,{'children':[%s,%d,%d],"
             "'rotation':%s},{%s,'extensions':{'KHR_lights_punctual':{'light':0}}},{'camera':0,"
             "'translation':[3,11,7],'rotation':[-0.4546182,0.1781011,0.0933139,0.8676951]}]",
             things, children, count + 1, count + 2, turn, light->node);
    gn_maker_set(&m, "nodes", json);
    snprintf(json, sizeof json, "[{'nodes':[%d]}]", count);
    gn_maker_set(&m, "scenes", json);
    snprintf(json, sizeof json, "{'KHR_lights_punctual':{'lights':[%s]}}", light->light);
    gn_maker_set(&m, "extensions", json);
    gn_maker_set(&m, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&m, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.5,'zfar':40}}]");
    struct gn_scene *scene = gn_maker_load(&m, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

static void shoot(const struct gn_scene *scene, const struct gn_frame_opts *more) {
    struct gn_frame_opts opts = *more;
    struct gn_err err = {0};
    struct gn_pose pose;
    opts.width_px = WIDTH;
    opts.height_px = HEIGHT;
    opts.encoding = GN_ENCODING_AUTO;
    opts.technique_given = true;
    opts.technique = GN_TECHNIQUE_PLANAR;
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    if (!gn_gl_load(gl, scene, &err)) fail_msg("%s", err.text);
    struct gn_frame *frame = gn_frame_create(scene, gn_gl_caps(gl));
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err) ||
        !gn_gl_read_f32(gl, picture, &err))
        fail_msg("%s", err.text);
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
}

static void find_truth(struct gn_truth *truth, const struct gn_scene *scene) {
    struct gn_err err = {0};
    const struct gn_truth_opts opts = {.width_px = WIDTH, .height_px = HEIGHT};
    if (!gn_truth_make(truth, scene, &opts, &err)) fail_msg("%s", err.text);
}

static bool is_on_plane(const struct gn_truth *truth, const struct gn_scene *scene, int i) {
    return truth->mask.item[i] >= 0 && scene->items[truth->mask.item[i]].plane;
}

/* ---- against truth ---- */

/* Draws visibility and compares it on the plane; elsewhere, away from where the rasteriser may see
 * something else than the ray, it is 1. Returns how much of the plane is truly dark, in per cent.
 */
static double compare(const char *name, const struct gn_scene *scene) {
    static uint8_t lit[PIXELS];
    static float edges[PIXELS];
    struct gn_truth truth;
    struct gn_picture shot;
    struct gn_mask_score score;
    int plane = 0, astray = 0;
    shoot(scene, &(struct gn_frame_opts){.aov = GN_AOV_VISIBILITY});
    find_truth(&truth, scene);
    gn_truth_band(&truth, 1024);
    gn_mask_edges(&truth.mask, edges);
    gn_picture_init(&shot, WIDTH, HEIGHT, 1);
    for (int i = 0; i < PIXELS; i++) {
        bool on_plane = is_on_plane(&truth, scene, i);
        shot.data[i] = picture[4 * i];
        lit[i] = truth.mask.lit[i] || !on_plane;
        plane += on_plane;
        astray += !on_plane && edges[i] > 1 && shot.data[i] < 1;
    }
    truth.mask.lit = lit;
    gn_mask_compare(&truth.mask, &shot, &score);
    score.pixels = (uint64_t)plane;
    double acne = gn_mask_acne(&score), leak = gn_mask_leak(&score), gap = gn_mask_gap(&score),
           wrong = gn_mask_wrong(&score), dark = 100.0 * (double)score.dark / plane;
    printf("%-20s %4.1f %% dark; acne %.4f leak %.4f gap %.3f wrong %.4f; %d px astray\n", name,
           dark, acne, leak, gap, wrong, astray);
    bool ok = acne <= .02 && leak <= .02 && gap <= 3 && wrong <= .15 && astray == 0;
    if (!ok) gn_mask_save(NULL, name, &truth.mask, &shot);
    gn_picture_finish(&shot);
    gn_truth_finish(&truth);
    assert_true(plane > PIXELS / 5);
    assert_true(ok);
    return dark;
}

/* On the plane, over it, and through it; two that overlap; one with holes. */
static const char things[] = ",{'mesh':1,'translation':[-3,0.6,-2],'scale':[0.6,0.6,0.6]}"
                             ",{'mesh':1,'translation':[-1.5,2,-3],'scale':[0.4,0.2,0.7],'rotation'"
                             ":[0.2073116,0,0.0621935,0.976296]}"
                             ",{'mesh':1,'translation':[2.5,0.3,-2.5],'scale':[0.7,0.8,0.5],'"
                             "rotation':[0.2073116,0,0.0621935,0.976296]}"
                             ",{'mesh':2,'translation':[1.5,1.2,1.5],'scale':[1.2,1,1.2],'rotation'"
                             ":[0.2073116,0,0.0621935,0.976296]}"
                             ",{'mesh':1,'translation':[-2.5,1,2.5],'scale':[0.05,1,0.05]}";

static void test_lights_and_planes_of_all_kinds_agree_with_truth(void **state) {
    (void)state;
    for (size_t l = 0; l < sizeof lights / sizeof *lights; l++)
        for (size_t t = 0; t < sizeof turns / sizeof *turns; t++) {
            char name[40];
            snprintf(name, sizeof name, "planar-%s-%s", lights[l].name, turns[t].name);
            struct gn_scene *scene = make(turns[t].turn, &lights[l], things);
            assert_true(compare(name, scene) > 2);
            gn_scene_destroy(scene);
        }
}

/* Things over the light, beside it and reaching past it, under the plane, and in the plane. */
static void test_what_is_not_between_light_and_plane_darkens_nothing(void **state) {
    (void)state;
    static const char behind[] = ",{'mesh':1,'translation':[-1,5.5,1.5],'scale':[1,0.3,1]}"
                                 ",{'mesh':1,'translation':[1,-1.5,0]}"
                                 ",{'mesh':1,'translation':[-6,-2,-6],'scale':[0.5,2,0.5]}"
                                 ",{'mesh':0,'translation':[0,-0.5,0],'scale':[3,1,3]}"
                                 ",{'mesh':0,'translation':[2,0,-1]}";
    static const char through[] = ",{'mesh':1,'translation':[2.5,3,0],'scale':[0.2,3,0.4]}"
                                  ",{'mesh':1,'translation':[-3.5,0,-2],'scale':[0.5,0.4,0.5]}";
    struct gn_scene *scene = make(turns[0].turn, &lights[1], behind);
    assert_true(compare("planar-behind", scene) == 0);
    for (int i = 0; i < PIXELS; i++) assert_true(picture[4 * i] == 1);
    gn_scene_destroy(scene);
    scene = make(turns[0].turn, &lights[1], through);
    assert_true(compare("planar-through", scene) > 1);
    gn_scene_destroy(scene);
}

/* A table on which a box casts past the edge, the floor under it, and one more square in the very
 * plane of the table. */
static void test_a_shadow_ends_with_its_plane(void **state) {
    (void)state;
    static const char table[] = ",{'mesh':1,'translation':[4.5,1.5,4.5],'scale':[0.4,1.5,0.4]}"
                                ",{'mesh':1,'translation':[-4.6,1.5,-4],'scale':[0.3,1.5,0.3]}"
                                ",{'mesh':0,'translation':[-6,0,-4]}"
                                ",{'mesh':0,'translation':[0,-2,0],'scale':[9,1,9]}";
    struct gn_scene *scene = make(turns[0].turn, &lights[0], table);
    assert_true(compare("planar-edge", scene) > 0.2);
    gn_scene_destroy(scene);
}

/* ---- exactly ---- */

static const char pile[] = ",{'mesh':0,'translation':[0,1,0],'scale':[2,1,2]}"
                           ",{'mesh':0,'translation':[0.8,1.4,0.5],'scale':[2,1,2]}"
                           ",{'mesh':0,'translation':[0.3,1.8,0.9],'scale':[2,1,2]}"
                           ",{'mesh':0,'translation':[-3,2.5,-2]}";

/* White, looks up, under so many suns: one colour in the light, also on what casts and is cast on,
 * and one in the shadow on the plane, whether one thing casts it or three. */
static void expect_two_shades(const char *nodes, int suns) {
    static float edges[PIXELS];
    struct gn_scene *scene = make(turns[0].turn, &lights[0], nodes);
    struct gn_truth truth;
    float shades[2] = {0, 0};
    int counts[2] = {0, 0};
    assert_int_equal(scene->light_count, suns);
    shoot(scene,
          &(struct gn_frame_opts){.output_float = true, .strength_given = true, .strength = 0.7f});
    find_truth(&truth, scene);
    gn_mask_edges(&truth.mask, edges);
    for (int i = 0; i < PIXELS; i++) {
        if (truth.mask.item[i] < 0 || edges[i] < 4) continue;
        int lit = truth.mask.lit[i] || !is_on_plane(&truth, scene, i);
        if (!counts[lit]++) shades[lit] = picture[4 * i];
        assert_true(fabsf(picture[4 * i] - shades[lit]) < 1e-3f * shades[lit]);
    }
    assert_true(counts[0] > 1500 && counts[1] > 50000);
    float ambient = scene->sky[0], sun = 3.0f / GLM_PIf * (float)suns * 0.863868f;
    assert_true(fabsf(shades[1] - (ambient + sun)) < 2e-3f * shades[1]);
    assert_true(fabsf(shades[0] - (ambient + 0.3f * sun)) < 2e-3f * shades[1]);
    gn_truth_finish(&truth);
    gn_scene_destroy(scene);
}

static void test_overlapping_casters_darken_once(void **state) {
    (void)state;
    expect_two_shades(pile, 1);
}

/* More than one pass takes: what is added knows what is on the plane, too. */
static void test_more_lights_than_a_pass_takes(void **state) {
    (void)state;
    char nodes[3000];
    snprintf(nodes, sizeof nodes, "%s", pile);
    for (int i = 0; i < 5; i++)
        snprintf(nodes + strlen(nodes), sizeof nodes - strlen(nodes),
                 ",{'mesh':0,'translation':[0,-9,0],%s,'extensions':{'KHR_lights_punctual':{"
                 "'light':0}}}",
                 lights[0].node);
    expect_two_shades(nodes, 6);
}

static uint32_t draws_at(struct gn_frame *frame, struct gn_pose *pose, int64_t time_ns) {
    const struct gn_frame_opts opts = {.width_px = WIDTH,
                                       .height_px = HEIGHT,
                                       .encoding = GN_ENCODING_AUTO,
                                       .technique_given = true,
                                       .technique = GN_TECHNIQUE_PLANAR};
    struct gn_err err = {0};
    gn_pose_step(pose, time_ns);
    const struct gn_plan *plan = gn_frame_build(frame, pose, &opts, NULL);
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err))
        fail_msg("%s", err.text);
    return gn_gl_stats(gl).shadow_draws;
}

static void test_masks_are_drawn_when_something_moved(void **state) {
    (void)state;
    struct gn_scene *scene = gn_stage_scene_make();
    struct gn_err err = {0};
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    if (!gn_gl_load(gl, scene, &err)) fail_msg("%s", err.text);
    struct gn_frame *frame = gn_frame_create(scene, gn_gl_caps(gl));
    assert_true(draws_at(frame, &pose, 0) > 0);
    assert_int_equal(draws_at(frame, &pose, 0), 0);
    assert_int_equal(gn_gl_stats(gl).shadow_passes_skipped, 3);
    assert_true(draws_at(frame, &pose, 1000000) > 0); /* the mover goes 1 m/s */
    assert_int_equal(draws_at(frame, &pose, 1000000), 0);
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lights_and_planes_of_all_kinds_agree_with_truth),
        cmocka_unit_test(test_what_is_not_between_light_and_plane_darkens_nothing),
        cmocka_unit_test(test_a_shadow_ends_with_its_plane),
        cmocka_unit_test(test_overlapping_casters_darken_once),
        cmocka_unit_test(test_more_lights_than_a_pass_takes),
        cmocka_unit_test(test_masks_are_drawn_when_something_moved),
    };
    return cmocka_run_group_tests_name("planar", tests, open_gl, close_gl);
}
