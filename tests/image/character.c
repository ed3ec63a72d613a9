#include "image/character.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "unit/gltf_maker.h"

enum { RINGS = 9, SIDES = 8, VERTICES = RINGS * SIDES + 2, FLOAT = 5126, U16 = 5123, U8 = 5121 };
enum { TRIANGLES = 2 * SIDES * (RINGS - 1) + 2 * SIDES };

struct mesh {
    float positions[VERTICES][3], normals[VERTICES][3], bulge[VERTICES][3];
    uint8_t joints[2][VERTICES][4], weights[VERTICES][4];
    float more[VERTICES][4]; /* weights of the second four */
    uint16_t indices[TRIANGLES][3];
};

/* A column along y from 0 to 2, of three joints at 0, .7 and 1.4. */
static void make_mesh(struct mesh *m) {
    int t = 0;
    memset(m, 0, sizeof *m);
    for (int v = 0; v < VERTICES; v++) {
        const int ring = v / SIDES;
        const bool cap = v >= RINGS * SIDES;
        const double angle = 2 * M_PI * (v % SIDES) / SIDES;
        const double y = cap ? (v == VERTICES - 1 ? 2 : 0) : 2.0 * ring / (RINGS - 1);
        const double radius = cap ? 0 : .3;
        m->positions[v][0] = (float)(radius * cos(angle));
        m->positions[v][1] = (float)y;
        m->positions[v][2] = (float)(-radius * sin(angle));
        m->normals[v][0] = cap ? 0 : (float)cos(angle);
        m->normals[v][1] = cap ? (v == VERTICES - 1 ? 1 : -1) : 0;
        m->normals[v][2] = cap ? 0 : (float)-sin(angle);
        for (int k = 0; k < 3; k += 2) m->bulge[v][k] = .5f * m->positions[v][k];
        /* the lower, the middle and, of the second four, the upper joint */
        const double up = fmin(fmax((y - .3) / .8, 0), 1), top = fmin(fmax((y - 1.2) / .5, 0), 1);
        m->joints[0][v][1] = 1;
        m->joints[1][v][0] = 2;
        m->weights[v][0] = (uint8_t)lround(200 * (1 - up));
        m->weights[v][1] = (uint8_t)lround(200 * up * (1 - top));
        m->more[v][0] = (float)(200 * up * top / 255);
    }
    for (int r = 0; r + 1 < RINGS; r++)
        for (int s = 0; s < SIDES; s++) {
            const int a = r * SIDES + s, b = r * SIDES + (s + 1) % SIDES;
            const int quad[2][3] = {{a, b, b + SIDES}, {a, b + SIDES, a + SIDES}};
            for (int k = 0; k < 6; k++) m->indices[t + k / 3][k % 3] = (uint16_t)quad[k / 3][k % 3];
            t += 2;
        }
    for (int s = 0; s < SIDES; s++) {
        const int next = (s + 1) % SIDES, upper = (RINGS - 1) * SIDES;
        const int caps[2][3] = {{VERTICES - 2, next, s}, {VERTICES - 1, upper + s, upper + next}};
        for (int k = 0; k < 6; k++) m->indices[t + k / 3][k % 3] = (uint16_t)caps[k / 3][k % 3];
        t += 2;
    }
}

/* Nods at one vertex of the rim, as a sparse accessor; returns it. */
static int add_sparse(struct gn_maker *maker) {
    static const uint16_t where[] = {RINGS * SIDES - 3, RINGS * SIDES - 2};
    static const float what[] = {.2f, .3f, 0, .1f, .2f, .1f};
    char json[300];
    snprintf(json, sizeof json,
             "{'type':'VEC3','componentType':5126,'count':%d,'sparse':{'count':2,'indices':"
             "{'bufferView':%d,'componentType':5123},'values':{'bufferView':%d}}}",
             VERTICES, gn_maker_view(maker, where, sizeof where),
             gn_maker_view(maker, what, sizeof what));
    return gn_maker_add(maker, "accessors", json);
}

