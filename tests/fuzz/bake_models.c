#include "bake_models.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/dice.h"

enum { SIDE_MAX = 24, MOST = SIDE_MAX * SIDE_MAX * 6, STRAY = 5, JOINTS = 3, TARGETS = 2 };
enum index_kind { UNINDEXED, BYTES, SHORTS, INTEGERS, STRIP, INDEX_KINDS };

/* A sheet of side x side quads, its vertices one by one. */
struct model {
    struct gn_maker m;
    struct gn_dice dice;
    char *what;
    size_t what_size;
    double size, middle[3];
    float positions[MOST + STRAY][3], normals[MOST + STRAY][3], uvs[MOST + STRAY][2];
    uint32_t corners[MOST];
    size_t vertex_count, corner_count;
    int side;
    enum index_kind kind;
    bool is_point, integers, transformed;
};

static size_t below(struct model *m, size_t n) { return (size_t)(gn_dice_next(&m->dice) % n); }

static double between(struct model *m, double low, double high) {
    return gn_dice_between(&m->dice, low, high);
}

/* One time in n; says so then. */
static bool happens(struct model *m, size_t n, const char *word) {
    const size_t length = strlen(m->what);
    if (below(m, n) != 0) return false;
    snprintf(m->what + length, m->what_size - length, " %s", word);
    return true;
}

/* ---- the sheet ---- */

static void put_vertex(struct model *m, int x, int z, float flatness, const double uv[4]) {
    const size_t v = m->vertex_count++;
    const double u = (double)x / m->side, w = (double)z / m->side,
                 angle = 6.3 * sin(3.1 * u + 5.3 * w), tilt = 1.5 * cos(7.7 * u * w);
    const double place[3] = {u - .5, (double)flatness * .3 * sin(9 * u) * cos(4 * w), w - .5};
    const double normal[3] = {cos(angle) * sin(tilt), cos(tilt), sin(angle) * sin(tilt)};
    for (int k = 0; k < 3; k++) {
        m->positions[v][k] = (float)(m->middle[k] + (m->is_point ? 0 : m->size * place[k]));
        m->normals[v][k] = (float)normal[k];
    }
    for (int k = 0; k < 2; k++) m->uvs[v][k] = (float)(uv[k] + uv[2 + k] * (k ? w : u));
}

