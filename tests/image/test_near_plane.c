/* A picture does not depend on how near the file's camera sees, or how far: a sheet 2 mm over a
 * floor is before it everywhere, standing and animated, with shadows of maps and of rays. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* A floor of 6 m with the sheet, seen from 5 m away; a cube that a clip brings near the camera,
 * from 0 s to 1 s. */
static char *write_scene(const char *name, const char *camera) {
    struct gn_maker maker;
    struct gn_err err = {0};
    char *path = malloc(300);
    const float times[2] = {0, 1}, places[2][3] = {{0, 0.3f, 0}, {0.05f, 2.95f, 3.4f}};
    snprintf(path, 300, "%s/near_plane_%s.glb", gn_shot_build(), name);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    const int input =
        gn_maker_accessor(&maker, "SCALAR", 5126, 2, times, sizeof times, "'min':[0],'max':[1]");
    const int output = gn_maker_accessor(&maker, "VEC3", 5126, 2, places, sizeof places, NULL);
    char text[400];
    snprintf(text, sizeof text,
             "{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,"
             "'target':{'node':2,'path':'translation'}}]}",
             input, output);
    gn_maker_add(&maker, "animations", text);
    gn_maker_set(&maker, "materials",
                 "[{'pbrMetallicRoughness':{'baseColorFactor':[1,0.2,0.2,1]}}]");
    gn_maker_add(&maker, "meshes",
                 "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]}");
    gn_maker_add(&maker, "cameras", camera);
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':2}]}}");
    gn_maker_set(&maker, "nodes",
                 "[{'mesh':0,'scale':[3,1,3]},{'mesh':2,'translation':[0,0.002,0]},"
                 "{'mesh':1,'scale':[0.03,0.03,0.03]},{'camera':0,'translation':[0,3,4],"
                 "'rotation':[-0.3420201,0,0,0.9396926]},{'rotation':[-0.6,0.2,0,0.7745967],"
                 "'extensions':{'KHR_lights_punctual':{'light':0}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3,4]}]");
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static void compare(const char *first, const char *second, const char *const args[]) {
    struct gn_picture a, b;
    struct gn_err err = {0};
    if (!gn_shot(&a, NULL, &err, "pfm", first, args)) fail_msg("%s", err.text);
    if (!gn_shot(&b, NULL, &err, "pfm", second, args)) fail_msg("%s", err.text);
    const int pixels = a.width_px * a.height_px;
    int differ = 0, red = 0;
    for (int i = 0; i < pixels; i++) {
        const float *p = a.data + a.channels * i, *q = b.data + b.channels * i;
        float most = 0;
        for (int k = 0; k < 3; k++) most = p[k] - q[k] > most ? p[k] - q[k] : most;
        for (int k = 0; k < 3; k++) most = q[k] - p[k] > most ? q[k] - p[k] : most;
        differ += most > .02f;
        red += p[0] > 2 * p[1];
    }
    print_message("%s, %s %s: %d of %d pixels differ\n", second, args[2], args[3], differ, pixels);
    assert_true(red > pixels / 20);
    assert_true(differ <= pixels / 2000);
    gn_picture_finish(&a);
    gn_picture_finish(&b);
}

static void compare_cameras(const char *good, const char *const others[]) {
    static const char *const times[] = {"0", "0.5", "0.97"};
    static const char *const techniques[] = {"hard", "truth"};
    char *first = write_scene("good", good);
    for (int i = 0; others[i]; i++) {
        char *second = write_scene("other", others[i]);
        for (int t = 0; t < 3; t++)
            for (int k = 0; k < 2; k++)
                compare(first, second,
                        (const char *const[]){"--size", "160x120", "--time", times[t], "--shadow",
                                              techniques[k], NULL});
        free(second);
    }
    free(first);
}

#define PERSPECTIVE(planes) "{'type':'perspective','perspective':{'yfov':0.7," planes "}}"
#define FLAT(planes)        "{'type':'orthographic','orthographic':{'xmag':2,'ymag':1.5," planes "}}"

static void test_a_near_plane_costs_no_pixel(void **state) {
    (void)state;
    compare_cameras(PERSPECTIVE("'znear':0.3,'zfar':20"),
                    (const char *const[]){PERSPECTIVE("'znear':0.0001"),
                                          PERSPECTIVE("'znear':1e-6,'zfar':1000"),
                                          PERSPECTIVE("'znear':1e-15"), NULL});
}

static void test_an_orthographic_range_costs_no_pixel(void **state) {
    (void)state;
    compare_cameras(FLAT("'znear':0.3,'zfar':20"),
                    (const char *const[]){FLAT("'znear':0,'zfar':70000"),
                                          FLAT("'znear':0.0001,'zfar':1e6"), NULL});
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_near_plane_costs_no_pixel),
        cmocka_unit_test(test_an_orthographic_range_costs_no_pixel),
    };
    return RUN(tests);
}
