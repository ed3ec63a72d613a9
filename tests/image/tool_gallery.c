/* `make gallery`: one scene with every technique, and the truth beside it: DIR/NAME.png. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/penumbra.h"
#include "image/shot.h"
#include "shadow/technique.h"
#include "unit/gltf_maker.h"

enum { WIDTH = 400, HEIGHT = 300, SAMPLES = 2 /* per side of a pixel */ };

static void quit(const struct gn_err *err) {
    fprintf(stderr, "tool_gallery: %s\n", err->text);
    exit(1);
}

static const char things[] =
    "{'mesh':0,'scale':[7,1,7],'extras':{'gnomon_plane':true}},"
    "{'mesh':1,'translation':[-1.5,0.5,0.6],'rotation':[0,0.26,0,0.9656],'scale':[0.5,0.5,0.5]},"
    "{'mesh':2,'translation':[1.2,1.5,-0.6],'rotation':[0,0.2,0.1,0.9747],'scale':[0.7,0.05,0.7]},"
    "{'mesh':2,'translation':[-0.2,0.75,-1.3],'scale':[0.05,0.75,0.05]},"
    "{'mesh':2,'translation':[0.2,0.75,-1.3],'scale':[0.05,0.75,0.05]},"
    "{'mesh':2,'translation':[-0.6,0.75,-1.3],'scale':[0.05,0.75,0.05]},"
    "{'mesh':2,'translation':[-1.0,0.75,-1.3],'scale':[0.05,0.75,0.05]},"
    "{'mesh':2,'translation':[-0.4,1.45,-1.3],'scale':[0.75,0.05,0.05]},"
    "{'mesh':3,'translation':[0.5,0.4,1.2],'rotation':[0,0,0.38,0.925],'scale':[0.03,0.6,0.5]},";

static void add_material(struct gn_maker *maker, const char *color) {
    char text[200];
    snprintf(text, sizeof text,
             "{'doubleSided':true,'pbrMetallicRoughness':{'baseColorFactor':[%s,1],"
             "'metallicFactor':0,'roughnessFactor':1}}",
             color);
    gn_maker_add(maker, "materials", text);
}

/* Meshes 1 to 3 are the cube in three colours, mesh 0 the ground. */
static void add_meshes(struct gn_maker *maker) {
    gn_maker_square(maker);
    gn_maker_cube(maker);
    add_material(maker, "0.75,0.73,0.7");
    add_material(maker, "0.75,0.3,0.15");
    add_material(maker, "0.2,0.45,0.7");
    add_material(maker, "0.8,0.65,0.2");
    json_t *meshes = json_object_get(maker->root, "meshes");
    for (int i = 0; i < 2; i++)
        json_array_append_new(meshes, json_deep_copy(json_array_get(meshes, 1)));
    for (size_t i = 0; i < 4; i++) {
        json_t *primitives = json_object_get(json_array_get(meshes, i), "primitives");
        json_object_set_new(json_array_get(primitives, 0), "material", json_integer((json_int_t)i));
    }
}

/* The same scene with a light of that intensity. */
static void write_scene(const char *path, int intensity) {
    struct gn_maker maker;
    struct gn_err err = {0};
    char nodes[3000], lights[400];
    gn_maker_init(&maker);
    add_meshes(&maker);
    snprintf(
        nodes, sizeof nodes,
        "[%s{'translation':[3.4,6.4,2.6],'rotation':[-0.4777,0.3606,0.2225,0.7697],"
        "'extensions':{'KHR_lights_punctual':{'light':0}}},"
        "{'camera':0,'translation':[-1.6,3.3,5.4],'rotation':[-0.2482,-0.1395,-0.0361,0.9579]}]",
        things);
    gn_maker_set(&maker, "nodes", nodes);
    gn_maker_set(
        &maker, "scenes",
        "[{'nodes':[0,1,2,3,4,5,6,7,8,9,10],'extras':{'gnomon_background':[0.2,0.25,0.3]}}]");
    gn_maker_set(&maker, "cameras",
                 "[{'type':'perspective','perspective':{'yfov':0.62,'znear':0.1,'zfar':40}}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    snprintf(lights, sizeof lights,
             "{'KHR_lights_punctual':{'lights':[{'type':'spot','intensity':%d,'spot':"
             "{'innerConeAngle':0.5,'outerConeAngle':0.7},'extras':{'gnomon_radius':0.5}}]}}",
             intensity);
    gn_maker_set(&maker, "extensions", lights);
    if (!gn_maker_write(&maker, path, &err)) quit(&err);
}

static struct gn_picture shoot(const char *scene, const char *technique) {
    struct gn_err err = {0};
    struct gn_picture shot;
    char size[32];
    snprintf(size, sizeof size, "%dx%d", SAMPLES * WIDTH, SAMPLES * HEIGHT);
    const char *const args[] = {"--size",    size,       "--shadow", technique,    "--map",
                                "256",       "--output", "linear",   "--exposure", "0",
                                "--backend", "egl",      NULL};
    if (!gn_shot(&shot, NULL, &err, "pfm", scene, args)) quit(&err);
    return shot;
}

static float encode(float c) {
    c = fminf(fmaxf(c, 0), 1);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1 / 2.4f) - 0.055f;
}

static void write_small(const struct gn_picture *large, const char *folder, const char *name) {
    struct gn_err err = {0};
    struct gn_picture small;
    char path[600];
    gn_picture_init(&small, WIDTH, HEIGHT, 3);
    for (int y = 0; y < SAMPLES * HEIGHT; y++)
        for (int x = 0; x < SAMPLES * WIDTH; x++)
            for (int k = 0; k < 3; k++)
                gn_picture_at(&small, x / SAMPLES, y / SAMPLES)[k] +=
                    gn_picture_at(large, x, y)[k] / (SAMPLES * SAMPLES);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) small.data[i] = encode(small.data[i]);
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    if (!gn_picture_write_png(&small, path, &err)) quit(&err);
    gn_picture_finish(&small);
}

/* Ambient, and as much of the light as is seen. */
static void write_truth(const char *scene, const char *dark_scene, const char *folder, bool point) {
    struct gn_err err = {0};
    struct gn_picture truth, lit = shoot(scene, "none"), dark = shoot(dark_scene, "none");
    if (!gn_penumbra_truth(&truth, scene, point, lit.width_px, lit.height_px, &err)) quit(&err);
    for (int i = 0; i < 3 * lit.width_px * lit.height_px; i++)
        lit.data[i] = dark.data[i] + truth.data[i / 3] * (lit.data[i] - dark.data[i]);
    write_small(&lit, folder, point ? "truth-point" : "truth");
    gn_picture_finish(&lit);
    gn_picture_finish(&dark);
    gn_picture_finish(&truth);
}

int main(int argc, char **argv) {
    char scene[400], dark_scene[400];
    if (argc != 2) {
        fprintf(stderr, "usage: tool_gallery DIR\n");
        return 2;
    }
    snprintf(scene, sizeof scene, "%s/gallery.glb", gn_shot_build());
    snprintf(dark_scene, sizeof dark_scene, "%s/gallery-dark.glb", gn_shot_build());
    write_scene(scene, 160);
    write_scene(dark_scene, 0);
    for (int t = 0; t < GN_TECHNIQUE_COUNT; t++) {
        struct gn_picture shot = shoot(scene, gn_techniques[t].name);
        write_small(&shot, argv[1], gn_techniques[t].name);
        gn_picture_finish(&shot);
    }
    write_truth(scene, dark_scene, argv[1], true);
    write_truth(scene, dark_scene, argv[1], false);
    return 0;
}
