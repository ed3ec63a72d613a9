/* gnomon_cast_faces against truth, which knows nothing of it: whichever faces go into the map,
 * solid things throw the same shadow; with `both`, `auto` and `middle` open and one-sided things do
 * too. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "image/truth.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* A cube on the ground, one on its corner above it, a wall 3 cm thick; and the open ones: a sheet
 * that faces the sun, one that shows it its back, one on edge. %s: their extras. */
static const char ground[] = "{'mesh':0,'scale':[5,1,5]}";
static const char solid[] =
    ",{'mesh':1,'translation':[-1.6,0.5,0.4],'scale':[0.5,0.5,0.5]%s}"
    ",{'mesh':1,'translation':[0.4,1.2,-1],'rotation':[0.28,0.36,0.1,0.884],'scale':[0.4,0.4,0.4]%"
    "s}"
    ",{'mesh':1,'translation':[1.7,0.6,0.5],'rotation':[0,0.3,0,0.954],'scale':[0.6,0.6,0.015]%s}";
static const char sheets[] =
    ",{'mesh':0,'translation':[-0.3,0.9,1.4],'rotation':[0.2,0,0.1,0.9747],'scale':[0.4,1,0.3]%s}"
    ",{'mesh':0,'translation':[-1.8,1.3,-1.6],'rotation':[0.98,0,0.1,0.17],'scale':[0.4,1,0.4]%s}"
    ",{'mesh':0,'translation':[1.6,0.5,-1.7],'rotation':[0,0,0.7071,0.7071],'scale':[0.5,1,0.4]%s}";

static char *write_scene(const char *faces, bool with_open, bool spot) {
    struct gn_maker maker;
    struct gn_err err = {0};
    char extras[64], nodes[2400], all[3200];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    snprintf(extras, sizeof extras, ",'extras':{'gnomon_cast_faces':'%s'}", faces);
    int n = snprintf(nodes, sizeof nodes, solid, extras, extras, extras);
    if (with_open) snprintf(nodes + n, sizeof nodes - (size_t)n, sheets, extras, extras, extras);
    snprintf(
        all, sizeof all,
        "[%s,{'translation':[2.2,5.5,3],'rotation':[-0.4839,0.2391,0.1396,0.8301],"
        "'extensions':{'KHR_lights_punctual':{'light':0}}},"
        "{'camera':0,'translation':[-3.2,4.6,6.4],'rotation':[-0.2759,-0.2179,-0.0643,0.9339]}%s]",
        ground, nodes);
    gn_maker_set(&maker, "nodes", all);
    gn_maker_set(&maker, "scenes",
                 with_open ? "[{'nodes':[0,1,2,3,4,5,6,7,8]}]" : "[{'nodes':[0,1,2,3,4,5]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.75,'znear':0.1,'zfar':40}}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 spot
                     ? "{'KHR_lights_punctual':{'lights':[{'type':'spot','intensity':300,"
                       "'spot':{'innerConeAngle':0.8,'outerConeAngle':0.9}}]}}"
                     : "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3}]}}");
    char *path = malloc(400);
    if (!path) abort();
    snprintf(path, 400, "%s/faces-%s-%d-%d.glb", gn_shot_build(), faces, with_open, spot);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static struct gn_mask_score measure(const char *faces, bool with_open, bool spot,
                                    const char *technique) {
    struct gn_err err = {0};
    struct gn_truth truth;
    struct gn_picture shot;
    struct gn_mask_score score;
    char *path = write_scene(faces, with_open, spot);
    const char *const args[] = {"--aov", "visibility", "--size",  "640x480", "--backend",
                                "egl",   "--shadow",   technique, NULL};
    if (!gn_truth_load(&truth, path, NULL, &err)) fail_msg("%s", err.text);
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    gn_truth_band(&truth, 1024);
    gn_mask_compare(&truth.mask, shot.data, shot.channels, &score);
    gn_picture_finish(&shot);
    gn_truth_finish(&truth);
    free(path);
    return score;
}

static void check(const char *faces, bool with_open, bool spot) {
    static const char *const techniques[] = {"hard", "pcf"};
    for (int t = 0; t < 2; t++) {
        struct gn_mask_score score = measure(faces, with_open, spot, techniques[t]);
        print_message(
            "%-5s %-5s %-4s %-4s acne %.4f %%, leak %.4f %%, gap %.3f %%, wrong %.3f %%\n", faces,
            with_open ? "open" : "solid", spot ? "spot" : "sun", techniques[t],
            gn_mask_acne(&score), gn_mask_leak(&score), gn_mask_gap(&score), gn_mask_wrong(&score));
        assert_true(score.dark > 3000);
        assert_true(gn_mask_acne(&score) <= .02);
        assert_true(gn_mask_leak(&score) <= .02);
        assert_true(gn_mask_gap(&score) <= 3);
        assert_true(gn_mask_wrong(&score) <= .15);
    }
}

static void test_solid_things_by_any_faces(void **state) {
    (void)state;
    static const char *const faces[] = {"both", "front", "back", "auto", "middle"};
    for (int f = 0; f < 5; f++)
        for (int spot = 0; spot < 2; spot++) check(faces[f], false, spot);
}

static void test_open_things_by_both_auto_and_middle(void **state) {
    (void)state;
    for (int spot = 0; spot < 2; spot++) {
        check("both", true, spot);
        check("auto", true, spot);
        check("middle", true, spot);
    }
}

/* A sheet that faces the sun is gone from a map of back faces, one that shows it its back from a
 * map of front faces: the words mean what they say. */
static void test_one_side_of_a_sheet_throws_no_shadow(void **state) {
    (void)state;
    struct gn_mask_score back = measure("back", true, false, "hard");
    struct gn_mask_score front = measure("front", true, false, "hard");
    struct gn_mask_score both = measure("both", true, false, "hard");
    assert_true(back.leak > both.leak + 300);
    assert_true(front.leak > both.leak + 300);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solid_things_by_any_faces),
        cmocka_unit_test(test_open_things_by_both_auto_and_middle),
        cmocka_unit_test(test_one_side_of_a_sheet_throws_no_shadow),
    };
    return cmocka_run_group_tests_name("cast faces", tests, NULL, NULL);
}
