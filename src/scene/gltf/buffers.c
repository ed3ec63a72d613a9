/* Buffers and their views. */
#include "scene/private.h"

#include <inttypes.h>

static bool load_buffer(struct gn_gltf *g, const struct gn_at *at, size_t index,
                        struct gn_blob *buffer) {
    uint64_t wanted = gn_at_uint(g, at, "byteLength", UINT64_MAX);
    struct gn_at length_at = gn_at_any(at, "byteLength"), uri_at = gn_at_any(at, "uri");
    if (g->failed) return false;
    if (wanted == UINT64_MAX) return gn_gltf_fail(g, &length_at, "missing");
    const char *uri = gn_at_text(g, at, "uri");
    struct gn_err err = {0};
    if (g->failed) return false;
    if (uri && !gn_uri_fetch(g, uri, buffer, &err)) return gn_gltf_fail(g, &uri_at, "%s", err.text);
    if (!uri && index == 0) *buffer = g->file.bin; /* later ones without a URI are placeholders */
    if (buffer->data && wanted > buffer->size) {
        gn_gltf_fail(g, &length_at, "%" PRIu64 ", but the data has %zu bytes", wanted,
                     buffer->size);
        gn_gltf_spare(g, "read as far as it goes");
    }
    return true;
}

static bool read_view(struct gn_gltf *g, const struct gn_at *at, struct gn_buffer_view *view) {
    struct gn_at buffer_at = gn_at_any(at, "buffer");
    const int32_t index = gn_at_ref(g, at, "buffer", g->file.buffer_count, "buffers");
    const uint64_t offset = gn_at_uint(g, at, "byteOffset", 0);
    const uint64_t length = gn_at_uint(g, at, "byteLength", 0);
    view->stride = (size_t)gn_at_uint(g, at, "byteStride", 0);
    view->size = (size_t)length;
    view->buffer = index;
    if (g->failed || !gn_gltf_decompress(g, at, view)) return false;
    if (view->data) return true;
    if (index < 0) return gn_gltf_fail(g, &buffer_at, "missing");
    const struct gn_blob *buffer = &g->file.buffers[index];
    if (!buffer->data) return true;
    if (offset > buffer->size || length > buffer->size - offset)
        return gn_gltf_fail(g, at,
                            "byteOffset %" PRIu64 " + byteLength %" PRIu64
                            " passes the end of buffer %d (%zu bytes)",
                            offset, length, index, buffer->size);
    view->data = buffer->data + offset;
    return true;
}

bool gn_gltf_buffers(struct gn_gltf *g) {
    struct gn_at root = gn_at_root(g), buffers = gn_at_array(g, &root, "buffers");
    size_t count = gn_at_size(&buffers);
    GN_NEW(g, &g->memory.load, g->file.buffers, count);
    if (!g->file.buffers) return false;
    g->file.buffer_count = count;
    for (size_t i = 0; i < count; i++) {
        struct gn_at at = gn_at_element(&buffers, i);
        if (!load_buffer(g, &at, i, &g->file.buffers[i]) && !gn_gltf_spare(g, "not read"))
            return false;
    }
    struct gn_at views = gn_at_array(g, &root, "bufferViews");
    g->file.view_count = gn_at_size(&views);
    GN_NEW(g, &g->memory.load, g->file.views, g->file.view_count);
    for (size_t i = 0; i < g->file.view_count && !g->failed; i++) {
        struct gn_at at = gn_at_element(&views, i);
        if (!read_view(g, &at, &g->file.views[i]) && !gn_gltf_spare(g, "not read")) return false;
    }
    return !g->failed;
}