static void add_mesh(struct gn_maker *maker) {
    static struct mesh m;
    char json[600];
    make_mesh(&m);
    const int p = gn_maker_accessor(maker, "VEC3", FLOAT, VERTICES, m.positions, sizeof m.positions,
                                    "'min':[-0.3,0,-0.3],'max':[0.3,2,0.3]");
    const int n =
        gn_maker_accessor(maker, "VEC3", FLOAT, VERTICES, m.normals, sizeof m.normals, NULL);
    const int j0 =
        gn_maker_accessor(maker, "VEC4", U8, VERTICES, m.joints[0], sizeof m.joints[0], NULL);
    const int j1 =
        gn_maker_accessor(maker, "VEC4", U8, VERTICES, m.joints[1], sizeof m.joints[1], NULL);
    const int w0 = gn_maker_accessor(maker, "VEC4", U8, VERTICES, m.weights, sizeof m.weights,
                                     "'normalized':true");
    const int w1 = gn_maker_accessor(maker, "VEC4", FLOAT, VERTICES, m.more, sizeof m.more, NULL);
    const int bulge =
        gn_maker_accessor(maker, "VEC3", FLOAT, VERTICES, m.bulge, sizeof m.bulge, NULL);
    const int i =
        gn_maker_accessor(maker, "SCALAR", U16, 3 * TRIANGLES, m.indices, sizeof m.indices, NULL);
    snprintf(json, sizeof json,
             "{'weights':[0.5,0],'primitives':[{'indices':%d,'attributes':{'POSITION':%d,"
             "'NORMAL':%d,'JOINTS_0':%d,'WEIGHTS_0':%d,'JOINTS_1':%d,'WEIGHTS_1':%d},'targets':"
             "[{'POSITION':%d},{'POSITION':%d}]}]}",
             i, p, n, j0, w0, j1, w1, bulge, add_sparse(maker));
    gn_maker_add(maker, "meshes", json);
}

static void add_clip(struct gn_maker *maker) {
    static const float times[] = {0, 1, GN_CHARACTER_S};
    static const float turns[] = {0, 0, 0, 1, 0, 0, .38268343f, .92387953f, 0, 0, 0, 1};
    static const float nods[] = {0, 0, 0, 1, -.38268343f, 0, 0, .92387953f, 0, .5f, 0, .8660254f};
    /* in-tangents, values and out-tangents of two weights */
    static const float weights[] = {0, 0, .5f, 0, 1, 1, 0, 0, 1, 1, 0, 1, 0, -.5f, 0, 0, 0, 0};
    char json[700];
    const int time =
        gn_maker_accessor(maker, "SCALAR", FLOAT, 3, times, sizeof times, "'min':[0],'max':[2]");
    const int turn = gn_maker_accessor(maker, "VEC4", FLOAT, 3, turns, sizeof turns, NULL);
    const int nod = gn_maker_accessor(maker, "VEC4", FLOAT, 3, nods, sizeof nods, NULL);
    const int weight = gn_maker_accessor(maker, "SCALAR", FLOAT, 18, weights, sizeof weights, NULL);
    snprintf(json, sizeof json,
             "{'samplers':[{'input':%d,'output':%d},{'input':%d,'output':%d},"
             "{'input':%d,'output':%d,'interpolation':'CUBICSPLINE'}],'channels':["
             "{'sampler':0,'target':{'node':1,'path':'rotation'}},"
             "{'sampler':1,'target':{'node':2,'path':'rotation'}},"
             "{'sampler':1,'target':{'node':5,'path':'rotation'}},"
             "{'sampler':2,'target':{'node':6,'path':'weights'}}]}",
             time, turn, time, nod, time, weight);
    gn_maker_add(maker, "animations", json);
}

bool gn_character_write(const char *path, struct gn_err *err) {
    static const float binds[3][16] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                                       {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -.7f, 0, 1},
                                       {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1.4f, 0, 1}};
    struct gn_maker maker;
    char json[200];
    gn_maker_init(&maker);
    gn_maker_square(&maker); /* mesh 0 */
    add_mesh(&maker);
    add_clip(&maker);
    const int bind = gn_maker_accessor(&maker, "MAT4", FLOAT, 3, binds, sizeof binds, NULL);
    snprintf(json, sizeof json,
             "[{'joints':[0,1,2],'inverseBindMatrices':%d},"
             "{'joints':[3,4,5],'inverseBindMatrices':%d}]",
             bind, bind);
    gn_maker_set(&maker, "skins", json);
    gn_maker_set(
        &maker, "nodes",
        "[{'children':[1],'translation':[-0.9,0,0],'scale':[1.6,1,0.7]},"
        "{'children':[2],'translation':[0,0.7,0]},{'translation':[0,0.7,0]},"
        "{'children':[4],'translation':[0.9,0,0.2],'rotation':[0,0.38268343,0,0.92387953]},"
        "{'children':[5],'translation':[0,0.7,0]},"
        "{'translation':[0,0.7,0],'scale':[1,1.5,1]},"
        "{'mesh':1,'skin':0,'translation':[50,3,0]},{'mesh':1,'skin':1,'weights':[0,1]},"
        "{'mesh':0,'scale':[2.5,1,2.5]},"
        "{'rotation':[-0.5356519,-0.6249272,-0.0000000,0.5679287],'extensions':{'KHR_lights_"
        "punctual':{'light':0}}}]");
    gn_maker_set(&maker, "scenes", "[{'nodes':[0,3,6,7,8,9]}]");
    gn_maker_set(&maker, "extensionsUsed", "['KHR_lights_punctual']");
    gn_maker_set(&maker, "extensions",
                 "{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':3}]}}");
    return gn_maker_write(&maker, path, err);
}

