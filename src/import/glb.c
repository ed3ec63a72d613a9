#include "import/glb.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/disk.h"
#include "import/import.h"

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "glTF buffers are little endian");

void gn_glb_init(struct gn_glb *glb) {
    json_set_alloc_funcs(gn_import_alloc, free);
    *glb = (struct gn_glb){.root = json_object()};
    json_object_set_new(
        glb->root, "asset",
        json_pack("{s:s,s:s}", "version", "2.0", "generator", "gnomon-import " GN_VERSION));
}

int gn_glb_add(struct gn_glb *glb, const char *array, json_t *item) {
    json_t *list = json_object_get(glb->root, array);
    if (!list) {
        list = json_array();
        json_object_set_new(glb->root, array, list);
    }
    json_array_append_new(list, item);
    return (int)json_array_size(list) - 1;
}

size_t gn_glb_append(struct gn_glb *glb, const void *data, size_t size) {
    size_t start = (glb->size + 3) & ~(size_t)3;
    if (start + size > glb->room) {
        glb->room = 2 * (start + size);
        glb->bin = gn_import_grow(glb->bin, glb->room);
    }
    memset(glb->bin + glb->size, 0, start - glb->size);
    if (size > 0) memcpy(glb->bin + start, data, size);
    glb->size = start + size;
    return start;
}

int gn_glb_view(struct gn_glb *glb, const void *data, size_t size) {
    const size_t start = gn_glb_append(glb, data, size);
    return gn_glb_add(glb, "bufferViews",
                      json_pack("{s:i,s:I,s:I}", "buffer", 0, "byteOffset", (json_int_t)start,
                                "byteLength", (json_int_t)size));
}

json_t *gn_glb_floats(const float *values, int count) {
    json_t *array = json_array();
    for (int i = 0; i < count; i++) json_array_append_new(array, json_real((double)values[i]));
    return array;
}

int gn_glb_accessor(struct gn_glb *glb, const struct gn_glb_accessor *a) {
    static const char *const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    enum { VERTICES = 34962, INDICES = 34963 };
    const size_t width = (size_t)a->width;
    size_t bytes = a->component == GN_GLB_U8 ? 1 : a->component == GN_GLB_U16 ? 2 : 4;
    int view = gn_glb_view(glb, a->data, a->count * width * bytes);
    json_object_set_new(json_array_get(json_object_get(glb->root, "bufferViews"), (size_t)view),
                        "target", json_integer(a->indices ? INDICES : VERTICES));
    json_t *object =
        json_pack("{s:i,s:i,s:I,s:s}", "bufferView", view, "componentType", (int)a->component,
                  "count", (json_int_t)a->count, "type", types[a->width]);
    if (a->normalized) json_object_set_new(object, "normalized", json_true());
    if (a->bounds) {
        float low[4], high[4];
        const float *values = a->data;
        memcpy(low, values, width * sizeof *low);
        memcpy(high, values, width * sizeof *high);
        for (size_t i = 0; i < a->count * width; i++) {
            low[i % width] = fminf(low[i % width], values[i]);
            high[i % width] = fmaxf(high[i % width], values[i]);
        }
        json_object_set_new(object, "min", gn_glb_floats(low, a->width));
        json_object_set_new(object, "max", gn_glb_floats(high, a->width));
    }
    return gn_glb_add(glb, "accessors", object);
}

json_t *gn_glb_text(const char *text) {
    json_t *string = json_string(text);
    if (string) return string;
    char *plain = gn_import_alloc(strlen(text) + 1);
    for (size_t i = 0; i <= strlen(text); i++) plain[i] = (signed char)text[i] < 0 ? '?' : text[i];
    string = json_string(plain);
    free(plain);
    return string;
}

json_t *gn_glb_extension(struct gn_glb *glb, const char *name) {
    json_t *all = json_object_get(glb->root, "extensions");
    if (!all) {
        all = json_object();
        json_object_set_new(glb->root, "extensions", all);
    }
    json_t *object = json_object_get(all, name);
    if (object) return object;
    gn_glb_add(glb, "extensionsUsed", json_string(name));
    object = json_object();
    json_object_set_new(all, name, object);
    return object;
}

static size_t padded_size(size_t size) { return (size + 3) & ~(size_t)3; }

static bool write_chunk(int fd, const char type[4], const void *data, size_t size, char pad) {
    uint32_t head[2] = {(uint32_t)padded_size(size)};
    char pads[3] = {pad, pad, pad};
    memcpy(&head[1], type, 4);
    return gn_disk_write_all(&gn_disk, fd, head, sizeof head) &&
           gn_disk_write_all(&gn_disk, fd, data, size) &&
           gn_disk_write_all(&gn_disk, fd, pads, padded_size(size) - size);
}

bool gn_glb_write(struct gn_glb *glb, int fd, struct gn_err *err) {
    enum { HEADER = 12, CHUNK = 8 };
    if (glb->size)
        gn_glb_add(glb, "buffers", json_pack("{s:I}", "byteLength", (json_int_t)glb->size));
    if (glb->size) glb->bin = gn_import_grow(glb->bin, glb->room = glb->size);
    char *text = json_dumps(glb->root, JSON_COMPACT | JSON_REAL_PRECISION(9));
    size_t length = text ? strlen(text) : 0, bin = glb->size ? CHUNK + padded_size(glb->size) : 0;
    size_t total = HEADER + CHUNK + padded_size(length) + bin;
    uint32_t head[3] = {0x46546c67, 2, (uint32_t)total}; /* "glTF" */
    bool ok = false;
    gn_import_reserve(total);
    if (total > UINT32_MAX)
        gn_fail(err, "too large for a .glb (4 GB)");
    else if (gn_disk_write_all(&gn_disk, fd, head, sizeof head) &&
             write_chunk(fd, "JSON", text, length, ' ') &&
             (!bin || write_chunk(fd, "BIN", glb->bin, glb->size, 0)))
        ok = true;
    else if (errno == EFBIG)
        gn_fail(err, "its .glb exceeds the file size limit; raise it with gnomon-import --file MB");
    else
        gn_fail(err, "cannot write its .glb: %s", strerror(errno));
    free(text);
    return ok;
}
