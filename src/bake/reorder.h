/* What libmeshoptimizer does here: merges vertices, orders triangles and vertices, simplifies,
 * compresses. Only functions that its versions 0.18 and later have. A build without it has
 * reorder_none.c. */
#ifndef GN_BAKE_REORDER_H
#define GN_BAKE_REORDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gn_stream_bytes { /* of one attribute: count x stride */
    uint8_t *data;
    size_t stride; /* a multiple of 4, at most 256 */
};
enum { GN_STREAM_STRIDE_MAX = 256 };

struct gn_reorder {
    /* Finds vertices that are the same in all streams. Of each vertex its new number in remap, or
     * UINT32_MAX if no corner uses it; how many there are is returned. work: vertex_count numbers.
     */
    size_t (*merge)(const struct gn_stream_bytes *streams, size_t stream_count,
                    const uint32_t *corners, size_t corner_count, size_t vertex_count,
                    uint32_t *remap, uint32_t *work);
    /* Puts vertices, and corners, where remap says. */
    void (*vertices)(const struct gn_stream_bytes *stream, size_t vertex_count,
                     const uint32_t *remap);
    void (*corners)(uint32_t *corners, size_t count, const uint32_t *remap);
    /* Collapses edges until about so many corners are left; the number that is. *error: the largest
     * move, in sizes of the mesh; it stays below most_error. */
    size_t (*simplify)(uint32_t *corners, size_t count, const float *positions, size_t vertex_count,
                       size_t wanted, float most_error, bool locks_border, float *error);
    /* Orders the triangles for the cache of transformed vertices and for little overdraw. */
    void (*triangles)(uint32_t *corners, size_t count, const float *positions, size_t vertex_count);
    /* Of vertices, the order in which corners use them, as merge(). */
    size_t (*fetch)(uint32_t *remap, const uint32_t *corners, size_t count, size_t vertex_count);
    /* Compress by version 0 of the codec, of attributes and of triangles. The size in bytes, or 0:
     * it takes more than room. */
    size_t (*compress_vertices)(uint8_t *out, size_t room, const void *vertices, size_t count,
                                size_t stride);
    size_t (*compress_triangles)(uint8_t *out, size_t room, const uint32_t *corners, size_t count);
};
extern const struct gn_reorder *const gn_reorder; /* NULL: this build has none */

#endif