static void add_corners(struct model *m) {
    static const int quad[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
    const double far = happens(m, 3, "uv-outside") ? pow(10, between(m, 0, 3)) : 0;
    const double uv[4] = {far * between(m, -1, 1), far * between(m, -1, 1),
                          far > 0 ? far * between(m, .1, 1) : 1, 1};
    const float flatness = happens(m, 4, "flat") ? 0 : 1;
    const int side = m->side;
    if (m->kind == UNINDEXED) {
        for (int i = 0; i < side * side * 6; i++)
            put_vertex(m, i / 6 % side + quad[i % 6][0], i / 6 / side + quad[i % 6][1], flatness,
                       uv);
        m->corner_count = m->vertex_count;
        return;
    }
    for (int i = 0; i < (side + 1) * (side + 1); i++)
        put_vertex(m, i % (side + 1), i / (side + 1), flatness, uv);
    const int rows = m->kind == STRIP ? 1 : side;
    for (int i = 0; m->kind != STRIP && i < side * rows * 6; i++)
        m->corners[m->corner_count++] = (uint32_t)(i / 6 % side + quad[i % 6][0] +
                                                   (i / 6 / side + quad[i % 6][1]) * (side + 1));
    for (int i = 0; m->kind == STRIP && i < 2 * (side + 1); i++)
        m->corners[m->corner_count++] = (uint32_t)(i / 2 + i % 2 * (side + 1));
}

/* Triangles that show nothing, and vertices of none. */
static void add_nothing(struct model *m) {
    if (m->kind == UNINDEXED) return;
    if (m->kind != STRIP && happens(m, 3, "degenerate"))
        for (size_t i = 0; i + 2 < m->corner_count; i += 3 * (1 + below(m, 9)))
            m->corners[i] = m->corners[i + 1];
    if (!happens(m, 3, "stray")) return;
    for (int i = 0; i < STRAY; i++)
        for (int k = 0; k < 3; k++)
            m->positions[m->vertex_count + (size_t)i][k] =
                (float)(m->size * 1e6 * between(m, -1, 1));
    memset(m->normals[m->vertex_count], 0, STRAY * sizeof m->normals[0]);
    m->vertex_count += STRAY;
}

/* ---- accessors ---- */

static int put(struct model *m, const char *type, int component, const void *data, size_t element,
               const char *more) {
    return gn_maker_accessor(&m->m, type, component, m->vertex_count, data,
                             m->vertex_count * element, more);
}

/* The first and last vertices of it are in a sparse part. */
static void make_sparse(struct model *m, int accessor) {
    const uint16_t which[2] = {0, (uint16_t)(m->vertex_count - 1)};
    const float values[2][3] = {
        {m->positions[0][0], m->positions[0][1], m->positions[0][2]},
        {m->positions[which[1]][0], m->positions[which[1]][1], m->positions[which[1]][2]}};
    const int indices = gn_maker_view(&m->m, which, sizeof which),
              data = gn_maker_view(&m->m, values, sizeof values);
    json_object_set_new(json_array_get(json_object_get(m->m.root, "accessors"), (size_t)accessor),
                        "sparse",
                        json_pack("{s:i,s:{s:i,s:i},s:{s:i}}", "count", 2, "indices", "bufferView",
                                  indices, "componentType", 5123, "values", "bufferView", data));
}

static int put_positions(struct model *m) {
    static uint16_t shorts[MOST + STRAY][4];
    float first[3], last[3];
    if (m->integers) {
        for (size_t i = 0; i < m->vertex_count; i++)
            for (int k = 0; k < 3; k++)
                shorts[i][k] =
                    (uint16_t)(32768 +
                               30000 * ((double)m->positions[i][k] - m->middle[k]) / m->size);
        const int accessor = put(m, "VEC3", 5123, shorts, sizeof shorts[0], NULL);
        const json_t *views = json_object_get(m->m.root, "bufferViews");
        json_object_set_new(json_array_get(views, json_array_size(views) - 1), "byteStride",
                            json_integer(8));
        return accessor;
    }
    if (m->vertex_count > 60000 || !happens(m, 4, "sparse"))
        return put(m, "VEC3", 5126, m->positions, sizeof m->positions[0], NULL);
    memcpy(first, m->positions[0], sizeof first);
    memcpy(last, m->positions[m->vertex_count - 1], sizeof last);
    memset(m->positions[0], 0, sizeof first);
    memset(m->positions[m->vertex_count - 1], 0, sizeof last);
    const int accessor = put(m, "VEC3", 5126, m->positions, sizeof m->positions[0], NULL);
    memcpy(m->positions[0], first, sizeof first);
    memcpy(m->positions[m->vertex_count - 1], last, sizeof last);
    make_sparse(m, accessor);
    return accessor;
}

static int put_indices(struct model *m, size_t first, size_t count) {
    static uint8_t out[4 * MOST];
    const size_t width = m->kind == BYTES ? 1 : m->kind == INTEGERS ? 4 : 2;
    for (size_t i = 0; i < count; i++) memcpy(out + width * i, &m->corners[first + i], width);
    return gn_maker_accessor(&m->m, "SCALAR",
                             width == 1   ? 5121
                             : width == 2 ? 5123
                                          : 5125,
                             count, out, width * count, NULL);
}

/* Two targets, the second of a larger move; the text of the primitive's member. */
static void put_targets(struct model *m, char *text, size_t size) {
    static float moves[MOST + STRAY][3], turns[MOST + STRAY][3];
    int accessors[TARGETS][2];
    for (int t = 0; t < TARGETS; t++) {
        for (size_t i = 0; i < m->vertex_count; i++)
            for (int k = 0; k < 3; k++) {
                moves[i][k] = (float)(m->size * (t + 1) * between(m, -.5, .5));
                turns[i][k] = (float)between(m, -.1, .1);
            }
        accessors[t][0] = put(m, "VEC3", 5126, moves, sizeof moves[0], NULL);
        accessors[t][1] = put(m, "VEC3", 5126, turns, sizeof turns[0], NULL);
    }
    snprintf(text, size, ",'targets':[{'POSITION':%d,'NORMAL':%d},{'POSITION':%d,'NORMAL':%d}]",
             accessors[0][0], accessors[0][1], accessors[1][0], accessors[1][1]);
}

static void put_weights(struct model *m, char *text, size_t size) {
    static uint16_t joints[MOST + STRAY][4];
    static float weights[MOST + STRAY][4];
    for (size_t i = 0; i < m->vertex_count; i++) {
        const double share = between(m, 0, 1);
        memcpy(joints[i], (uint16_t[]){(uint16_t)below(m, JOINTS), 1, 0, 0}, sizeof joints[i]);
        memcpy(weights[i], (float[]){(float)share, (float)(1 - share), 0, 0}, sizeof weights[i]);
    }
    const int j = put(m, "VEC4", 5123, joints, sizeof joints[0], NULL),
              w = put(m, "VEC4", 5126, weights, sizeof weights[0], NULL);
    snprintf(text, size, ",'JOINTS_0':%d,'WEIGHTS_0':%d", j, w);
}

/* ---- the file ---- */

static void add_material(struct model *m) {
    static const uint8_t rgba[16] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 255};
    struct gn_made png = gn_maker_png(2, 2, rgba);
    char text[300];
    snprintf(text, sizeof text, "{'mimeType':'image/png','bufferView':%d}",
             gn_maker_view(&m->m, png.data, png.size));
    free(png.data);
    gn_maker_add(&m->m, "images", text);
    gn_maker_set(&m->m, "textures", "[{'source':0}]");
    m->transformed = happens(m, 3, "uv-transform");
    const double scale = m->transformed ? pow(10, between(m, -1, 3)) : 1;
    snprintf(text, sizeof text,
             "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0%s%.9g,%.9g%s}}",
             m->transformed ? ",'extensions':{'KHR_texture_transform':{'rotation':0.4,'scale':["
                            : ",'extras':{'x':[",
             scale, scale, m->transformed ? "]}}}" : "]}}");
    gn_maker_add(&m->m, "materials", text);
}