/* ---- many joints --------------------------------------------------------------------------- */

enum { JOINTS = 1024, ROW = 32 };

bool gn_many_joints_write(const char *path, struct gn_err *err) {
    static float positions[JOINTS][3][3], weights[JOINTS][3][4];
    static uint16_t joints[JOINTS][3][4];
    struct gn_maker maker;
    char json[200];
    gn_maker_init(&maker);
    for (int i = 0; i < JOINTS; i++) {
        snprintf(json, sizeof json, "{'translation':[%d,%d,0],'rotation':[0,%g,0,1]}", i % ROW,
                 i / ROW, (i * 37 % 64 - 32) / 64.0);
        gn_maker_add(&maker, "nodes", json);
        for (int c = 0; c < 3; c++) {
            positions[i][c][0] = c == 1 ? .9f : 0;
            positions[i][c][1] = c == 2 ? .9f : 0;
            joints[i][c][0] = (uint16_t)i;
            weights[i][c][0] = 1;
        }
    }
    gn_maker_skinned(&maker, JOINTS, 3 * JOINTS, positions[0], joints[0], weights[0]);
    return gn_maker_write(&maker, path, err);
}

/* ---- a crowd ------------------------------------------------------------------------------- */

enum { CROWD_RINGS = 51, CROWD_SIDES = 50, CROWD_JOINTS = 20, CROWD = 20 };
enum { CROWD_VERTICES = CROWD_RINGS * CROWD_SIDES };

struct crowd_mesh {
    float positions[CROWD_VERTICES][3], normals[CROWD_VERTICES][3], weights[CROWD_VERTICES][4];
    uint8_t joints[CROWD_VERTICES][4];
    uint16_t indices[2 * (CROWD_RINGS - 1) * CROWD_SIDES][3];
};

static void make_crowd_mesh(struct crowd_mesh *m) {
    int t = 0;
    memset(m, 0, sizeof *m);
    for (int v = 0; v < CROWD_VERTICES; v++) {
        const double angle = 2 * M_PI * (v % CROWD_SIDES) / CROWD_SIDES;
        const double along = (double)(v / CROWD_SIDES) / (CROWD_RINGS - 1) * (CROWD_JOINTS - 1);
        const int joint = (int)along < CROWD_JOINTS - 2 ? (int)along : CROWD_JOINTS - 2;
        m->positions[v][0] = m->normals[v][0] = (float)cos(angle);
        m->positions[v][2] = m->normals[v][2] = (float)-sin(angle);
        for (int k = 0; k < 3; k += 2) m->positions[v][k] *= .25f;
        m->positions[v][1] = (float)(.1 * along);
        for (int k = 0; k < 4; k++) { /* all four count, as on a character */
            m->joints[v][k] = (uint8_t)(joint + k / 2);
            m->weights[v][k] = (float)((k / 2 ? along - joint : 1 - along + joint) / 2);
        }
    }
    for (int r = 0; r + 1 < CROWD_RINGS; r++)
        for (int s = 0; s < CROWD_SIDES; s++) {
            const int a = r * CROWD_SIDES + s, b = r * CROWD_SIDES + (s + 1) % CROWD_SIDES;
            const int quad[6] = {a, b, b + CROWD_SIDES, a, b + CROWD_SIDES, a + CROWD_SIDES};
            for (int k = 0; k < 6; k++) m->indices[t + k / 3][k % 3] = (uint16_t)quad[k];
            t += 2;
        }
}

