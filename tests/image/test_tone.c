/* Tone mapping against each operator in double precision, written as its source has it, over the
 * linear picture that `render -o x.pfm` writes; as surfaces are drawn, and as the last pass does it
 * where lights are added. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { COLUMNS = 16, ROWS = 9, SIDE = 12, WIDTH = COLUMNS * SIDE, HEIGHT = ROWS * SIDE };
enum { FEW = 1, MANY = 11 }; /* lights: of one pass, of two */

/* ---- the operators ---- */

static void multiply(const double m[9], const double v[3], double out[3]) {
    for (int r = 0; r < 3; r++)
        out[r] = m[3 * r] * v[0] + m[3 * r + 1] * v[1] + m[3 * r + 2] * v[2];
}

/* Khronos: PBR Neutral tone mapper, specification. */
static void neutral(const double in[3], double out[3]) {
    const double start = 0.8 - 0.04, desaturation = 0.15;
    const double x = fmin(in[0], fmin(in[1], in[2]));
    const double offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    for (int k = 0; k < 3; k++) out[k] = in[k] - offset;
    const double peak = fmax(out[0], fmax(out[1], out[2]));
    if (peak < start) return;
    const double d = 1 - start, new_peak = 1 - d * d / (peak + d - start);
    const double g = 1 - 1 / (desaturation * (peak - new_peak) + 1);
    for (int k = 0; k < 3; k++) out[k] = out[k] * new_peak / peak * (1 - g) + new_peak * g;
}

/* Stephen Hill's fit, as in "Baking Lab"; the factor is three.js'. */
static void aces(const double in[3], double out[3]) {
    static const double rrt[9] = {.59719, .35458, .04823, .076,  .90834,
                                  .01566, .0284,  .13383, .83777};
    static const double odt[9] = {1.60475, -.53108, -.07367, -.10208, 1.10813,
                                  -.00605, -.00327, -.07276, 1.07602};
    double v[3], fit[3];
    for (int k = 0; k < 3; k++) out[k] = in[k] / 0.6;
    multiply(rrt, out, v);
    for (int k = 0; k < 3; k++)
        fit[k] = (v[k] * (v[k] + 0.0245786) - 0.000090537) /
                 (v[k] * (0.983729 * v[k] + 0.4329510) + 0.238081);
    multiply(odt, fit, out);
}

/* Benjamin Wrensch: "Minimal AgX Implementation"; rows here. */
static void agx(const double in[3], double out[3]) {
    static const double inset[9] = {0.842479062253094,  0.0784335999999992, 0.0792237451477643,
                                    0.0423282422610123, 0.878468636469772,  0.0791661274605434,
                                    0.0423756549057051, 0.0784336,          0.879142973793104};
    static const double outset[9] = {1.19687900512017,    -0.0980208811401368, -0.0990297440797205,
                                     -0.0528968517574562, 1.15190312990417,    -0.0989611768448433,
                                     -0.0529716355144438, -0.0980434501171241, 1.15107367264116};
    double x[3];
    multiply(inset, in, x);
    for (int k = 0; k < 3; k++) {
        const double log = fmin(fmax(log2(fmax(x[k], 1e-10)), -12.47393), 4.026069);
        const double t = (log + 12.47393) / (4.026069 + 12.47393);
        x[k] = 15.5 * pow(t, 6) - 40.14 * pow(t, 5) + 31.96 * pow(t, 4) - 6.868 * pow(t, 3) +
               0.4298 * t * t + 0.1191 * t - 0.00232;
    }
    multiply(outset, x, out);
    for (int k = 0; k < 3; k++) out[k] = pow(fmin(fmax(out[k], 0), 1), 2.2);
}

static void none(const double in[3], double out[3]) { memcpy(out, in, 3 * sizeof *in); }

static const struct {
    const char *name;
    void (*map)(const double in[3], double out[3]);
} operators[] = {{"none", none}, {"neutral", neutral}, {"aces", aces}, {"agx", agx}};
enum { OPERATORS = sizeof operators / sizeof *operators };

