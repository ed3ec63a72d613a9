/* Backgrounds: a transparent picture, laid over white and over black in linear light, is the
 * picture drawn over white and black; a colour is the colour that is given, whatever the tone. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { WIDTH = 192, HEIGHT = 108, PANES = 8, FEW = 1, MANY = 11 };

static double linear_of(double c) {
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}
static double encoded(double c) {
    c = fmin(fmax(c, 0), 1);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

/* Panes of rising alpha, half of them before a slanted opaque square, some shining, two of grey
 * glass. */
static const char *make_scene(const char *name, int lights) {
    static char path[600];
    struct gn_maker maker;
    struct gn_err err = {0};
    char text[500];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "meshes", "[]");
    gn_maker_set(&maker, "nodes",
                 "[{'camera':0,'translation':[0,10,0],'rotation':[-0.70710678,0,0,0.70710678]},"
                 "{'mesh':0,'translation':[-3,-1,0.5],'rotation':[0,0.3,0,0.954],'scale':[2.5,1,"
                 "1.2]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':8,'ymag':4.5,'znear':1,"
                 "'zfar':20}}]");
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'metallicFactor':0,'baseColorFactor':[0.9,0.4,0.1,1]}"
                 "}]");
    gn_maker_set(&maker, "meshes",
                 "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}]");
    for (int i = 0; i < PANES; i++) {
        snprintf(text, sizeof text,
                 "{'alphaMode':'%s','emissiveFactor':[%.3f,0,%.3f],'pbrMetallicRoughness':{"
                 "'metallicFactor':0,'baseColorFactor':[%.3f,%.3f,%.3f,%.4f]},'extensions':{"
                 "'KHR_materials_transmission':{'transmissionFactor':%g}}}",
                 i == 3 ? "OPAQUE" : "BLEND", i % 4 == 1 ? 0.9 : 0.0, i % 4 == 2 ? 1.0 : 0.0,
                 i / 8.0, i % 4 == 3 ? i / 8.0 : 0.5, i % 4 == 3 ? i / 8.0 : 0.8,
                 (i + 0.6) / (PANES + 1), i % 4 == 3 ? 0.8 : 0.0);
        gn_maker_add(&maker, "materials", text);
        snprintf(text, sizeof text,
                 "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':%d}]}", i + 1);
        gn_maker_add(&maker, "meshes", text);
        snprintf(text, sizeof text,
                 "{'mesh':%d,'translation':[%.2f,%.2f,%.2f],'scale':[1,1,1.6],"
                 "'rotation':[0,%.3f,0,1]}",
                 i + 1, -6.0 + 1.7 * i, 0.1 * i, i % 2 ? -1.5 : 1.2, 0.03 * i);
        gn_maker_add(&maker, "nodes", text);
    }
    gn_maker_suns(&maker, lights, 3.0 / lights);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_show_all(&maker, NULL);
    snprintf(path, sizeof path, "%s/background-%s.glb", gn_shot_build(), name);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

struct look {
    const char *tone, *msaa, *without;
};

static struct gn_picture shoot(const char *path, const char *background, const struct look *look) {
    struct gn_picture picture;
    struct gn_err err = {0};
    char size[32];
    snprintf(size, sizeof size, "%dx%d", WIDTH, HEIGHT);
    const char *args[20] = {"--size",
                            size,
                            "--backend",
                            "egl",
                            "--background",
                            background,
                            "--tone",
                            look->tone,
                            "--msaa",
                            look->msaa,
                            "--shadow",
                            "none",
                            "--exposure",
                            look->tone[0] == 'n' && look->tone[1] == 'o' ? "-1" : "1",
                            NULL,
                            NULL,
                            NULL};
    if (look->without) args[14] = "--without", args[15] = look->without;
    if (!gn_shot(&picture, NULL, &err, "png", path, args)) fail_msg("%s", err.text);
    return picture;
}

/* In linear light, where gnomon blends. Rounded are the straight colour, alpha, and the picture
 * that it is compared with, by half a code each: 1 of 255 where alpha is 0 or 1, else 2; and 1 more
 * with passes that add lights, after which both pictures are rounded once more. Without sRGB
 * targets blending itself is another one, which is not compared. Without a tone the light is so
 * weak that no surface is brighter than white, which straight colours cannot be. */