static void add_mesh(struct model *m, bool skinned, bool morphed) {
    char weights[80] = "", targets[200] = "", one[500], indices[40] = "", mesh[1400];
    const int p = put_positions(m),
              n = put(m, "VEC3", 5126, m->normals, sizeof m->normals[0], NULL),
              t = put(m, "VEC2", 5126, m->uvs, sizeof m->uvs[0], NULL);
    if (skinned) put_weights(m, weights, sizeof weights);
    if (morphed) put_targets(m, targets, sizeof targets);
    const bool halves = m->kind != UNINDEXED && m->kind != STRIP && happens(m, 3, "shared");
    const size_t half = halves ? m->corner_count / 6 * 3 : m->corner_count;
    if (m->kind != UNINDEXED)
        snprintf(indices, sizeof indices, ",'indices':%d", put_indices(m, 0, half));
    snprintf(one, sizeof one,
             "'attributes':{'POSITION':%d,'NORMAL':%d,'TEXCOORD_0':%d%s},'material':0,'mode':%d%s",
             p, n, t, weights, m->kind == STRIP ? 5 : 4, targets);
    int length = snprintf(mesh, sizeof mesh, "{%s'primitives':[{%s%s}",
                          morphed ? "'weights':[0.4,0.7]," : "", one, indices);
    if (halves)
        length += snprintf(mesh + length, sizeof mesh - (size_t)length, ",{%s,'indices':%d}", one,
                           put_indices(m, half, m->corner_count - half));
    if (!morphed && happens(m, 8, "lines"))
        length += snprintf(mesh + length, sizeof mesh - (size_t)length,
                           ",{'attributes':{'POSITION':%d},'mode':1}", p);
    snprintf(mesh + length, sizeof mesh - (size_t)length, "]}");
    gn_maker_add(&m->m, "meshes", mesh);
}

