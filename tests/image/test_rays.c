/* gnomon render --shadow truth: its visibility is the oracle's to the bit, whatever the light, at
 * any time and with any number of threads; its picture has it where the surface is lit by the
 * light. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/penumbra.h"
#include "image/shot.h"
#include "truth/cast.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH = 96, HEIGHT = 72 };

static struct gn_picture shoot(const char *path, const char *kind, const char *const args[]) {
    const char *all[24] = {"--size", "96x72", "--backend", "egl"};
    int count = 4;
    struct gn_err err = {0};
    struct gn_picture shot;
    while (*args) all[count++] = *args++;
    if (!gn_shot(&shot, NULL, &err, kind, path, all)) fail_msg("%s", err.text);
    return shot;
}

/* One ray after the other, by the oracle's own functions. */
static void ask_oracle(const struct gn_scene *scene, int64_t time_ns, uint32_t camera, int samples,
                       float out[WIDTH * HEIGHT]) {
    struct gn_pose pose;
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, time_ns);
    gn_raycast_init(&rays, scene, &pose, NULL);
    gn_ray_eye_init(&eye, &pose, camera, WIDTH, HEIGHT);
    gn_ray_lamp_init(&lamp, &pose, 0);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        struct gn_ray_surface surface;
        out[i] = 1;
        if (!gn_raycast_eye(&rays, &eye, i % WIDTH, i / WIDTH, &surface)) continue;
        out[i] = samples > 1 ? (float)gn_raycast_share(&rays, &lamp, &surface, samples)
                             : (float)gn_raycast_visible(&rays, &lamp, &surface);
    }
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
}

static struct gn_scene *load(const char *path) {
    struct gn_err err = {0};
    struct gn_scene *scene = gn_scene_load(path, NULL, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

static void equals_oracle(const char *path, const char *time_s, int samples) {
    float truth[WIDTH * HEIGHT];
    char count[16];
    struct gn_scene *scene = load(path);
    ask_oracle(scene, (int64_t)(strtod(time_s, NULL) * 1e9), 0, samples, truth);
    snprintf(count, sizeof count, "%d", samples);
    struct gn_picture shot =
        shoot(path, "pfm",
              (const char *const[]){"--shadow", "truth", "--aov", "visibility", "--samples", count,
                                    "--time", time_s, NULL});
    int partly = 0, dark = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        partly += truth[i] > 0 && truth[i] < 1;
        dark += truth[i] == 0;
    }
    print_message("%s, %d samples: %d dark, %d partly\n", path, samples, dark, partly);
    assert_true(dark > 30 && (samples == 1) == (partly == 0));
    assert_int_equal(shot.channels, 1);
    assert_memory_equal(shot.data, truth, sizeof truth);
    gn_picture_finish(&shot);
    gn_scene_destroy(scene);
}

static void test_visibility_is_the_oracles_to_the_bit(void **state) {
    (void)state;
    static const int scenes[] = {GN_PENUMBRA_BARS, GN_PENUMBRA_BOX, GN_PENUMBRA_BULB};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct gn_err err = {0};
        char *path = gn_penumbra_write(scenes[i], &err);
        if (!path) fail_msg("%s", err.text);
        equals_oracle(path, "0", i == 0 ? 64 : 16);
        equals_oracle(path, "0", 1);
        free(path);
    }
    equals_oracle("assets/bench/yard.glb", "2.5", 8);
}

static void test_threads_change_no_bit(void **state) {
    (void)state;
    struct gn_scene *scene = load("assets/bench/yard.glb");
    struct gn_pose pose;
    struct gn_raycast rays;
    struct gn_ray_eye eye;
    struct gn_ray_lamp lamp;
    static float one[WIDTH * HEIGHT], many[WIDTH * HEIGHT];
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_raycast_init(&rays, scene, &pose, NULL);
    gn_ray_eye_init(&eye, &pose, 0, WIDTH, HEIGHT);
    gn_ray_lamp_init(&lamp, &pose, 0);
    struct gn_cast_opts opts = {
        .rays = &rays, .eye = &eye, .lamps = &lamp, .lamp_count = 1, .samples = 4, .threads = 1};
    gn_cast(&opts, (float *const[]){one});
    opts.threads = 7;
    gn_cast(&opts, (float *const[]){many});
    assert_memory_equal(one, many, sizeof one);
    gn_raycast_finish(&rays);
    gn_pose_finish(&pose);
    gn_scene_destroy(scene);
}

/* The picture in linear light: the light's share of a pixel is its visibility times what it is
 * without shadows. Of pixels whose neighbours see as much: at outlines the rasteriser may choose
 * another surface. */
