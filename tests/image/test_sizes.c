/* A small thing on a floor has its planar shadow however large the floor is, under a sun and under
 * a lamp a few of its sizes up; and the lamp sees it. Floors of 1 mm, 10 m and 10 km. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

static const struct size {
    const char *name;
    double floor_m, thing_m;
} sizes[] = {{"1 mm", 1e-3, 3e-5}, {"10 m", 10, .3}, {"10 km", 1e4, .3}};
enum { SIZES = 3 };

/* A floor, a cube that stands on it, and a light: a spot of 5 cubes' height, or a sun; seen from
 * above. */
static const char *write_scene(const struct size *s, bool is_spot) {
    static char path[300];
    struct gn_maker maker;
    struct gn_err err = {0};
    char text[900];
    const double b = s->thing_m, half = s->floor_m / 2;
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    snprintf(text, sizeof text,
             "[{'type':'orthographic','orthographic':{'xmag':%g,'ymag':%g,'znear':0,'zfar':%g}}]",
             2 * b, 2 * b, 20 * b);
    gn_maker_set(&maker, "cameras", text);
    snprintf(text, sizeof text,
             "{'KHR_lights_punctual':{'lights':[{'name':'L','type':'%s','intensity':%g,'extras':{'"
             "gnomon_radius':0}%s}]}}",
             is_spot ? "spot" : "directional", is_spot ? 75 * b * b : 3,
             is_spot ? ",'spot':{'outerConeAngle':0.8}" : "");
    gn_maker_set(&maker, "extensions", text);
    snprintf(text, sizeof text,
             "[{'mesh':0,'scale':[%g,1,%g]},{'mesh':1,'translation':[0,%g,0],'scale':[%g,%g,%g]},"
             "{'camera':0,'translation':[0,%g,0],'rotation':[-0.70710678,0,0,0.70710678]},"
             "{'translation':[%g,%g,0],'rotation':[-0.60633906,0.36380344,0,0.70710678],"
             "'extensions':{'KHR_lights_punctual':{'light':0}}}]",
             half, half, b / 2, b / 2, b / 2, b / 2, 10 * b, 3 * b, 5 * b);
    gn_maker_set(&maker, "nodes", text);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    snprintf(path, sizeof path, "%s/sizes.glb", gn_shot_build());
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

/* The share of dark pixels. */
static double find_dark(const char *path, const char *shadow, const char *camera) {
    struct gn_picture shot;
    struct gn_err err = {0};
    int dark = 0;
    const char *const args[] = {"--shadow",  shadow, "--aov",    "visibility", "--size", "128x128",
                                "--backend", "egl",  "--camera", camera,       NULL};
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    for (int i = 0; i < 128 * 128; i++) dark += shot.data[i * shot.channels] < .5f;
    gn_picture_finish(&shot);
    return dark / (128. * 128.);
}

static void test_planar_shadows_do_not_depend_on_the_floor(void **state) {
    (void)state;
    int wrong = 0;
    for (int is_spot = 0; is_spot < 2; is_spot++)
        for (int i = 0; i < SIZES; i++) {
            const char *path = write_scene(&sizes[i], is_spot);
            const double truth = find_dark(path, "truth", "0"),
                         planar = find_dark(path, "planar", "0");
            printf("floor of %s, %s: %.2f %% dark, planar %.2f %%\n", sizes[i].name,
                   is_spot ? "spot" : "sun", 100 * truth, 100 * planar);
            wrong += !(truth > .02 && planar > truth - .005 && planar < truth + .005);
        }
    assert_int_equal(wrong, 0);
}

/* And it is as bright in all of them. */
static void test_a_spot_sees_what_it_is_near_to(void **state) {
    (void)state;
    double light[SIZES] = {0};
    for (int i = 0; i < SIZES; i++) {
        struct gn_picture shot;
        struct gn_err err = {0};
        int seen = 0;
        const char *const args[] = {"--camera", "light:L",   "--size", "64x64", "--background",
                                    "#ff00ff",  "--backend", "egl",    NULL};
        if (!gn_shot(&shot, NULL, &err, "png", write_scene(&sizes[i], true), args))
            fail_msg("%s", err.text);
        for (int k = 0; k < 64 * 64; k++) {
            const float green = shot.data[k * shot.channels + 1];
            seen += green > 0;
            light[i] += (double)green / 4096;
        }
        gn_picture_finish(&shot);
        printf("floor of %s: the spot sees %d of 4096 pixels, mean %.3f\n", sizes[i].name, seen,
               light[i] / seen * 4096);
        assert_true(seen > 3800);
        assert_true(fabs(light[i] / light[0] * 3901 / seen - 1) < .1);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_planar_shadows_do_not_depend_on_the_floor),
        cmocka_unit_test(test_a_spot_sees_what_it_is_near_to),
    };
    return cmocka_run_group_tests_name("sizes", tests, NULL, NULL);
}
