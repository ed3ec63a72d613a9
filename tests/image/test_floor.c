/* The unseen floor (--floor): where there is one, what shadows it shows, how it lies over the
 * background. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "shadow/technique.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* A cube that stands, one on its corner above it, a thin wall; no light of its own. */
static const char bodies[] =
    "{'mesh':1,'translation':[-1.6,0.5,0.4],'scale':[0.5,0.5,0.5]}"
    ",{'mesh':1,'translation':[0.4,1.2,-1],'rotation':[0.28,0.36,0.1,0.884],'scale':[0.4,0.4,0.4]}"
    ",{'mesh':1,'translation':[1.7,0.6,0.5],'rotation':[0,0.3,0,0.954],'scale':[0.6,0.6,0.015]}"
    ",{'camera':0,'translation':[-3.2,4.6,6.4],'rotation':[-0.2759,-0.2179,-0.0643,0.9339]}";

static const char *write_scene(const char *name, const char *ground, const char *background) {
    static char path[400];
    struct gn_maker maker;
    struct gn_err err = {0};
    char nodes[1000], scenes[300];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    snprintf(nodes, sizeof nodes, "[%s%s]", bodies, ground);
    snprintf(scenes, sizeof scenes,
             "[{'nodes':[0,1,2,3%s],'extras':{'gnomon_background':%s,'gnomon_sky':[0.5,0.5,0.5],'"
             "gnomon_ground':[0.5,0.5,0.5]}}]",
             ground[0] ? ",4" : "", background);
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(&maker, "scenes", scenes);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.75,'znear':0.1,'zfar':40}}]");
    snprintf(path, sizeof path, "%s/floor-%s.glb", gn_shot_build(), name);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static struct gn_picture draw(const char *scene, const char *floor, const char *technique,
                              const char *kind, bool visibility) {
    struct gn_picture picture;
    struct gn_err err = {0};
    const char *args[] = {"--size",
                          "400x300",
                          "--backend",
                          "egl",
                          "--floor",
                          floor,
                          "--shadow",
                          technique,
                          "--output",
                          "linear",
                          "--exposure",
                          "0",
                          visibility ? "--aov" : NULL,
                          "visibility",
                          NULL};
    if (!gn_shot(&picture, NULL, &err, kind, scene, args)) fail_msg("%s", err.text);
    return picture;
}

/* Share of pixels at least 3 pixels from a shadow's edge that are wrong by over a half. */
static double wrong_share(const struct gn_picture *truth, const struct gn_picture *shot) {
    uint32_t wrong = 0, all = 0;
    for (int y = 3; y < truth->height_px - 3; y++)
        for (int x = 3; x < truth->width_px - 3; x++) {
            const float lit = gn_picture_at(truth, x, y)[0];
            bool inside = true;
            for (int k = 0; k < 49; k++)
                inside &= gn_picture_at(truth, x - 3 + k % 7, y - 3 + k / 7)[0] == lit;
            all += inside;
            wrong += inside && fabsf(gn_picture_at(shot, x, y)[0] - lit) > .5f;
        }
    return wrong / (double)all;
}

/* Lit pixels inside what is dark, edges of the dark excluded: a seam where the model stands would
 * be a row of them between its dark side and its shadow. */
static uint32_t seam_pixels(const struct gn_picture *truth, const struct gn_picture *shot) {
    uint32_t lit = 0;
    for (int y = 1; y < truth->height_px - 1; y++)
        for (int x = 1; x < truth->width_px - 1; x++) {
            bool dark = true;
            for (int k = 0; k < 9; k++)
                dark &= gn_picture_at(truth, x - 1 + k % 3, y - 1 + k / 3)[0] == 0;
            lit += dark && gn_picture_at(shot, x, y)[0] > .75f;
        }
    return lit;
}

