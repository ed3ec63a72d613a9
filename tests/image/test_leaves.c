/* Leaves of an alpha mask stay as many with distance, in the picture and in its shadows, and have
 * no rim of the colour that the picture has where it is clear. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { SIDE = 256, PX = 240 };

/* Leaves on a fifth of it, green on black; red where it is clear. */
static void paint_leaves(uint8_t rgba[4 * SIDE * SIDE]) {
    uint32_t seed = 5;
    for (int i = 0; i < SIDE * SIDE; i++) memcpy(rgba + 4 * i, (uint8_t[]){255, 0, 0, 0}, 4);
    for (int i = 0; i < 500; i++) {
        int at[2];
        for (int k = 0; k < 2; k++) {
            seed = seed * 1664525u + 1013904223u;
            at[k] = (int)(seed >> 16) % SIDE;
        }
        for (int k = 0; k < 81; k++) {
            const int x = k % 9 - 4, y = k / 9 - 4;
            uint8_t *p =
                rgba + 4 * (((at[1] + y) & (SIDE - 1)) * SIDE + ((at[0] + x) & (SIDE - 1)));
            if (4 * x * x + y * y < 17) memcpy(p, (uint8_t[]){0, 255, 0, 255}, 4);
        }
    }
}

/* A square of 2 m with leaves on a fifth of it, on black; `away` from the camera, over a floor 0.5
 * m behind it, which a light shines on along the view. */
static char *write_scene(float away, float cutoff, float factor) {
    static uint8_t rgba[4 * SIDE * SIDE];
    static const float uv[8] = {0, 0, 1, 0, 0, 1, 1, 1};
    struct gn_maker maker;
    struct gn_err err = {0};
    char text[500], *path = malloc(300);
    snprintf(path, 300, "%s/leaves.glb", gn_shot_build());
    paint_leaves(rgba);
    struct gn_made png = gn_maker_png(SIDE, SIDE, rgba);
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    const int view = gn_maker_view(&maker, png.data, png.size);
    const int coords = gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL);
    free(png.data);
    snprintf(text, sizeof text, "{'bufferView':%d,'mimeType':'image/png'}", view);
    gn_maker_add(&maker, "images", text);
    gn_maker_set(&maker, "textures", "[{'source':0}]");
    snprintf(text, sizeof text,
             "[{'alphaMode':'MASK','alphaCutoff':%g,'doubleSided':true,"
             "'extensions':{'KHR_materials_unlit':{}},'pbrMetallicRoughness':{'baseColorFactor':"
             "[1,1,1,%g],'baseColorTexture':{'index':0}}}]",
             (double)cutoff, (double)factor);
    gn_maker_set(&maker, "materials", text);
    snprintf(text, sizeof text,
             "{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':%d},'indices':1,"
             "'material':0}]}",
             coords);
    gn_maker_add(&maker, "meshes", text);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.5,'znear':0.1}}]");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3}]}}");
    snprintf(text, sizeof text,
             "[{'mesh':1},{'camera':0,'translation':[0.013,%g,0.007],"
             "'rotation':[-0.70710678,0,0,0.70710678]},{'mesh':0,'translation':[0,-0.5,0],"
             "'scale':[20,1,20]},{'rotation':[-0.70710678,0,0,0.70710678],"
             "'extensions':{'KHR_lights_punctual':{'light':0}}}]",
             (double)away);
    gn_maker_set(&maker, "nodes", text);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

/* Pixels that are leaves, as a share of the square's. */
static double leaves_at(float away, float cutoff, float factor) {
    struct gn_picture shot;
    struct gn_err err = {0};
    char *path = write_scene(away, cutoff, factor);
    const char *const args[] = {"--size", "240x240", "--shadow", "none", NULL};
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    int leaves = 0, reddish = 0;
    for (int i = 0; i < PX * PX; i++) {
        const float *p = shot.data + shot.channels * i;
        if (!(p[1] > 1.5f * p[2])) continue;
        leaves++;
        reddish += p[0] > .3f * p[1];
    }
    const double side_px = PX * 2 / (2 * .2553419 * (double)away);
    print_message("%.0f px, cutoff %g, factor %g: %.1f %%, %d reddish\n", side_px, (double)cutoff,
                  (double)factor, 100 * leaves / (side_px * side_px), reddish);
    if (side_px < 100) assert_true(reddish < leaves / 20);
    gn_picture_finish(&shot);
    free(path);
    return leaves / (side_px * side_px);
}

static void stays(float cutoff, float factor) {
    static const float far_m[] = {9, 14, 20, 30, 38};
    const double near = leaves_at(4.2f, cutoff, factor);
    assert_true(near > .08 && near < .4);
    for (size_t i = 0; i < sizeof far_m / sizeof *far_m; i++) {
        const double share = leaves_at(far_m[i], cutoff, factor);
        assert_true(share > (i < 3 ? .9 : .8) * near); /* by chance, of so few pixels */
        assert_true(share < (i < 3 ? 1.1 : 1.2) * near);
    }
}

static void test_leaves_stay_as_many_with_distance(void **state) {
    (void)state;
    stays(.5f, 1);
}

static void test_a_factor_of_alpha_counts(void **state) {
    (void)state;
    stays(.3f, .5f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_leaves_stay_as_many_with_distance),
        cmocka_unit_test(test_a_factor_of_alpha_counts),
    };
    return RUN(tests);
}
