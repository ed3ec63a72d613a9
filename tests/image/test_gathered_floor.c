/* The unseen floor under the made light: its texture of alpha against rays, how it is gathered from
 * frame to frame, and when there is none. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "scene/scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"
#include "unit/gltf_maker.h"

enum { WIDTH = 400, HEIGHT = 300, PIXELS = WIDTH * HEIGHT };

/* ---- scenes without a light, and without a ground ---- */

static const char *const bodies[] = {
    /* a cube that stands, one on its corner, a thin wall */
    "{'mesh':1,'translation':[-1.6,0.5,0.4],'scale':[0.5,0.5,0.5]}"
    ",{'mesh':1,'translation':[0.4,1.2,-1],'rotation':[0.28,0.36,0.1,0.884],'scale':[0.4,0.4,0.4]}"
    ",{'mesh':1,'translation':[1.7,0.6,0.5],'rotation':[0,0.3,0,0.954],'scale':[0.6,0.6,0.015]}",
    /* a table */
    "{'mesh':1,'translation':[0,1,0],'scale':[1.2,0.05,0.8]}"
    ",{'mesh':1,'translation':[-1.1,0.5,-0.7],'scale':[0.05,0.5,0.05]}"
    ",{'mesh':1,'translation':[1.1,0.5,0.7],'scale':[0.05,0.5,0.05]}",
    /* low under high: a stick under a board */
    "{'mesh':1,'translation':[0,2,0],'scale':[1,0.03,1]}"
    ",{'mesh':1,'translation':[0.3,0.05,0.3],'scale':[1.2,0.05,0.03]}"
    ",{'mesh':1,'translation':[-0.2,0.3,-0.3],'scale':[0.04,0.3,0.04]}",
};
enum { BODIES = sizeof bodies / sizeof *bodies };

static void add_camera(struct gn_maker *maker) {
    gn_maker_set(maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.75,'znear':0.1,'zfar':40}}]");
}

static const float origin[3] = {0}, right[3] = {1, 0, 0};

/* moves: by a clip that holds them where they are. */
static const char *write_scene(int body, bool moves) {
    static char path[400];
    struct gn_maker maker;
    struct gn_err err = {0};
    char nodes[1000];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    snprintf(nodes, sizeof nodes,
             "[%s,{'camera':0,'translation':[-3.2,4.6,6.4],'rotation':[-0.2759,-0.2179,-0.0643,"
             "0.9339]},{'children':[0,1,2]}]",
             bodies[body]);
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(&maker, "scenes", "[{'nodes':[3,4]}]");
    if (moves) gn_maker_move(&maker, 4, 1, origin, origin);
    add_camera(&maker);
    snprintf(path, sizeof path, "%s/gathered-%d-%d.glb", gn_shot_build(), body, moves);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

/* ---- against rays ---- */

static struct gn_picture draw(const char *scene, const char *technique, const char *const more[]) {
    struct gn_picture picture;
    struct gn_err err = {0};
    const char *args[20] = {"--size", "400x300",  "--backend", "egl",      "--floor",
                            "auto",   "--shadow", technique,   "--output", "linear"};
    int count = 10;
    while (*more) args[count++] = *more++;
    if (!gn_shot(&picture, NULL, &err, "pfm", scene, args)) fail_msg("%s", err.text);
    return picture;
}

/* Root mean square of the difference where truth is between, the largest one, how many, and by how
 * much the pixels beside a body are darker. */
struct difference {
    double rms, most, darker;
    int count;
};
static struct difference differ(const struct gn_picture *truth, const struct gn_picture *shot,
                                const struct gn_picture *distance) {
    struct difference d = {0};
    int beside = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            bool floor = true; /* and no edge of a body near */
            for (int k = 0; k < 9; k++) {
                const int px = x - 1 + k % 3, py = y - 1 + k / 3;
                floor &= px >= 0 && py >= 0 && px < WIDTH && py < HEIGHT &&
                         isinf(gn_picture_at(distance, px, py)[0]);
            }
            const double t = (double)gn_picture_at(truth, x, y)[0],
                         brighter = (double)gn_picture_at(shot, x, y)[0] - t, by = fabs(brighter);
            if (!floor && isinf(gn_picture_at(distance, x, y)[0])) {
                d.darker -= fmin(brighter, 0);
                beside++;
            }
            if (!floor) continue;
            d.most = fmax(d.most, by);
            if (t <= .02 || t >= .98) continue;
            d.rms += by * by;
            d.count++;
        }
    d.rms = sqrt(d.rms / fmax(d.count, 1));
    d.darker /= fmax(beside, 1);
    return d;
}

/* The lamp as wide as the default picture has it. */
#define LAMP "--light-radius", "0.237"

