/* What `inspect --for` counts as pixels of a picture, against what the GPU here draws: of convex
 * bodies with their backs culled each pixel is drawn once, so both are the same, wherever bodies,
 * camera and clips put them. Lanes are not fewer than pixels, nor more than quads of single pixels.
 */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/ball.h"
#include "image/shot.h"
#include "unit/check.h"

#define SIZE "320x240"
enum { PIXELS = 320 * 240 };

/* Balls that do not hide one another, one of them mirrored, one partly out of sight, one moved by a
 * clip to there; mask: a material with a cutoff, of which nothing is cut. */
static const char *write_scene(bool mask) {
    static char path[300];
    struct gn_maker maker;
    struct gn_err err = {0};
    char text[700];
    const float times[2] = {0, 1}, places[2][3] = {{0, 0, 0}, {0.4f, 1.5f, 0}};
    gn_maker_init(&maker);
    const int ball = gn_ball_add(&maker, 1);
    const int input =
        gn_maker_accessor(&maker, "SCALAR", 5126, 2, times, sizeof times, "'min':[0],'max':[1]");
    const int output = gn_maker_accessor(&maker, "VEC3", 5126, 2, places, sizeof places, NULL);
    snprintf(text, sizeof text,
             "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,"
             "'target':{'node':2,'path':'translation'}}]}",
             input, output);
    gn_maker_add(&maker, "animations", text);
    gn_maker_set(&maker, "materials", mask ? "[{'alphaMode':'MASK'}]" : "[{}]");
    snprintf(
        text, sizeof text,
        "{'primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d},'indices':%d,'material':0}]}",
        ball, ball + 1, ball + 2);
    gn_maker_add(&maker, "meshes", text);
    gn_maker_add(&maker, "cameras",
                 "{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1}}");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':2}]}}");
    gn_maker_set(
        &maker, "nodes",
        "[{'mesh':0,'translation':[-3,1,-2],'scale':[-1,0.6,1]},"
        "{'mesh':0,'translation':[4.6,-0.5,0]},{'mesh':0,'scale':[0.8,0.8,0.3]},"
        "{'camera':0,'translation':[0,0,9]},{'extensions':{'KHR_lights_punctual':{'light':0}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3,4]}]");
    snprintf(path, sizeof path, "%s/lanes.glb", gn_shot_build());
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static json_t *inspect(const char *path, const char *msaa) {
    static struct gn_run run;
    struct gn_err err = {0};
    const char *const argv[] = {
        gn_shot_program(), "inspect", path,      "--for", "pi4",    "--size", SIZE,
        "--msaa",          msaa,      "--floor", "none",  "--json", NULL};
    if (!gn_run(&run, argv, 0, &err)) fail_msg("%s", err.text);
    if (run.status != 0) fail_msg("%s", run.err);
    json_t *all = json_loads(run.out, 0, NULL);
    assert_non_null(all);
    return all;
}

static double number(const json_t *of, const char *key) {
    const json_t *value = json_object_get(of, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

/* Of the passes of that name, "opaque". */
static double sum_passes(const json_t *all, const char *key) {
    const json_t *passes = json_object_get(json_object_get(all, "time"), "passes");
    double sum = 0;
    for (size_t i = 0; i < json_array_size(passes); i++) {
        const json_t *pass = json_array_get(passes, i);
        if (strcmp(json_string_value(json_object_get(pass, "label")), "opaque") == 0)
            sum += number(pass, key);
    }
    return sum;
}

static int count_drawn(const char *path) {
    struct gn_picture shot;
    struct gn_err err = {0};
    int drawn = 0;
    const char *const args[] = {"--aov", "distance", "--size", SIZE, "--backend", "egl", NULL};
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    for (int i = 0; i < PIXELS; i++) drawn += isfinite(shot.data[i * shot.channels]) != 0;
    gn_picture_finish(&shot);
    return drawn;
}

static void test_pixels_are_those_drawn(void **state) {
    (void)state;
    for (int mask = 0; mask < 2; mask++) {
        const char *path = write_scene(mask);
        const int drawn = count_drawn(path);
        json_t *all = inspect(path, "0");
        const double pixels = sum_passes(all, "pixels"), lanes = sum_passes(all, "lanes");
        print_message("%d drawn, %g counted, %g lanes\n", drawn, pixels, lanes);
        assert_true(drawn > PIXELS / 20 && drawn < PIXELS / 2);
        assert_true(fabs(pixels - drawn) <= 0.002 * drawn + 2);
        assert_true(lanes >= 1.05 * pixels && lanes <= 4 * pixels);
        json_decref(all);
    }
}

/* With samples, what a triangle touches at a rim is shaded, too. */
static void test_samples_add_lanes(void **state) {
    (void)state;
    const char *path = write_scene(false);
    json_t *none = inspect(path, "0"), *four = inspect(path, "4");
    assert_true(sum_passes(four, "lanes") > 1.02 * sum_passes(none, "lanes"));
    assert_true(sum_passes(four, "lanes") < 2 * sum_passes(none, "lanes"));
    assert_true(sum_passes(four, "pixels") > sum_passes(none, "pixels"));
    json_decref(none);
    json_decref(four);
}

/* The sums that the report says are those of its parts. */
static void test_report(void **state) {
    (void)state;
    json_t *all = inspect(write_scene(false), "4"), *time = json_object_get(all, "time");
    const json_t *passes = json_object_get(time, "passes");
    double each = 0, sum = 0;
    for (size_t i = 0; i < json_array_size(passes); i++) {
        const json_t *pass = json_array_get(passes, i);
        const double most = fmax(fmax(number(pass, "instructions_ms"), number(pass, "fetches_ms")),
                                 number(pass, "bytes_ms"));
        assert_true(fabs(most + number(pass, "vertices_ms") - number(pass, "ms")) < 1e-5);
        sum += number(pass, "ms");
        if (strcmp(json_string_value(json_object_get(pass, "drawn")), "each frame") == 0)
            each += number(pass, "ms");
    }
    assert_true(each > 0 && fabs(each - number(time, "each_frame_ms")) < 1e-4);
    assert_true(fabs(sum - number(time, "all_ms")) < 1e-4);
    assert_int_equal(json_array_size(json_object_get(time, "materials")), 1);
    assert_int_equal(json_array_size(json_object_get(time, "lights")), 1);
    json_decref(all);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pixels_are_those_drawn),
        cmocka_unit_test(test_samples_add_lanes),
        cmocka_unit_test(test_report),
    };
    return RUN(tests);
}
