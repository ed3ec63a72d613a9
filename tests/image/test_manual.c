/* What figures of a filter do that are automatic unless they are set, on six of the generated
 * scenes with a map of 1024: README of src/shadow has these. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/arena.h"
#include "image/table.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH_PX = 640, HEIGHT_PX = 480, PIXELS = WIDTH_PX * HEIGHT_PX };

/* A sun, a spot and a point light each, the last three on coarse meshes. */
static const int numbers[] = {1, 13, 24, 30, 33, 36};
enum { SCENES = sizeof numbers / sizeof numbers[0] };

static struct gn_display display;
static struct gn_gl *gl;
static float *aov; /* four floats a pixel */
static struct shown {
    struct gn_scene *scene;
    struct gn_truth truth;
} scenes[SCENES];

static int open_all(void **state) {
    struct gn_err err = {0};
    (void)state;
    help_open(&display, "egl");
    gl = help_gl(&display, NULL, NULL);
    char *folder = gn_table_scenes(false, &err);
    if (!folder) fail_msg("%s", err.text);
    for (int i = 0; i < SCENES; i++) {
        char path[600];
        const struct gn_truth_opts opts = {.width_px = WIDTH_PX, .height_px = HEIGHT_PX};
        snprintf(path, sizeof path, "%s/truth-%02d.glb", folder, numbers[i]);
        scenes[i].scene = gn_scene_load(path, NULL, NULL, &err);
        if (!scenes[i].scene || !gn_truth_load(&scenes[i].truth, path, &opts, &err))
            fail_msg("%s", err.text);
        gn_truth_band(&scenes[i].truth, 1024);
        gn_truth_safe(&scenes[i].truth, 1024, 4);
    }
    free(folder);
    aov = gn_xalloc(4 * PIXELS, sizeof *aov);
    return 0;
}

static int close_all(void **state) {
    (void)state;
    free(aov);
    for (int i = 0; i < SCENES; i++) {
        gn_truth_finish(&scenes[i].truth);
        gn_scene_destroy(scenes[i].scene);
    }
    gn_gl_destroy(gl);
    gn_display_close(&display);
    return 0;
}

static struct gn_frame_opts opts_of(enum gn_technique technique) {
    return (struct gn_frame_opts){
        .output.width_px = WIDTH_PX,
        .output.height_px = HEIGHT_PX,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                       .technique = technique,
                       .map_px = 1024},
        .debug.aov = GN_AOV_VISIBILITY};
}

static void draw_scene(const struct gn_scene *scene, const struct gn_frame_opts *opts) {
    struct gn_err err = {0};
    struct gn_pose pose;
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    if (!gn_gl_load(gl, scene, &err)) fail_msg("%s", err.text);
    struct gn_frame *frame = gn_frame_create(scene, gn_gl_caps(gl));
    const struct gn_plan *plan = gn_frame_build(frame, &pose, opts, NULL);
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err) ||
        !gn_gl_read_f32(gl, aov, &err))
        fail_msg("%s", err.text);
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
}

static uint64_t shades; /* pixels of all scenes that are neither lit nor dark */

/* Of all scenes. Prints a line. */
static struct gn_mask_score score_of(const char *what, const struct gn_frame_opts *opts) {
    struct gn_mask_score sum = {0};
    shades = 0;
    for (int i = 0; i < SCENES; i++) {
        struct gn_mask_score s;
        struct gn_picture shot;
        draw_scene(scenes[i].scene, opts);
        gn_picture_init(&shot, WIDTH_PX, HEIGHT_PX, 1);
        for (int p = 0; p < PIXELS; p++) {
            shot.data[p] = aov[4 * p];
            shades += aov[4 * p] > .02f && aov[4 * p] < .98f;
        }
        gn_mask_compare(&scenes[i].truth.mask, shot.data, shot.channels, &s);
        gn_picture_finish(&shot);
        sum.pixels += s.pixels, sum.dark += s.dark, sum.away_lit += s.away_lit, sum.acne += s.acne;
        sum.gap += s.gap, sum.wrong += s.wrong, sum.safe += s.safe, sum.darkened += s.darkened;
        sum.darkness += s.darkness;
    }
    printf("%s, %s: darkening %.3f %%, over 5 %%: %.3f %%, gap %.2f %%, wrong %.3f %%, "
           "shades %.2f %%\n",
           gn_techniques[opts->shadow.any.technique].name, what, gn_mask_darkening(&sum),
           gn_mask_darkened(&sum), gn_mask_gap(&sum), gn_mask_wrong(&sum),
           100 * (double)shades / (double)sum.pixels);
    return sum;
}

static struct gn_mask_score with_bias(enum gn_technique technique, float texels) {
    struct gn_frame_opts opts = opts_of(technique);
    char what[32];
    GN_LIGHT_SET(&opts.shadow.any, bias_texels, texels);
    snprintf(what, sizeof what, "bias %g", (double)texels);
    return score_of(what, &opts);
}