static double encoded(double c) {
    c = fmin(fmax(c, 0), 1);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

/* ---- the scene: squares that emit, seen from above; the last row is black and unlit ---- */

/* Hues and their mixtures with white in columns, strengths in rows. */
static void colour_of(int column, int row, double out[3]) {
    const double hue = column % 8 / 7.0 * 6, white = column < 8 ? 0 : 0.35;
    const double strength = pow(0.5, row);
    for (int k = 0; k < 3; k++) {
        const double away = fabs(fmod(hue + 6 - 2 * k, 6) - 3) - 1;
        const double pure = column % 8 == 7 ? 1 : fmin(fmax(away, 0), 1);
        out[k] = strength * (white + (1 - white) * pure);
    }
}

/* lights 0: gnomon makes one. */
static const char *make_scene(const char *name, int lights) {
    static char path[600];
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "meshes", "[]");
    gn_maker_set(&maker, "nodes", "[]");
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        double color[3];
        colour_of(i % COLUMNS, i / COLUMNS, color);
        char text[500];
        if (i / COLUMNS == ROWS - 1)
            snprintf(text, sizeof text,
                     "{'extensions':{'KHR_materials_unlit':{}},'pbrMetallicRoughness':{"
                     "'baseColorFactor':[%.6f,%.6f,%.6f,1]}}",
                     pow(i % COLUMNS / 15.0, 2), i % 2 * 0.7, i % 3 * 0.5);
        else
            snprintf(text, sizeof text,
                     "{'emissiveFactor':[%.6f,%.6f,%.6f],'pbrMetallicRoughness':{'metallicFactor':"
                     "0,'baseColorFactor':[%.6f,0.3,0.02,1]}}",
                     color[0], color[1], color[2], i % 5 * 0.2);
        gn_maker_add(&maker, "materials", text);
        snprintf(text, sizeof text,
                 "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':%d}]}", i);
        gn_maker_add(&maker, "meshes", text);
        snprintf(text, sizeof text, "{'mesh':%d,'translation':[%d,0,%d],'scale':[0.4,1,0.4]}", i,
                 i % COLUMNS, i / COLUMNS);
        gn_maker_add(&maker, "nodes", text);
    }
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':8,'ymag':4.5,'znear':1,"
                 "'zfar':20}}]");
    gn_maker_add(&maker, "nodes",
                 "{'camera':0,'translation':[7.5,10,4],'rotation':[-0.70710678,0,0,0.70710678]}");
    if (lights > 0) gn_maker_suns(&maker, lights, 0.8 / lights);
    gn_maker_set(&maker, "extensionsUsed",
                 lights > 0 ? "['KHR_lights_punctual','KHR_materials_unlit']"
                            : "['KHR_materials_unlit']");
    gn_maker_show_all(&maker, "[0.9,0.5,0.1]");
    snprintf(path, sizeof path, "%s/tone-%s.glb", gn_shot_build(), name);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static struct gn_picture shoot(const char *kind, const char *path, const char *ev, const char *tone,
                               const char *without) {
    struct gn_picture picture;
    struct gn_err err = {0};
    char size[32];
    snprintf(size, sizeof size, "%dx%d", WIDTH, HEIGHT);
    const char *args[20] = {"--size", size,       "--backend", "egl", "--exposure", ev,  "--tone",
                            tone,     "--shadow", "none",      NULL,  NULL,         NULL};
    if (without) args[10] = "--without", args[11] = without;
    if (!gn_shot(&picture, NULL, &err, kind, path, args)) fail_msg("%s", err.text);
    return picture;
}

/* The middles of the squares, and of the gaps between them, which show the background. Sums of
 * lights are rounded to half floats once per pass. */