static void test_the_picture_has_the_visibility(void **state) {
    (void)state;
    struct gn_err err = {0};
    char *path = gn_penumbra_write(GN_PENUMBRA_BULB, &err);
    if (!path) fail_msg("%s", err.text);
    static const char *const linear[] = {"--output", "linear"};
    struct gn_picture seen =
        shoot(path, "pfm", (const char *const[]){"--shadow", "truth", "--aov", "visibility", NULL});
    struct gn_picture truth =
        shoot(path, "pfm", (const char *const[]){linear[0], linear[1], "--shadow", "truth", NULL});
    struct gn_picture open =
        shoot(path, "pfm", (const char *const[]){linear[0], linear[1], "--shadow", "none", NULL});
    struct gn_picture half = shoot(path, "pfm",
                                   (const char *const[]){linear[0], linear[1], "--shadow", "truth",
                                                         "--shadow-strength", ".5", NULL});
    int partly = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const float v = seen.data[i], most = open.data[3 * i],
                    least = 2 * half.data[3 * i] - truth.data[3 * i];
        const float tolerance = .004f * fmaxf(most, 1e-3f);
        partly += v > 0 && v < 1;
        if (v == 1) assert_float_equal(truth.data[3 * i], most, tolerance);
        assert_float_equal(least, most, 2 * tolerance);
        if (v < .5f) assert_true(truth.data[3 * i] < most + tolerance);
    }
    assert_true(partly > 100);
    struct gn_picture *all[] = {&seen, &truth, &open, &half};
    for (int i = 0; i < 4; i++) gn_picture_finish(all[i]);
    free(path);
}

/* ---- rays and picture have one camera ---- */

static struct gn_scene *load_bars(void) {
    struct gn_err err = {0};
    char *path = gn_penumbra_write(GN_PENUMBRA_BARS, &err);
    if (!path) fail_msg("%s", err.text);
    struct gn_scene *scene = load(path);
    free(path);
    return scene;
}

/* How many pixels of the picture and of the rays are not at the same distance: outlines alone. */
static int count_apart(struct help_stage *stage, const struct gn_frame_view_opts *view, int *seen) {
    static float drawn[4 * WIDTH * HEIGHT];
    const struct gn_frame_opts opts = {.output.width_px = WIDTH,
                                       .output.height_px = HEIGHT,
                                       .debug.aov = GN_AOV_DISTANCE,
                                       .view = *view};
    struct gn_err err = {0};
    struct gn_raycast rays;
    struct gn_framing framing;
    struct gn_ray_eye eye;
    int apart = 0;
    help_stage_draw(stage, &opts, NULL);
    if (!gn_gl_read_f32(stage->gl, drawn, &err)) fail_msg("%s", err.text);
    gn_frame_camera(&stage->pose, view, (float)WIDTH / HEIGHT, &framing);
    gn_ray_eye_look(&eye, &framing, WIDTH, HEIGHT);
    gn_raycast_init(&rays, stage->scene, &stage->pose, NULL);
    *seen = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        struct gn_ray_surface surface;
        const bool hit = gn_raycast_eye(&rays, &eye, i % WIDTH, i / WIDTH, &surface);
        const double distance_m = hit ? surface.distance_m : (double)INFINITY;
        *seen += hit;
        apart += hit ? fabs((double)drawn[4 * i] - distance_m) > .002 * distance_m
                     : isfinite(drawn[4 * i]);
    }
    gn_raycast_finish(&rays);
    return apart;
}

static void test_rays_and_picture_have_one_camera(void **state) {
    (void)state;
    const struct gn_orbit orbit = {.yaw_rad = .4f, .pitch_rad = .1f, .zoom = .8f};
    const struct {
        const char *what;
        float xmag_m, ymag_m; /* 0: as the file has the camera */
        struct gn_frame_view_opts view;
    } rows[] = {
        {"as in the file", 0, 0, {0}},
        {"moved", 0, 0, {.orbit = orbit}},
        {"on the turntable", 0, 0, {.turntable_rad = .7f}},
        {"placed", 0, 0, {.framing = {.given = GN_FRAMING_DISTANCE, .distance_m = 9}}},
        {"orthographic", 4, 4, {0}},
        {"orthographic, wider than the picture", 12, 2, {0}},
        {"orthographic, moved", 5, 4, {.orbit = orbit}},
        {"a light's", 0, 0, {.light_plus_1 = 1}},
        {"a light's, after the camera was moved", 0, 0, {.light_plus_1 = 1, .orbit = orbit}},
        {"a light's on the turntable", 0, 0, {.light_plus_1 = 1, .turntable_rad = .7f}},
    };
    struct help_stage stage;
    help_stage_open(&stage, load_bars, "egl", NULL, NULL);
    struct gn_camera *camera = &stage.scene->cameras[0];
    const struct gn_camera file = *camera;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        int seen = 0;
        *camera = file;
        camera->orthographic = rows[i].xmag_m > 0;
        camera->xmag_m = rows[i].xmag_m;
        camera->ymag_m = rows[i].ymag_m;
        const int apart = count_apart(&stage, &rows[i].view, &seen);
        print_message("%s: %d of %d pixels apart\n", rows[i].what, apart, seen);
        assert_true(seen > WIDTH * HEIGHT / 10);
        assert_true(apart <= WIDTH * HEIGHT / 100);
    }
    help_stage_close(&stage);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays_and_picture_have_one_camera),
        cmocka_unit_test(test_visibility_is_the_oracles_to_the_bit),
        cmocka_unit_test(test_threads_change_no_bit),
        cmocka_unit_test(test_the_picture_has_the_visibility),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
