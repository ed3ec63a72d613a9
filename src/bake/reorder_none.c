#include "bake/reorder.h"

bool gn_reorder_is_built(void) { return false; }

/* None of these is called. */
size_t gn_reorder_merge(const struct gn_stream_bytes *streams, size_t stream_count,
                        const uint32_t *corners, size_t corner_count, size_t vertex_count,
                        uint32_t *remap, uint32_t *work) {
    (void)streams, (void)stream_count, (void)corners, (void)corner_count, (void)remap, (void)work;
    return vertex_count;
}
void gn_reorder_vertices(const struct gn_stream_bytes *stream, size_t vertex_count,
                         const uint32_t *remap) {
    (void)stream, (void)vertex_count, (void)remap;
}
void gn_reorder_corners(uint32_t *corners, size_t count, const uint32_t *remap) {
    (void)corners, (void)count, (void)remap;
}
size_t gn_reorder_simplify(uint32_t *corners, size_t count, const float *positions,
                           size_t vertex_count, size_t wanted, float most_error, bool locks_border,
                           float *error) {
    (void)corners, (void)positions, (void)vertex_count, (void)wanted, (void)most_error;
    (void)locks_border, (void)error;
    return count;
}
void gn_reorder_triangles(uint32_t *corners, size_t count, const float *positions,
                          size_t vertex_count) {
    (void)corners, (void)count, (void)positions, (void)vertex_count;
}
size_t gn_reorder_fetch(uint32_t *remap, const uint32_t *corners, size_t count,
                        size_t vertex_count) {
    (void)remap, (void)corners, (void)count;
    return vertex_count;
}
size_t gn_compress_vertices(uint8_t *out, size_t room, const void *vertices, size_t count,
                            size_t stride) {
    (void)out, (void)room, (void)vertices, (void)count, (void)stride;
    return 0;
}
size_t gn_compress_triangles(uint8_t *out, size_t room, const uint32_t *corners, size_t count) {
    (void)out, (void)room, (void)corners, (void)count;
    return 0;
}
