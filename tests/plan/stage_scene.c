#include "plan/stage_scene.h"
#include "unit/check.h"

#include <stdio.h>

#include "unit/gltf_maker.h"

enum { GL_FLOAT_CODE = 5126, GL_USHORT_CODE = 5123 };

static int add_floats(struct gn_maker *m, const char *type, const float *values, size_t count,
                      int components) {
    return gn_maker_accessor(m, type, GL_FLOAT_CODE, count, values,
                             count * (size_t)components * sizeof *values, NULL);
}

/* A unit cube round the origin: 24 vertices with normals. */
static void add_cube(struct gn_maker *m, int *position, int *normal, int *index) {
    float p[72], n[72];
    uint16_t triangles[36];
    for (int face = 0, v = 0; face < 6; face++) {
        int axis = face / 2, u = (axis + 1) % 3, w = (axis + 2) % 3;
        float side = face % 2 ? -1.0f : 1.0f;
        static const uint16_t quad[6] = {0, 1, 2, 0, 2, 3};
        for (int k = 0; k < 6; k++) triangles[6 * face + k] = (uint16_t)(v + quad[k]);
        for (int corner = 0; corner < 4; corner++, v++) {
            float across = corner == 1 || corner == 2 ? 0.5f : -0.5f,
                  up = corner >= 2 ? 0.5f : -0.5f;
            p[3 * v + axis] = 0.5f * side;
            p[3 * v + u] = across * side;
            p[3 * v + w] = up;
            n[3 * v + axis] = side;
            n[3 * v + u] = n[3 * v + w] = 0.0f;
        }
    }
    *position = add_floats(m, "VEC3", p, 24, 3);
    *normal = add_floats(m, "VEC3", n, 24, 3);
    *index = gn_maker_accessor(m, "SCALAR", GL_USHORT_CODE, 36, triangles, sizeof triangles, NULL);
}

static int add_mesh(struct gn_maker *m, const int cube[3], int material) {
    char json[256];
    snprintf(
        json, sizeof json,
        "{'primitives':[{'attributes':{'POSITION':%d,'NORMAL':%d},'indices':%d,'material':%d}]}",
        cube[0], cube[1], cube[2], material);
    return gn_maker_add(m, "meshes", json);
}

static int add_node(struct gn_maker *m, int mesh, const char *rest) {
    char json[512];
    snprintf(json, sizeof json, "{'mesh':%d,%s}", mesh, rest);
    return gn_maker_add(m, "nodes", json);
}

static void add_materials(struct gn_maker *m) {
    static const char *const materials[] = {
        "{'name':'ground','pbrMetallicRoughness':{'baseColorFactor':[0.6,0.6,0.6,1],'"
        "metallicFactor':0}}",
        "{'name':'red','pbrMetallicRoughness':{'baseColorFactor':[0.8,0.2,0.1,1],'metallicFactor':"
        "0,'roughnessFactor':0.5}}",
        "{'name':'blue','pbrMetallicRoughness':{'baseColorFactor':[0.1,0.2,0.8,1],'metallicFactor':"
        "0,'roughnessFactor':0.6}}",
        "{'name':'leaf','alphaMode':'MASK','doubleSided':true,'pbrMetallicRoughness':{'"
        "metallicFactor':0}}",
        "{'name':'glass','alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,1,1,0.3],"
        "'metallicFactor':0}}",
        "{'name':'sign','extensions':{'KHR_materials_unlit':{}}}",
    };
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++)
        gn_maker_add(m, "materials", materials[i]);
}

