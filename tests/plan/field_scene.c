#include "plan/field_scene.h"

#include "unit/check.h"

#include <math.h>
#include <stdio.h>

#include "unit/gltf_maker.h"

enum { GL_FLOAT_CODE = 5126, GL_USHORT_CODE = 5123, RINGS = 16, IN_RING = 4, POLES = 20 };

/* The cube is 2 wide. */
static void add_block(struct gn_maker *m, int cube, float x, float z, float width, float height) {
    char json[256];
    snprintf(json, sizeof json,
             "{'mesh':%d,'translation':[%.4f,%.4f,%.4f],'scale':[%.4f,%.4f,%.4f]}", cube, (double)x,
             (double)(0.5f * height), (double)z, (double)(0.5f * width), (double)(0.5f * height),
             (double)(0.5f * width));
    gn_maker_add(m, "nodes", json);
}

static void add_blocks(struct gn_maker *m, int cube, float scale) {
    float away = 5.0f;
    for (int ring = 0; ring < RINGS; ring++, away *= 1.339f) /* the last: 400 m */
        for (int i = 0; i < IN_RING; i++) {
            const float turn = (float)(ring * IN_RING + i) * 2.3999632f; /* the golden angle */
            const float side = (0.8f * (float)i / (IN_RING - 1) - 0.4f + 0.08f * sinf(turn)) * away,
                        size = 0.4f + 0.02f * away;
            add_block(m, cube, scale * side, -scale * away * (1.0f + 0.1f * cosf(turn)),
                      scale * size, scale * size * (1.5f + 0.8f * sinf(3.0f * turn)));
        }
    for (int i = 0; i < POLES; i++)
        add_block(m, cube, -3.0f * scale, -scale * (4.0f + 9.0f * (float)i), 0.15f * scale,
                  3.0f * scale);
}

static void add_ground(struct gn_maker *m, float scale) {
    const float side = 450.0f * scale, near = 50.0f * scale, far = -850.0f * scale;
    const float corners[12] = {-side, 0, far, -side, 0, near, side, 0, near, side, 0, far};
    const uint16_t triangles[6] = {0, 1, 2, 0, 2, 3};
    const int position =
        gn_maker_accessor(m, "VEC3", GL_FLOAT_CODE, 4, corners, sizeof corners, NULL);
    const int index =
        gn_maker_accessor(m, "SCALAR", GL_USHORT_CODE, 6, triangles, sizeof triangles, NULL);
    char json[256];
    snprintf(json, sizeof json, "{'primitives':[{'attributes':{'POSITION':%d},'indices':%d}]}",
             position, index);
    snprintf(json, sizeof json, "{'mesh':%d}", gn_maker_add(m, "meshes", json));
    gn_maker_add(m, "nodes", json);
}

/* Yaw about +Y, then pitch about +X, radians. */
static void add_looking(struct gn_maker *m, const char *what, const float at[3], float yaw,
                        float pitch) {
    const double cy = cos(0.5 * (double)yaw), sy = sin(0.5 * (double)yaw),
                 cp = cos(0.5 * (double)pitch), sp = sin(0.5 * (double)pitch);
    char json[256];
    snprintf(json, sizeof json, "{%s,'translation':[%.4f,%.4f,%.4f],'rotation':[%f,%f,%f,%f]}",
             what, (double)at[0], (double)at[1], (double)at[2], cy * sp, sy * cp, -sy * sp,
             cy * cp);
    gn_maker_add(m, "nodes", json);
}

static void add_cameras(struct gn_maker *m, float scale) {
    char json[256];
    snprintf(json, sizeof json, "{'type':'perspective','perspective':{'yfov':0.9,'znear':%g}}",
             (double)(0.1f * scale));
    gn_maker_add(m, "cameras", json);
    snprintf(json, sizeof json,
             "{'type':'orthographic','orthographic':{'xmag':%g,'ymag':%g,'znear':%g,'zfar':%g}}",
             (double)(200.0f * scale), (double)(112.0f * scale), (double)(0.1f * scale),
             (double)(900.0f * scale));
    gn_maker_add(m, "cameras", json);
    add_looking(m, "'camera':0", (float[]){0.0f, 1.7f * scale, 0.0f}, 0.0f, -0.08f);
    add_looking(m, "'camera':0", (float[]){-2.0f * scale, 0.2f * scale, -5.2f * scale}, 0.0f, 0.0f);
    add_looking(m, "'camera':0", (float[]){20.0f * scale, 30.0f * scale, 20.0f * scale}, 0.9f,
                -0.65f);
    add_looking(m, "'camera':1", (float[]){0.0f, 200.0f * scale, -100.0f * scale}, 0.0f, -1.2f);
}

/* The camera that stands comes down to its place within 4 s. */
static void add_flight(struct gn_maker *m, size_t camera, float from_m) {
    gn_maker_move(m, (int)camera, 4, (const float[3]){0, from_m, 0}, (const float[3]){0, 1.7f, 0});
}

static struct gn_scene *make(float scale, float from_m) {
    struct gn_maker m;
    gn_maker_init(&m);
    add_ground(&m, scale);
    gn_maker_cube(&m);
    add_blocks(&m, (int)json_array_size(json_object_get(m.root, "meshes")) - 1, scale);
    gn_maker_set(&m, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&m, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','name':'Sun',"
                 "'intensity':2.5}]}}");
    add_looking(&m, "'extensions':{'KHR_lights_punctual':{'light':0}}", (float[]){0, 0, 0}, 0.9f,
                -0.65f);
    const size_t camera = json_array_size(json_object_get(m.root, "nodes"));
    add_cameras(&m, scale);
    if (from_m > 0.0f) add_flight(&m, camera, from_m);
    json_t *nodes = json_array();
    for (size_t i = 0; i < json_array_size(json_object_get(m.root, "nodes")); i++)
        json_array_append_new(nodes, json_integer((json_int_t)i));
    json_object_set_new(m.root, "scenes", json_pack("[{so}]", "nodes", nodes));
    gn_maker_set(&m, "scene", "0");
    struct gn_err err = {0};
    struct gn_scene *scene = gn_maker_load(&m, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}

struct gn_scene *gn_field_scene_make_scaled(float scale) {
    return make(scale, 0.0f);
}

struct gn_scene *gn_field_scene_make_flown(float from_m) {
    return make(1.0f, from_m);
}

struct gn_scene *gn_field_scene_make(void) {
    return gn_field_scene_make_scaled(1.0f);
}
