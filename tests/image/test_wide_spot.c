/* A wide spot and plates that face it from near the rim of its cone: a surface that the light meets
 * at a right angle, whose depth along the light's axis still changes from texel to texel. */
#include <stdio.h>
#include <stdlib.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

static char scene[600];

/* The spot hangs at (0, 4, 0) and looks down, 75 degrees to each side; plates of 1.2 m stand 3 m
 * from it, 60 degrees off its axis to +x and to -x; the ground is 12 m wide. */
static int make_scene(void **state) {
    (void)state;
    struct gn_maker maker;
    struct gn_err err = {0};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[6,1,6]},"
                 "{'mesh':0,'translation':[2.598,2.5,0],'rotation':[0,0,0.5,0.8660254],"
                 "'scale':[0.6,1,0.6]},"
                 "{'mesh':0,'translation':[-2.598,2.5,0],'rotation':[0,0,-0.5,0.8660254],"
                 "'scale':[0.6,1,0.6]},"
                 "{'translation':[0,4,0],'rotation':[-0.70710678,0,0,0.70710678],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}},"
                 "{'camera':0,'translation':[0,9,0],'rotation':[-0.70710678,0,0,0.70710678]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3,4]}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.8,'znear':0.1,'zfar':20}}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'spot','intensity':100,"
                 "'spot':{'innerConeAngle':1.2,'outerConeAngle':1.309}}]}}");
    snprintf(scene, sizeof scene, "%s/wide-spot.glb", gn_shot_build());
    if (!gn_maker_write(&maker, scene, &err)) fail_msg("%s", err.text);
    return 0;
}

static int remove_scene(void **state) {
    (void)state;
    return remove(scene);
}

static void shoot(struct gn_picture *picture, const char *aov, const char *technique,
                  const char *format) {
    struct gn_err err = {0};
    const char *const args[] = {"--aov",        aov,    "--size",   "640x480",
                                "--backend",    "egl",  "--shadow", technique,
                                "--map-format", format, NULL};
    if (!gn_shot(picture, NULL, &err, "pfm", scene, args)) fail_msg("%s", err.text);
}

static void test_what_faces_a_wide_spot_off_its_axis_does_not_shadow_itself(void **state) {
    (void)state;
    static const char *const formats[] = {"depth", "r32ui", "r16f", "r16f-raw", "rgba8"};
    static const char *const techniques[] = {"hard", "pcf", "pcf5"};
    struct gn_picture normal, seen;
    shoot(&normal, "normal", "none", "auto");
    for (int f = 0; f < 5; f++)
        for (int t = 0; t < 3; t++) {
            shoot(&seen, "visibility", techniques[t], formats[f]);
            int plates = 0, spoilt = 0, shadow = 0;
            for (int i = 0; i < seen.width_px * seen.height_px; i++) {
                bool plate = normal.data[3 * i + 1] > 0.4f && normal.data[3 * i + 1] < 0.6f;
                plates += plate;
                spoilt += plate && seen.data[i] < 0.98f;
                shadow += !plate && seen.data[i] < 0.5f;
            }
            gn_picture_finish(&seen);
            assert_true(plates > 4000);
            assert_true(shadow > 1000); /* they are in the map: they throw shadows */
            if (spoilt)
                fail_msg("%s %s: %d of %d pixels of the plates are not fully lit", techniques[t],
                         formats[f], spoilt, plates);
        }
    gn_picture_finish(&normal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_faces_a_wide_spot_off_its_axis_does_not_shadow_itself),
    };
    return cmocka_run_group_tests_name("wide spot", tests, make_scene, remove_scene);
}