static void compare(const char *path, const char *ev, int operator, const char * without) {
    const double most = strstr(path, "many") ? 1.5 : 1.0; /* in 255 */
    struct gn_picture linear = shoot("pfm", path, ev, operators[operator].name, NULL);
    struct gn_picture shown = shoot("png", path, ev, operators[operator].name, without);
    for (int y = 0; y < 2 * ROWS - 1; y++)
        for (int x = 0; x < COLUMNS; x++) {
            const int px = x * SIDE + SIDE / 2, py = y * SIDE / 2 + SIDE / 2;
            const float *in = gn_picture_at(&linear, px, py), *got = gn_picture_at(&shown, px, py);
            const double radiance[3] = {in[0], in[1], in[2]};
            double wanted[3];
            (y % 2 ? none : operators[operator].map)(radiance, wanted);
            for (int k = 0; k < 3; k++)
                if (fabs(255 * (got[k] - encoded(wanted[k]))) > most)
                    fail_msg("%s, %s EV, %s, square %d, %.1f, channel %d: %.4f becomes %.2f, not "
                             "%.2f",
                             path, ev, operators[operator].name, x, y / 2.0, k, radiance[k],
                             255 * (double)got[k], 255 * encoded(wanted[k]));
        }
    gn_picture_finish(&linear);
    gn_picture_finish(&shown);
}

static void test_each_operator_is_as_its_source_has_it(void **state) {
    (void)state;
    static const char *const exposures[] = {"0", "3", "6"};
    const char *path = make_scene("few", FEW);
    for (int i = 0; i < OPERATORS; i++)
        for (int e = 0; e < 3; e++) compare(path, exposures[e], i, NULL);
}

static void test_added_lights_are_mapped_as_a_sum(void **state) {
    (void)state;
    const char *path = make_scene("many", MANY);
    for (int i = 0; i < OPERATORS; i++) compare(path, "4", i, NULL);
}

/* Shaders encode, or a last pass. */
static void test_without_srgb_targets_it_is_the_same(void **state) {
    (void)state;
    compare(make_scene("few", FEW), "4", 1, "srgb");
    compare(make_scene("many", MANY), "4", 1, "srgb");
}

/* Half floats are what lights are added in; without them there is no tone, and one line says so. */
static void test_without_half_floats_sums_have_no_tone(void **state) {
    (void)state;
    static struct gn_run run;
    struct gn_err err = {0};
    char out[600];
    snprintf(out, sizeof out, "%s/tone-poor.png", gn_shot_build());
    const char *const argv[] = {gn_shot_program(),
                                "render",
                                make_scene("many", MANY),
                                "-o",
                                out,
                                "--size",
                                "64x36",
                                "--backend",
                                "egl",
                                "--without",
                                "rgba16f",
                                "--tone",
                                "agx",
                                NULL};
    if (!gn_run(&run, argv, 0, &err)) fail_msg("%s", err.text);
    assert_int_equal(run.status, 0);
    assert_non_null(strstr(run.err, "no tone mapping"));
    unlink(out);
}

static void expect_same(const char *path, const char *kind, const char *tone, const char *as,
                        bool same) {
    struct gn_picture a = shoot(kind, path, "3", tone, NULL), b = shoot(kind, path, "3", as, NULL);
    const size_t size = (size_t)(WIDTH * HEIGHT * a.channels) * sizeof *a.data;
    if ((memcmp(a.data, b.data, size) == 0) != same)
        fail_msg("%s: --tone %s is %s as %s", path, tone, same ? "not the same" : "the same", as);
    gn_picture_finish(&a);
    gn_picture_finish(&b);
}

static void test_auto_is_neutral_for_a_light_that_gnomon_made(void **state) {
    (void)state;
    expect_same(make_scene("few", FEW), "png", "auto", "none", true);
    const char *path = make_scene("made", 0);
    expect_same(path, "png", "auto", "neutral", true);
    expect_same(path, "png", "auto", "none", false);
    expect_same(path, "pfm", "neutral", "none", true); /* for measurement: linear */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_operator_is_as_its_source_has_it),
        cmocka_unit_test(test_added_lights_are_mapped_as_a_sum),
        cmocka_unit_test(test_without_srgb_targets_it_is_the_same),
        cmocka_unit_test(test_without_half_floats_sums_have_no_tone),
        cmocka_unit_test(test_auto_is_neutral_for_a_light_that_gnomon_made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
