/* Planar shadows of lamps that have a size: penumbrae against ray-traced truth, and how points of
 * the lamp are gathered from frame to frame. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "frame/frame.h"
#include "image/planar_scene.h"
#include "image/truth.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH = 640, HEIGHT = 480, PIXELS = WIDTH * HEIGHT };

static struct gn_display display;
static struct gn_gl *gl;
static float picture[4 * PIXELS];

static int open_gl(void **state) {
    (void)state;
    help_open(&display, "egl");
    /* R16F, which a mask could be, cannot be drawn to */
    gl = help_gl(&display, &(struct gn_gl_opts){.without = "r16f"}, NULL);
    return 0;
}

static int close_gl(void **state) {
    (void)state;
    gn_gl_destroy(gl);
    gn_display_close(&display);
    return 0;
}

/* ---- drawing ---- */

struct soft {
    struct gn_frame *frame;
    struct gn_pose pose;
    struct gn_frame_opts opts;
    bool is_behind;
};

/* gather: points a frame adds; 0: all. */
static void begin(struct soft *s, const struct gn_scene *scene, uint32_t points, uint32_t gather) {
    struct gn_err err = {0};
    s->opts = (struct gn_frame_opts){
        .output.width_px = WIDTH,
        .output.height_px = HEIGHT,
        .debug.aov = GN_AOV_VISIBILITY,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique), .technique = GN_TECHNIQUE_PLANAR},
        .shadow.planar_points = points,
        .shadow.gather_points = gather};
    gn_pose_init(&s->pose, scene, GN_POSE_DEFAULT);
    if (!gn_gl_load(gl, scene, &err)) fail_msg("%s", err.text);
    s->frame = gn_frame_create(scene, gn_gl_caps(gl));
}

static void end(struct soft *s) {
    gn_frame_destroy(s->frame);
    gn_pose_finish(&s->pose);
}

/* Into `picture`. Returns how many draws the maps took. */
static uint32_t draw(struct soft *s) {
    struct gn_err err = {0};
    const struct gn_plan *plan = gn_frame_build(s->frame, &s->pose, &s->opts, NULL);
    s->is_behind = plan->is_behind;
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err) ||
        !gn_gl_read_f32(gl, picture, &err))
        fail_msg("%s", err.text);
    return gn_gl_stats(gl).shadow_draws;
}

/* ---- against truth ---- */

static void find_truth(struct gn_truth *truth, const struct gn_scene *scene) {
    struct gn_err err = {0};
    const struct gn_truth_opts opts = {.width_px = WIDTH, .height_px = HEIGHT};
    if (!gn_truth_make(truth, scene, &opts, &err)) fail_msg("%s", err.text);
}

static bool is_on_plane(const struct gn_truth *truth, const struct gn_scene *scene, int i) {
    return truth->mask.item[i] >= 0 && scene->items[truth->mask.item[i]].plane;
}

/* Every so many pixels; samples: of what is partly seen by the first. */
enum { STRIDE = 5, FEW = 128, MANY = 1536 };

static float shares[PIXELS];
static int on[GN_PLANES_MAX + 1]; /* how many of them are on each plane */

/* The share of the lamp that pixels of the planes see, by MANY rays, every STRIDE pixels; -1 where
 * the first FEW see all or nothing of it, and off the planes. Returns how many are in penumbrae. */
static int find_shares(const struct gn_scene *scene) {
    struct gn_truth truth;
    struct gn_pose pose;
    struct gn_raycast rays;
    int count = 0;
    memset(on, 0, sizeof on);
    find_truth(&truth, scene);
    gn_pose_init(&pose, scene, GN_POSE_NONE);
    gn_raycast_init(&rays, scene, &pose, NULL);
    for (int i = 0; i < PIXELS; i++) {
        struct gn_ray_surface surface;
        const int x = i % WIDTH, y = i / WIDTH;
        shares[i] = -1;
        if (x % STRIDE || y % STRIDE || !is_on_plane(&truth, scene, i)) continue;
        if (!gn_raycast_eye(&rays, &truth.frame.eye, x, y, &surface)) continue;
        const double few = gn_raycast_share(&rays, &truth.frame.lamp, &surface, FEW);
        if (few <= 0 || few >= 1) continue;
        shares[i] = (float)gn_raycast_share(&rays, &truth.frame.lamp, &surface, MANY);
        on[scene->items[truth.mask.item[i]].plane]++;
        count++;
    }
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
    gn_truth_finish(&truth);
    return count;
}

