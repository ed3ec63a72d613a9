/* Properties that clips move (KHR_animation_pointer): the picture half way is that of a file that
 * has the value there, shadows and the oracle included. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/compare.h"
#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

/* What differs between the files of a case: a value at 0 s, at 2 s, and what a still file has. */
struct how {
    const char *light, *material, *camera, *node; /* members of their JSON, of the still file */
};
struct move {
    const char *pointer;
    int components;
    float from[4], to[4];
    const char *interpolation;
};

static char path[2][600];

static int begin(void **state) {
    (void)state;
    snprintf(path[0], sizeof path[0], "%s/property-moves.glb", gn_shot_build());
    snprintf(path[1], sizeof path[1], "%s/property-still.glb", gn_shot_build());
    return 0;
}

static int end(void **state) {
    (void)state;
    return remove(path[0]) | remove(path[1]);
}

static void add_move(struct gn_maker *maker, const struct move *move) {
    static const char *const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    static const float times[] = {0, 2};
    const size_t bytes = (size_t)move->components * sizeof(float);
    float values[8];
    char json[600];
    memcpy(values, move->from, bytes);
    memcpy(values + move->components, move->to, bytes);
    const int input = gn_maker_accessor(maker, "SCALAR", 5126, 2, times, sizeof times, NULL),
              output = gn_maker_accessor(maker, types[move->components], 5126, 2, values, 2 * bytes,
                                         NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d,'interpolation':'%s'}],'channels':[{'sampler':0,"
             "'target':{'path':'pointer','extensions':{'KHR_animation_pointer':{'pointer':'%s'}}}}"
             "]}",
             input, output, move->interpolation ? move->interpolation : "LINEAR", move->pointer);
    gn_maker_add(maker, "animations", json);
}

/* A cube over a ground, under a spot; its texture has a red and three other texels. */
static void make(const char *to, const struct how *how, const struct move *move) {
    static const uint8_t texels[] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 90, 90, 90, 0};
    struct gn_maker maker;
    struct gn_err err = {0};
    char json[1400];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    struct gn_made png = gn_maker_png(2, 2, texels);
    snprintf(json, sizeof json, "[{'bufferView':%d,'mimeType':'image/png'}]",
             gn_maker_view(&maker, png.data, png.size));
    free(png.data);
    gn_maker_set(&maker, "images", json);
    gn_maker_set(&maker, "textures", "[{'source':0}]");
    snprintf(json, sizeof json, "[{'name':'moves'%s%s},{'name':'ground'}]",
             *how->material ? "," : "", how->material);
    gn_maker_set(&maker, "materials", json);
    static const float uv[] = {0, 0, 1, 0, 1, 1, 0, 1};
    snprintf(json, sizeof json,
             "[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':%d},'indices':1,'material':0"
             "}]},{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':1}]}]",
             gn_maker_accessor(&maker, "VEC2", 5126, 4, uv, sizeof uv, NULL));
    gn_maker_set(&maker, "meshes", json);
    snprintf(json, sizeof json,
             "[{'mesh':1,'scale':[6,1,6]},{'children':[2],'translation':[0,1,0]%s%s},"
             "{'mesh':0,'rotation':[0.2,0,0,0.98],'scale':[1.5,1,1.5]},"
             "{'translation':[0,5,0],'rotation':[-0.70710678,0,0,0.70710678],"
             "'extensions':{'KHR_lights_punctual':{'light':0}}},"
             "{'camera':0,'translation':[0,6,8],'rotation':[-0.3246,0,0,0.9458]}]",
             *how->node ? "," : "", how->node);
    gn_maker_set(&maker, "nodes", json);
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,3,4]}]");
    snprintf(json, sizeof json, "[{'type':'perspective','perspective':{'znear':0.1,%s}}]",
             *how->camera ? how->camera : "'yfov':0.8");
    gn_maker_set(&maker, "cameras", json);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual','KHR_animation_pointer']");
    snprintf(json, sizeof json, "{'KHR_lights_punctual':{'lights':[{'type':'spot',%s}]}}",
             *how->light ? how->light
                         : "'intensity':60,'spot':{'innerConeAngle':0.3,'outerConeAngle':1}");
    gn_maker_set(&maker, "extensions", json);
    if (move) add_move(&maker, move);
    if (!gn_maker_write(&maker, to, &err)) fail_msg("%s", err.text);
}

static void shoot(struct gn_picture *picture, const char *scene, const char *time_s,
                  const char *shadow) {
    struct gn_err err = {0};
    const char *const args[] = {"--size",     "160x120",  "--backend", "egl",       "--time",
                                time_s,       "--shadow", shadow,      "--samples", "1",
                                "--exposure", "0",        NULL};
    if (!gn_shot(picture, NULL, &err, "png", scene, args)) fail_msg("%s", err.text);
}

