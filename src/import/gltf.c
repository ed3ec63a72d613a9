/* A glTF file whose meshes are compressed by Draco, as a .glb with plain ones. All else stays as it
 * is, also what is wrong with it: gnomon's loader looks at the result. All buffers become one. */
#include <stdlib.h>
#include <string.h>

#include "core/encoding.h"
#include "import/draco.h"
#include "import/import.h"

#define DRACO "KHR_draco_mesh_compression"
static const char *const meshopt[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

struct part { /* of the file, or of the .glb */
    const uint8_t *data;
    size_t size;
};
struct gltf {
    struct gn_import *import;
    struct gn_glb *glb;
    struct part bin;
    struct extent {
        size_t start, size; /* in the chunk of the .glb; size 0: a placeholder */
    } * buffers;
    size_t buffer_count;
};

static bool fail_gltf(const struct gltf *g, const char *what, size_t index, const char *why) {
    return gn_fail(g->import->err, "%s: %s[%zu]: %s", g->import->opts->model, what, index, why);
}

/* ---- the file ---- */

static struct part json_part(const struct gn_bytes *file, struct part *bin) {
    enum { HEADER = 12, CHUNK = 8 };
    struct part json = {file->data, file->size}, chunks[2] = {{0}};
    if (file->size < HEADER + CHUNK || memcmp(file->data, "glTF", 4) != 0) return json;
    size_t at = HEADER;
    for (int i = 0; i < 2 && file->size - at >= CHUNK; i++) {
        const size_t size = gn_u32_at(file->data + at), room = file->size - at - CHUNK;
        chunks[i] = (struct part){file->data + at + CHUNK, size < room ? size : room};
        at += CHUNK + chunks[i].size;
    }
    *bin = chunks[1];
    return chunks[0];
}

static bool read_file(struct gltf *g, struct gn_bytes *file) {
    struct gn_import *import = g->import;
    if (!gn_import_model_read(import, file, import->err)) return false;
    const struct part json = json_part(file, &g->bin);
    json_error_t error;
    json_t *root = json_loadb((const char *)json.data, json.size, JSON_DISABLE_EOF_CHECK, &error);
    if (!json_is_object(root))
        return gn_fail(import->err, "%s: neither .glb nor .gltf", import->opts->model);
    json_decref(g->glb->root);
    g->glb->root = root;
    return true;
}

/* ---- buffers become one ---- */

static bool read_buffer(struct gltf *g, size_t index, const json_t *buffer) {
    const char *uri = json_string_value(json_object_get(buffer, "uri")), *why = "cannot be read";
    struct part part = {0};
    struct gn_bytes file = {0};
    uint8_t *plain = NULL;
    bool ok = true;
    if (!uri && index == 0)
        part = g->bin;
    else if (uri && gn_data_uri_is(uri)) {
        part.data = plain = gn_import_alloc(strlen(uri));
        ok = gn_data_uri_decode(uri, plain, &part.size, &why);
    } else if (uri) {
        plain = gn_import_alloc(strlen(uri) + 1);
        ok = false;
        for (int i = 0; !ok && gn_uri_name(uri, i, (char *)plain) > 0; i++)
            ok = gn_import_folder_read(g->import, (const char *)plain, &file);
        part = (struct part){file.data, file.size};
    }
    const size_t start = gn_glb_append(g->glb, part.data, ok ? part.size : 0);
    g->buffers[index] = (struct extent){start, part.size};
    free(plain);
    gn_bytes_finish(&file);
    return ok || fail_gltf(g, "buffers", index, why);
}

static bool read_buffers(struct gltf *g) {
    const json_t *buffers = json_object_get(g->glb->root, "buffers");
    g->buffer_count = json_array_size(buffers);
    g->buffers = gn_import_alloc((g->buffer_count + 1) * sizeof *g->buffers);
    for (size_t i = 0; i < g->buffer_count; i++)
        if (!read_buffer(g, i, json_array_get(buffers, i))) return false;
    json_object_del(g->glb->root, "buffers");
    return true;
}

static int64_t number_of(const json_t *object, const char *key, int64_t absent) {
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? (int64_t)json_number_value(value) : absent;
}

/* Of a view, or of its extension for meshoptimizer. */
static void move_view(const struct gltf *g, json_t *view) {
    const int64_t buffer = number_of(view, "buffer", -1), offset = number_of(view, "byteOffset", 0);
    if (buffer < 0 || (uint64_t)buffer >= g->buffer_count || offset < 0 || offset > UINT32_MAX)
        return; /* the loader says so */
    const int64_t start = (int64_t)g->buffers[buffer].start;
    json_object_set_new(view, "buffer", json_integer(0));
    json_object_set_new(view, "byteOffset", json_integer(start + offset));
}

static void move_views(const struct gltf *g) {
    json_t *view, *views = json_object_get(g->glb->root, "bufferViews");
    size_t i;
    json_array_foreach(views, i, view) {
        move_view(g, view);
        for (int k = 0; k < 2; k++) {
            json_t *stream = json_object_get(json_object_get(view, "extensions"), meshopt[k]);
            if (json_is_object(stream)) move_view(g, stream);
        }
    }
}

/* ---- meshes ---- */

static struct part view_part(const struct gltf *g, int64_t index) {
    const json_t *views = json_object_get(g->glb->root, "bufferViews");
    const json_t *view = index < 0 ? NULL : json_array_get(views, (size_t)index);
    const int64_t start = number_of(view, "byteOffset", 0), size = number_of(view, "byteLength", 0);
    if (start < 0 || size <= 0 || (uint64_t)start > g->glb->size ||
        (uint64_t)size > g->glb->size - (uint64_t)start)
        return (struct part){0};
    return (struct part){g->glb->bin + start, (size_t)size};
}

static int width_of(const json_t *accessor) {
    static const char *const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const char *type = json_string_value(json_object_get(accessor, "type"));
    for (int i = 0; type && i < 4; i++)
        if (strcmp(type, types[i]) == 0) return i + 1;
    return 0;
}

static size_t bytes_of(int64_t component) {
    switch (component) {
    case GN_GLB_I8:
    case GN_GLB_U8: return 1;
    case GN_GLB_I16:
    case GN_GLB_U16: return 2;
    case GN_GLB_U32:
    case GN_GLB_F32: return 4;
    default: return 0;
    }
}

/* A copy of the accessor for count elements of that data; its number. */
static int add_accessor(struct gltf *g, const json_t *accessor, const void *data, size_t count,
                        size_t stride, bool is_vertex) {
    const int view = gn_glb_view(g->glb, data, count * stride);
    if (is_vertex)
        json_object_set_new(
            json_array_get(json_object_get(g->glb->root, "bufferViews"), (size_t)view),
            "byteStride", json_integer((json_int_t)stride));
    json_t *copy = json_copy((json_t *)(uintptr_t)accessor);
    json_object_del(copy, "byteOffset");
    json_object_del(copy, "sparse");
    json_object_set_new(copy, "bufferView", json_integer(view));
    json_object_set_new(copy, "count", json_integer((json_int_t)count));
    return gn_glb_add(g->glb, "accessors", copy);
}

static const json_t *accessor_of(const struct gltf *g, const json_t *number) {
    const json_t *accessors = json_object_get(g->glb->root, "accessors");
    if (!json_is_integer(number) || json_integer_value(number) < 0) return NULL;
    return json_array_get(accessors, (size_t)json_integer_value(number));
}

static bool decode_attribute(struct gltf *g, const struct gn_draco *draco, json_t *attributes,
                             const char *name, const json_t *id) {
    const json_t *accessor = accessor_of(g, json_object_get(attributes, name));
    const int64_t component = number_of(accessor, "componentType", 0);
    const int width = width_of(accessor);
    const size_t stride = ((size_t)width * bytes_of(component) + 3) & ~(size_t)3;
    if (stride == 0 || !json_is_integer(id)) return false;
    uint8_t *data = gn_import_alloc(draco->point_count * stride);
    const bool ok = gn_draco_attribute(draco, (uint32_t)json_integer_value(id), (int)component,
                                       width, stride, data);
    if (ok)
        json_object_set_new(
            attributes, name,
            json_integer(add_accessor(g, accessor, data, draco->point_count, stride, true)));
    free(data);
    return ok;
}

static void decode_indices(struct gltf *g, const struct gn_draco *draco, json_t *primitive) {
    const size_t count = 3 * (size_t)draco->triangle_count;
    uint32_t *indices = gn_import_alloc(count * sizeof *indices);
    gn_draco_indices(draco, indices);
    json_t *plain = json_pack("{s:i,s:s}", "componentType", (int)GN_GLB_U32, "type", "SCALAR");
    json_object_set_new(
        primitive, "indices",
        json_integer(add_accessor(g, plain, indices, count, sizeof *indices, false)));
    json_object_del(primitive, "mode"); /* triangles */
    json_decref(plain);
    free(indices);
}

static bool decode_primitive(struct gltf *g, size_t mesh, json_t *primitive) {
    json_t *extensions = json_object_get(primitive, "extensions");
    json_t *compressed = json_object_get(extensions, DRACO), *id;
    if (!compressed) return true;
    const struct part part = view_part(g, number_of(compressed, "bufferView", -1));
    const char *why = "no Draco-compressed data", *name;
    struct gn_draco draco = {0};
    if (part.size == 0 || !gn_draco_open(&draco, part.data, part.size, &why))
        return fail_gltf(g, "meshes", mesh, why);
    json_t *attributes = json_object_get(primitive, "attributes");
    bool has_positions = true;
    json_object_foreach(json_object_get(compressed, "attributes"), name, id) {
        if (decode_attribute(g, &draco, attributes, name, id)) continue;
        has_positions &= strcmp(name, "POSITION") != 0;
        json_object_del(attributes, name);
        gn_warn(g->import->warnings,
                "%s: meshes[%zu]: %.40s is not in the Draco-compressed data; shown without it",
                g->import->opts->model, mesh, name);
    }
    if (has_positions) decode_indices(g, &draco, primitive);
    gn_draco_close(&draco);
    json_object_del(extensions, DRACO);
    return has_positions ||
           fail_gltf(g, "meshes", mesh, "POSITION is not in the Draco-compressed data");
}

static bool decode_meshes(struct gltf *g) {
    json_t *mesh, *primitive;
    size_t i, k;
    json_array_foreach(json_object_get(g->glb->root, "meshes"), i, mesh)
        json_array_foreach(json_object_get(mesh, "primitives"), k,
                           primitive) if (!decode_primitive(g, i, primitive)) return false;
    return true;
}

static void forget_extension(json_t *root, const char *list) {
    json_t *names = json_object_get(root, list);
    for (size_t i = json_array_size(names); i-- > 0;) {
        const char *name = json_string_value(json_array_get(names, i));
        if (name && strcmp(name, DRACO) == 0) json_array_remove(names, i);
    }
    if (json_array_size(names) == 0) json_object_del(root, list);
}

bool gn_import_gltf_build(struct gn_import *import) {
    struct gltf g = {.import = import, .glb = &import->glb};
    struct gn_bytes file = {0};
    if (!read_file(&g, &file) || !read_buffers(&g)) return false;
    move_views(&g);
    if (!decode_meshes(&g)) return false;
    forget_extension(g.glb->root, "extensionsUsed");
    forget_extension(g.glb->root, "extensionsRequired");
    return true;
}
