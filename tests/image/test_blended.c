/* Blended surfaces in the order in which they hide each other: opaque texels as if they were not
 * blended, whatever the order of items; back faces before front faces; shadows by alpha. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/shot.h"
#include "shadow/technique.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

enum { WIDTH = 160, HEIGHT = 90, FEW = 1, MANY = 11 };

/* Seen from above, 16 m wide; every colour is emitted. At x = 2 m a red sheet lies over a green
 * one, but its middle is farther; so is the middle of a blue one, half clear, that lies over both.
 * At x = -5 m one mesh has a clear yellow square, and behind it, later in the file, a cyan one that
 * turns its back. */
static const char *make_scene(const char *name, int lights) {
    static char path[600];
    static const float near_m = 1, far_m = -1;
    const float positions[8][3] = {{-6, near_m, -1}, {-6, near_m, 1}, {-4, near_m, 1},
                                   {-4, near_m, -1}, {-6, far_m, -1}, {-4, far_m, -1},
                                   {-4, far_m, 1},   {-6, far_m, 1}};
    const float colors[8][4] = {{1, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, 1},
                                {0, 1, 1, 1}, {0, 1, 1, 1}, {0, 1, 1, 1}, {0, 1, 1, 1}};
    static const uint16_t indices[12] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    struct gn_maker maker;
    struct gn_err err = {0};
    char text[500];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    const int at = gn_maker_accessor(&maker, "VEC3", 5126, 8, positions, sizeof positions,
                                     "'min':[-6,-1,-1],'max':[-4,1,1]");
    const int color = gn_maker_accessor(&maker, "VEC4", 5126, 8, colors, sizeof colors, NULL);
    const int index = gn_maker_accessor(&maker, "SCALAR", 5123, 12, indices, sizeof indices, NULL);
    gn_maker_set(&maker, "materials",
                 "[{'alphaMode':'BLEND','doubleSided':true,'emissiveFactor':[0,1,0],"
                 "'pbrMetallicRoughness':{'metallicFactor':0,'baseColorFactor':[0,0,0,1]}},"
                 "{'alphaMode':'BLEND','doubleSided':true,'emissiveFactor':[1,0,0],"
                 "'pbrMetallicRoughness':{'metallicFactor':0,'baseColorFactor':[0,0,0,0.995]}},"
                 "{'alphaMode':'BLEND','doubleSided':true,'emissiveFactor':[0,0,1],"
                 "'pbrMetallicRoughness':{'metallicFactor':0,'baseColorFactor':[0,0,0,0.5]}},"
                 "{'alphaMode':'BLEND','doubleSided':true,'extensions':{'KHR_materials_unlit':{}},"
                 "'pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.5]}}]");
    gn_maker_set(&maker, "meshes", "[]");
    for (int i = 0; i < 3; i++) {
        snprintf(text, sizeof text,
                 "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':%d}]}", i);
        gn_maker_add(&maker, "meshes", text);
    }
    snprintf(text, sizeof text,
             "{'primitives':[{'attributes':{'POSITION':%d,'COLOR_0':%d},'indices':%d,'material':3}]"
             "}",
             at, color, index);
    gn_maker_add(&maker, "meshes", text);
    gn_maker_set(&maker, "nodes",
                 "[{'camera':0,'translation':[0,16,0],'rotation':[-0.70710678,0,0,0.70710678]},"
                 "{'mesh':0,'translation':[2,1,0],'scale':[0.8,1,1]},"
                 "{'mesh':1,'rotation':[0,0,0.3826834,0.9238795],'scale':[4.5,1,1.5]},"
                 "{'mesh':2,'translation':[-1,-3,0],'rotation':[0,0,0.5504,0.8349],"
                 "'scale':[9,1,1]},"
                 "{'mesh':3}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':8,'ymag':4.5,'znear':1,"
                 "'zfar':40}}]");
    gn_maker_suns(&maker, lights, 0.1);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual','KHR_materials_unlit']");
    gn_maker_show_all(&maker, "0");
    snprintf(path, sizeof path, "%s/blended-%s.glb", gn_shot_build(), name);
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

static void expect_at(const struct gn_picture *picture, double x_m, const double wanted[3]) {
    const float *got = gn_picture_at(picture, (int)((x_m + 8) * 10), HEIGHT / 2);
    for (int k = 0; k < 3; k++)
        if (fabs((double)got[k] - wanted[k]) > 0.01)
            fail_msg("at %.1f m: %.3f %.3f %.3f, not %.3f %.3f %.3f", x_m, (double)got[0],
                     (double)got[1], (double)got[2], wanted[0], wanted[1], wanted[2]);
}

static void draw_and_check(const char *path) {
    struct gn_picture picture;
    struct gn_err err = {0};
    const char *const args[] = {"--size", "160x90",     "--backend", "egl", "--shadow",
                                "none",   "--exposure", "0",         NULL};
    if (!gn_shot(&picture, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    expect_at(&picture, 2.0, (double[]){0.5, 0, 0.5});      /* blue over red over green */
    expect_at(&picture, -5.0, (double[]){0.5, 0.75, 0.25}); /* yellow over cyan */
    gn_picture_finish(&picture);
}

static void test_what_is_nearer_hides_what_is_farther(void **state) {
    (void)state;
    draw_and_check(make_scene("few", FEW));
}

static void test_so_it_does_where_lights_are_added(void **state) {
    (void)state;
    draw_and_check(make_scene("many", MANY));
}

/* ---- shadows by alpha ---- */

#define PLAIN(color) "'pbrMetallicRoughness':{'metallicFactor':0,'baseColorFactor':" color "}"
#define FILM         "'alphaMode':'BLEND'," PLAIN("[1,1,1,0.3]")
#define GLASS(factor, more)                                                                        \
    ",'extensions':{'KHR_materials_transmission':{'transmissionFactor':" factor more "}}"

/* A ground of 8 m, and a pane of 2 m over it, under a sun in the zenith. */
static const char *make_pane(const char *material, bool casts) {
    static char path[600];
    struct gn_maker maker;
    struct gn_err err = {0};
    char nodes[800], text[400];
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    const int uv = gn_maker_accessor(&maker, "VEC2", 5126, 4, (float[8]){0}, 32, NULL);
    static const uint8_t half[] = {128, 0, 0, 255};
    struct gn_made png = gn_maker_png(1, 1, half);
    snprintf(text, sizeof text, "[{'bufferView':%d,'mimeType':'image/png'}]",
             gn_maker_view(&maker, png.data, png.size));
    free(png.data);
    gn_maker_set(&maker, "images", text);
    gn_maker_set(&maker, "textures", "[{'source':0}]");
    snprintf(text, sizeof text, "[{'pbrMetallicRoughness':{'metallicFactor':0}},{%s}]", material);
    gn_maker_set(&maker, "materials", text);
    snprintf(text, sizeof text,
             "[{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':0}]},"
             "{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':%d},'indices':1,"
             "'material':1}]}]",
             uv);
    gn_maker_set(&maker, "meshes", text);
    snprintf(
        nodes, sizeof nodes,
        "[{'camera':0,'translation':[0,16,0],'rotation':[-0.70710678,0,0,0.70710678]},"
        "{'mesh':0,'scale':[4,1,4]},{'mesh':1,'translation':[0,1,0]%s},"
        "{'rotation':[-0.70710678,0,0,0.70710678],'extensions':{'KHR_lights_punctual':{'light':"
        "0}}}]",
        casts ? ",'extras':{'gnomon_cast_alpha':true}" : "");
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':2.4,'ymag':1.35,'znear':1,"
                 "'zfar':40}}]");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':1}]}}");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2,3]}]");
    snprintf(path, sizeof path, "%s/pane-%s.glb", gn_shot_build(), casts ? "casts" : "clear");
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    return path;
}

/* The mean of the visibility under the inner half of the pane. */
static double light_under(const char *path, const char *technique, const char *planar) {
    struct gn_picture picture;
    struct gn_err err = {0};
    const char *const args[] = {"--size",     "320x180",  "--backend", "egl",      "--aov",
                                "visibility", "--shadow", technique,   "--planar", planar,
                                "--map",      "512",      NULL};
    double sum = 0;
    if (!gn_shot(&picture, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    for (int y = 57; y < 123; y++)
        for (int x = 127; x < 193; x++) sum += (double)*gn_picture_at(&picture, x, y);
    gn_picture_finish(&picture);
    return sum / (66 * 66);
}

static void check_pane(const char *technique, const char *planar) {
    const double clear = light_under(make_pane(FILM, false), technique, planar);
    const double under = light_under(make_pane(FILM, true), technique, planar);
    print_message("%s %s: %.3f\n", technique, planar, under);
    if (clear < 0.999) fail_msg("%s: a blended pane casts: %.3f", technique, clear);
    if (fabs(under - 0.7) > 0.1) fail_msg("%s: %.3f, not .7", technique, under);
}

static void test_a_blended_caster_takes_its_alpha_of_the_light(void **state) {
    (void)state;
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        if (!gn_techniques[t].file) continue;
        check_pane(gn_techniques[t].name, "mask");
        if (gn_techniques[t].on_plane) check_pane(gn_techniques[t].name, "stencil");
    }
}

/* Glass casts none unless it is asked to, and then by what it does not let through, for the sum of
 * colours as the eye has it; with a texture, or where most of it is no glass, in any case. */
static void test_glass_takes_what_it_does_not_let_through(void **state) {
    (void)state;
    static const struct {
        const char *material;
        double unasked, asked; /* visibility */
    } panes[] = {
        {PLAIN("[1,1,1,1]") GLASS("0.8", ""), 1, 0.8},
        {PLAIN("[0,0.5,0,0.1]") GLASS("1", ""), 1, 0.7152 / 2},
        {PLAIN("[1,1,1,1]") GLASS("0.4", ""), 0.4, 0.4},
        {PLAIN("[1,1,1,1]") GLASS("1", ",'transmissionTexture':{'index':0}"), 0.5, 0.5},
        {"'alphaMode':'BLEND'," PLAIN("[1,1,1,0.5]") GLASS("0.6", ""), 1, 0.8},
    };
    for (size_t i = 0; i < sizeof panes / sizeof *panes; i++)
        for (int asked = 0; asked < 2; asked++) {
            const double got = light_under(make_pane(panes[i].material, asked), "pcf", "mask");
            const double wanted = asked ? panes[i].asked : panes[i].unasked;
            print_message("%s: %.3f\n", panes[i].material, got);
            if (fabs(got - wanted) > 0.05)
                fail_msg("%s%s: %.3f, not %.3f", panes[i].material, asked ? ", asked" : "", got,
                         wanted);
        }
}

/* Seen from above: red glass with something blue in it, half clear both, whose middle is nearer to
 * the eye than that of the glass. */
static void test_what_is_in_a_vessel_is_behind_its_near_side(void **state) {
    (void)state;
    char path[600], text[200];
    struct gn_maker maker;
    struct gn_picture picture;
    struct gn_err err = {0};
    const char *const args[] = {"--size", "160x90", "--backend", "egl", NULL};
    gn_maker_init(&maker);
    gn_maker_square(&maker);
    gn_maker_cube(&maker);
    gn_maker_set(&maker, "extensionsUsed", "['KHR_materials_unlit']");
    gn_maker_set(&maker, "materials", "[]");
    for (int i = 0; i < 2; i++) {
        snprintf(text, sizeof text,
                 "{'alphaMode':'BLEND','extensions':{'KHR_materials_unlit':{}},"
                 "'pbrMetallicRoughness':{'baseColorFactor':[%d,0,%d,0.5]}}",
                 !i, i);
        gn_maker_add(&maker, "materials", text);
    }
    json_t *meshes = json_object_get(maker.root, "meshes");
    json_t *blue = json_deep_copy(json_array_get(meshes, 1));
    for (int i = 0; i < 2; i++) {
        json_t *mesh = i ? blue : json_array_get(meshes, 1);
        json_t *primitive = json_array_get(json_object_get(mesh, "primitives"), 0);
        json_object_set_new(primitive, "material", json_integer(i));
    }
    json_array_append_new(meshes, blue);
    gn_maker_set(&maker, "cameras",
                 "[{'type':'orthographic','orthographic':{'xmag':8,'ymag':4.5,'znear':1,"
                 "'zfar':40}}]");
    gn_maker_set(&maker, "nodes",
                 "[{'camera':0,'translation':[0,16,0],'rotation':[-0.70710678,0,0,0.70710678]},"
                 "{'mesh':1,'scale':[4,4,4]},{'mesh':2,'translation':[0,2,0]}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,1,2],'extras':{'gnomon_background':0}}]");
    snprintf(path, sizeof path, "%s/blended-vessel.glb", gn_shot_build());
    if (!gn_maker_write(&maker, path, &err)) fail_msg("%s", err.text);
    if (!gn_shot(&picture, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    expect_at(&picture, 0, (double[]){0.5, 0, 0.25});
    gn_picture_finish(&picture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_nearer_hides_what_is_farther),
        cmocka_unit_test(test_what_is_in_a_vessel_is_behind_its_near_side),
        cmocka_unit_test(test_so_it_does_where_lights_are_added),
        cmocka_unit_test(test_a_blended_caster_takes_its_alpha_of_the_light),
        cmocka_unit_test(test_glass_takes_what_it_does_not_let_through),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