/* At 1 s, as the second frame of a film that begins at 0 s. */
static void shoot_second(struct gn_picture *picture, const char *scene, const char *shadow) {
    struct gn_err err = {0};
    const char *const args[] = {"--size",     "160x120", "--backend", "egl",      "--frames",
                                "2",          "--fps",   "1",         "--shadow", shadow,
                                "--exposure", "0",       NULL};
    char name[2][700], pattern[700];
    snprintf(pattern, sizeof pattern, "%s/property-%%04d.png", gn_shot_build());
    for (int i = 0; i < 2; i++)
        snprintf(name[i], sizeof name[i], "%s/property-%04d.png", gn_shot_build(), i);
    if (!gn_shot_file(pattern, NULL, &err, scene, args) || !gn_picture_read(picture, name[1], &err))
        fail_msg("%s", err.text);
    assert_int_equal(remove(name[0]) | remove(name[1]), 0);
}

/* Within two steps of a byte, in all pixels but one in a thousand; and it was another picture
 * before. */
static void assert_half_way(const char *name, const struct how *moving, const struct move *move,
                            const struct how *still, const char *shadow) {
    struct gn_picture at_0, half, expected;
    struct gn_difference before, after;
    make(path[0], moving, move);
    make(path[1], still, NULL);
    shoot(&at_0, path[0], "0", shadow);
    if (strcmp(shadow, "truth") == 0)
        shoot(&half, path[0], "1", shadow);
    else
        shoot_second(&half, path[0], shadow);
    shoot(&expected, path[1], "0", shadow);
    assert_true(gn_compare(&at_0, &expected, 2.5 / 255, &before));
    assert_true(gn_compare(&half, &expected, 2.5 / 255, &after));
    if (after.share > .001) gn_compare_save(NULL, name, &half, &expected);
    printf("%-14s %-6s off before: %.2f %%, after: %.3f %%\n", name, shadow, 100 * before.share,
           100 * after.share);
    if (after.share > .001 || before.share < .01) fail_msg("%s: not that of the still file", name);
    gn_picture_finish(&at_0);
    gn_picture_finish(&half);
    gn_picture_finish(&expected);
}

#define LIGHT(name) "/extensions/KHR_lights_punctual/lights/0/" name
#define SPOT(inner, outer)                                                                         \
    "'intensity':60,'spot':{'innerConeAngle':" inner ",'outerConeAngle':" outer "}"

static void test_lights(void **state) {
    (void)state;
    static const char *const shadows[] = {"pcf", "truth"};
    for (int i = 0; i < 2; i++) {
        assert_half_way("intensity", &(struct how){"'intensity':1", "", "", ""},
                        &(struct move){LIGHT("intensity"), 1, {0}, {120}, NULL},
                        &(struct how){"'intensity':60", "", "", ""}, shadows[i]);
        assert_half_way("colour", &(struct how){"'intensity':60", "", "", ""},
                        &(struct move){LIGHT("color"), 3, {1, 0, 0}, {0, 0, 1}, NULL},
                        &(struct how){"'intensity':60,'color':[0.5,0,0.5]", "", "", ""},
                        shadows[i]);
        assert_half_way("cone", &(struct how){SPOT("0.1", "0.9"), "", "", ""},
                        &(struct move){LIGHT("spot/outerConeAngle"), 1, {.2f}, {.8f}, NULL},
                        &(struct how){SPOT("0.1", "0.5"), "", "", ""}, shadows[i]);
        assert_half_way("inner cone", &(struct how){SPOT("0.1", "0.9"), "", "", ""},
                        &(struct move){LIGHT("spot/innerConeAngle"), 1, {0}, {.8f}, NULL},
                        &(struct how){SPOT("0.4", "0.9"), "", "", ""}, shadows[i]);
        assert_half_way("range", &(struct how){"'intensity':60", "", "", ""},
                        &(struct move){LIGHT("range"), 1, {4.1f}, {9.9f}, NULL},
                        &(struct how){"'intensity':60,'range':7", "", "", ""}, shadows[i]);
    }
}

#define PBR(members) "'pbrMetallicRoughness':{" members "}"
#define TEXTURED(transform)                                                                        \
    PBR("'baseColorTexture':{'index':0,'extensions':{'KHR_texture_transform':{" transform "}}}")
#define CUT "'alphaMode':'MASK'," PBR("'baseColorTexture':{'index':0}")
#define COATED(factor)                                                                             \
    PBR("'baseColorFactor':[0.1,0.1,0.1,1]")                                                       \
    ",'extensions':{'KHR_materials_clearcoat':{'clearcoatFactor':" factor                          \
    ",'clearcoatRoughnessFactor':0.5}}"

