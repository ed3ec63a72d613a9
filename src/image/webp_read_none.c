/* A build without libwebp. */
#include "image/read.h"

bool gn_webp_is_read(void) { return false; }

bool gn_webp_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err) {
    (void)data, (void)size, (void)px;
    return gn_fail(err, "WebP is not read: this gnomon was built without libwebp");
}

uint64_t gn_webp_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]) {
    (void)data, (void)size, (void)px;
    return 0;
}

bool gn_webp_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                  uint8_t *rgba, struct gn_err *err) {
    (void)rgba, (void)shrink;
    return gn_webp_size(data, size, (uint32_t[2]){px[0], px[1]}, err);
}
