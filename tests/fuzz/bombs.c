#include "fuzz/bombs.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

#include "core/arena.h"
#include "fuzz/bomb_file.h"
#include "fuzz/bomb_pictures.h"
#include "shadow/technique.h"

/* How many a kind adds. */
static int some(struct gn_bomb *b) { return (int)gn_bomb_magnitude(b, b->most); }

/* ---- what every bomb has: a square in a node ---- */

static void add_base(struct gn_bomb *b) {
    static const float square[] = {-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1};
    static const uint16_t corners[] = {0, 1, 2, 0, 2, 3};
    gn_bomb_accessor(b, gn_bomb_view(b, square, sizeof square, 0), "VEC3", 5126, 4);
    gn_bomb_accessor(b, gn_bomb_view(b, corners, sizeof corners, 0), "SCALAR", 5123, 6);
    gn_bomb_begin(b, GN_BOMB_MESHES);
    gn_bomb_put(&b->arrays[GN_BOMB_MESHES],
                "{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}");
    gn_bomb_begin(b, GN_BOMB_NODES);
    gn_bomb_put(&b->arrays[GN_BOMB_NODES], "{'mesh':0}");
}

static void add_node(struct gn_bomb *b, int mesh) {
    gn_bomb_begin(b, GN_BOMB_NODES);
    gn_bomb_put(&b->arrays[GN_BOMB_NODES], "{'mesh':%d,'translation':[%d,%d,%d]}", mesh,
                (int)gn_bomb_below(b, 9), (int)gn_bomb_below(b, 9), (int)gn_bomb_below(b, 9));
}

/* ---- kinds ---- */