static void test_no_bias_is_acne_and_a_large_one_a_gap(void **state) {
    (void)state;
    static const enum gn_technique techniques[] = {GN_TECHNIQUE_HARD, GN_TECHNIQUE_PCF};
    for (int i = 0; i < 2; i++) {
        const enum gn_technique technique = techniques[i];
        const struct gn_frame_opts opts = opts_of(technique);
        const struct gn_mask_score automatic = score_of("automatic", &opts),
                                   own = with_bias(technique, gn_techniques[technique].bias_texels),
                                   none = with_bias(technique, 0), large = with_bias(technique, 16);
        assert_true(own.wrong == automatic.wrong && own.darkness == automatic.darkness);
        assert_true(gn_mask_darkening(&none) > 20 * gn_mask_darkening(&automatic));
        assert_true(none.wrong > 2 * automatic.wrong);
        assert_true(large.gap > 3 * automatic.gap);
        assert_true(large.wrong > 2 * automatic.wrong);
    }
}

/* Wider edges, and no acne from them. */
static void test_the_radius_of_a_filter(void **state) {
    (void)state;
    static const struct {
        enum gn_technique technique;
        float narrow_px, own_px, wide_px; /* own: 0: unlike any */
    } rows[] = {{GN_TECHNIQUE_DISK, 1, 3, 8},
                {GN_TECHNIQUE_PCF, 1, 1.5f, 2},
                {GN_TECHNIQUE_MSM, 1.5f, 0, 4.5f}};
    for (int i = 0; i < 3; i++) {
        struct gn_frame_opts opts = opts_of(rows[i].technique);
        const float radii[] = {0, rows[i].own_px, rows[i].narrow_px, rows[i].wide_px};
        struct gn_mask_score scores[4];
        uint64_t counts[4];
        for (int k = 0; k < 4; k++) {
            char what[32];
            GN_LIGHT_SET(&opts.shadow.any, filter_radius_px, radii[k]);
            snprintf(what, sizeof what, "radius %g", (double)radii[k]);
            scores[k] = score_of(what, &opts);
            counts[k] = shades;
            if (i < 2) assert_true(gn_mask_darkening(&scores[k]) < .02);
        }
        assert_true(scores[1].wrong == scores[0].wrong && counts[1] == counts[0]);
        if (i < 2) assert_true(counts[2] < counts[0]);
        assert_true(counts[3] > counts[2] * 5 / 4);
    }
}

enum { COUNTS = 4 };
static const unsigned counts[COUNTS] = {0, 4, 16, 32};

/* Root mean square of what pictures with so many taps differ from those with 64, over the pixels
 * that are neither lit nor dark in one of them. */
static void find_noise(enum gn_technique technique, double noise[COUNTS]) {
    static float many[PIXELS];
    struct gn_frame_opts opts = opts_of(technique);
    uint64_t pixels[COUNTS] = {0};
    for (int k = 0; k < COUNTS; k++) noise[k] = 0;
    for (int i = 0; i < SCENES; i++) {
        GN_LIGHT_SET(&opts.shadow.any, taps, GN_TAPS_MAX);
        draw_scene(scenes[i].scene, &opts);
        for (int p = 0; p < PIXELS; p++) many[p] = aov[4 * p];
        for (int k = 0; k < COUNTS; k++) {
            GN_LIGHT_SET(&opts.shadow.any, taps, counts[k]);
            draw_scene(scenes[i].scene, &opts);
            for (int p = 0; p < PIXELS; p++) {
                const double d = (double)(aov[4 * p] - many[p]);
                if (d == 0 && (many[p] == 0 || many[p] == 1)) continue;
                noise[k] += d * d;
                pixels[k]++;
            }
        }
    }
    for (int k = 0; k < COUNTS; k++) {
        assert_true(pixels[k] > 0);
        noise[k] = sqrt(noise[k] / (double)pixels[k]);
        printf("%s, taps %u: %.4f\n", gn_techniques[technique].name, counts[k], noise[k]);
    }
}

static void test_more_taps_are_less_noise(void **state) {
    (void)state;
    static const enum gn_technique techniques[] = {GN_TECHNIQUE_DISK, GN_TECHNIQUE_PCSS};
    for (int i = 0; i < 2; i++) {
        double noise[COUNTS];
        find_noise(techniques[i], noise);
        assert_true(noise[0] == noise[2]); /* automatic: 16 */
        assert_true(noise[1] > 2 * noise[2]);
        assert_true(noise[3] < .8 * noise[2]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_bias_is_acne_and_a_large_one_a_gap),
        cmocka_unit_test(test_the_radius_of_a_filter),
        cmocka_unit_test(test_more_taps_are_less_noise),
    };
    return cmocka_run_group_tests_name("manual", tests, open_all, close_all);
}
