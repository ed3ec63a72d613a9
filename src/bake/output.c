/* The .glb under construction. */
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bake/private.h"
#include "bake/reorder.h"

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "glTF buffers are little endian");
#define MESHOPT "EXT_meshopt_compression"

bool gn_bake_fail(struct gn_baker *b, const char *format, ...) {
    if (b->failed) return false;
    b->failed = true;
    char text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return gn_fail(b->err, "%s: %s", b->opts->path, text);
}

static bool fail_memory(struct gn_baker *b) {
    return gn_bake_fail(b, "out of memory, or over the limit memory_mb=%" PRIu64,
                        gn_scene_limits_or_default(b->opts->limits).memory_mb);
}

bool gn_bake_has_room(const struct gn_baker *b, uint64_t bytes) {
    return b->whole.used + b->step.used + b->room + bytes <= gn_document_room(b->in);
}

void *gn_bake_alloc(struct gn_baker *b, size_t count, size_t size) {
    uint64_t bytes;
    void *memory = NULL;
    if (!b->failed && !__builtin_mul_overflow(count, size, &bytes) && gn_bake_has_room(b, bytes))
        memory = gn_arena_alloc(&b->step, count, size);
    if (!memory) fail_memory(b);
    return memory;
}

/* ---- the binary chunk ---- */

static bool reserve_bytes(struct gn_baker *b, size_t size) {
    if (b->failed) return false;
    if (size > UINT32_MAX || b->size + size > UINT32_MAX)
        return gn_bake_fail(b, "too large for a .glb (4 GB)");
    if (b->size + size <= b->room) return true;
    const size_t least = b->size + size, room = gn_bake_has_room(b, 2 * least) ? 2 * least : least;
    uint8_t *more = gn_bake_has_room(b, room) ? realloc(b->bin, room) : NULL;
    if (!more) return fail_memory(b);
    b->bin = more;
    b->room = room;
    return true;
}

static void pad_chunk(struct gn_baker *b) {
    while (b->size % 4 != 0 && reserve_bytes(b, 1)) b->bin[b->size++] = 0;
}

/* Triangles are written with so many bytes a corner. */
static void put_triangles(uint8_t *out, const uint32_t *corners, size_t count, size_t stride) {
    if (stride == sizeof *corners) memcpy(out, corners, count * stride);
    for (size_t i = 0; stride == 2 && i < count; i++)
        memcpy(out + 2 * i, &(uint16_t){(uint16_t)corners[i]}, 2);
}

/* Appends it, compressed if that takes less than its plain size; the size that it takes. */
static size_t put_block(struct gn_baker *b, const struct gn_block *block, size_t plain) {
    size_t packed = 0;
    uint8_t *at = b->bin + b->size;
    if (block->kind == GN_BLOCK_TRIANGLES)
        packed = gn_reorder->compress_triangles(at, plain, block->data, block->count);
    else if (block->kind != GN_BLOCK_BYTES && block->stride % 4 == 0 &&
             block->stride <= GN_STREAM_STRIDE_MAX)
        packed = gn_reorder->compress_vertices(at, plain, block->data, block->count, block->stride);
    if (packed > 0 && packed < plain) return packed;
    if (block->kind == GN_BLOCK_TRIANGLES)
        put_triangles(at, block->data, block->count, block->stride);
    else if (plain > 0)
        memcpy(at, block->data, plain);
    return plain;
}

size_t gn_bake_view(struct gn_baker *b, const struct gn_block *block) {
    enum { VERTICES = 34962, TRIANGLES = 34963 };
    const size_t plain = block->count * block->stride;
    pad_chunk(b);
    if (!reserve_bytes(b, plain)) return 0;
    const size_t start = b->size, size = put_block(b, block, plain);
    const bool is_packed = size < plain;
    b->size += size;
    json_t *view = json_pack("{s:i,s:I,s:I}", "buffer", (int)is_packed, "byteOffset",
                             (json_int_t)(is_packed ? b->plain_bytes : start), "byteLength",
                             (json_int_t)plain);
    if (block->kind == GN_BLOCK_VERTICES)
        json_object_set_new(view, "byteStride", json_integer((json_int_t)block->stride));
    if (block->kind == GN_BLOCK_VERTICES || block->kind == GN_BLOCK_TRIANGLES)
        json_object_set_new(view, "target",
                            json_integer(block->kind == GN_BLOCK_VERTICES ? VERTICES : TRIANGLES));
    if (is_packed) {
        json_object_set_new(
            view, "extensions",
            json_pack("{s:{s:i,s:I,s:I,s:I,s:I,s:s}}", MESHOPT, "buffer", 0, "byteOffset",
                      (json_int_t)start, "byteLength", (json_int_t)size, "byteStride",
                      (json_int_t)block->stride, "count", (json_int_t)block->count, "mode",
                      block->kind == GN_BLOCK_TRIANGLES ? "TRIANGLES" : "ATTRIBUTES"));
        b->plain_bytes += (plain + 3) / 4 * 4;
    }
    return gn_bake_add(b, "bufferViews", view);
}

/* ---- JSON ---- */

