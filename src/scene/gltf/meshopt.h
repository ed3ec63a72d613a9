/* Streams of EXT_meshopt_compression, decoded by libmeshoptimizer (meshopt.c), and meshes that it
 * simplifies; a build without it has meshopt_none.c. Only functions that its versions 0.18 and
 * later have. */
#ifndef GN_SCENE_GLTF_MESHOPT_H
#define GN_SCENE_GLTF_MESHOPT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

enum gn_meshopt_mode { GN_MESHOPT_ATTRIBUTES, GN_MESHOPT_TRIANGLES, GN_MESHOPT_INDICES };
enum gn_meshopt_filter {
    GN_MESHOPT_NO_FILTER,
    GN_MESHOPT_OCTAHEDRAL,
    GN_MESHOPT_QUATERNION,
    GN_MESHOPT_EXPONENTIAL
};
struct gn_meshopt_stream {
    const uint8_t *data;
    size_t size;          /* of the compressed data in bytes */
    size_t count, stride; /* elements, and the bytes of each */
    enum gn_meshopt_mode mode;
    enum gn_meshopt_filter filter;
};

bool gn_meshopt_is_read(void); /* false: this build has no decoder */
/* Into out, count x stride bytes, aligned for any type. Stride, count and filter are what the
 * extension allows for the mode. Decoded indices may have any value. */
bool gn_meshopt_decode(const struct gn_meshopt_stream *stream, void *out, struct gn_err *err);

/* Collapses edges where that moves the surface by at most `error_m`, by its quadrics, into out,
 * which may be the same; returns how many corners are left. No vertex moves; those of open edges
 * stay, and of seams both sides go together. *error_m becomes the largest move. Without the library
 * nothing changes. */
size_t gn_meshopt_simplify(uint32_t *out, const uint32_t *corners, size_t count,
                           const float *positions, size_t vertex_count, float *error_m);

#endif
