#include "bake/reorder.h"

#include <meshoptimizer.h>
#include <string.h>

enum { STREAMS_AT_ONCE = 16 };   /* of meshopt_generateVertexRemapMulti */
#define OVERDRAW_THRESHOLD 1.05f /* how much longer the cache's work may become */

static size_t merge_vertices(const struct gn_stream_bytes *streams, size_t stream_count,
                             const uint32_t *corners, size_t corner_count, size_t vertex_count,
                             uint32_t *remap, uint32_t *work) {
    size_t unique = 0;
    for (size_t done = 0; done < stream_count;) {
        struct meshopt_Stream some[STREAMS_AT_ONCE];
        size_t n = 0;
        if (done > 0) { /* vertices are the same if they were, and are in these streams */
            memcpy(work, remap, vertex_count * sizeof *work);
            some[n++] = (struct meshopt_Stream){work, sizeof *work, sizeof *work};
        }
        for (; n < STREAMS_AT_ONCE && done < stream_count; n++, done++)
            some[n] = (struct meshopt_Stream){streams[done].data, streams[done].stride,
                                              streams[done].stride};
        unique =
            meshopt_generateVertexRemapMulti(remap, corners, corner_count, vertex_count, some, n);
    }
    return unique;
}

static void put_vertices(const struct gn_stream_bytes *stream, size_t vertex_count,
                         const uint32_t *remap) {
    meshopt_remapVertexBuffer(stream->data, stream->data, vertex_count, stream->stride, remap);
}

static void put_corners(uint32_t *corners, size_t count, const uint32_t *remap) {
    meshopt_remapIndexBuffer(corners, corners, count, remap);
}

static size_t simplify(uint32_t *corners, size_t count, const float *positions, size_t vertex_count,
                       size_t wanted, float most_error, bool locks_border, float *error) {
    return meshopt_simplify(corners, corners, count, positions, vertex_count, 3 * sizeof(float),
                            wanted, most_error, locks_border ? meshopt_SimplifyLockBorder : 0,
                            error);
}

static void order_triangles(uint32_t *corners, size_t count, const float *positions,
                            size_t vertex_count) {
    meshopt_optimizeVertexCache(corners, corners, count, vertex_count);
    meshopt_optimizeOverdraw(corners, corners, count, positions, vertex_count, 3 * sizeof(float),
                             OVERDRAW_THRESHOLD);
}

static size_t order_vertices(uint32_t *remap, const uint32_t *corners, size_t count,
                             size_t vertex_count) {
    return meshopt_optimizeVertexFetchRemap(remap, corners, count, vertex_count);
}

static size_t compress_vertices(uint8_t *out, size_t room, const void *vertices, size_t count,
                                size_t stride) {
    meshopt_encodeVertexVersion(0);
    return meshopt_encodeVertexBuffer(out, room, vertices, count, stride);
}

static size_t compress_triangles(uint8_t *out, size_t room, const uint32_t *corners, size_t count) {
    meshopt_encodeIndexVersion(0);
    return meshopt_encodeIndexBuffer(out, room, corners, count);
}

static const struct gn_reorder by_meshoptimizer = {
    .merge = merge_vertices,
    .vertices = put_vertices,
    .corners = put_corners,
    .simplify = simplify,
    .triangles = order_triangles,
    .fetch = order_vertices,
    .compress_vertices = compress_vertices,
    .compress_triangles = compress_triangles,
};
const struct gn_reorder *const gn_reorder = &by_meshoptimizer;