size_t gn_bake_add(struct gn_baker *b, const char *array, json_t *item) {
    json_t *list = json_object_get(b->root, array);
    if (!list) {
        list = json_array();
        json_object_set_new(b->root, array, list);
    }
    if (!item || json_array_append_new(list, item) != 0) gn_bake_fail(b, "out of memory");
    const size_t count = json_array_size(list);
    return count > 0 ? count - 1 : 0;
}

int64_t gn_bake_number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    const double number = json_is_number(value) ? json_number_value(value) : -1;
    return number >= 0 && number < 1e15 ? (int64_t)number : -1;
}

json_t *gn_bake_extension(const json_t *object, const char *name) {
    return json_object_get(json_object_get(object, "extensions"), name);
}

static size_t find_text(const json_t *list, const char *text) {
    size_t i = 0;
    for (; i < json_array_size(list); i++) {
        const char *name = json_string_value(json_array_get(list, i));
        if (name && strcmp(name, text) == 0) break;
    }
    return i;
}

static const char *const lists[] = {"extensionsUsed", "extensionsRequired"};

void gn_bake_forget_extension(struct gn_baker *b, const char *name) {
    for (int k = 0; k < 2; k++) {
        json_t *list = json_object_get(b->root, lists[k]);
        while (find_text(list, name) < json_array_size(list))
            json_array_remove(list, find_text(list, name));
        if (list && json_array_size(list) == 0) json_object_del(b->root, lists[k]);
    }
}

void gn_bake_require_extension(struct gn_baker *b, const char *name) {
    for (int k = 0; k < 2; k++) {
        const json_t *list = json_object_get(b->root, lists[k]);
        if (find_text(list, name) >= json_array_size(list))
            gn_bake_add(b, lists[k], json_string(name));
    }
}

json_t *gn_bake_accessor_json(const struct gn_baker *b, size_t accessor) {
    static const char *const places[] = {"bufferView", "byteOffset", "sparse", "min", "max"};
    json_t *copy = json_deep_copy(json_array_get(b->accessors, accessor));
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) json_object_del(copy, places[i]);
    return copy;
}

/* ---- the file ---- */

static void put_u32(uint8_t *out, size_t value) { memcpy(out, &(uint32_t){(uint32_t)value}, 4); }

static bool write_glb(struct gn_baker *b, const char *text, struct gn_bytes *out) {
    enum { HEADER = 12, CHUNK = 8, JSON = 0x4e4f534a, BIN = 0x004e4942, MAGIC = 0x46546c67 };
    const size_t length = strlen(text), json = (length + 3) / 4 * 4;
    const size_t bin = b->size > 0 ? CHUNK + b->size : 0, total = HEADER + CHUNK + json + bin;
    if (total > UINT32_MAX) return gn_bake_fail(b, "too large for a .glb (4 GB)");
    uint8_t *at = out->data = gn_bake_has_room(b, total) ? malloc(total) : NULL;
    if (!at) return fail_memory(b);
    out->size = total;
    const size_t head[] = {MAGIC, 2, total, json, JSON};
    for (int i = 0; i < 5; i++, at += 4) put_u32(at, head[i]);
    memset(at, ' ', json);
    for (size_t i = 0; i < length; i++) at[i] = (uint8_t)text[i]; /* without the zero at its end */
    at += json;
    if (bin == 0) return true;
    put_u32(at, b->size);
    put_u32(at + 4, BIN);
    memcpy(at + CHUNK, b->bin, b->size);
    return true;
}

/* Whether numbers of 9 digits say all that these do. What is read as floats loses nothing by them;
 * extras are whoever's, and places far off are read in double precision. */
static bool fits_9_digits(const json_t *json, bool is_extra) {
    const json_t *value;
    const char *key;
    size_t i;
    if (json_is_object(json)) json_object_foreach((json_t *)(uintptr_t)json, key, value) {
            if (!fits_9_digits(value, is_extra || strcmp(key, "extras") == 0)) return false;
        }
    json_array_foreach(json, i, value) if (!fits_9_digits(value, is_extra)) return false;
    if (!json_is_real(json)) return true;
    char text[32];
    const double number = json_real_value(json);
    snprintf(text, sizeof text, "%.9g", number);
    const double again = strtod(text, NULL);
    return again == number || (!is_extra && fabs(number) < 1000 && (float)again == (float)number);
}

bool gn_bake_write(struct gn_baker *b, struct gn_bytes *out) {
    pad_chunk(b);
    if (b->size > 0)
        gn_bake_add(b, "buffers", json_pack("{s:I}", "byteLength", (json_int_t)b->size));
    if (b->plain_bytes > 0) { /* stands for what the views are when they are decompressed */
        gn_bake_add(b, "buffers",
                    json_pack("{s:I,s:{s:{s:b}}}", "byteLength", (json_int_t)b->plain_bytes,
                              "extensions", MESHOPT, "fallback", 1));
        gn_bake_require_extension(b, MESHOPT);
    }
    if (b->quantized) gn_bake_require_extension(b, "KHR_mesh_quantization");
    const size_t digits = fits_9_digits(b->root, false) ? 9 : 17;
    char *text = b->failed ? NULL : json_dumps(b->root, JSON_COMPACT | JSON_REAL_PRECISION(digits));
    if (!text) return gn_bake_fail(b, "out of memory");
    const bool done = write_glb(b, text, out);
    free(text);
    return done && !b->failed;
}
