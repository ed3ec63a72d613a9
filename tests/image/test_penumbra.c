/* Penumbrae against truth: pcss, cone, vssm and smsm are as wide as the light makes them, disk and
 * poisson are monotone and not too grainy. The quick form is smaller and leaves out some formats.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/compare.h"
#include "image/penumbra.h"
#include "image/shot.h"
#include "shadow/technique.h"
#include "unit/check.h"

enum { QUICK_W = 240, QUICK_H = 180, FULL_W = 640, FULL_H = 480 };

/* As large as the truth. */
static struct gn_picture shoot(const char *path, const struct gn_picture *truth,
                               const char *technique, const char *format, const char *taps) {
    struct gn_err err = {0};
    struct gn_picture shot;
    char size[32];
    snprintf(size, sizeof size, "%dx%d", truth->width_px, truth->height_px);
    const char *const args[] = {"--aov",  "visibility", "--size",  size,           "--backend",
                                "egl",    "--shadow",   technique, "--map-format", format,
                                "--taps", taps,         NULL};
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    return shot;
}

/* A scene's file and its truth, which is cast once. */
static struct {
    char *path;
    struct gn_picture truth;
} made[GN_PENUMBRA_ALL];

static const char *make_of_size(int scene, struct gn_picture *truth, int width_px, int height_px) {
    struct gn_err err = {0};
    struct gn_picture *kept = &made[scene].truth;
    if (!made[scene].path && !(made[scene].path = gn_penumbra_write(scene, &err)))
        fail_msg("%s", err.text);
    if (kept->width_px != width_px) {
        gn_picture_finish(kept);
        if (!gn_penumbra_truth(kept, made[scene].path, false, width_px, height_px, &err))
            fail_msg("%s", err.text);
    }
    *truth = *kept;
    return made[scene].path;
}

static const char *make(int scene, struct gn_picture *truth) {
    return make_of_size(scene, truth, gn_shot_full() ? FULL_W : QUICK_W,
                        gn_shot_full() ? FULL_H : QUICK_H);
}

static int finish_made(void **state) {
    (void)state;
    for (int i = 0; i < GN_PENUMBRA_ALL; i++) {
        gn_picture_finish(&made[i].truth);
        free(made[i].path);
    }
    return 0;
}

static struct gn_penumbra_score score_of(const char *path, const struct gn_picture *truth,
                                         const char *technique, const char *format) {
    struct gn_picture shot = shoot(path, truth, technique, format, "16");
    struct gn_penumbra_score score;
    gn_penumbra_score(truth, &shot, &score);
    gn_picture_finish(&shot);
    return score;
}

/* Of shot - truth over the penumbrae of these rows; NAN: there are hardly any. */
static double bias_of_rows(const struct gn_picture *truth, const struct gn_picture *shot, int y,
                           int rows) {
    double sum = 0;
    int count = 0;
    for (int i = y * truth->width_px; i < (y + rows) * truth->width_px; i++)
        if (truth->data[i] > .01f && truth->data[i] < .99f) {
            sum += (double)(shot->data[i] - truth->data[i]);
            count++;
        }
    return count < 4 * rows ? NAN : sum / count;
}

/* From ten rows of the ground to the next, over their whole width; test_splits looks closer. FIRST:
 * 90 m away, where the bar is as wide as a texel; there are splits at 13 and 45 m. */
static void check_splits(const char *path, const struct gn_picture *truth, const char *technique) {
    enum { FIRST = 136, ROWS = 10 };
    struct gn_picture shot = shoot(path, truth, technique, "auto", "16");
    double worst = 0;
    int pairs = 0;
    for (int y = FIRST; y + 2 * ROWS <= FULL_H; y++) {
        const double step =
            bias_of_rows(truth, &shot, y + ROWS, ROWS) - bias_of_rows(truth, &shot, y, ROWS);
        if (isnan(step)) continue;
        worst = fmax(worst, fabs(step));
        pairs++;
    }
    print_message("%s: from rows to the next at most %.3f, %d pairs\n", technique, worst, pairs);
    assert_true(pairs > 300);
    assert_true(worst <= .1);
    gn_picture_finish(&shot);
}

static void test_no_split_is_seen_in_a_penumbra(void **state) {
    (void)state;
    struct gn_picture truth;
    const char *path = make_of_size(GN_PENUMBRA_FIELD, &truth, FULL_W, FULL_H);
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
        if (gn_techniques[t].soft) check_splits(path, &truth, gn_techniques[t].name);
}

static void check_scene(int scene) {
    static const char *const formats[] = {"r16f", "depth", "r32ui", "rgba8", "r16f-raw"};
    struct gn_picture truth;
    const char *path = make(scene, &truth);
    struct gn_penumbra_score hard = score_of(path, &truth, "hard", "r16f");
    for (int f = 0; f < (gn_shot_full() || scene == GN_PENUMBRA_SEAM ? 5 : 2); f++) {
        struct gn_penumbra_score pcss = score_of(path, &truth, "pcss", formats[f]);
        print_message("%-7s %-8s soft %.4f (hard %.4f, %.2f of it), rest %.4f\n",
                      gn_penumbra_names[scene], formats[f], pcss.soft, hard.soft,
                      pcss.soft / hard.soft, pcss.rest);
        assert_true(pcss.soft_pixels > 200);
        assert_true(pcss.soft <= .06);
        assert_true(pcss.soft <= .3 * hard.soft);
        assert_true(pcss.rest <= .02);
    }
}

static void test_pcss(void **state) {
    (void)state;
    for (int scene = 0; scene < GN_PENUMBRA_EDGE; scene++) check_scene(scene);
}

