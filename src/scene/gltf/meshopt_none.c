/* A build without libmeshoptimizer. */
#include "scene/gltf/meshopt.h"

bool gn_meshopt_is_read(void) { return false; }

bool gn_meshopt_decode(const struct gn_meshopt_stream *stream, void *out, struct gn_err *err) {
    (void)stream, (void)out;
    return gn_fail(err, "this gnomon was built without libmeshoptimizer");
}
