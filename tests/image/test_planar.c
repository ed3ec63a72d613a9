/* Planar shadows, by a mask and by the stencil: against ray-traced truth on their plane, with every
 * kind of light and whichever way the plane looks; and what must hold to the last pixel. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/frame.h"
#include "image/planar_scene.h"
#include "image/shot.h"
#include "image/truth.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

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

#define PLANAR(...)                                                                                \
    (struct gn_frame_opts) {                                                                       \
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique), .technique = GN_TECHNIQUE_PLANAR},      \
        __VA_ARGS__                                                                                \
    }

/* What draws them; the tests go through both. */
enum { MASK, STENCIL, WAYS };
static const char *const way_names[WAYS] = {"mask", "stencil"};

/* Into `picture`, of floats. */
static void shoot(const struct gn_scene *scene, int way, const struct gn_frame_opts *more) {
    struct gn_frame_opts opts = *more;
    opts.shadow.planar_in_stencil = way == STENCIL;
    struct gn_err err = {0};
    struct gn_pose pose;
    opts.output.width_px = WIDTH;
    opts.output.height_px = HEIGHT;
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

struct faults {
    double acne, leak, gap, wrong; /* per cent of what is dark or lit, or of the plane */
    int astray;                    /* pixels */
};

/* Of a shot of visibility. Off the plane, away from where the rasteriser may see something else
 * than the ray, it is 1. lit: of the truth, with all off the plane. */
static struct faults faults_of(const char *name, struct gn_truth *truth, const uint8_t *on_plane,
                               const float *edges) {
    struct gn_picture shot;
    struct gn_mask_score score;
    struct faults f = {.astray = 0};
    uint64_t plane = 0;
    gn_picture_init(&shot, WIDTH, HEIGHT, 1);
    for (int i = 0; i < PIXELS; i++) {
        shot.data[i] = picture[4 * i];
        plane += on_plane[i];
        f.astray += !on_plane[i] && edges[i] > 1 && shot.data[i] < 1;
    }
    gn_mask_compare(&truth->mask, shot.data, shot.channels, &score);
    score.pixels = plane;
    f.acne = gn_mask_acne(&score), f.leak = gn_mask_leak(&score);
    f.gap = gn_mask_gap(&score), f.wrong = gn_mask_wrong(&score);
    printf("%-28s %4.1f %% dark; acne %.4f leak %.4f gap %.3f wrong %.4f; %d px astray\n", name,
           100.0 * (double)score.dark / (double)plane, f.acne, f.leak, f.gap, f.wrong, f.astray);
    bool ok = f.acne <= .02 && f.leak <= .02 && f.gap <= 3 && f.wrong <= .15 && f.astray == 0;
    if (!ok) gn_mask_save(NULL, name, &truth->mask, &shot);
    gn_picture_finish(&shot);
    assert_true(ok);
    return f;
}

/* Compares visibility with truth on the plane, drawn both ways: the stencil has no texels to be
 * wrong by. Returns how much of the plane is truly dark, in per cent; where that is none, nothing
 * may be. */
static double compare(const char *name, const struct gn_scene *scene) {
    static uint8_t lit[PIXELS], on_plane[PIXELS];
    static float edges[PIXELS];
    struct gn_truth truth;
    struct faults faults[WAYS];
    int plane = 0, dark = 0;
    find_truth(&truth, scene);
    gn_truth_band(&truth, 1024);
    gn_mask_edges(&truth.mask, edges);
    for (int i = 0; i < PIXELS; i++) {
        on_plane[i] = is_on_plane(&truth, scene, i);
        lit[i] = truth.mask.lit[i] || !on_plane[i];
        plane += on_plane[i];
        dark += !lit[i];
    }
    assert_true(plane > PIXELS / 5);
    truth.mask.lit = lit;
    for (int way = 0; way < WAYS; way++) {
        char full[60];
        snprintf(full, sizeof full, "%s-%s", name, way_names[way]);
        shoot(scene, way, &PLANAR(.debug.aov = GN_AOV_VISIBILITY));
        faults[way] = faults_of(full, &truth, on_plane, edges);
        for (int i = 0; i < PIXELS && !dark; i++) assert_true(picture[4 * i] == 1);
        for (int i = 0; i < PIXELS && way == STENCIL; i++)
            assert_true(picture[4 * i] == 0 || picture[4 * i] == 1);
    }
    assert_true(faults[STENCIL].acne == 0 && faults[STENCIL].leak == 0);
    assert_true(faults[STENCIL].gap <= faults[MASK].gap);
    assert_true(faults[STENCIL].wrong <= faults[MASK].wrong);
    gn_truth_finish(&truth);
    return 100.0 * dark / plane;
}

static void test_lights_and_planes_of_all_kinds_agree_with_truth(void **state) {
    (void)state;
    for (size_t l = 0; l < GN_PLANAR_LIGHTS; l++)
        for (size_t t = 0; t < GN_PLANAR_TURNS; t++) {
            char name[40];
            snprintf(name, sizeof name, "planar-%s-%s", gn_planar_lights[l].name,
                     gn_planar_turns[t].name);
            struct gn_scene *scene =
                gn_planar_scene(gn_planar_turns[t].turn, &gn_planar_lights[l], gn_planar_things);
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
    struct gn_scene *scene = gn_planar_scene(gn_planar_turns[0].turn, &gn_planar_lights[1], behind);
    assert_true(compare("planar-behind", scene) == 0);
    gn_scene_destroy(scene);
    scene = gn_planar_scene(gn_planar_turns[0].turn, &gn_planar_lights[1], through);
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
    struct gn_scene *scene = gn_planar_scene(gn_planar_turns[0].turn, &gn_planar_lights[0], table);
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
static void expect_two_shades(const char *nodes, int suns, int way) {
    static float edges[PIXELS];
    struct gn_scene *scene = gn_planar_scene(gn_planar_turns[0].turn, &gn_planar_lights[0], nodes);
    struct gn_truth truth;
    float shades[2] = {0, 0};
    int counts[2] = {0, 0};
    assert_int_equal(scene->light_count, suns);
    struct gn_frame_opts opts = PLANAR(.output.floats = true);
    GN_LIGHT_SET(&opts.shadow.any, strength, 0.7f);
    shoot(scene, way, &opts);
    find_truth(&truth, scene);
    gn_mask_edges(&truth.mask, edges);
    for (int i = 0; i < PIXELS; i++) {
        if (truth.mask.item[i] < 0 || edges[i] < 4) continue;
        int lit = truth.mask.lit[i] || !is_on_plane(&truth, scene, i);
        if (!counts[lit]++) shades[lit] = picture[4 * i];
        assert_true(fabsf(picture[4 * i] - shades[lit]) < 1e-3f * shades[lit]);
    }
    assert_true(counts[0] > 1500 && counts[1] > 50000);
    float ambient = scene->environment.sky[0], sun = 3.0f / GLM_PIf * (float)suns * 0.863868f;
    assert_true(fabsf(shades[1] - (ambient + sun)) < 2e-3f * shades[1]);
    assert_true(fabsf(shades[0] - (ambient + 0.3f * sun)) < 2e-3f * shades[1]);
    gn_truth_finish(&truth);
    gn_scene_destroy(scene);
}

static void test_overlapping_casters_darken_once(void **state) {
    (void)state;
    for (int way = 0; way < WAYS; way++) expect_two_shades(pile, 1, way);
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
                 gn_planar_lights[0].node);
    for (int way = 0; way < WAYS; way++) expect_two_shades(nodes, 6, way);
}

/* ---- lights among others ---- */

/* A sun, a lamp and a spot at once, over things that overlap. */
static struct gn_scene *make_three(const char *turn) {
    char nodes[3000];
    snprintf(nodes, sizeof nodes, "%s", gn_planar_things);
    for (int i = 1; i < 3; i++)
        snprintf(nodes + strlen(nodes), sizeof nodes - strlen(nodes),
                 ",{'mesh':0,'scale':[0.001,0.001,0.001],%s,'extensions':{'KHR_lights_punctual':{"
                 "'light':%d}}}",
                 gn_planar_lights[i].node, i);
    struct gn_planar_light three = gn_planar_lights[0];
    three.light = GN_PLANAR_SUN "," GN_PLANAR_POINT "," GN_PLANAR_SPOT;
    return gn_planar_scene(turn, &three, nodes);
}

/* Draws with the lights of these bits alone. */
static void shoot_lights(struct gn_scene *scene, unsigned bits, int way,
                         const struct gn_frame_opts *opts) {
    vec3 colors[3];
    assert_int_equal(scene->light_count, 3);
    for (int i = 0; i < 3; i++) {
        glm_vec3_copy(scene->lights[i].color, colors[i]);
        if (!(bits >> i & 1)) glm_vec3_zero(scene->lights[i].color);
    }
    shoot(scene, way, opts);
    for (int i = 0; i < 3; i++) glm_vec3_copy(colors[i], scene->lights[i].color);
}

/* All at once is what each adds to none, to less than a byte of the picture shows. */
static void expect_sum(struct gn_scene *scene, const struct gn_frame_opts *opts) {
    static float sum[4 * PIXELS], none[4 * PIXELS];
    shoot_lights(scene, 0, STENCIL, opts);
    memcpy(none, picture, sizeof none);
    memcpy(sum, picture, sizeof sum);
    for (unsigned i = 0; i < 3; i++) {
        shoot_lights(scene, 1u << i, STENCIL, opts);
        for (int k = 0; k < 4 * PIXELS; k++) sum[k] += picture[k] - none[k];
    }
    shoot_lights(scene, 7, STENCIL, opts);
    for (int k = 0; k < 4 * PIXELS; k++)
        assert_true(fabsf(picture[k] - sum[k]) <= fmaxf(1.0f, picture[k]) / 255);
}

static void test_lights_at_once_are_the_sum_of_single_ones(void **state) {
    (void)state;
    static const char *const mixed[3] = {"planar", "pcf", "planar"};
    struct gn_scene *scene = make_three(gn_planar_turns[1].turn);
    struct gn_frame_opts opts = PLANAR(.output.floats = true, .exposure_given = true);
    expect_sum(scene, &opts);
    GN_LIGHT_SET(&opts.shadow.any, strength, 0.4f);
    expect_sum(scene, &opts);
    for (int i = 0; i < 3; i++) scene->lights[i].technique = mixed[i];
    expect_sum(scene, &(struct gn_frame_opts){.output.floats = true, .exposure_given = true});
    gn_scene_destroy(scene);
}

/* Away from the edges of shadows, where the mask is soft, both ways show one picture; antialiased,
 * too, and then edges have shades between. */
static void test_both_ways_show_one_picture(void **state) {
    (void)state;
    static float mask[4 * PIXELS], plain[4 * PIXELS];
    struct gn_scene *scene = make_three(gn_planar_turns[0].turn);
    int smoothed = 0;
    for (uint32_t msaa = 0; msaa <= 4; msaa += 4) {
        const struct gn_frame_opts opts = PLANAR(.output.floats = true, .exposure_given = true,
                                                 .exposure_ev = -3, .output.msaa = msaa);
        int apart = 0;
        shoot(scene, MASK, &opts);
        memcpy(mask, picture, sizeof mask);
        shoot(scene, STENCIL, &opts);
        for (int i = 0; i < PIXELS; i++)
            apart += fabsf(picture[4 * i] - mask[4 * i]) > fmaxf(1.0f, mask[4 * i]) / 255;
        printf("msaa %u: %.2f %% of the pixels apart\n", msaa, 100.0 * apart / PIXELS);
        assert_in_range(apart, PIXELS / 1000, PIXELS / 25);
        if (msaa == 0) memcpy(plain, picture, sizeof plain);
    }
    for (int i = 0; i < PIXELS; i++)
        smoothed += fabsf(picture[4 * i] - plain[4 * i]) > 0.05f * plain[4 * i];
    printf("%.2f %% of the pixels smoothed\n", 100.0 * smoothed / PIXELS);
    if (gn_gl_caps(gl)->has & 1u << GN_CAP_MSAA4) assert_true(smoothed > PIXELS / 200);
    gn_scene_destroy(scene);
}

/* Lit from below, where the things are, and seen from above. */
static void test_the_other_side_of_the_plane(void **state) {
    (void)state;
    static const struct gn_planar_light below = {"below", GN_PLANAR_POINT,
                                                 "'translation':[-1,-4,1.5]"};
    static const char hanging[] = ",{'mesh':1,'translation':[-3,-0.8,-2],'scale':[0.6,0.6,0.6]}"
                                  ",{'mesh':0,'translation':[1,-1.5,-1]}"
                                  ",{'mesh':1,'translation':[2,2,2]}";
    struct gn_scene *scene = gn_planar_scene(gn_planar_turns[0].turn, &below, hanging);
    for (uint32_t i = 0; i < scene->item_count; i++)
        if (scene->items[i].plane) scene->items[i].casts = false;
    assert_true(compare("planar-below", scene) > 1);
    gn_scene_destroy(scene);
}

static bool shot_by(const char *backend, struct gn_picture *shot) {
    struct gn_err err = {0};
    const char *args[] = {"--backend", backend,    "--size",  "640x360", "--shadow",
                          "planar",    "--planar", "stencil", NULL};
    bool ok = gn_shot(shot, NULL, &err, "png", "assets/bench/yard.glb", args);
    if (!ok && !strstr(err.text, "not built in")) fail_msg("%s", err.text);
    return ok;
}

static void test_backends_agree_on_the_stencil(void **state) {
    (void)state;
    struct gn_picture egl, osmesa;
    struct gn_difference d;
    if (!shot_by("osmesa", &osmesa)) skip();
    assert_true(shot_by("egl", &egl));
    bool alike = gn_compare(&osmesa, &egl, 1.001 / 255, &d);
    printf("%.4f %% of the pixels apart, at most %.4f\n", 100 * d.share, d.max);
    gn_picture_finish(&egl);
    gn_picture_finish(&osmesa);
    assert_true(alike && d.share <= .001);
}

static uint32_t draws_at(struct gn_frame *frame, struct gn_pose *pose, int64_t time_ns) {
    const struct gn_frame_opts opts = {
        .output.width_px = WIDTH,
        .output.height_px = HEIGHT,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique), .technique = GN_TECHNIQUE_PLANAR}};
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
        cmocka_unit_test(test_lights_at_once_are_the_sum_of_single_ones),
        cmocka_unit_test(test_both_ways_show_one_picture),
        cmocka_unit_test(test_the_other_side_of_the_plane),
        cmocka_unit_test(test_backends_agree_on_the_stencil),
        cmocka_unit_test(test_masks_are_drawn_when_something_moved),
    };
    return cmocka_run_group_tests_name("planar", tests, open_gl, close_gl);
}