/* No worse than pcss with as many taps, and in all formats the same but for how they filter. */
static void check_cones(int scene) {
    static const char *const formats[] = {"rg16f", "rg16f-bits", "rg16f-bytes"};
    struct gn_picture truth;
    const char *path = make(scene, &truth);
    const struct gn_penumbra_score pcss = score_of(path, &truth, "pcss", "auto");
    for (int f = 0; f < (gn_shot_full() || scene == GN_PENUMBRA_SEAM ? 3 : 1); f++) {
        const struct gn_penumbra_score cone = score_of(path, &truth, "cone", formats[f]);
        print_message("%-7s %-11s soft %.4f (pcss %.4f), rest %.4f\n", gn_penumbra_names[scene],
                      formats[f], cone.soft, pcss.soft, cone.rest);
        assert_true(cone.soft_pixels > 200);
        assert_true(cone.soft <= pcss.soft);
        assert_true(cone.rest <= .01);
    }
}

static void test_cones(void **state) {
    (void)state;
    for (int scene = 0; scene < GN_PENUMBRA_EDGE; scene++) check_cones(scene);
}

/* The limits are wider than those of pcss, whose taps know each blocker by itself. */
static void check_tables(int scene) {
    struct gn_picture truth;
    const char *path = make(scene, &truth);
    struct gn_penumbra_score hard = score_of(path, &truth, "hard", "r16f");
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        if (gn_techniques[t].filter != GN_FILTER_TABLE) continue;
        struct gn_penumbra_score score = score_of(path, &truth, gn_techniques[t].name, "auto");
        print_message("%-7s %-8s soft %.4f (hard %.4f, %.2f of it), rest %.4f\n",
                      gn_penumbra_names[scene], gn_techniques[t].name, score.soft, hard.soft,
                      score.soft / hard.soft, score.rest);
        assert_true(score.soft_pixels > 200);
        assert_true(score.soft <= .13);
        assert_true(score.soft <= .5 * hard.soft);
        assert_true(score.rest <= .03);
    }
}

static void test_summed_area_tables(void **state) {
    (void)state;
    for (int scene = 0; scene < GN_PENUMBRA_EDGE; scene++) check_tables(scene);
}

static void check_edge(const char *path, const struct gn_picture *truth, const char *technique) {
    struct gn_picture shot = shoot(path, truth, technique, "auto", "16");
    struct gn_penumbra_edge edge;
    gn_penumbra_edge(truth, &shot, &edge);
    print_message("%s: width %.3f of %.3f m, energy %+.4f, grain %.3f, back %.4f\n", technique,
                  edge.width, edge.width_truth, edge.energy, edge.grain, edge.rise);
    assert_true(fabs(edge.width - edge.width_truth) <= .1 * edge.width_truth);
    assert_true(fabs(edge.energy) <= .02);
    assert_true(edge.rise <= .01);
    gn_picture_finish(&shot);
}

/* Blurred ones know no penumbrae, but what is fully lit or dark, of casters that span 850 m. */
static void test_moments_of_a_field(void **state) {
    (void)state;
    struct gn_picture truth;
    const char *path = make(GN_PENUMBRA_FIELD, &truth);
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        if (gn_techniques[t].filter != GN_FILTER_BLUR) continue;
        struct gn_penumbra_score score = score_of(path, &truth, gn_techniques[t].name, "auto");
        print_message("field   %-8s rest %.4f\n", gn_techniques[t].name, score.rest);
        assert_true(score.rest <= .03);
    }
}

static void test_the_edge_of_a_half_plane_is_exact(void **state) {
    (void)state;
    struct gn_picture truth;
    const char *path = make(GN_PENUMBRA_EDGE, &truth);
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++)
        if (gn_techniques[t].soft) check_edge(path, &truth, gn_techniques[t].name);
}

/* A filter three texels wide: the map is coarse, so that its penumbra is many pixels wide. */
static void test_disks_are_monotone_and_hardly_grainy(void **state) {
    (void)state;
    struct gn_picture truth;
    const char *path = make(GN_PENUMBRA_EDGE, &truth);
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        const char *name = gn_techniques[t].name;
        if (!gn_techniques[t].taps || gn_techniques[t].soft || t == GN_TECHNIQUE_WHITE) continue;
        struct gn_err err = {0};
        struct gn_picture shot, again;
        const char *const args[] = {"--aov",     "visibility", "--size",   "480x360",
                                    "--backend", "egl",        "--shadow", name,
                                    "--map",     "32",         NULL};
        if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
        if (!gn_shot(&again, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
        struct gn_penumbra_edge edge;
        gn_penumbra_edge(&shot, &shot, &edge);
        print_message("%s: %.3f m wide, grain %.3f, back %.4f\n", name, edge.width, edge.grain,
                      edge.rise);
        assert_true(edge.width > .05); /* it is wide enough to be looked at */
        assert_true(edge.grain <= .08);
        assert_true(edge.rise <= .01);
        assert_memory_equal(shot.data, again.data, 480ul * 360 * sizeof(float));
        gn_picture_finish(&shot);
        gn_picture_finish(&again);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pcss),
        cmocka_unit_test(test_cones),
        cmocka_unit_test(test_summed_area_tables),
        cmocka_unit_test(test_no_split_is_seen_in_a_penumbra),
        cmocka_unit_test(test_moments_of_a_field),
        cmocka_unit_test(test_the_edge_of_a_half_plane_is_exact),
        cmocka_unit_test(test_disks_are_monotone_and_hardly_grainy),
    };
    return cmocka_run_group_tests_name("penumbra", tests, NULL, finish_made);
}