/* Root mean square of visibility in `picture` less the shares. */
static double error_of(void) {
    double sum = 0;
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        if (shares[i] < 0) continue;
        sum += pow((double)picture[4 * i] - (double)shares[i], 2);
        count++;
    }
    return sqrt(sum / count);
}

static void test_penumbrae_agree_with_truth(void **state) {
    (void)state;
    static const float radii[] = {0.2f, 0.4f, 0.6f}; /* of gn_planar_lights[] */
    static const struct {
        uint32_t points;
        double most;
    } counts[] = {{16, .05}, {64, .02}, {256, .01}};
    struct soft s;
    bool ok = true;
    for (size_t l = 0; l < GN_PLANAR_LIGHTS; l++)
        for (size_t t = 0; t < 2; t++) {
            struct gn_scene *scene =
                gn_planar_scene(gn_planar_turns[t].turn, &gn_planar_lights[l], gn_planar_things);
            scene->lights[0].radius = radii[l];
            const int pixels = find_shares(scene);
            assert_true(pixels > 400);
            for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
                begin(&s, scene, counts[k].points, 0);
                draw(&s);
                end(&s);
                const double error = error_of();
                printf("%s, %s, %3u points: %.4f over %d pixels\n", gn_planar_lights[l].name,
                       gn_planar_turns[t].name, counts[k].points, error, pixels);
                ok &= error <= counts[k].most;
            }
            gn_scene_destroy(scene);
        }
    assert_true(ok);
}

/* ---- more than one plane ---- */

/* On the floor and on a wall, each with its own mask; things on the floor shadow both, and floor
 * and wall each other. In colour the two are passes of the same programs. */
static void test_floor_and_wall_agree_with_truth(void **state) {
    (void)state;
    char nodes[2000];
    snprintf(nodes, sizeof nodes, "%s%s", gn_planar_things, GN_PLANAR_WALL);
    for (size_t l = 0; l < GN_PLANAR_LIGHTS; l++) {
        struct gn_scene *scene =
            gn_planar_scene(gn_planar_turns[l].turn, &gn_planar_lights[l], nodes);
        struct soft s;
        scene->lights[0].radius = l ? 0.5f : 0.2f;
        find_shares(scene);
        begin(&s, scene, 64, 0);
        draw(&s);
        const double error = error_of();
        printf("%s: %.4f, %d pixels on the wall\n", gn_planar_lights[l].name, error, on[2]);
        assert_true(on[2] > 15 && error <= .02);
        end(&s);
        gn_scene_destroy(scene);
    }
}

/* Nothing is named: a floor and two walls are found where the lamp throws shadows on them. */
static void test_a_room_is_found_and_agrees_with_truth(void **state) {
    (void)state;
    for (size_t l = 0; l < GN_PLANAR_LIGHTS; l++) {
        struct gn_scene *scene = gn_planar_room(&gn_planar_lights[l]);
        struct soft s;
        int planes = 0;
        scene->lights[0].radius = l ? 0.5f : 0.2f;
        assert_false(scene->planes_named);
        find_shares(scene);
        for (uint32_t i = 0; i < scene->item_count; i++)
            if (scene->items[i].plane > planes) planes = scene->items[i].plane;
        begin(&s, scene, 64, 0);
        draw(&s);
        const double error = error_of();
        printf("%s: %.4f, %d planes, pixels on them %d, %d, %d\n", gn_planar_lights[l].name, error,
               planes, on[1], on[2], on[3]);
        assert_int_equal(planes, 3);
        assert_true(on[1] > 400 && on[2] + on[3] > 40 && error <= .02);
        end(&s);
        gn_scene_destroy(scene);
    }
}

