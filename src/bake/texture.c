/* Pictures: those over the limit are made smaller, all become parts of the .glb. */
#include <stdlib.h>
#include <string.h>

#include "bake/private.h"
#include "core/encoding.h"
#include "image/format.h"
#include "image/write.h"

/* ---- what a picture shows ---- */

/* By the member of a material that names its texture. */
static enum gn_scale_kind kind_of(const char *key) {
    static const struct {
        const char *end; /* of the name */
        enum gn_scale_kind kind;
    } kinds[] = {{"ormalTexture", GN_SCALE_NORMALS},
                 {"ColorTexture", GN_SCALE_COLOR},
                 {"emissiveTexture", GN_SCALE_COLOR},
                 {"diffuseTexture", GN_SCALE_COLOR},
                 {"specularGlossinessTexture", GN_SCALE_COLOR}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const size_t length = strlen(key), end = strlen(kinds[i].end);
        if (length >= end && strcmp(key + length - end, kinds[i].end) == 0) return kinds[i].kind;
    }
    return GN_SCALE_DATA;
}

static void mark_image(const struct gn_baker *b, int64_t texture, int kind, uint8_t *kinds,
                       size_t image_count) {
    static const char *const sources[] = {"EXT_texture_webp", "KHR_texture_basisu",
                                          "EXT_texture_avif"};
    const json_t *list = json_object_get(b->root, "textures");
    const json_t *json = texture < 0 ? NULL : json_array_get(list, (size_t)texture);
    for (int i = -1; i < 3; i++) {
        const json_t *from = i < 0 ? json : gn_bake_extension(json, sources[i]);
        const int64_t image = gn_bake_number(from, "source");
        if (image >= 0 && (uint64_t)image < image_count) kinds[image] |= (uint8_t)(1 << kind);
    }
}

static void mark_textures(const struct gn_baker *b, const json_t *json, uint8_t *kinds,
                          size_t count) {
    json_t *value;
    const char *key;
    json_object_foreach((json_t *)(uintptr_t)json, key, value) {
        if (!json_is_object(value) || strcmp(key, "extras") == 0) continue;
        const size_t length = strlen(key), suffix = strlen("Texture");
        if (length >= suffix && strcmp(key + length - suffix, "Texture") == 0)
            mark_image(b, gn_bake_number(value, "index"), (int)kind_of(key), kinds, count);
        mark_textures(b, value, kinds, count);
    }
}

/* ---- bytes ---- */

/* The bytes of an image; *owned: to be freed. */
static bool read_image(struct gn_baker *b, const json_t *image, struct gn_bytes *out, bool *owned,
                       struct gn_err *why) {
    const char *uri = json_string_value(json_object_get(image, "uri"));
    const int64_t view = gn_bake_number(image, "bufferView");
    *owned = uri;
    if (uri) return gn_document_fetch(b->in, uri, out, why);
    const uint8_t *data = NULL;
    size_t size = 0, stride;
    if (view >= 0) gn_document_view(b->in, (size_t)view, &data, &size, &stride);
    *out = (struct gn_bytes){(uint8_t *)(uintptr_t)data, size};
    return size > 0 || gn_fail(why, "has no data");
}

static bool encode(enum gn_format format, const struct gn_bytes *from, const uint8_t *rgba,
                   const uint32_t px[2], struct gn_bytes *out, struct gn_err *why) {
    const int width = (int)px[0], height = (int)px[1];
    switch (format) {
    case GN_FORMAT_PNG: return gn_picture_encode_png_rgba(rgba, width, height, out, why);
    case GN_FORMAT_JPEG: return gn_picture_encode_jpeg(rgba, width, height, out, why);
    default:
        return gn_picture_encode_webp(rgba, width, height,
                                      gn_webp_is_lossless(from->data, from->size), out, why);
    }
}

static uint32_t scaled_px(uint32_t px, uint32_t larger, uint32_t limit) {
    const uint64_t scaled = ((uint64_t)px * limit + larger / 2) / larger;
    return scaled > 0 ? (uint32_t)scaled : 1;
}

/* Into out; false where it stays as it is, with the reason in why, or none if it is small. */
static bool scale(struct gn_baker *b, enum gn_format format, const struct gn_bytes *from, int kind,
                  struct gn_bytes *out, struct gn_err *why) {
    const struct gn_scene_limits limits = gn_scene_limits_or_default(b->opts->limits);
    const uint32_t limit = (uint32_t)b->opts->texture_limit_px;
    struct gn_picture_file file = {.kind = format, .data = from->data, .size = from->size};
    uint32_t to[2], shrink = 0;
    if (format >= GN_FORMAT_KTX2 || (format == GN_FORMAT_WEBP && !gn_webp_is_read()) ||
        !gn_picture_size(&file, why))
        return false;
    const uint32_t larger = file.px[0] > file.px[1] ? file.px[0] : file.px[1];
    if (larger <= limit) return false;
    if ((uint64_t)file.px[0] * file.px[1] > limits.texels)
        return gn_fail(why, "%ux%u is over the limit texels=%llu", file.px[0], file.px[1],
                       (unsigned long long)limits.texels);
    for (int k = 0; k < 2; k++) to[k] = scaled_px(file.px[k], larger, limit);
    const uint64_t kept = UINT64_C(4) * to[0] * to[1];
    while (!gn_bake_has_room(b, kept + gn_picture_work_bytes(&file, to, shrink)))
        if (shrink == gn_picture_most_shrink(&file) || gn_shrunk_px(larger, shrink + 1) < limit ||
            ++shrink > GN_SHRINK_MOST)
            return gn_fail(why, "exceeds the limit memory_mb");
    uint8_t *small = gn_bake_alloc(b, kept, 1);
    return small && gn_picture_decode(&file, shrink, (enum gn_scale_kind)kind, small, to, why) &&
           encode(format, from, small, to, out, why);
}