/* Accessors without data, which cost nothing in the file. */
static void add_empty_accessors(struct gn_bomb *b) {
    static const char *const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT4"};
    for (int n = (int)gn_bomb_magnitude(b, 40); n > 0; n--) {
        const double most = gn_bomb_below(b, 4) ? 2e7 : 1e18;
        const int position = gn_bomb_accessor(b, -1, "VEC3", 5126, gn_bomb_magnitude(b, most));
        const int second =
            gn_bomb_accessor(b, -1, types[gn_bomb_below(b, 5)], gn_bomb_below(b, 2) ? 5126 : 5121,
                             gn_bomb_magnitude(b, most));
        const int indices = gn_bomb_accessor(b, -1, "SCALAR", 5125, gn_bomb_magnitude(b, most));
        const int mesh = gn_bomb_begin(b, GN_BOMB_MESHES);
        struct gn_bomb_text *text = &b->arrays[GN_BOMB_MESHES];
        gn_bomb_put(text, "{'primitives':[{'attributes':{'POSITION':%d",
                    gn_bomb_below(b, 4) ? position : 0);
        static const char *const names[] = {"NORMAL", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"};
        for (int k = 0; k < 4; k++)
            if (gn_bomb_below(b, 3) == 0)
                gn_bomb_put(text, ",'%s':%d", names[k], gn_bomb_below(b, 2) ? second : position);
        gn_bomb_put(text, "},'mode':%d", (int)gn_bomb_below(b, 7));
        if (gn_bomb_below(b, 2)) gn_bomb_put(text, ",'indices':%d", indices);
        gn_bomb_put(text, "}]}");
        add_node(b, mesh);
    }
}

/* Real positions in a line, a fan or a cloud, which many primitives share. */
static void add_shared_vertices(struct gn_bomb *b) {
    const size_t count = gn_bomb_magnitude(b, 4.0 * b->most);
    float *xyz = gn_xalloc(3 * count, sizeof *xyz);
    const uint64_t shape = gn_bomb_below(b, 5);
    for (size_t i = 0; i < count; i++) {
        const double t = (double)i;
        xyz[3 * i] =
            shape == 0 ? 0 : (float)(shape == 1 ? cos(t) : gn_dice_between(&b->dice, -1, 1));
        xyz[3 * i + 1] = (float)(shape == 1 ? sin(t) : shape == 2 ? 0 : (double)(i % 7));
        xyz[3 * i + 2] = shape == 3 ? (float)t * 1e30f : (float)t;
    }
    const int view = gn_bomb_view(b, xyz, 3 * count * sizeof *xyz, 0);
    free(xyz);
    const int position = gn_bomb_accessor(b, view, "VEC3", 5126, count);
    const int normal = gn_bomb_below(b, 2) ? gn_bomb_accessor(b, view, "VEC3", 5126, count) : -1;
    uint16_t *corners = gn_xalloc(count, sizeof *corners);
    for (size_t i = 0; i < count; i++)
        corners[i] = (uint16_t)(gn_bomb_below(b, 3) ? gn_bomb_below(b, count) : 0);
    const int index_view = gn_bomb_view(b, corners, count * sizeof *corners, 0);
    free(corners);
    const int primitives = some(b), mesh = gn_bomb_begin(b, GN_BOMB_MESHES);
    struct gn_bomb_text *text = &b->arrays[GN_BOMB_MESHES];
    for (int i = 0; i < primitives; i++) {
        gn_bomb_put(text, "%s{'mode':%d,'attributes':{'POSITION':%d", i ? "," : "{'primitives':[",
                    gn_bomb_below(b, 4) ? 4 : 5 + (int)gn_bomb_below(b, 2), position);
        if (normal >= 0) gn_bomb_put(text, ",'NORMAL':%d", normal);
        gn_bomb_put(text, "}");
        if (gn_bomb_below(b, 4) == 0)
            gn_bomb_put(text, ",'indices':%d",
                        gn_bomb_accessor(b, index_view, "SCALAR", 5123, count));
        gn_bomb_put(text, "}");
    }
    gn_bomb_put(text, "]}");
    for (int n = (int)gn_bomb_magnitude(b, 20); n > 0; n--) add_node(b, mesh);
}

/* Accessors that begin at each element of one view, each for a mesh of its own. */
static void add_overlapping(struct gn_bomb *b) {
    const int meshes = some(b);
    const size_t count = 3 * (size_t)meshes;
    float *xyz = gn_xalloc(3 * count, sizeof *xyz);
    for (size_t i = 0; i < 3 * count; i++) xyz[i] = (float)gn_dice_between(&b->dice, -1, 1);
    const int view = gn_bomb_view(b, xyz, 3 * count * sizeof *xyz, 0);
    free(xyz);
    for (int i = 0; i < meshes; i++) {
        const int a = gn_bomb_begin(b, GN_BOMB_ACCESSORS);
        gn_bomb_put(
            &b->arrays[GN_BOMB_ACCESSORS],
            "{'bufferView':%d,'byteOffset':%d,'componentType':5126,'count':%zu,'type':'VEC3'}",
            view, 12 * i, count - (size_t)i);
        const int mesh = gn_bomb_begin(b, GN_BOMB_MESHES);
        gn_bomb_put(&b->arrays[GN_BOMB_MESHES], "{'primitives':[{'attributes':{'POSITION':%d}}]}",
                    a);
        add_node(b, mesh);
    }
}

static void add_sparse(struct gn_bomb *b) {
    const size_t set = gn_bomb_magnitude(b, b->most);
    uint32_t *index = gn_xalloc(set, sizeof *index);
    float *values = gn_xalloc(set, 3 * sizeof *values);
    for (size_t i = 0; i < set; i++) index[i] = (uint32_t)i;
    const int where = gn_bomb_view(b, index, set * sizeof *index, 0);
    const int what = gn_bomb_view(b, values, set * 3 * sizeof *values, 0);
    free(index);
    free(values);
    for (int n = (int)gn_bomb_magnitude(b, b->most / 4.0 + 1); n > 0; n--) {
        const int a = gn_bomb_begin(b, GN_BOMB_ACCESSORS);
        gn_bomb_put(
            &b->arrays[GN_BOMB_ACCESSORS],
            "{'componentType':5126,'type':'VEC3','count':%" PRIu64
            ",'sparse':{'count':%zu,'indices':{'bufferView':%d,'componentType':5125},'values':{"
            "'bufferView':%d}}}",
            set + gn_bomb_magnitude(b, 1e7), set, where, what);
        const int mesh = gn_bomb_begin(b, GN_BOMB_MESHES);
        gn_bomb_put(&b->arrays[GN_BOMB_MESHES], "{'primitives':[{'attributes':{'POSITION':%d}}]}",
                    a);
        add_node(b, mesh);
    }
}

static void add_instances(struct gn_bomb *b) {
    const int mesh = (int)gn_bomb_below(b, (uint64_t)b->arrays[GN_BOMB_MESHES].count);
    for (int n = (int)gn_bomb_magnitude(b, b->most / 10.0 + 1); n > 0; n--) {
        const int where = gn_bomb_accessor(b, -1, "VEC3", 5126,
                                           gn_bomb_magnitude(b, gn_bomb_below(b, 4) ? 1e6 : 1e12));
        gn_bomb_begin(b, GN_BOMB_NODES);
        gn_bomb_put(
            &b->arrays[GN_BOMB_NODES],
            "{'mesh':%d,'scale':[%g,1,1],'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{"
            "'TRANSLATION':%d}}}}",
            mesh, exp2(gn_dice_between(&b->dice, -60, 60)), where);
    }
}

/* A chain, a star, or a tree in which nodes are named again and again. */
static void add_nodes(struct gn_bomb *b) {
    const int count = some(b), first = b->arrays[GN_BOMB_NODES].count;
    const uint64_t shape = gn_bomb_below(b, 4);
    struct gn_bomb_text *text = &b->arrays[GN_BOMB_NODES];
    for (int i = 0; i < count; i++) {
        gn_bomb_begin(b, GN_BOMB_NODES);
        gn_bomb_put(text, "{'mesh':%d,'translation':[1e-3,%d,0]",
                    i % 3 ? 0 : (int)gn_bomb_below(b, (uint64_t)b->arrays[GN_BOMB_MESHES].count),
                    (int)gn_bomb_below(b, 3));
        if (shape == 0 && i + 1 < count) gn_bomb_put(text, ",'children':[%d]", first + i + 1);
        if (shape == 1 && i == 0 && count > 1) {
            gn_bomb_put(text, ",'children':[");
            for (int k = 1; k < count; k++) gn_bomb_put(text, k > 1 ? ",%d" : "%d", first + k);
            gn_bomb_put(text, "]");
        }
        if (shape == 2 && i + 2 < count)
            gn_bomb_put(text, ",'children':[%d,%d]", first + i + 1, first + i + 2);
        gn_bomb_put(text, "}");
    }
    if (gn_bomb_below(b, 3) == 0) { /* scenes that list them all */
        for (int n = 1 + (int)gn_bomb_below(b, 3); n > 0; n--) {
            gn_bomb_begin(b, GN_BOMB_SCENES);
            gn_bomb_put(&b->arrays[GN_BOMB_SCENES], "{'nodes':[0");
            for (int k = 0; k < count; k++)
                gn_bomb_put(&b->arrays[GN_BOMB_SCENES], ",%d",
                            first + (gn_bomb_below(b, 9) ? k : 0));
            gn_bomb_put(&b->arrays[GN_BOMB_SCENES], "]}");
        }
    }
}

static void add_lights(struct gn_bomb *b) {
    static const char *const types[] = {"directional", "point", "spot"};
    for (int n = gn_bomb_below(b, 2) ? 16 : some(b); n > 0; n--) {
        const int light = gn_bomb_begin(b, GN_BOMB_LIGHTS);
        struct gn_bomb_text *text = &b->arrays[GN_BOMB_LIGHTS];
        gn_bomb_put(text, "{'type':'%s','intensity':%g", types[gn_bomb_below(b, 3)],
                    exp2(gn_dice_between(&b->dice, -9, 100)));
        gn_bomb_put(
            text, ",'extras':{'gnomon_map_px':%" PRIu64 ",'gnomon_shadow':'%s','gnomon_radius':%g",
            gn_bomb_magnitude(b, 70000), gn_techniques[gn_bomb_below(b, GN_TECHNIQUE_COUNT)].name,
            exp2(gn_dice_between(&b->dice, -20, 120)));
        if (b->arrays[GN_BOMB_TEXTURES].count > 0)
            gn_bomb_put(text, ",'gnomon_slide':%d",
                        (int)gn_bomb_below(b, (uint64_t)b->arrays[GN_BOMB_TEXTURES].count));
        gn_bomb_put(text, "}}");
        gn_bomb_begin(b, GN_BOMB_NODES);
        gn_bomb_put(
            &b->arrays[GN_BOMB_NODES],
            "{'translation':[%d,3,0],'rotation':[-0.7,0,0,0.7],'extensions':{'KHR_lights_punctual':"
            "{'light':%d}}}",
            (int)gn_bomb_below(b, 5), light);
    }
}

/* A material with a picture, and a node that shows it. */
static void add_picture(struct gn_bomb *b, int view) {
    const int image = gn_bomb_begin(b, GN_BOMB_IMAGES);
    gn_bomb_put(&b->arrays[GN_BOMB_IMAGES], "{'bufferView':%d,'mimeType':'image/png'}", view);
    const int texture = gn_bomb_begin(b, GN_BOMB_TEXTURES);
    gn_bomb_put(&b->arrays[GN_BOMB_TEXTURES], "{'source':%d}", image);
    const int material = gn_bomb_begin(b, GN_BOMB_MATERIALS);
    gn_bomb_put(&b->arrays[GN_BOMB_MATERIALS], "{'%s':{'index':%d}}",
                gn_bomb_below(b, 2) ? "emissiveTexture" : "occlusionTexture", texture);
    const int mesh = gn_bomb_begin(b, GN_BOMB_MESHES);
    gn_bomb_put(&b->arrays[GN_BOMB_MESHES],
                "{'primitives':[{'attributes':{'POSITION':0},'indices':1,'material':%d}]}",
                material);
    add_node(b, mesh);
}

/* Many texels in a few bytes, in each format: sides of up to what it can have, or short ones. */
static void add_large_pictures(struct gn_bomb *b) {
    struct gn_made made;
    const int many = 1 + (int)gn_bomb_below(b, 20), format = (int)gn_bomb_below(b, 4);
    const int most[] = {16384, 65500, 16383, 8192};
    int px[2];
    for (int k = 0; k < 2; k++)
        px[k] = gn_bomb_below(b, 3) ? most[format] >> gn_bomb_below(b, 3)
                                    : (int)gn_bomb_magnitude(b, most[format]);
    const int depths[] = {1, 8, 16, 32};
    const bool flag = gn_bomb_below(b, 2);
    const int depth = px[0] > 8192 || px[1] > 8192 ? 0 : (int)gn_bomb_below(b, 4);
    const struct gn_bomb_png png = {.width_px = (uint32_t)px[0],
                                    .height_px = (uint32_t)px[1],
                                    .depth = depths[depth],
                                    .interlaced = flag};
    switch (format) {
    case 0: made = gn_bomb_png_make(&png); break;
    case 1: made = gn_bomb_jpeg_arithmetic(px[0], px[1], depth > 1 ? 3 : 1, flag); break;
    case 2: made = gn_bomb_webp(px[0], px[1]); break;
    default: made = gn_bomb_ktx2(px[0], px[1], depth + 1);
    }
    for (int i = 0; i < many; i++) /* each has a place of its own: else it is decoded once */
        add_picture(b, gn_bomb_view(b, made.data, made.size, 0));
    free(made.data);
}

/* Pictures of one view or of many parts of one, and textures and materials that use them. */
static void add_images(struct gn_bomb *b) {
    struct gn_made made;
    const double side = b->most > 3000 ? 8192 : 2048;
    const bool jpeg = gn_bomb_below(b, 3) == 0;
    const int w = (int)gn_bomb_magnitude(b, side), h = (int)gn_bomb_magnitude(b, side);
    if (jpeg && gn_bomb_below(b, 2))
        made = gn_bomb_jpeg_scans((w + 7) / 8 * 8, (int)gn_bomb_magnitude(b, 80));
    else if (jpeg)
        made = gn_bomb_jpeg_progressive(w, h, (int)gn_bomb_below(b, 2) ? TJSAMP_444 : TJSAMP_420);
    else {
        const bool narrow = gn_bomb_below(b, 4) == 0;
        const int depths[] = {1, 8, 16, 32};
        const struct gn_bomb_png png = {
            .width_px = narrow ? 1 : (uint32_t)w,
            .height_px = narrow ? 1 + (uint32_t)gn_bomb_below(b, 999999) : (uint32_t)h,
            .depth = depths[w > 2048 ? 0 : gn_bomb_below(b, 4)],
            .interlaced = gn_bomb_below(b, 2),
            .text_size = gn_bomb_below(b, 3) ? 0 : gn_bomb_magnitude(b, 3e7)};
        made = gn_bomb_png_make(&png);
    }
    if (gn_bomb_below(b, 4) == 0)
        made.size = gn_bomb_magnitude(b, (double)made.size); /* truncated */
    if (gn_bomb_below(b, 6) == 0 && made.size > 60)
        memset(made.data + 33 + gn_bomb_below(b, made.size - 40), 0x7f, 4); /* a length, perhaps */
    const int count = (int)gn_bomb_magnitude(b, b->most / 4.0 + 1),
              view = gn_bomb_view(b, made.data, made.size, 0);
    const bool parts = gn_bomb_below(b, 2);
    for (int i = 0; i < count; i++) {
        int of = view;
        if (parts) { /* the same start and another end */
            of = gn_bomb_begin(b, GN_BOMB_VIEWS);
            gn_bomb_put(&b->arrays[GN_BOMB_VIEWS], "{'buffer':0,'byteOffset':%zu,'byteLength':%zu}",
                        b->bin_size - (made.size + 3) / 4 * 4,
                        made.size > (size_t)i ? made.size - (size_t)i : made.size);
        }
        add_picture(b, of);
    }
    free(made.data);
}

/* Channels that play the same keys, many clips, keys without data. */
static void add_animations(struct gn_bomb *b) {
    const size_t keys = gn_bomb_magnitude(b, b->most);
    float *times = gn_xalloc(keys, sizeof *times);
    for (size_t i = 0; i < keys; i++) times[i] = (float)i * 1e-3f;
    const bool empty = gn_bomb_below(b, 2);
    const uint64_t claimed = empty ? gn_bomb_magnitude(b, 1e8) : keys;
    const int input = gn_bomb_accessor(
        b, empty ? -1 : gn_bomb_view(b, times, keys * sizeof *times, 0), "SCALAR", 5126, claimed);
    const int output = gn_bomb_accessor(b, -1, "VEC3", 5126, claimed);
    free(times);
    for (int n = (int)gn_bomb_magnitude(b, b->most / 8.0 + 1); n > 0; n--) {
        gn_bomb_begin(b, GN_BOMB_ANIMATIONS);
        struct gn_bomb_text *text = &b->arrays[GN_BOMB_ANIMATIONS];
        gn_bomb_put(text, "{'samplers':[{'input':%d,'output':%d}],'channels':[", input, output);
        const int channels = (int)gn_bomb_magnitude(b, b->most / 8.0 + 1);
        for (int k = 0; k < channels && ftell(text->file) < (long)b->most * 100; k++)
            gn_bomb_put(text, "%s{'sampler':0,'target':{'node':%d,'path':'%s'}}", k ? "," : "",
                        (int)gn_bomb_below(b, (uint64_t)b->arrays[GN_BOMB_NODES].count),
                        gn_bomb_below(b, 2) ? "scale" : "translation");
        gn_bomb_put(text, "]}");
    }
}

/* Names, extras and JSON that nobody reads: long, deep, many, with escapes. */
static void add_words(struct gn_bomb *b) {
    static const char *const parts[] = {"a",      "\\u0000", "\\ud800", "\\u202e",
                                        "1e999,", "[",       "{'x':"};
    const uint64_t what = gn_bomb_below(b, 8);
    const int count = 10 * some(b);
    struct gn_bomb_text *text = &b->arrays[GN_BOMB_NODES];
    gn_bomb_begin(b, GN_BOMB_NODES);
    if (what < 4) {
        gn_bomb_put(text, "{'name':'");
        for (int i = 0; i < count; i++) gn_bomb_put(text, "%s", parts[what]);
        gn_bomb_put(text, "','mesh':0}");
    } else if (what < 6) { /* deep, or many numbers that no double holds */
        gn_bomb_put(text, "{'mesh':0,'extras':{'x':[");
        for (int i = 0; i < count; i++) gn_bomb_put(text, "%s", parts[what]);
        for (int i = 0; i < count && what == 5; i++) gn_bomb_put(text, "]");
        gn_bomb_put(text, what == 4 ? "0]}}" : "]}}");
    } else {
        gn_bomb_put(text, "{'mesh':0,'extras':{");
        for (int i = 0; i < count; i++)
            gn_bomb_put(text, "'%s%x':%s,", gn_bomb_below(b, 9) ? "k" : "gnomon_",
                        (unsigned)gn_bomb_below(b, 1 << 30), what == 6 ? "-1e300" : "{}");
        gn_bomb_put(text, "'gnomon_cast':3}}");
    }
}

/* Members of the root that are read before anything else. */
static void add_root(struct gn_bomb *b) {
    const int count = some(b);
    gn_bomb_put(&b->more, ",'extensionsUsed':[");
    for (int i = 0; i < count; i++) gn_bomb_put(&b->more, "'EXT_%d',", (int)gn_bomb_below(b, 99));
    gn_bomb_put(&b->more, "'KHR_lights_punctual']");
}

/* Buffers and views that claim more than there is, and the same data URI again and again. */
static void add_buffers(struct gn_bomb *b) {
    for (int n = some(b); n > 0; n--) {
        const int buffer = gn_bomb_begin(b, GN_BOMB_BUFFERS);
        const uint64_t size = gn_bomb_magnitude(b, gn_bomb_below(b, 30) ? 30 : 1e18);
        gn_bomb_put(&b->arrays[GN_BOMB_BUFFERS], "{'byteLength':%" PRIu64, size);
        if (gn_bomb_below(b, 4))
            gn_bomb_put(
                &b->arrays[GN_BOMB_BUFFERS], ",'uri':'data:application/octet-stream;base64,%.*s'",
                40,
                "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA");
        gn_bomb_put(&b->arrays[GN_BOMB_BUFFERS], "}");
        gn_bomb_begin(b, GN_BOMB_VIEWS);
        gn_bomb_put(&b->arrays[GN_BOMB_VIEWS], "{'buffer':%d,'byteLength':%" PRIu64 "}", buffer,
                    gn_bomb_below(b, 2) ? 1 : size);
    }
}

/* Cameras and materials with numbers at the ends of a float. */
static void add_cameras(struct gn_bomb *b) {
    for (int n = some(b); n > 0; n--) {
        const int camera = gn_bomb_begin(b, GN_BOMB_CAMERAS);
        gn_bomb_put(&b->arrays[GN_BOMB_CAMERAS],
                    "{'type':'perspective','perspective':{'yfov':%g,'znear':%g,'zfar':%g}}",
                    exp2(gn_dice_between(&b->dice, -30, 1)),
                    exp2(gn_dice_between(&b->dice, -120, 0)),
                    exp2(gn_dice_between(&b->dice, 1, 120)));
        gn_bomb_begin(b, GN_BOMB_NODES);
        gn_bomb_put(&b->arrays[GN_BOMB_NODES], "{'camera':%d,'translation':[0,%d,9]}", camera,
                    (int)gn_bomb_below(b, 9));
        gn_bomb_begin(b, GN_BOMB_MATERIALS);
        gn_bomb_put(&b->arrays[GN_BOMB_MATERIALS],
                    "{'emissiveFactor':[1,1,1],'alphaMode':'BLEND','pbrMetallicRoughness':{"
                    "'baseColorFactor':[%g,1,1,0.5]}}",
                    gn_dice_between(&b->dice, 0, 1));
    }
}

static const struct kind {
    const char *name;
    void (*add)(struct gn_bomb *);
} KINDS[] = {
    {"empty accessors", add_empty_accessors},
    {"shared vertices", add_shared_vertices},
    {"overlapping accessors", add_overlapping},
    {"sparse accessors", add_sparse},
    {"instances", add_instances},
    {"nodes", add_nodes},
    {"images", add_images},
    {"large pictures", add_large_pictures},
    {"lights", add_lights},
    {"animations", add_animations},
    {"words", add_words},
    {"root", add_root},
    {"buffers", add_buffers},
    {"cameras", add_cameras},
};
enum { KIND_COUNT = sizeof KINDS / sizeof KINDS[0] };

struct gn_made gn_bomb_make(uint64_t number, char *kinds, size_t size) {
    struct gn_bomb b = {.dice = {UINT64_C(0x626f6d6273) + number * UINT64_C(1000003)}};
    gn_bomb_open(&b);
    b.most = (int)gn_bomb_magnitude(&b, 20000);
    add_base(&b);
    int at = snprintf(kinds, size, "up to %d:", b.most);
    for (uint64_t n = 1 + gn_bomb_below(&b, 3); n > 0; n--) {
        const struct kind *kind = &KINDS[gn_bomb_below(&b, KIND_COUNT)];
        kind->add(&b);
        if (at < (int)size) at += snprintf(kinds + at, size - (size_t)at, " %s", kind->name);
    }
    return gn_bomb_close(&b);
}