/* Each plane has one normal and one white, and a sun: its colour is a line over visibility. */
static void test_both_planes_have_their_shadow_in_colour(void **state) {
    (void)state;
    static float seen[4 * PIXELS];
    char nodes[2000];
    snprintf(nodes, sizeof nodes, "%s%s", gn_planar_things, GN_PLANAR_WALL);
    struct gn_scene *scene = gn_planar_scene(gn_planar_turns[0].turn, &gn_planar_lights[0], nodes);
    struct soft s;
    struct gn_truth truth;
    scene->lights[0].radius = 0.2f;
    find_truth(&truth, scene);
    begin(&s, scene, 64, 0);
    draw(&s);
    memcpy(seen, picture, sizeof seen);
    s.opts.debug.aov = GN_AOV_COLOR;
    s.opts.output.floats = true;
    draw(&s);
    for (uint8_t plane = 1; plane <= 2; plane++) {
        int least = -1, most = -1; /* pixels */
        for (int i = 0; i < PIXELS; i++) {
            if (truth.mask.item[i] < 0 || scene->items[truth.mask.item[i]].plane != plane) continue;
            if (least < 0 || seen[4 * i] < seen[4 * least]) least = i;
            if (most < 0 || seen[4 * i] > seen[4 * most]) most = i;
        }
        const float dark = picture[4 * least], rise = picture[4 * most] - dark;
        printf("plane %d: visibility %.2f to %.2f, colour %.3f to %.3f\n", plane,
               (double)seen[4 * least], (double)seen[4 * most], (double)dark,
               (double)picture[4 * most]);
        assert_true(seen[4 * most] - seen[4 * least] > .5f && rise > .03f);
        for (int i = 0; i < PIXELS; i++)
            if (truth.mask.item[i] >= 0 && scene->items[truth.mask.item[i]].plane == plane)
                assert_true(fabsf(picture[4 * i] - dark -
                                  rise * (seen[4 * i] - seen[4 * least]) /
                                      (seen[4 * most] - seen[4 * least])) < .01f * rise + .001f);
    }
    end(&s);
    gn_truth_finish(&truth);
    gn_scene_destroy(scene);
}

/* Six suns from one direction are two passes: on floor and wall all are six times one of them. */
static void test_lights_of_two_passes_reach_both_planes(void **state) {
    (void)state;
    enum { SUNS = 6 };
    static float none[4 * PIXELS], one[4 * PIXELS];
    char nodes[4000];
    snprintf(nodes, sizeof nodes, "%s%s", gn_planar_things, GN_PLANAR_WALL);
    for (int i = 1; i < SUNS; i++)
        snprintf(nodes + strlen(nodes), sizeof nodes - strlen(nodes),
                 ",{'mesh':0,'translation':[0,-9,0],%s,'extensions':{'KHR_lights_punctual':{"
                 "'light':0}}}",
                 gn_planar_lights[0].node);
    struct gn_scene *scene = gn_planar_scene(gn_planar_turns[0].turn, &gn_planar_lights[0], nodes);
    struct soft s;
    vec3 color;
    assert_int_equal(scene->light_count, SUNS);
    glm_vec3_copy(scene->lights[0].color, color);
    begin(&s, scene, 16, 0);
    s.opts.debug.aov = GN_AOV_COLOR;
    s.opts.output.floats = s.opts.exposure_given = true;
    for (int lit = 0; lit <= SUNS; lit++) {
        for (int i = 0; i < SUNS; i++) {
            scene->lights[i].radius = 0.2f;
            glm_vec3_scale(color, i < lit, scene->lights[i].color);
        }
        draw(&s);
        if (lit == 0) memcpy(none, picture, sizeof none);
        if (lit == 1) memcpy(one, picture, sizeof one);
        for (int k = 0; k < 4 * PIXELS; k++) {
            const float wanted = none[k] + (float)lit * (one[k] - none[k]);
            assert_true(fabsf(picture[k] - wanted) <= fmaxf(1.0f, picture[k]) / 255);
        }
    }
    end(&s);
    gn_scene_destroy(scene);
}

/* ---- gathering ---- */

