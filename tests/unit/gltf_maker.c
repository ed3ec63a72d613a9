#include "gltf_maker.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

#include "core/arena.h"
#include "core/file.h"
#include "scene_check.h"

static json_t *parse(const char *json) {
    char *text = strdup(json);
    for (char *c = text; *c; c++)
        if (*c == '\'') *c = '"';
    json_error_t error;
    json_t *value = json_loads(text, JSON_DECODE_ANY, &error);
    if (!value) {
        fprintf(stderr, "%s\n%s\n", error.text, text);
        abort();
    }
    free(text);
    return value;
}

void gn_maker_init(struct gn_maker *maker) {
    *maker = (struct gn_maker){.root = parse("{'asset':{'version':'2.0'}}")};
}

void gn_maker_finish(struct gn_maker *maker) {
    json_decref(maker->root);
    free(maker->bin);
    *maker = (struct gn_maker){0};
}

void gn_maker_set(struct gn_maker *maker, const char *key, const char *json) {
    json_object_set_new(maker->root, key, parse(json));
}

int gn_maker_add(struct gn_maker *maker, const char *array, const char *json) {
    json_t *list = json_object_get(maker->root, array);
    if (!list) json_object_set_new(maker->root, array, list = json_array());
    json_array_append_new(list, parse(json));
    return (int)json_array_size(list) - 1;
}

int gn_maker_view(struct gn_maker *maker, const void *data, size_t size) {
    char json[120];
    size_t padded = (size + 3) / 4 * 4;
    snprintf(json, sizeof json, "{'buffer':0,'byteOffset':%zu,'byteLength':%zu}", maker->size,
             size);
    maker->bin = gn_xrealloc(maker->bin, maker->size + padded, 1);
    memset(maker->bin + maker->size, 0, padded);
    memcpy(maker->bin + maker->size, data, size);
    maker->size += padded;
    return gn_maker_add(maker, "bufferViews", json);
}

int gn_maker_accessor(struct gn_maker *maker, const char *type, int component, size_t count,
                      const void *data, size_t size, const char *more) {
    char json[400];
    int view = data ? gn_maker_view(maker, data, size) : -1, n = 0;
    if (view >= 0)
        n = snprintf(json, sizeof json, "{'bufferView':%d,", view);
    else
        n = snprintf(json, sizeof json, "{");
    snprintf(json + n, sizeof json - (size_t)n, "'componentType':%d,'count':%zu,'type':'%s'%s%s}",
             component, count, type, more ? "," : "", more ? more : "");
    return gn_maker_add(maker, "accessors", json);
}

void gn_maker_move(struct gn_maker *m, int node, float seconds, const float from[3],
                   const float to[3]) {
    const float times_s[2] = {0, seconds},
                places[6] = {from[0], from[1], from[2], to[0], to[1], to[2]};
    char most[60], json[260];
    snprintf(most, sizeof most, "'min':[0],'max':[%g]", (double)seconds);
    const int input = gn_maker_accessor(m, "SCALAR", 5126, 2, times_s, sizeof times_s, most),
              output = gn_maker_accessor(m, "VEC3", 5126, 2, places, sizeof places, NULL);
    snprintf(json, sizeof json,
             "[{'samplers':[{'input':%d,'output':%d}],'channels':[{'sampler':0,'target':{'node':%d,"
             "'path':'translation'}}]}]",
             input, output, node);
    gn_maker_set(m, "animations", json);
}

void gn_maker_square(struct gn_maker *maker) {
    static const float positions[] = {-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1};
    static const uint16_t indices[] = {0, 1, 2, 0, 2, 3};
    gn_maker_accessor(maker, "VEC3", 5126, 4, positions, sizeof positions,
                      "'min':[-1,0,-1],'max':[1,0,1]");
    gn_maker_accessor(maker, "SCALAR", 5123, 6, indices, sizeof indices, NULL);
    gn_maker_add(maker, "meshes", "{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}");
    gn_maker_add(maker, "nodes", "{'name':'square','mesh':0}");
    gn_maker_add(maker, "scenes", "{'nodes':[0]}");
    gn_maker_set(maker, "scene", "0");
}