static void test_its_penumbrae_are_true(void **state) {
    (void)state;
    for (int i = 0; i < 2 * BODIES; i++) {
        const int body = i / 2;
        const bool moves = i % 2;
        const char *scene = write_scene(body, moves);
        struct gn_picture distance =
                              draw(scene, "none", (const char *const[]){"--aov", "distance", NULL}),
                          truth = draw(scene, "truth",
                                       (const char *const[]){"--aov", "visibility", LAMP,
                                                             "--samples", "512", NULL}),
                          shot = draw(scene, "cone",
                                      (const char *const[]){"--aov", "visibility", LAMP, NULL});
        const struct difference d = differ(&truth, &shot, &distance);
        print_message("%d%s: rms %.4f, most %.3f, of %d pixels\n", body, moves ? ", moving" : "",
                      d.rms, d.most, d.count);
        assert_in_range(d.count, 3000, PIXELS);
        assert_true(d.rms <= (moves ? .02 : .01));
        gn_picture_finish(&truth);
        gn_picture_finish(&shot);
        gn_picture_finish(&distance);
    }
}

/* The picture itself: what shadow and occlusion take, as the program takes it that computes all for
 * each pixel, with visibility by rays. */
static void test_its_alpha_is_what_light_it_lacks(void **state) {
    (void)state;
    static const char *const lights[][3] = {{"--environment", "studio", NULL},
                                            {"--environment", "none", NULL},
                                            {"--shadow-strength", "0.6", NULL}};
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++)
        for (int body = 0; body < BODIES; body++) {
            const char *scene = write_scene(body, false);
            struct gn_picture distance = draw(scene, "none",
                                              (const char *const[]){"--aov", "distance", NULL}),
                              truth = draw(scene, "truth",
                                           (const char *const[]){LAMP, "--samples", "256",
                                                                 lights[i][0], lights[i][1], NULL}),
                              shot = draw(
                                  scene, "cone",
                                  (const char *const[]){LAMP, lights[i][0], lights[i][1], NULL});
            const struct difference d = differ(&truth, &shot, &distance);
            print_message("%s %s, %d: rms %.4f, most %.3f, of %d\n", lights[i][0], lights[i][1],
                          body, d.rms, d.most, d.count);
            assert_true(d.rms <= .012 && d.most <= .12);
            gn_picture_finish(&truth);
            gn_picture_finish(&shot);
            gn_picture_finish(&distance);
        }
}

/* A texel under a foot is dark. Of a pixel beside it neither the sampler nor mipmaps, which a mask
 * finer than the picture has, may take any of that. */
static void test_it_is_no_darker_beside_what_stands(void **state) {
    (void)state;
    for (int body = 0; body < BODIES; body++) {
        const char *scene = write_scene(body, false);
        struct gn_picture distance =
                              draw(scene, "none",
                                   (const char *const[]){"--msaa", "0", "--aov", "distance", NULL}),
                          truth = draw(
                              scene, "truth",
                              (const char *const[]){"--msaa", "0", LAMP, "--samples", "256", NULL}),
                          shot =
                              draw(scene, "cone", (const char *const[]){"--msaa", "0", LAMP, NULL});
        const struct difference d = differ(&truth, &shot, &distance);
        print_message("%d: %.4f darker\n", body, d.darker);
        assert_true(d.darker <= .0005);
        gn_picture_finish(&truth);
        gn_picture_finish(&shot);
        gn_picture_finish(&distance);
    }
}

/* Where light changes slowly no step of a grey level is a line that an eye can follow: of pixels
 * that are a little darker than the open ground few stand among as many equal ones. */
static void test_its_steps_are_noise(void **state) {
    (void)state;
    enum { SIDE = 1280, EQUAL = 6 };
    struct gn_picture shot;
    struct gn_err err = {0};
    const char *args[] = {"--size", "1280x1280",     "--shadow", "cone", "--floor",
                          "auto",   "--environment", "studio",   NULL};
    if (!gn_shot(&shot, NULL, &err, "png", write_scene(1, false), args)) fail_msg("%s", err.text);
    const float open = gn_picture_at(&shot, 0, 0)[1];
    int all = 0, in_lines = 0;
    for (int y = 0; y < SIDE; y++)
        for (int x = 0, end; x < SIDE; x = end) {
            const float grey = gn_picture_at(&shot, x, y)[1], darker = (open - grey) * 255;
            for (end = x + 1; end < SIDE && gn_picture_at(&shot, end, y)[1] == grey;) end++;
            if (darker < 1.5f || darker > 14.5f) continue;
            all += end - x;
            in_lines += end - x < EQUAL ? 0 : end - x;
        }
    print_message("%d pixels, %d in lines\n", all, in_lines);
    assert_in_range(all, 50000, SIDE * SIDE);
    assert_in_range(in_lines, 0, all * 3 / 4);
    gn_picture_finish(&shot);
}

