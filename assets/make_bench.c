/* Benchmark scenes: g x g boxes of one geometry, a rotating knot, a sun. S1 has 64 boxes, S2 4,096.
 * Illuminance and hemisphere are chosen so that the picture is plain Lambert: colour x (0.25 + 0.75
 * n.l). */
#include "glb.h"
#include "shape/shapes.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static float hash01(uint32_t index) {
    return (float)((index * 1103515245u + 12345u) >> 16 & 0x7fffu) / 32767.0f;
}

static int matte(struct gn_glb *glb, float r, float g, float b) {
    return gn_glb_material(glb, &(struct gn_glb_material){.rgba = {r, g, b}, .rough = 1});
}

static void add_ground(struct gn_glb *glb) {
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    gn_shape_plane(&shape, 20, 20);
    int mesh =
        gn_glb_mesh(glb, "ground", gn_glb_geometry(glb, &shape), matte(glb, 0.6f, 0.6f, 0.6f));
    gn_glb_node(glb, &(struct gn_glb_node){.name = "ground", .mesh = mesh});
    gn_shape_finish(&shape);
}

static void add_box(struct gn_glb *glb, int geometry, int grid, int index) {
    float pitch = 18.0f / (float)grid, h = hash01((uint32_t)index),
          height = (.25f + .75f * h) * .9f * pitch;
    char name[24];
    snprintf(name, sizeof name, "box %d", index);
    int mesh = gn_glb_mesh(glb, NULL, geometry, matte(glb, .4f + .5f * h, .5f, .7f - .4f * h));
    gn_glb_node(glb, &(struct gn_glb_node){
                         .name = name,
                         .mesh = mesh,
                         .move = {((float)(index % grid) + .5f) * pitch - 9, height / 2,
                                  ((float)(index / grid) + .5f) * pitch - 9},
                         .scale = {.4f * pitch, height, .4f * pitch},
                     });
}

static void add_boxes(struct gn_glb *glb, int grid) {
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    gn_shape_box(&shape, 1, 1, 1);
    int geometry = gn_glb_geometry(glb, &shape);
    for (int i = 0; i < grid * grid; i++) add_box(glb, geometry, grid, i);
    gn_shape_finish(&shape);
}

/* 0.02 rad per frame at 60 frames per second. */
static void turn_forever(struct gn_glb *glb, int node) {
    enum { KEYS = 9 };
    const double period = 2 * M_PI / 1.2;
    float times[KEYS], turns[KEYS][4];
    for (int i = 0; i < KEYS; i++) {
        times[i] = (float)(period * i / (KEYS - 1));
        gn_glb_turn_y(360.0f * (float)i / (KEYS - 1), turns[i]);
    }
    gn_glb_channel(glb, gn_glb_animation(glb, "turn"),
                   &(struct gn_glb_channel){.node = node,
                                            .path = GN_GLB_ROTATION,
                                            .keys = KEYS,
                                            .times = times,
                                            .values = turns[0]});
}

static void add_knot(struct gn_glb *glb) {
    struct gn_shape shape;
    gn_shape_init(&shape, 0);
    gn_shape_knot(&shape, 1.2f, .4f, 256, 20);
    int mesh = gn_glb_mesh(glb, "knot", gn_glb_geometry(glb, &shape), matte(glb, .9f, .5f, .2f));
    turn_forever(glb, gn_glb_node(glb, &(struct gn_glb_node){
                                           .name = "knot", .mesh = mesh, .move = {0, 3.5f, 0}}));
    gn_shape_finish(&shape);
}

static void add_sun(struct gn_glb *glb) {
    int light =
        gn_glb_light(glb, &(struct gn_glb_light){.name = "sun", .intensity = (float)(.75 * M_PI)});
    struct gn_glb_node node = {.name = "sun", .light = light};
    float length = sqrtf(6 * 6 + 10 * 10 + 4 * 4);
    for (int i = 0; i < 3; i++) node.move[i] = 20 * (float[]){6, 10, 4}[i] / length;
    gn_glb_look(node.move, (float[3]){0}, node.turn);
    gn_glb_node(glb, &node);
}

static void add_camera(struct gn_glb *glb) {
    struct gn_glb_camera lens = {
        .name = "camera", .yfov = (float)(M_PI / 4), .znear = .1f, .zfar = 100};
    struct gn_glb_node node = {
        .name = "camera", .camera = gn_glb_camera(glb, &lens), .move = {0, 9, 16}};
    gn_glb_look(node.move, (float[3]){0, 1, 0}, node.turn);
    gn_glb_node(glb, &node);
}

int main(int argc, char **argv) {
    int grid = argc != 3 ? 0 : !strcmp(argv[1], "s1") ? 8 : !strcmp(argv[1], "s2") ? 64 : 0;
    if (!grid) {
        fprintf(stderr, "usage: make_bench s1|s2 OUT.glb\n");
        return 2;
    }
    struct gn_glb *glb = gn_glb_create("gnomon assets", "CC0 1.0, the authors of gnomon");
    gn_glb_scene_extras(glb, "{\"gnomon_sky\":[0.25,0.25,0.25],\"gnomon_ground\":[0.25,0.25,0.25],"
                             "\"gnomon_background\":[0.2,0.3,0.4]}");
    add_ground(glb);
    add_boxes(glb, grid);
    add_knot(glb);
    add_sun(glb);
    add_camera(glb);
    bool ok = gn_glb_write(glb, argv[2]);
    gn_glb_destroy(glb);
    return ok ? 0 : 1;
}
