#include "fuzz/bomb_file.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"

static const char *const ARRAYS[GN_BOMB_ARRAY_COUNT] = {
    "accessors", "animations", "buffers", "bufferViews", "cameras", "images",  "lights",
    "materials", "meshes",     "nodes",   "samplers",    "scenes",  "textures"};

/* ---- numbers ---- */

uint64_t gn_bomb_below(struct gn_bomb *b, uint64_t n) { return gn_dice_next(&b->dice) % n; }

uint64_t gn_bomb_magnitude(struct gn_bomb *b, double most) {
    return (uint64_t)exp2(gn_dice_between(&b->dice, 0, log2(most)));
}

/* ---- text ---- */

void gn_bomb_put(struct gn_bomb_text *text, const char *format, ...) {
    char json[4096];
    va_list args;
    va_start(args, format);
    vsnprintf(json, sizeof json, format, args);
    va_end(args);
    for (char *c = json; *c; c++) putc(*c == '\'' ? '"' : *c, text->file);
}

int gn_bomb_begin(struct gn_bomb *b, enum gn_bomb_array array) {
    if (b->arrays[array].count > 0) gn_bomb_put(&b->arrays[array], ",");
    return b->arrays[array].count++;
}

int gn_bomb_view(struct gn_bomb *b, const void *data, size_t size, size_t stride) {
    const size_t padded = (size + 3) / 4 * 4, at = b->bin_size;
    b->bin = gn_xrealloc(b->bin, at + padded, 1);
    memset(b->bin + at, 0, padded);
    memcpy(b->bin + at, data, size);
    b->bin_size += padded;
    const int index = gn_bomb_begin(b, GN_BOMB_VIEWS);
    gn_bomb_put(&b->arrays[GN_BOMB_VIEWS], "{'buffer':0,'byteOffset':%zu,'byteLength':%zu", at,
                size);
    gn_bomb_put(&b->arrays[GN_BOMB_VIEWS], stride ? ",'byteStride':%zu}" : "}", stride);
    return index;
}

int gn_bomb_accessor(struct gn_bomb *b, int view, const char *type, int component, uint64_t count) {
    const int index = gn_bomb_begin(b, GN_BOMB_ACCESSORS);
    struct gn_bomb_text *text = &b->arrays[GN_BOMB_ACCESSORS];
    gn_bomb_put(text, "{'componentType':%d,'count':%" PRIu64 ",'type':'%s'", component, count,
                type);
    if (view >= 0) gn_bomb_put(text, ",'bufferView':%d", view);
    gn_bomb_put(text, "}");
    return index;
}

/* ---- the file ---- */

static void put_u32(FILE *to, size_t value) {
    for (int i = 0; i < 4; i++) putc((int)(value >> (8 * i) & 255), to);
}

void gn_bomb_open(struct gn_bomb *b) {
    for (int i = 0; i < GN_BOMB_ARRAY_COUNT; i++)
        b->arrays[i].file = open_memstream(&b->arrays[i].data, &b->arrays[i].size);
    b->more.file = open_memstream(&b->more.data, &b->more.size);
    b->arrays[GN_BOMB_BUFFERS].count = 1; /* the first one is written at the end */
}

struct gn_made gn_bomb_close(struct gn_bomb *b) {
    struct gn_bomb_text json = {0};
    struct gn_made made = {0};
    char *data = NULL;
    json.file = open_memstream(&json.data, &json.size);
    gn_bomb_put(&json, "{'asset':{'version':'2.0'}");
    for (int i = 0; i < GN_BOMB_ARRAY_COUNT; i++) {
        struct gn_bomb_text *array = &b->arrays[i];
        fclose(array->file);
        if (array->count > 0 && i == GN_BOMB_LIGHTS)
            fprintf(json.file, ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[%s]}}",
                    array->data);
        else if (i == GN_BOMB_BUFFERS)
            fprintf(json.file, ",\"buffers\":[{\"byteLength\":%zu}%s]", b->bin_size, array->data);
        else if (array->count > 0)
            fprintf(json.file, ",\"%s\":[%s]", ARRAYS[i], array->data);
        free(array->data);
    }
    fclose(b->more.file);
    fprintf(json.file, "%s}", b->more.data);
    free(b->more.data);
    fflush(json.file);
    while (json.size % 4) {
        putc(' ', json.file);
        fflush(json.file);
    }
    FILE *to = open_memstream(&data, &made.size);
    fputs("glTF", to);
    put_u32(to, 2);
    put_u32(to, 28 + json.size + b->bin_size);
    put_u32(to, json.size);
    fputs("JSON", to);
    fwrite(json.data, 1, json.size, to);
    put_u32(to, gn_bomb_below(b, 30) ? b->bin_size
                                     : gn_bomb_magnitude(b, 4e9)); /* a chunk that claims more */
    fwrite("BIN", 1, 4, to);
    fwrite(b->bin, 1, b->bin_size, to);
    fclose(to);
    fclose(json.file);
    free(json.data);
    made.data = (uint8_t *)data;
    free(b->bin);
    return made;
}