/* ---- from frame to frame ---- */

static struct help_stage stage;
static uint8_t pictures[2][4 * PIXELS];

static struct gn_scene *finish(struct gn_maker *maker) {
    struct gn_err err = {0};
    const struct gn_scene_limits limits = {.floor = {.kind = GN_FLOOR_AUTO}};
    add_camera(maker);
    struct gn_made made = gn_maker_glb(maker);
    struct gn_scene *scene = gn_scene_load_bytes("t", made.data, made.size, &limits, NULL, &err);
    free(made.data);
    gn_maker_finish(maker);
    if (!scene) fail_msg("%s", err.text);
    assert_true(scene->added.light && scene->added.floor);
    return scene;
}

/* So many triangles that a frame has the least number of points: a lattice of cubes. */
static struct gn_scene *make_lattice(void) {
    enum { SIDE = 14 };
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    static char nodes[SIDE * SIDE * SIDE * 100], list[SIDE * SIDE * SIDE * 6 + 40];
    size_t at = (size_t)snprintf(nodes, sizeof nodes,
                                 "[{'camera':0,'translation':[0,3.5,5],'rotation':[-0.2588,0,0,"
                                 "0.9659]}"),
           in = (size_t)snprintf(list, sizeof list, "[{'nodes':[0");
    for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
        at += (size_t)snprintf(nodes + at, sizeof nodes - at,
                               ",{'mesh':1,'translation':[%g,%g,%g],'scale':[0.02,0.02,0.02]}",
                               .1 * (i % SIDE - 7), .1 * (i / SIDE % SIDE) + .02,
                               .1 * (i / SIDE / SIDE - 7));
        in += (size_t)snprintf(list + in, sizeof list - in, ",%d", i + 1);
    }
    snprintf(nodes + at, sizeof nodes - at, "]");
    snprintf(list + in, sizeof list - in, "]}]");
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(&maker, "scenes", list);
    return finish(&maker);
}

/* A cube; a second one, which a clip moves. */
/* One cube stands, one moves. */
static struct gn_scene *make_moving(void) {
    struct gn_maker maker;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_move(&maker, 3, 1, origin, right);
    gn_maker_set(&maker, "nodes",
                 "[{'camera':0,'translation':[0,3.5,5],'rotation':[-0.2588,0,0,0.9659]}"
                 ",{'mesh':1,'translation':[-1,0.5,0],'scale':[0.5,0.5,0.5]}"
                 ",{'mesh':1,'translation':[0,0.5,0],'scale':[0.3,0.5,0.3]},{'children':[2]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,3]}]");
    return finish(&maker);
}

/* One of 700. */
static struct gn_scene *make_many_moving(void) {
    static char nodes[60000], children[6000];
    struct gn_maker maker;
    size_t size = 0, used = 0;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_move(&maker, 1, 1, origin, right);
    for (int i = 0; i < 700; i++) {
        size += (size_t)snprintf(nodes + size, sizeof nodes - size,
                                 ",{'mesh':1,'translation':[%g,0.5,%g],'scale':[0.02,0.5,0.02]}",
                                 i % 28 * .1, i / 28 * .1);
        used +=
            (size_t)snprintf(children + used, sizeof children - used, "%s%d", i ? "," : "", i + 2);
    }
    static char all[80000];
    snprintf(all, sizeof all,
             "[{'camera':0,'translation':[0,3.5,5],'rotation':[-0.2588,0,0,0.9659]}"
             ",{'children':[%s]}%s]",
             children, nodes);
    gn_maker_set(&maker, "nodes", all);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1]}]");
    return finish(&maker);
}

static struct gn_frame_opts live_opts(void) {
    struct gn_frame_opts opts = {.output = {.width_px = WIDTH, .height_px = HEIGHT},
                                 .shadow.gather_points = 16};
    GN_LIGHT_SET(&opts.shadow.any, technique, GN_TECHNIQUE_CONE);
    GN_LIGHT_SET(&opts.shadow.any, radius, 0.237f);
    return opts;
}

static void read(uint8_t *to) {
    struct gn_err err = {0};
    if (!gn_gl_read_rgba8(stage.gl, to, &err)) fail_msg("%s", err.text);
}

static bool has_floor_pass(const struct gn_plan *plan) {
    for (uint32_t i = 0; i < plan->pass_count; i++)
        if (strcmp(plan->passes[i].label, "floor") == 0) return true;
    return false;
}

/* Draws until no further frame is wanted. Returns the number of frames; *most: the largest step
 * between two. */