/* ---- images ---- */

struct put_image { /* one that is in the output */
    struct gn_bytes from;
    int kind;
    size_t view;
};

/* The view of an equal picture that was put before, or -1. */
static int64_t find_equal(const struct put_image *put, size_t count, const struct gn_bytes *from,
                          int kind) {
    for (size_t i = 0; i < count; i++)
        if (put[i].kind == kind && put[i].from.size == from->size && from->size > 0 &&
            memcmp(put[i].from.data, from->data, from->size) == 0)
            return (int64_t)put[i].view;
    return -1;
}

static bool put_image(struct gn_baker *b, json_t *image, size_t index, int kind,
                      struct put_image *put, size_t put_count, struct gn_bytes *from) {
    struct gn_err why = {0};
    struct gn_bytes scaled = {0};
    const enum gn_format format = gn_format_of(from->data, from->size);
    int64_t view = find_equal(put, put_count, from, kind);
    if (view < 0) {
        const bool smaller = scale(b, format, from, kind, &scaled, &why);
        if (!smaller && why.text[0])
            gn_warn(b->warnings, "%s: images[%zu]: %s; kept as it is", b->opts->path, index,
                    why.text);
        const struct gn_bytes *bytes = smaller ? &scaled : from;
        const struct gn_block block = {GN_BLOCK_BYTES, bytes->data, bytes->size, 1};
        view = (int64_t)gn_bake_view(b, &block);
        b->report->scaled_images += smaller;
        b->report->image_bytes_after += bytes->size;
        gn_bytes_finish(&scaled);
        gn_arena_reset(&b->step);
    }
    json_object_del(image, "uri");
    json_object_set_new(image, "bufferView", json_integer((json_int_t)view));
    if (format != GN_FORMAT_OTHER)
        json_object_set_new(image, "mimeType", json_string(gn_format_mime(format)));
    return !b->failed;
}

/* Colour where any material says so, and directions only where all do. */
static int choose_kind(unsigned kinds) {
    if (kinds & 1u << GN_SCALE_COLOR || kinds == 0) return GN_SCALE_COLOR;
    return kinds & 1u << GN_SCALE_DATA ? GN_SCALE_DATA : GN_SCALE_NORMALS;
}

static bool put_images(struct gn_baker *b, json_t *images, const uint8_t *kinds,
                       struct put_image *put, bool *owned) {
    json_t *image;
    size_t i;
    json_array_foreach(images, i, image) {
        struct gn_err why = {0};
        struct gn_bytes *from = &put[i].from;
        if (!read_image(b, image, from, &owned[i], &why) ||
            (gn_format_of(from->data, from->size) == GN_FORMAT_OTHER &&
             !json_object_get(image, "mimeType"))) {
            gn_warn(b->warnings, "%s: images[%zu]: %s; kept as it is", b->opts->path, i,
                    why.text[0] ? why.text : GN_FORMAT_OTHER_TEXT);
            json_object_del(image, "bufferView");
            continue;
        }
        const char *uri = json_string_value(json_object_get(image, "uri"));
        b->report->image_bytes_before += from->size;
        b->report->other_bytes += uri && !gn_data_uri_is(uri) ? from->size : 0;
        put[i].kind = choose_kind(kinds[i]);
        if (!put_image(b, image, i, put[i].kind, put, i, from)) return false;
        put[i].view = (size_t)gn_bake_number(image, "bufferView");
    }
    return true;
}

bool gn_bake_images(struct gn_baker *b) {
    json_t *images = json_object_get(b->root, "images"), *material;
    const size_t count = json_array_size(images);
    b->report->images = count;
    uint8_t *kinds = gn_arena_alloc(&b->whole, count, sizeof *kinds);
    struct put_image *put = gn_arena_alloc(&b->whole, count, sizeof *put);
    bool *owned = gn_arena_alloc(&b->whole, count, sizeof *owned);
    if (!kinds || !put || !owned) return gn_bake_fail(b, "out of memory");
    size_t i;
    json_array_foreach(json_object_get(b->root, "materials"), i, material)
        mark_textures(b, material, kinds, count);
    const bool done = put_images(b, images, kinds, put, owned);
    for (i = 0; i < count; i++)
        if (owned[i]) gn_bytes_finish(&put[i].from);
    return done;
}