void gn_maker_posed_square(struct gn_maker *maker) {
    static const float binds[2][16] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1},
                                       {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1}};
    static const float lift[] = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    static const float nudge[] = {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    uint8_t joints[4][4] = {{0}};
    float weights[4][4] = {{0}}, corners[4][3];
    gn_maker_square(maker);
    memcpy(corners, maker->bin, sizeof corners);
    for (int v = 0; v < 4; v++) {
        joints[v][0] = corners[v][0] > 0;
        weights[v][0] = 1;
    }
    gn_maker_accessor(maker, "VEC4", 5121, 4, joints, sizeof joints, NULL);
    gn_maker_accessor(maker, "VEC4", 5126, 4, weights, sizeof weights, NULL);
    gn_maker_accessor(maker, "VEC3", 5126, 4, lift, sizeof lift, NULL);
    gn_maker_accessor(maker, "VEC3", 5126, 4, nudge, sizeof nudge, NULL);
    gn_maker_accessor(maker, "MAT4", 5126, 2, binds, sizeof binds, NULL);
    gn_maker_set(maker, "meshes",
                 "[{'weights':[0,0],'primitives':[{'indices':1,'attributes':{'POSITION':0,"
                 "'JOINTS_0':2,'WEIGHTS_0':3},'targets':[{'POSITION':4},{'POSITION':5}]}]}]");
    gn_maker_set(maker, "skins", "[{'joints':[1,2],'inverseBindMatrices':6}]");
    gn_maker_set(maker, "nodes",
                 "[{'mesh':0,'skin':0,'translation':[9,9,9]},"
                 "{'children':[2],'translation':[-1,0,0]},{'translation':[2,0,0]}]");
    gn_maker_set(maker, "scenes", "[{'nodes':[0,1]}]");
}

void gn_maker_suns(struct gn_maker *maker, int count, double lux) {
    json_t *lights = json_array();
    char json[200];
    for (int i = 0; i < count; i++) {
        json_array_append_new(lights,
                              json_pack("{ss sf}", "type", "directional", "intensity", lux));
        snprintf(json, sizeof json,
                 "{'rotation':[-0.65,%.3f,0,0.75],'extensions':{'KHR_lights_punctual':{'light':%d}}"
                 "}",
                 0.01 * i, i);
        gn_maker_add(maker, "nodes", json);
    }
    json_object_set_new(maker->root, "extensions",
                        json_pack("{s{so}}", "KHR_lights_punctual", "lights", lights));
}

void gn_maker_show_all(struct gn_maker *maker, const char *background) {
    const int count = (int)json_array_size(json_object_get(maker->root, "nodes"));
    json_t *roots = json_array(), *scene = json_pack("{so}", "nodes", roots);
    for (int i = 0; i < count; i++) json_array_append_new(roots, json_integer(i));
    if (background)
        json_object_set_new(scene, "extras",
                            json_pack("{so}", "gnomon_background", parse(background)));
    json_object_set_new(maker->root, "scenes", json_pack("[o]", scene));
}

void gn_maker_skinned(struct gn_maker *maker, int nodes, size_t vertices,
                      const float (*positions)[3], const uint16_t (*joints)[4],
                      const float (*weights)[4]) {
    json_t *list = json_array();
    for (int i = 0; i < nodes; i++) json_array_append_new(list, json_integer(i));
    gn_maker_accessor(maker, "VEC3", 5126, vertices, positions, vertices * sizeof *positions, NULL);
    gn_maker_accessor(maker, "VEC4", 5123, vertices, joints, vertices * sizeof *joints, NULL);
    gn_maker_accessor(maker, "VEC4", 5126, vertices, weights, vertices * sizeof *weights, NULL);
    gn_maker_add(maker, "meshes",
                 "{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':1,'WEIGHTS_0':2}}]}");
    json_object_set_new(maker->root, "skins", json_pack("[{so}]", "joints", list));
    gn_maker_add(maker, "nodes", "{'mesh':0,'skin':0}");
    gn_maker_show_all(maker, NULL);
}

void gn_maker_cube(struct gn_maker *maker) {
    float positions[72];
    uint16_t indices[36];
    int n = 0;
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side <= 1; side += 2)
            for (int i = 0; i < 4; i++, n++) { /* anticlockwise seen from outside */
                float u = i == 1 || i == 2 ? 1 : -1, v = i > 1 ? 1 : -1;
                positions[3 * n + axis] = (float)side;
                positions[3 * n + (axis + 1) % 3] = u * (float)side;
                positions[3 * n + (axis + 2) % 3] = v;
            }
    for (int f = 0; f < 6; f++)
        for (int i = 0; i < 6; i++)
            indices[6 * f + i] = (uint16_t)(4 * f + (const int[]){0, 1, 2, 0, 2, 3}[i]);
    char mesh[200];
    int p = gn_maker_accessor(maker, "VEC3", 5126, 24, positions, sizeof positions,
                              "'min':[-1,-1,-1],'max':[1,1,1]");
    int i = gn_maker_accessor(maker, "SCALAR", 5123, 36, indices, sizeof indices, NULL);
    snprintf(mesh, sizeof mesh, "{'primitives':[{'attributes':{'POSITION':%d},'indices':%d}]}", p,
             i);
    gn_maker_add(maker, "meshes", mesh);
}

static void put_u32(uint8_t *out, size_t value) {
    for (int i = 0; i < 4; i++) out[i] = (uint8_t)(value >> (8 * i));
}

/* Buffers that a test has added stay behind it. */
static void set_first_buffer(struct gn_maker *maker, json_t *buffer) {
    json_t *buffers = json_object_get(maker->root, "buffers");
    if (!buffers) json_object_set_new(maker->root, "buffers", buffers = json_array());
    json_array_insert_new(buffers, 0, buffer);
}