static void compare(const char *path, const struct look *look, bool passes) {
    struct gn_picture clear = shoot(path, "transparent", look);
    assert_int_equal(clear.channels, 4);
    bool seen[3] = {0};
    double worst[2] = {0, 0};
    for (int white = 0; white < 2; white++) {
        const struct look plain = {look->tone, look->msaa, NULL};
        struct gn_picture over = shoot(path, white ? "#ffffff" : "#000000", &plain);
        assert_int_equal(over.channels, 3);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const float *from = clear.data + 4 * i, *got = over.data + 3 * i;
            const double alpha = from[3];
            seen[alpha == 0 ? 0 : alpha == 1 ? 2 : 1] = true;
            for (int k = 0; k < 3; k++) {
                const double laid = linear_of(from[k]) * alpha + white * (1 - alpha);
                const double apart = 255 * fabs(laid - linear_of(got[k]));
                const double codes = 255 * fabs(encoded(laid) - got[k]);
                worst[0] = fmax(worst[0], apart);
                worst[1] = fmax(worst[1], codes);
                if (codes > (alpha > 0 && alpha < 1 ? 2.01 : 1.01) + (passes ? 1 : 0))
                    fail_msg("%s, tone %s, %s samples%s%s, over %s, pixel %d %d: alpha %.3f, %.2f "
                             "of 255 apart in light, %.2f in bytes",
                             path, look->tone, look->msaa, look->without ? ", without " : "",
                             look->without ? look->without : "", white ? "white" : "black",
                             i % WIDTH, i / WIDTH, alpha, apart, codes);
            }
        }
        gn_picture_finish(&over);
    }
    assert_true(seen[0] && seen[1] && seen[2]);
    print_message("%s, tone %s, %s samples: %.2f of 255 in light, %.2f in bytes\n", path,
                  look->tone, look->msaa, worst[0], worst[1]);
    gn_picture_finish(&clear);
}

static void test_a_transparent_picture_can_be_laid_over_any_other(void **state) {
    (void)state;
    const char *path = make_scene("few", FEW);
    compare(path, &(struct look){"none", "0", NULL}, false);
    compare(path, &(struct look){"neutral", "4", NULL}, false);
    compare(path, &(struct look){"neutral", "0", "srgb"}, false);
    compare(path, &(struct look){"agx", "4", "srgb"}, false);
}

static void test_so_can_one_that_lights_are_added_to(void **state) {
    (void)state;
    const char *path = make_scene("many", MANY);
    compare(path, &(struct look){"none", "4", NULL}, true);
    compare(path, &(struct look){"neutral", "0", NULL}, true);
    compare(path, &(struct look){"aces", "4", "srgb"}, true);
}

/* The corner shows it. */
static void expect_corner(const char *path, const char *background, const struct look *look,
                          const int rgb[3]) {
    struct gn_picture picture = shoot(path, background, look);
    for (int k = 0; k < 3; k++) {
        const double code = 255 * (double)gn_picture_at(&picture, 0, 0)[k];
        if (fabs(code - rgb[k]) > 0.6)
            fail_msg("%s, tone %s: channel %d of the background is %.1f", background, look->tone, k,
                     code);
    }
    gn_picture_finish(&picture);
}

static void test_a_colour_has_no_tone(void **state) {
    (void)state;
    static const int orange[3] = {255, 128, 16};
    expect_corner(make_scene("few", FEW), "#ff8010", &(struct look){"none", "0", NULL}, orange);
    expect_corner(make_scene("few", FEW), "#FF8010", &(struct look){"agx", "4", "srgb"}, orange);
    expect_corner(make_scene("many", MANY), "#ff8010", &(struct look){"agx", "0", NULL}, orange);
}

static const char *said(const char *path, const char *out, const char *without) {
    static struct gn_run run;
    struct gn_err err = {0};
    char file[600];
    snprintf(file, sizeof file, "%s/%s", gn_shot_build(), out);
    const char *const argv[] = {gn_shot_program(),
                                "render",
                                path,
                                "-o",
                                file,
                                "--size",
                                "32x18",
                                "--background",
                                "transparent",
                                "--backend",
                                "egl",
                                without ? "--without" : NULL,
                                without,
                                NULL};
    if (!gn_run(&run, argv, 0, &err)) fail_msg("%s", err.text);
    assert_int_equal(run.status, 0);
    remove(file);
    return run.err;
}

static void test_where_alpha_is_not_kept_one_line_says_so(void **state) {
    (void)state;
    const char *path = make_scene("few", FEW), *black = "here it is black";
    assert_string_equal(said(path, "background.png", NULL), "");
    assert_non_null(strstr(said(path, "background.pfm", NULL), black));
    assert_non_null(strstr(said(path, "background.png", "rgba16f"), black));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_transparent_picture_can_be_laid_over_any_other),
        cmocka_unit_test(test_so_can_one_that_lights_are_added_to),
        cmocka_unit_test(test_a_colour_has_no_tone),
        cmocka_unit_test(test_where_alpha_is_not_kept_one_line_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