static struct gn_scene *make_one(void) {
    struct gn_scene *scene =
        gn_planar_scene(gn_planar_turns[0].turn, &gn_planar_lights[2], gn_planar_things);
    scene->lights[0].radius = 0.5f;
    return scene;
}

/* A quarter of 64 points with each frame; then nothing more is drawn, nor is a frame wanted, and
 * the picture is that of all at once to the last bit. */
static void test_points_are_gathered_while_nothing_moves(void **state) {
    (void)state;
    static float once[4 * PIXELS], before[4 * PIXELS];
    struct gn_scene *scene = make_one();
    struct soft s;
    begin(&s, scene, 64, 0);
    const uint32_t all = draw(&s);
    assert_false(s.is_behind);
    assert_true(all > 0 && all % 64 == 0);
    memcpy(once, picture, sizeof once);
    end(&s);

    begin(&s, scene, 64, 16);
    for (int frame = 1; frame <= 4; frame++) {
        memcpy(before, picture, sizeof before);
        assert_int_equal(draw(&s), all / 4);
        assert_int_equal(s.is_behind, frame < 4);
        assert_memory_not_equal(picture, before, sizeof before);
    }
    assert_memory_equal(picture, once, sizeof once);
    for (int frame = 0; frame < 2; frame++) {
        assert_int_equal(draw(&s), 0);
        assert_false(s.is_behind);
        assert_memory_equal(picture, once, sizeof once);
    }

    /* the lamp moves: from the beginning */
    scene->lights[0].radius = 0.6f;
    assert_int_equal(draw(&s), all / 4);
    assert_true(s.is_behind);
    end(&s);
    gn_scene_destroy(scene);
}

/* What the GPU holds decides what is drawn, not what the builder remembers. */
static void test_a_lost_mask_is_drawn_again(void **state) {
    (void)state;
    static float expected[4 * PIXELS];
    struct gn_scene *scene = make_one();
    struct soft s;
    begin(&s, scene, 64, 16);
    const uint32_t each = draw(&s);
    draw(&s);
    memcpy(expected, picture, sizeof expected);
    end(&s);

    begin(&s, scene, 64, 16); /* loading a scene has dropped its maps */
    gn_frame_build(s.frame, &s.pose, &s.opts, NULL);
    assert_int_equal(draw(&s), 2 * each);
    assert_memory_equal(picture, expected, sizeof expected);

    /* another builder, which begins with fewer points than the mask has */
    gn_frame_destroy(s.frame);
    s.frame = gn_frame_create(scene, gn_gl_caps(gl));
    assert_int_equal(draw(&s), each);
    assert_memory_not_equal(picture, expected, sizeof expected);
    draw(&s);
    assert_memory_equal(picture, expected, sizeof expected);
    end(&s);
    gn_scene_destroy(scene);
}

/* A lamp so small that no penumbra is as wide as a texel has one point. */
static void test_a_point_is_drawn_once(void **state) {
    (void)state;
    static float hard[4 * PIXELS];
    struct gn_scene *scene = make_one();
    struct soft s;
    begin(&s, scene, 0, 0);
    const uint32_t each = draw(&s);
    memcpy(hard, picture, sizeof hard);
    end(&s);
    scene->lights[0].radius = 1e-4f;
    begin(&s, scene, 64, 16);
    assert_int_equal(draw(&s), each);
    assert_false(s.is_behind);
    assert_memory_equal(picture, hard, sizeof hard);
    end(&s);
    gn_scene_destroy(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points_are_gathered_while_nothing_moves),
        cmocka_unit_test(test_a_lost_mask_is_drawn_again),
        cmocka_unit_test(test_a_point_is_drawn_once),
        cmocka_unit_test(test_floor_and_wall_agree_with_truth),
        cmocka_unit_test(test_a_room_is_found_and_agrees_with_truth),
        cmocka_unit_test(test_both_planes_have_their_shadow_in_colour),
        cmocka_unit_test(test_lights_of_two_passes_reach_both_planes),
        cmocka_unit_test(test_penumbrae_agree_with_truth),
    };
    return cmocka_run_group_tests_name("soft_planar", tests, open_gl, close_gl);
}
