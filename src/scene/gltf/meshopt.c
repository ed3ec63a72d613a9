#include "scene/gltf/meshopt.h"

#include <meshoptimizer.h>

bool gn_meshopt_is_read(void) { return true; }

static int decode_stream(const struct gn_meshopt_stream *s, void *out) {
    switch (s->mode) {
    case GN_MESHOPT_TRIANGLES:
        return meshopt_decodeIndexBuffer(out, s->count, s->stride, s->data, s->size);
    case GN_MESHOPT_INDICES:
        return meshopt_decodeIndexSequence(out, s->count, s->stride, s->data, s->size);
    default: return meshopt_decodeVertexBuffer(out, s->count, s->stride, s->data, s->size);
    }
}

bool gn_meshopt_decode(const struct gn_meshopt_stream *stream, void *out, struct gn_err *err) {
    if (decode_stream(stream, out) != 0) return gn_fail(err, "the compressed data is damaged");
    switch (stream->filter) {
    case GN_MESHOPT_OCTAHEDRAL: meshopt_decodeFilterOct(out, stream->count, stream->stride); break;
    case GN_MESHOPT_QUATERNION: meshopt_decodeFilterQuat(out, stream->count, stream->stride); break;
    case GN_MESHOPT_EXPONENTIAL: meshopt_decodeFilterExp(out, stream->count, stream->stride); break;
    default: break;
    }
    return true;
}

size_t gn_meshopt_simplify(uint32_t *out, const uint32_t *corners, size_t count,
                           const float *positions, size_t vertex_count, float *error_m) {
    const size_t stride = 3 * sizeof(float);
    const float scale = meshopt_simplifyScale(positions, vertex_count, stride);
    float error = 0;
    const size_t left =
        meshopt_simplify(out, corners, count, positions, vertex_count, stride, 0,
                         scale > 0 ? *error_m / scale : 0, meshopt_SimplifyLockBorder, &error);
    *error_m = error * scale;
    return left;
}
