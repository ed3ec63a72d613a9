/* Unpacking by libzstd; a build without it has zstd_none.c. */
#include "image/ktx2.h"

#include <zstd.h>

bool gn_zstd_is_built(void) { return true; }

bool gn_zstd_unpack(const uint8_t *data, size_t size, uint8_t *out, size_t out_size,
                    struct gn_err *err) {
    const size_t got = ZSTD_decompress(out, out_size, data, size);
    if (ZSTD_isError(got)) return gn_fail(err, "KTX2: zstd: %s", ZSTD_getErrorName(got));
    return got == out_size ||
           gn_fail(err, "KTX2: zstd: a level has %zu bytes, not %zu", got, out_size);
}