static void add_nodes(struct model *m, bool skinned) {
    const double s = m->integers ? m->size / 6e4 : 1, x = m->size * between(m, -9, 9);
    char text[500];
    if (skinned) {
        snprintf(text, sizeof text,
                 "[{'mesh':0,'skin':0},{'rotation':[0,0.38268343,0,0.92387953]},"
                 "{'translation':[0,%.9g,0]},{'scale':[1.5,1,1]}]",
                 m->size / 2);
        gn_maker_set(&m->m, "skins", "[{'joints':[1,2,3]}]");
    } else if (happens(m, 4, "matrix"))
        snprintf(text, sizeof text,
                 "[{'mesh':0,'matrix':[%.9g,0,%.9g,0, 0,%.9g,0,0, %.9g,0,%.9g,0, %.9g,0,0,1]}]",
                 s * .8, s * .6, s * (happens(m, 2, "mirrored") ? -2 : 2), s * -.6, s * .8, x);
    else if (happens(m, 4, "children"))
        snprintf(text, sizeof text,
                 "[{'mesh':0,'scale':[%.9g,%.9g,%.9g],'children':[1]},{'mesh':0,'translation':[%."
                 "9g,0,0]}]",
                 s, s, s, m->size / s);
    else if (happens(m, 4, "instances")) {
        const float places[2][3] = {{0, 0, 0}, {(float)x, 0, 0}};
        const int a = gn_maker_accessor(&m->m, "VEC3", 5126, 2, places, sizeof places, NULL);
        snprintf(
            text, sizeof text,
            "[{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':%d}}},"
            "'scale':[%.9g,%.9g,%.9g]}]",
            a, s, s, s);
    } else
        snprintf(text, sizeof text,
                 "[{'mesh':0,'translation':[%.9g,%.9g,0],'rotation':[0.1,0.7,0,0.7],"
                 "'scale':[%.9g,%.9g,%.9g]}]",
                 x, -x, s * (happens(m, 2, "mirrored") ? -1 : 1), s * between(m, .2, 5), s);
    gn_maker_set(&m->m, "nodes", text);
    gn_maker_set(&m->m, "scenes", skinned ? "[{'nodes':[0,1,2,3]}]" : "[{'nodes':[0]}]");
}

struct gn_made gn_bake_model(int number, char *what, size_t what_size) {
    struct model *m = calloc(1, sizeof *m);
    m->dice.state = UINT64_C(0x62616b65) + (uint64_t)number * UINT64_C(1000003);
    m->what = what;
    m->what_size = what_size;
    m->size = pow(10, between(m, -6, 6));
    snprintf(what, what_size, "%.0e m", m->size);
    gn_maker_init(&m->m);
    gn_maker_set(&m->m, "extensionsUsed",
                 "['KHR_texture_transform','KHR_mesh_quantization','EXT_mesh_gpu_instancing']");
    const bool skinned = happens(m, 5, "skin"), morphed = happens(m, 5, "targets");
    m->is_point = morphed && happens(m, 3, "of-a-point");
    m->integers = !skinned && !morphed && happens(m, 6, "integers");
    m->kind = (enum index_kind)below(m, INDEX_KINDS);
    m->side = m->kind == BYTES ? 2 + (int)below(m, 10) : 2 + (int)below(m, SIDE_MAX - 1);
    const double far = !m->integers && happens(m, 4, "far") ? pow(10, between(m, 0, 6)) : 1;
    for (int k = 0; k < 3; k++) m->middle[k] = m->size * far * between(m, -1, 1);
    add_corners(m);
    if (!m->integers) add_nothing(m);
    add_material(m);
    add_mesh(m, skinned, morphed);
    add_nodes(m, skinned);
    struct gn_made made = gn_maker_glb(&m->m);
    gn_maker_finish(&m->m);
    free(m);
    return made;
}
