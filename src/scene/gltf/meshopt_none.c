/* A build without libmeshoptimizer. */
#include <string.h>

#include "scene/gltf/meshopt.h"

bool gn_meshopt_is_read(void) { return false; }

bool gn_meshopt_decode(const struct gn_meshopt_stream *stream, void *out, struct gn_err *err) {
    (void)stream, (void)out;
    return gn_fail(err, "this gnomon was built without libmeshoptimizer");
}

size_t gn_meshopt_simplify(uint32_t *out, const uint32_t *corners, size_t count,
                           const float *positions, size_t vertex_count, float *error_m) {
    (void)positions, (void)vertex_count;
    memmove(out, corners, count * sizeof *out);
    *error_m = 0;
    return count;
}
