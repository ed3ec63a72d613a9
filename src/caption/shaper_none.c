#include "caption/shaper.h"

bool gn_shaper_open(struct gn_err *err) {
    return gn_fail(err, "this gnomon was built without libraqm (libraqm-dev)");
}

size_t gn_shaper_run(const uint32_t *codes, void *const *faces, size_t count,
                     struct gn_shaper_glyph *out, size_t most, int32_t *width) {
    (void)codes, (void)faces, (void)count, (void)out, (void)most, (void)width;
    return 0;
}