static int settle(const struct gn_frame_opts *opts, int *most) {
    int frames = 1;
    *most = 0;
    const struct gn_plan *plan = help_stage_draw(&stage, opts, NULL);
    read(pictures[0]);
    for (; plan->is_behind && frames < 100; frames++) {
        plan = help_stage_draw(&stage, opts, NULL);
        read(pictures[frames & 1]);
        for (int i = 0; i < 4 * PIXELS; i++) {
            const int by = abs(pictures[0][i] - pictures[1][i]);
            if (by > *most) *most = by;
        }
    }
    return frames;
}

static void test_it_converges_unseen(void **state) {
    (void)state;
    static uint8_t all[4 * PIXELS];
    int most, wrong = 0, dark = 0;
    struct gn_frame_opts opts = live_opts();
    help_stage_open(&stage, make_lattice, "egl", NULL, NULL);
    opts.shadow.gather_points = 0;
    assert_int_equal(settle(&opts, &most), 1);
    memcpy(all, pictures[0], sizeof all);
    opts.shadow.gather_points = 16;
    gn_frame_destroy(stage.frame); /* as a kiosk begins */
    stage.frame = gn_frame_create(stage.scene, gn_gl_caps(stage.gl));
    const int frames = settle(&opts, &most);
    const uint8_t *last = pictures[(frames - 1) & 1];
    for (int i = 0; i < 4 * PIXELS; i++) wrong += abs(last[i] - all[i]) > 1;
    for (int i = 0; i < PIXELS; i++) dark += all[4 * i] + 8 < all[0];
    print_message("%d frames, the largest step %d of 255, %d pixels dark\n", frames, most, dark);
    assert_in_range(frames, 9, 30);
    assert_true(most <= 2);
    assert_int_equal(wrong, 0);
    assert_true(dark > 3000);

    /* an orbit draws no shadow again */
    opts.view.orbit.yaw_rad = .5f;
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    assert_false(plan->is_behind);
    assert_true(has_floor_pass(plan));
    assert_int_equal(gn_gl_stats(stage.gl).shadow_draws, 0);

    /* a weaker shadow is one at once */
    GN_LIGHT_SET(&opts.shadow.any, strength, 0.2f);
    assert_int_equal(settle(&opts, &most), 1);

    /* another lamp: all points again */
    GN_LIGHT_SET(&opts.shadow.any, radius, 0.1f);
    assert_true(help_stage_draw(&stage, &opts, NULL)->is_behind);
    help_stage_close(&stage);
}

/* All its points in one frame, and fewer of them; of large models the light's own map. */
static void test_what_moves_is_complete_in_each_frame(void **state) {
    (void)state;
    const struct gn_frame_opts opts = live_opts();
    help_stage_open(&stage, make_moving, "egl", NULL, NULL);
    for (int i = 0; i < 3; i++) {
        gn_pose_step(&stage.pose, i * INT64_C(100000000));
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
        const struct gn_shadow_lamp *lamp = &plan->shadows[1].lamp;
        assert_true(has_floor_pass(plan) && !plan->is_behind);
        assert_int_equal(lamp->drawn, 64);
        assert_int_equal(lamp->count, 64);
        read(pictures[0]);
        help_stage_draw(&stage, &opts, NULL);
        read(pictures[1]);
        assert_memory_equal(pictures[0], pictures[1], sizeof pictures[0]);
    }
    gn_pose_choose(&stage.pose, GN_POSE_NONE);
    gn_pose_step(&stage.pose, 0);
    assert_int_equal(help_stage_draw(&stage, &opts, NULL)->shadows[1].lamp.count, 128);
    help_stage_close(&stage);
    help_stage_open(&stage, make_many_moving, "egl", NULL, NULL);
    assert_false(has_floor_pass(help_stage_draw(&stage, &opts, NULL)));
    help_stage_close(&stage);
}

static void test_it_is_not_seen_from_below(void **state) {
    (void)state;
    struct gn_frame_opts opts = live_opts();
    help_stage_open(&stage, make_lattice, "egl", NULL, NULL);
    opts.view.orbit.pitch_rad = -1.2f;
    assert_false(has_floor_pass(help_stage_draw(&stage, &opts, NULL)));
    opts.view.orbit.pitch_rad = 0;
    assert_true(has_floor_pass(help_stage_draw(&stage, &opts, NULL)));
    help_stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_its_penumbrae_are_true),
        cmocka_unit_test(test_its_alpha_is_what_light_it_lacks),
        cmocka_unit_test(test_it_is_no_darker_beside_what_stands),
        cmocka_unit_test(test_its_steps_are_noise),
        cmocka_unit_test(test_it_converges_unseen),
        cmocka_unit_test(test_what_moves_is_complete_in_each_frame),
        cmocka_unit_test(test_it_is_not_seen_from_below),
    };
    return cmocka_run_group_tests_name("gathered_floor", tests, NULL, NULL);
}