struct gn_made gn_maker_glb(struct gn_maker *maker) {
    if (maker->size > 0)
        set_first_buffer(maker, json_pack("{s:I}", "byteLength", (json_int_t)maker->size));
    char *text = json_dumps(maker->root, JSON_COMPACT);
    size_t length = strlen(text), padded = (length + 3) / 4 * 4;
    struct gn_made made = {.size = 12 + 8 + padded + (maker->size > 0 ? 8 + maker->size : 0)};
    uint8_t *out = made.data = gn_xalloc(made.size, 1);
    memcpy(out, "glTF", 4);
    put_u32(out + 4, 2);
    put_u32(out + 8, made.size);
    put_u32(out + 12, padded);
    memcpy(out + 16, "JSON", 4);
    memset(out + 20, ' ', padded);
    memcpy(out + 20, text, length);
    if (maker->size > 0) {
        put_u32(out + 20 + padded, maker->size);
        memcpy(out + 24 + padded, "BIN", 4);
        memcpy(out + 28 + padded, maker->bin, maker->size);
    }
    free(text);
    return made;
}

static char *base64(const uint8_t *data, size_t size) {
    static const char alphabet[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *out = gn_xalloc((size + 2) / 3 * 4 + 1, 1), *to = out;
    for (size_t i = 0; i < size; i += 3) {
        uint32_t bits = (uint32_t)data[i] << 16 | (i + 1 < size ? (uint32_t)data[i + 1] << 8 : 0) |
                        (i + 2 < size ? data[i + 2] : 0);
        for (int k = 0; k < 4; k++)
            *to++ = i + (size_t)k <= size ? alphabet[bits >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

struct gn_made gn_maker_gltf(struct gn_maker *maker) {
    static const char head[] = "data:application/octet-stream;base64,";
    char *text = base64(maker->bin, maker->size), *uri = gn_xalloc(sizeof head + strlen(text), 1);
    strcpy(stpcpy(uri, head), text);
    if (maker->size > 0)
        set_first_buffer(maker,
                         json_pack("{s:s,s:I}", "uri", uri, "byteLength", (json_int_t)maker->size));
    free(text);
    free(uri);
    struct gn_made made = {.data = (uint8_t *)json_dumps(maker->root, JSON_COMPACT)};
    made.size = strlen((char *)made.data);
    return made;
}

bool gn_maker_write(struct gn_maker *maker, const char *path, struct gn_err *err) {
    struct gn_made made = gn_maker_glb(maker);
    bool ok = gn_file_write(path, made.data, made.size, err);
    free(made.data);
    gn_maker_finish(maker);
    return ok;
}

struct gn_scene *gn_maker_load(struct gn_maker *maker, struct gn_warnings *warnings,
                               struct gn_err *err) {
    struct gn_made made = gn_maker_glb(maker);
    struct gn_scene *scene = gn_scene_load_bytes("t", made.data, made.size, NULL, warnings, err);
    free(made.data);
    gn_maker_finish(maker);
    const char *wrong = scene ? gn_scene_check(scene) : NULL;
    if (!wrong) return scene;
    fprintf(stderr, "scene check: %s\n", wrong);
    abort();
}

/* ---- pictures ---- */

static void append(png_structp png, png_bytep data, size_t size) {
    struct gn_made *made = png_get_io_ptr(png);
    made->data = gn_xrealloc(made->data, made->size + size, 1);
    memcpy(made->data + made->size, data, size);
    made->size += size;
}

static void flush(png_structp png) { (void)png; }

static struct gn_made write_png(uint32_t width, uint32_t height, const uint8_t *rows, size_t stride,
                                int depth, int type) {
    struct gn_made made = {0};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &made, append, flush);
    png_set_IHDR(png, info, width, height, depth, type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    if (depth == 16) png_set_swap(png);
    for (uint32_t y = 0; y < height; y++) png_write_row(png, rows + y * stride);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return made;
}

struct gn_made gn_maker_png(uint32_t width, uint32_t height, const uint8_t *rgba) {
    return write_png(width, height, rgba, 4 * (size_t)width, 8, PNG_COLOR_TYPE_RGBA);
}

struct gn_made gn_maker_png_grey16(uint32_t width, uint32_t height, const uint16_t *grey) {
    return write_png(width, height, (const uint8_t *)grey, 2 * (size_t)width, 16,
                     PNG_COLOR_TYPE_GRAY);
}

struct gn_made gn_maker_jpeg(int width, int height, const uint8_t *rgb) {
    struct gn_made made = {0};
    unsigned char *data = NULL;
    unsigned long size = 0;
    tjhandle handle = tjInitCompress();
    tjCompress2(handle, rgb, width, 0, height, TJPF_RGB, &data, &size, TJSAMP_444, 95, 0);
    tjDestroy(handle);
    made.data = gn_xalloc(size, 1);
    made.size = size;
    memcpy(made.data, data, size);
    tjFree(data);
    return made;
}