static const struct {
    const char *name, *moving, *still;
    struct move move;
} materials[] = {
    {"base colour",
     "'name':'a'",
     PBR("'baseColorFactor':[0.5,0,0.5,1]"),
     {"/materials/0/pbrMetallicRoughness/baseColorFactor", 4, {1, 0, 0, 1}, {0, 0, 1, 1}, 0}},
    {"metal",
     PBR("'metallicFactor':0,'roughnessFactor':0.4"),
     PBR("'metallicFactor':0.5,'roughnessFactor':0.4"),
     {"/materials/0/pbrMetallicRoughness/metallicFactor", 1, {0}, {1}, 0}},
    {"roughness",
     PBR("'roughnessFactor':1"),
     PBR("'roughnessFactor':0.5"),
     {"/materials/0/pbrMetallicRoughness/roughnessFactor", 1, {.9f}, {.1f}, 0}},
    {"emissive",
     "'name':'a'",
     "'emissiveFactor':[0.1,0.3,0.1]",
     {"/materials/0/emissiveFactor", 3, {0, 0, 0}, {.2f, .6f, .2f}, 0}},
    {"emissive strength",
     "'emissiveFactor':[0.1,0.1,0]",
     "'emissiveFactor':[0.1,0.1,0],'extensions':{'KHR_materials_emissive_strength':{"
     "'emissiveStrength':3}}",
     {"/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", 1, {0}, {6}, 0}},
    {"ior",
     PBR("'metallicFactor':0,'roughnessFactor':0.5"),
     PBR("'metallicFactor':0,'roughnessFactor':0.5") ",'extensions':{'KHR_materials_ior':{"
                                                     "'ior':3}}",
     {"/materials/0/extensions/KHR_materials_ior/ior", 1, {1.5f}, {4.5f}, 0}},
    {"coat",
     COATED("0"),
     COATED("0.5"),
     {"/materials/0/extensions/KHR_materials_clearcoat/clearcoatFactor", 1, {0}, {1}, 0}},
    {"cutoff",
     CUT ",'alphaCutoff':0.001",
     CUT ",'alphaCutoff':0.8",
     {"/materials/0/alphaCutoff", 1, {0}, {1.6f}, 0}},
    {"offset",
     TEXTURED("'offset':[0,0]"),
     TEXTURED("'offset':[0.3,0.1]"),
     {"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
      "offset",
      2,
      {0, 0},
      {.6f, .2f},
      0}},
    {"rotation",
     TEXTURED("'rotation':0"),
     TEXTURED("'rotation':0.5"),
     {"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
      "rotation",
      1,
      {0},
      {1},
      0}},
};

static void test_materials(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
        assert_half_way(materials[i].name, &(struct how){"", materials[i].moving, "", ""},
                        &materials[i].move, &(struct how){"", materials[i].still, "", ""}, "pcf");
}

static void test_cameras(void **state) {
    (void)state;
    assert_half_way("yfov", &(struct how){"", "", "'yfov':0.8", ""},
                    &(struct move){"/cameras/0/perspective/yfov", 1, {.4f}, {1}, NULL},
                    &(struct how){"", "", "'yfov':0.7", ""}, "pcf");
    assert_half_way("zfar", &(struct how){"", "", "'yfov':0.8", ""},
                    &(struct move){"/cameras/0/perspective/zfar", 1, {5}, {15}, NULL},
                    &(struct how){"", "", "'yfov':0.8,'zfar':10", ""}, "pcf");
}

/* With its child, and the shadow of that. */
static void test_visibility(void **state) {
    (void)state;
    static const char *const shadows[] = {"pcf", "planar", "truth"};
    const char hidden[] = "'extensions':{'KHR_node_visibility':{'visible':false}}";
    for (int i = 0; i < 3; i++) {
        struct move move = {
            "/nodes/1/extensions/KHR_node_visibility/visible", 1, {1}, {0}, "LINEAR"};
        struct gn_picture half, gone;
        struct gn_difference difference;
        make(path[0], &(struct how){"", "", "", hidden}, NULL);
        make(path[1], &(struct how){"", "", "", "'scale':[0,0,0]"}, NULL);
        shoot(&half, path[0], "0", shadows[i]);
        shoot(&gone, path[1], "0", shadows[i]);
        assert_true(gn_compare(&half, &gone, .5 / 255, &difference));
        if (difference.share > 0) fail_msg("%s: what is hidden is seen", shadows[i]);
        gn_picture_finish(&half);
        gn_picture_finish(&gone);
        /* hidden until the key at 2 s, at first in the file it is shown */
        move.from[0] = 0;
        make(path[0], &(struct how){"", "", "", ""}, &move);
        shoot(&half, path[0], "1", shadows[i]);
        make(path[1], &(struct how){"", "", "", hidden}, NULL);
        shoot(&gone, path[1], "0", shadows[i]);
        assert_true(gn_compare(&half, &gone, .5 / 255, &difference));
        if (difference.share > 0) fail_msg("%s: a clip does not hide it", shadows[i]);
        make(path[1], &(struct how){"", "", "", ""}, NULL);
        gn_picture_finish(&gone);
        shoot(&gone, path[1], "0", shadows[i]);
        assert_true(gn_compare(&half, &gone, 8. / 255, &difference));
        printf("visible        %-6s %.2f %% of the picture\n", shadows[i], 100 * difference.share);
        if (difference.share < .02) fail_msg("%s: nothing was hidden", shadows[i]);
        gn_picture_finish(&half);
        gn_picture_finish(&gone);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lights),
        cmocka_unit_test(test_materials),
        cmocka_unit_test(test_cameras),
        cmocka_unit_test(test_visibility),
    };
    return cmocka_run_group_tests_name("properties", tests, begin, end);
}
