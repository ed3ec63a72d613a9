/* Buffer views that are compressed with meshoptimizer: EXT_meshopt_compression. */
#include "scene/private.h"

#include <inttypes.h>
#include <string.h>

#include "scene/gltf/meshopt.h"

/* Of KHR_meshopt_compression what its first version shares with this one is read. */
static const char *const paths[] = {"extensions.EXT_meshopt_compression",
                                    "extensions.KHR_meshopt_compression"};
static const char *const modes[] = {[GN_MESHOPT_ATTRIBUTES] = "ATTRIBUTES",
                                    [GN_MESHOPT_TRIANGLES] = "TRIANGLES",
                                    [GN_MESHOPT_INDICES] = "INDICES"};
static const char *const filters[] = {[GN_MESHOPT_NO_FILTER] = "NONE",
                                      [GN_MESHOPT_OCTAHEDRAL] = "OCTAHEDRAL",
                                      [GN_MESHOPT_QUATERNION] = "QUATERNION",
                                      [GN_MESHOPT_EXPONENTIAL] = "EXPONENTIAL"};

/* First bytes of the streams that are decoded (versions 0 and, of indices, 1). */
static bool has_known_version(const struct gn_meshopt_stream *s) {
    const uint8_t first = s->data[0];
    if (s->mode == GN_MESHOPT_ATTRIBUTES) return first == 0xa0;
    return (first & 0xfe) == (s->mode == GN_MESHOPT_TRIANGLES ? 0xe0 : 0xd0);
}

static bool has_filter_stride(const struct gn_meshopt_stream *s) {
    switch (s->filter) {
    case GN_MESHOPT_OCTAHEDRAL: return s->stride == 4 || s->stride == 8;
    case GN_MESHOPT_QUATERNION: return s->stride == 8;
    default: return true;
    }
}

static bool check_stream(const struct gn_meshopt_stream *s, struct gn_err *err) {
    const bool indices = s->mode != GN_MESHOPT_ATTRIBUTES;
    if (indices ? s->stride != 2 && s->stride != 4
                : s->stride == 0 || s->stride > 256 || s->stride % 4 != 0)
        return gn_fail(err, "byteStride %zu is not possible in mode %s", s->stride, modes[s->mode]);
    if (s->mode == GN_MESHOPT_TRIANGLES && s->count % 3 != 0)
        return gn_fail(err, "count %zu is not a multiple of 3", s->count);
    if (s->filter != GN_MESHOPT_NO_FILTER && (indices || !has_filter_stride(s)))
        return gn_fail(err, "filter %s is not possible here", filters[s->filter]);
    if (s->size == 0) return gn_fail(err, "no data");
    return has_known_version(s) ||
           gn_fail(err,
                   "version %d of the codec is not read: compress it again as "
                   "EXT_meshopt_compression (gltfpack -c)",
                   s->data[0] & 15);
}

static int word_at(struct gn_gltf *g, const struct gn_at *at, const char *key,
                   const char *const *words, size_t count, int absent) {
    const char *text = gn_at_text(g, at, key);
    struct gn_at where = gn_at_any(at, key);
    if (g->failed) return -1;
    for (size_t i = 0; text && i < count; i++)
        if (strcmp(text, words[i]) == 0) return (int)i;
    if (!text && absent >= 0) return absent;
    if (text)
        gn_gltf_fail(g, &where, "'%.20s' is not known", text);
    else
        gn_gltf_fail(g, &where, "missing");
    return -1;
}

/* False: failed, which gn_gltf_buffers() may spare. */
static bool read_stream(struct gn_gltf *g, const struct gn_at *at, struct gn_meshopt_stream *out) {
    const int32_t index = gn_at_ref(g, at, "buffer", g->file.buffer_count, "buffers");
    const uint64_t offset = gn_at_uint(g, at, "byteOffset", 0);
    const uint64_t length = gn_at_uint(g, at, "byteLength", 0);
    const uint64_t count = gn_at_uint(g, at, "count", 0),
                   stride = gn_at_uint(g, at, "byteStride", 0);
    const int mode = word_at(g, at, "mode", modes, 3, -1);
    const int filter = word_at(g, at, "filter", filters, 4, GN_MESHOPT_NO_FILTER);
    struct gn_at buffer_at = gn_at_any(at, "buffer");
    if (g->failed || mode < 0 || filter < 0) return false;
    const struct gn_blob *buffer = index < 0 ? NULL : &g->file.buffers[index];
    if (!buffer || !buffer->data) return gn_gltf_fail(g, &buffer_at, "holds no data");
    if (offset > buffer->size || length > buffer->size - offset)
        return gn_gltf_fail(g, at, "passes the end of buffer %d (%zu bytes)", index, buffer->size);
    *out = (struct gn_meshopt_stream){.data = buffer->data + offset,
                                      .size = (size_t)length,
                                      .count = (size_t)count,
                                      .stride = (size_t)stride,
                                      .mode = (enum gn_meshopt_mode)mode,
                                      .filter = (enum gn_meshopt_filter)filter};
    struct gn_err err = {0};
    return check_stream(out, &err) || gn_gltf_fail(g, at, "%s", err.text);
}

bool gn_gltf_decompress(struct gn_gltf *g, const struct gn_at *view_at,
                        struct gn_buffer_view *view) {
    struct gn_at at = {0};
    for (size_t i = 0; i < 2 && !at.json; i++) at = gn_at_object(g, view_at, paths[i]);
    struct gn_meshopt_stream stream = {0};
    if (!at.json || !gn_meshopt_is_read()) return !g->failed;
    if (!gn_gltf_check_time(g) || !read_stream(g, &at, &stream)) return false;
    uint8_t *out = gn_gltf_alloc(g, &g->memory.load, stream.count, stream.stride);
    struct gn_err err = {0};
    if (g->failed) return false;
    if (!gn_meshopt_decode(&stream, out, &err)) return gn_gltf_fail(g, &at, "%s", err.text);
    if (view->size > stream.count * stream.stride)
        return gn_gltf_fail(g, view_at, "byteLength %zu, but %zu bytes are compressed in it",
                            view->size, stream.count * stream.stride);
    view->data = out;
    return true;
}
