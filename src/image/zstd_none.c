/* A build without libzstd. */
#include "image/ktx2.h"

bool gn_zstd_is_built(void) { return false; }

bool gn_zstd_unpack(const uint8_t *data, size_t size, uint8_t *out, size_t out_size,
                    struct gn_err *err) {
    (void)data, (void)size, (void)out, (void)out_size;
    return gn_fail(err, "KTX2: compressed by zstd: this gnomon was built without libzstd");
}