/* One figure: its node, and its joints or none. All joints bend, or the node turns. */
static void add_figure(struct gn_maker *maker, int number, bool posed, json_t *channels,
                       json_t *shown) {
    char json[200];
    const int x = number % 5, z = number / 5;
    snprintf(json, sizeof json, "{'translation':[%d,0,%d]}", x - 2, z - 2);
    int node = gn_maker_add(maker, "nodes", json);
    json_array_append_new(shown, json_integer(node));
    json_t *joints = json_array();
    json_t *up = json_array_get(json_object_get(maker->root, "nodes"), (size_t)node);
    for (int i = 0; posed && i < CROWD_JOINTS; i++) {
        snprintf(json, sizeof json, "{'translation':[0,%g,0]}", i ? .1 : 0);
        const int joint = gn_maker_add(maker, "nodes", json);
        json_object_set_new(up, "children", json_pack("[i]", joint));
        up = json_array_get(json_object_get(maker->root, "nodes"), (size_t)joint);
        json_array_append_new(joints, json_integer(joint));
        json_array_append_new(channels, json_pack("{sis{siss}}", "sampler", 0, "target", "node",
                                                  joint, "path", "rotation"));
    }
    if (posed) {
        gn_maker_add(maker, "skins", "{'inverseBindMatrices':5}");
        json_t *skins = json_object_get(maker->root, "skins");
        json_object_set(json_array_get(skins, (size_t)number), "joints", joints);
        snprintf(json, sizeof json, "{'mesh':0,'skin':%d}", number);
        node = gn_maker_add(maker, "nodes", json);
        json_array_append_new(shown, json_integer(node));
    } else {
        json_object_set_new(up, "mesh", json_integer(0));
        json_array_append_new(channels, json_pack("{sis{siss}}", "sampler", 0, "target", "node",
                                                  node, "path", "rotation"));
    }
    json_decref(joints);
}

bool gn_crowd_write(const char *path, bool posed, struct gn_err *err) {
    static struct crowd_mesh m;
    static float binds[CROWD_JOINTS][16];
    static const float times[] = {0, 1, 2};
    static const float turns[] = {0, 0, 0, 1, 0, 0, .02f, .9998f, 0, 0, 0, 1};
    struct gn_maker maker;
    char json[300];
    make_crowd_mesh(&m);
    gn_maker_init(&maker);
    gn_maker_accessor(&maker, "VEC3", FLOAT, CROWD_VERTICES, m.positions, sizeof m.positions,
                      "'min':[-0.25,0,-0.25],'max':[0.25,1.9,0.25]");
    gn_maker_accessor(&maker, "VEC3", FLOAT, CROWD_VERTICES, m.normals, sizeof m.normals, NULL);
    gn_maker_accessor(&maker, "VEC4", U8, CROWD_VERTICES, m.joints, sizeof m.joints, NULL);
    gn_maker_accessor(&maker, "VEC4", FLOAT, CROWD_VERTICES, m.weights, sizeof m.weights, NULL);
    gn_maker_accessor(&maker, "SCALAR", U16, sizeof m.indices / 2, m.indices, sizeof m.indices,
                      NULL);
    for (int i = 0; i < CROWD_JOINTS; i++) {
        for (int k = 0; k < 16; k += 5) binds[i][k] = 1;
        binds[i][13] = (float)(-.1 * i);
    }
    gn_maker_accessor(&maker, "MAT4", FLOAT, CROWD_JOINTS, binds, sizeof binds, NULL);
    const int time = gn_maker_accessor(&maker, "SCALAR", FLOAT, 3, times, sizeof times, NULL);
    const int turn = gn_maker_accessor(&maker, "VEC4", FLOAT, 3, turns, sizeof turns, NULL);
    gn_maker_add(&maker, "meshes",
                 posed ? "{'primitives':[{'indices':4,'attributes':{'POSITION':0,'NORMAL':1,"
                         "'JOINTS_0':2,'WEIGHTS_0':3}}]}"
                       : "{'primitives':[{'indices':4,'attributes':{'POSITION':0,'NORMAL':1}}]}");
    gn_maker_set(&maker, "nodes", "[]");
    json_t *channels = json_array(), *shown = json_array();
    for (int i = 0; i < CROWD; i++) add_figure(&maker, i, posed, channels, shown);
    snprintf(json, sizeof json, "[{'samplers':[{'input':%d,'output':%d}]}]", time, turn);
    gn_maker_set(&maker, "animations", json);
    json_object_set_new(json_array_get(json_object_get(maker.root, "animations"), 0), "channels",
                        channels);
    json_object_set_new(maker.root, "scenes", json_pack("[{so}]", "nodes", shown));
    return gn_maker_write(&maker, path, err);
}