static int add_things(struct gn_maker *m) {
    int cube[3];
    add_cube(m, &cube[0], &cube[1], &cube[2]);
    int mesh[6];
    for (int i = 0; i < 6; i++) mesh[i] = add_mesh(m, cube, i);
    float plane[12] = {-10, 0, -10, -10, 0, 10, 10, 0, 10, 10, 0, -10};
    uint16_t triangles[6] = {0, 1, 2, 0, 2, 3};
    int position = add_floats(m, "VEC3", plane, 4, 3);
    int index =
        gn_maker_accessor(m, "SCALAR", GL_USHORT_CODE, 6, triangles, sizeof triangles, NULL);
    char json[256];
    snprintf(json, sizeof json,
             "{'primitives':[{'attributes':{'POSITION':%d},'indices':%d,'material':0}]}", position,
             index);
    add_node(m, gn_maker_add(m, "meshes", json), "'name':'Ground'");
    add_node(m, mesh[1], "'name':'A','translation':[-3,0.5,0]");
    add_node(m, mesh[2], "'name':'B','translation':[-1,0.5,0]");
    add_node(m, mesh[1], "'name':'Mirrored','translation':[1,0.5,0],'scale':[-1,1,1]");
    int mover = add_node(m, mesh[2], "'name':'Mover','translation':[0,1.5,2]");
    add_node(m, mesh[1], "'name':'Behind the eye','translation':[0,0.5,9.5]");
    add_node(m, mesh[3], "'name':'Card','translation':[3,1,0],'scale':[1,2,0.01]");
    add_node(m, mesh[4], "'name':'Pane','translation':[0,1,3],'scale':[2,2,0.01]");
    add_node(m, mesh[5], "'name':'Sign','translation':[0,3,-4]");
    return mover;
}

static void add_lights(struct gn_maker *m) {
    gn_maker_set(m, "extensionsUsed", "['KHR_lights_punctual','KHR_materials_unlit']");
    gn_maker_set(m, "extensions",
                 "{'KHR_lights_punctual':{'lights':["
                 "{'type':'directional','name':'Sun','intensity':2.5},"
                 "{'type':'spot','name':'Spot','intensity':40,'spot':{'outerConeAngle':0.6,'"
                 "innerConeAngle':0.4}},"
                 "{'type':'point','name':'Bulb','intensity':5}]}}");
    gn_maker_add(m, "nodes", "{'name':'Sun','rotation':[-0.461749,0.1913417,0.1027,0.8600]}");
    gn_maker_add(m, "nodes",
                 "{'name':'Spot','translation':[2,6,2],'rotation':[-0.6532815,0.2705981,0.2705981,"
                 "0.6532815]}");
    gn_maker_add(m, "nodes", "{'name':'Bulb','translation':[-4,3,4]}");
}

static void add_animation(struct gn_maker *m, int mover) {
    float times[2] = {0.0f, 4.0f}, path[6] = {0, 1.5f, 2, 4, 1.5f, 2};
    int input = add_floats(m, "SCALAR", times, 2, 1), output = add_floats(m, "VEC3", path, 2, 3);
    char json[256];
    snprintf(json, sizeof json,
             "{'name':'Move','samplers':[{'input':%d,'output':%d}],"
             "'channels':[{'sampler':0,'target':{'node':%d,'path':'translation'}}]}",
             input, output, mover);
    gn_maker_add(m, "animations", json);
}

struct gn_scene *gn_stage_scene_make(void) {
    struct gn_maker m;
    gn_maker_init(&m);
    add_materials(&m);
    int mover = add_things(&m);
    add_lights(&m);
    for (int i = 0; i < 3; i++) {
        json_t *node = json_array_get(json_object_get(m.root, "nodes"), 9 + (size_t)i);
        json_object_set_new(node, "extensions",
                            json_pack("{s{si}}", "KHR_lights_punctual", "light", i));
    }
    gn_maker_add(&m, "cameras",
                 "{'type':'perspective','name':'Front','perspective':{'yfov':0.8,'aspectRatio':0.1,"
                 "'znear':0.1,'zfar':50}}"); /* that shape: a narrow picture sees less */
    gn_maker_add(&m, "nodes",
                 "{'name':'Front','camera':0,'translation':[0,3,9],'rotation':[-0.13,0,0,0.9915]}");
    gn_maker_add(&m, "nodes",
                 "{'name':'Away','camera':0,'translation':[0,3,9],'rotation':[0,1,0,0]}");
    add_animation(&m, mover);
    gn_maker_set(&m, "scenes", "[{'nodes':[0,1,2,3,4,5,6,7,8,9,10,11,12,13]}]");
    gn_maker_set(&m, "scene", "0");
    struct gn_err err = {0};
    struct gn_scene *scene = gn_maker_load(&m, NULL, &err);
    if (!scene) fail_msg("%s", err.text);
    return scene;
}
