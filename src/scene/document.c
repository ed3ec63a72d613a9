#include "scene/document.h"

#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/encoding.h"
#include "scene/private.h"

struct gn_document {
    struct gn_gltf g;
    struct gn_arena scene; /* stays empty */
};

struct gn_document *gn_document_open(const char *path, const void *data, size_t size,
                                     const struct gn_scene_limits *limits,
                                     struct gn_warnings *warnings, struct gn_err *err) {
    struct gn_document *d = gn_xalloc(1, sizeof *d);
    struct gn_gltf *g = &d->g;
    *g = (struct gn_gltf){.path = path, .warnings = warnings, .err = err};
    g->limits = gn_scene_limits_or_default(limits);
    g->folder = gn_scene_folder(path);
    g->memory.scene = &d->scene;
    g->memory.other_bytes = size;
    g->hash_key = gn_hash_key_make();
    g->end_ns = gn_clock_thread_cpu_ns() + (int64_t)g->limits.seconds * GN_NS_PER_S;
    if (gn_gltf_open(g, data, size) && gn_gltf_check_support(g) && gn_gltf_buffers(g) &&
        gn_gltf_list_accessors(g))
        return d;
    gn_document_close(d);
    return NULL;
}

void gn_document_close(struct gn_document *d) {
    if (!d) return;
    struct gn_gltf *g = &d->g;
    for (size_t i = 0; i < g->file.buffer_count; i++) gn_blob_finish(g, &g->file.buffers[i]);
    json_decref(g->file.json);
    gn_arena_finish(&g->memory.step);
    gn_arena_finish(&g->memory.load);
    gn_arena_finish(&d->scene);
    free(g->folder);
    free(d);
}

const json_t *gn_document_json(const struct gn_document *d) { return d->g.file.json; }
size_t gn_document_accessor_count(const struct gn_document *d) { return d->g.file.accessor_count; }
size_t gn_document_view_count(const struct gn_document *d) { return d->g.file.view_count; }
size_t gn_document_room(const struct gn_document *d) { return gn_gltf_room(&d->g); }

static bool fail_accessor(struct gn_document *d, size_t index, const char *what) {
    struct gn_at root = gn_at_root(&d->g), array = gn_at_array(&d->g, &root, "accessors");
    struct gn_at at = gn_at_element(&array, index);
    return gn_gltf_fail(&d->g, &at, "%s", what);
}

bool gn_document_accessor(struct gn_document *d, size_t index, struct gn_elements *out) {
    if (index >= d->g.file.accessor_count) return fail_accessor(d, index, "does not exist");
    const struct gn_accessor *a = gn_gltf_accessor(&d->g, (int32_t)index);
    if (!a) return false;
    *out = (struct gn_elements){.data = a->data,
                                .stride = a->stride,
                                .element = gn_accessor_element_size(a),
                                .count = a->count,
                                .component = (int)a->component,
                                .components = a->components,
                                .normalized = a->normalized};
    return true;
}

void gn_document_floats(struct gn_document *d, size_t index, size_t components, float *out) {
    const struct gn_accessor *a = gn_gltf_accessor(&d->g, (int32_t)index);
    if (a) gn_accessor_floats(a, components, out);
}

bool gn_document_indices(struct gn_document *d, size_t index, uint32_t *out) {
    struct gn_elements e;
    if (!gn_document_accessor(d, index, &e)) return false;
    const struct gn_accessor *a = gn_gltf_accessor(&d->g, (int32_t)index);
    if (a->components != 1 ||
        (a->component != GN_U8 && a->component != GN_U16 && a->component != GN_U32))
        return fail_accessor(d, index, "indices must be unsigned scalars");
    gn_accessor_indices(a, out);
    return true;
}

void gn_document_view(const struct gn_document *d, size_t index, const uint8_t **data, size_t *size,
                      size_t *stride) {
    const struct gn_buffer_view none = {0}, *view = index < d->g.file.view_count
                                                        ? &d->g.file.views[index]
                                                        : &none;
    *data = view->data;
    *size = view->data ? view->size : 0;
    *stride = view->stride;
}

bool gn_document_fetch(struct gn_document *d, const char *uri, struct gn_bytes *out,
                       struct gn_err *why) {
    *out = (struct gn_bytes){0};
    if (gn_data_uri_is(uri)) {
        const char *reason = "no memory";
        out->data = malloc(strlen(uri) + 1);
        return (out->data && gn_data_uri_decode(uri, out->data, &out->size, &reason)) ||
               gn_fail(why, "%s", reason);
    }
    struct gn_blob blob = {0};
    const int fd = gn_uri_open(&d->g, uri, why);
    if (fd < 0 || !gn_uri_read(&d->g, fd, uri, &blob, why)) return false;
    d->g.memory.other_bytes -= blob.size; /* the caller's now */
    *out = blob.file;
    return true;
}