static void test_shadows_on_it_are_true(void **state) {
    (void)state;
    const char *scene = write_scene("true", "", "[1,1,1]");
    struct gn_picture truth = draw(scene, "auto", "truth", "pfm", true);
    uint32_t dark = 0;
    for (int i = 0; i < truth.width_px * truth.height_px; i++)
        dark += truth.data[(size_t)i * (size_t)truth.channels] == 0;
    assert_in_range(dark, 2000, 40000); /* the shadows on the floor are large */
    for (int i = 0; i < GN_TECHNIQUE_COUNT; i++) {
        const char *name = gn_techniques[i].name;
        if (!gn_techniques[i].file) continue;
        struct gn_picture shot = draw(scene, "auto", name, "pfm", true);
        const double wrong = wrong_share(&truth, &shot);
        const uint32_t seam = seam_pixels(&truth, &shot);
        print_message("%s: %.3f %% wrong, %u lit pixels in the dark\n", name, 100 * wrong, seam);
        if (seam > 4 && !gn_techniques[i].on_plane) fail_msg("%s: a seam of %u pixels", name, seam);
        /* planar shadows are on the floor alone */
        if (wrong > (gn_techniques[i].on_plane ? .03 : .0005))
            fail_msg("%s: wrong %.4f", name, wrong);
        gn_picture_finish(&shot);
    }
    gn_picture_finish(&truth);
}

static bool same(struct gn_picture a, struct gn_picture b) {
    const size_t bytes = sizeof(float) * (size_t)(a.width_px * a.height_px * a.channels);
    const bool equal = a.channels == b.channels && memcmp(a.data, b.data, bytes) == 0;
    gn_picture_finish(&a);
    gn_picture_finish(&b);
    return equal;
}

static void test_a_scene_with_a_floor_gets_none(void **state) {
    (void)state;
    const char *scene = write_scene("own", ",{'mesh':0,'scale':[5,1,5]}", "[1,1,1]");
    assert_true(
        same(draw(scene, "auto", "pcf", "png", false), draw(scene, "none", "pcf", "png", false)));
    /* a table top is none: the model does not stand on it */
    scene = write_scene("top", ",{'mesh':0,'scale':[5,1,5],'translation':[0,1.5,0]}", "[1,1,1]");
    assert_false(
        same(draw(scene, "auto", "pcf", "png", false), draw(scene, "none", "pcf", "png", false)));
}

static void test_its_height_can_be_given(void **state) {
    (void)state;
    const char *scene = write_scene("height", "", "[1,1,1]");
    assert_false(
        same(draw(scene, "-0.5", "pcf", "png", false), draw(scene, "auto", "pcf", "png", false)));
}

/* Over white and over black it takes the same share of light: that of the made light in all that
 * reaches a floor. */
static void test_it_darkens_any_background_alike(void **state) {
    (void)state;
    struct gn_picture white =
        draw(write_scene("white", "", "[1,1,1]"), "auto", "hard", "png", false);
    struct gn_picture bare =
        draw(write_scene("white", "", "[1,1,1]"), "none", "hard", "png", false);
    struct gn_picture grey =
        draw(write_scene("grey", "", "[0.5,0.5,0.5]"), "auto", "hard", "png", false);
    struct gn_picture black =
        draw(write_scene("black", "", "[0,0,0]"), "auto", "hard", "png", false);
    uint32_t shaded = 0;
    float least = 1;
    for (int y = 0; y < white.height_px; y++)
        for (int x = 0; x < white.width_px; x++) {
            const float *w = gn_picture_at(&white, x, y), *g = gn_picture_at(&grey, x, y),
                        *b = gn_picture_at(&black, x, y), *all = gn_picture_at(&bare, x, y);
            if (all[0] < 1 || all[1] < 1 || w[0] == 1) continue; /* the model, or no shadow */
            shaded++;
            least = fminf(least, w[0]);
            assert_float_equal(b[0], 0, .5 / 255);
            assert_float_equal(g[0], .5f * w[0], 1.01 / 255);
            assert_float_equal(w[0], w[1], .5 / 255); /* no colour of the light */
        }
    assert_in_range(shaded, 1000, 90000);
    assert_true(least < .4f);
    gn_picture_finish(&white);
    gn_picture_finish(&bare);
    gn_picture_finish(&grey);
    gn_picture_finish(&black);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shadows_on_it_are_true),
        cmocka_unit_test(test_a_scene_with_a_floor_gets_none),
        cmocka_unit_test(test_its_height_can_be_given),
        cmocka_unit_test(test_it_darkens_any_background_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
