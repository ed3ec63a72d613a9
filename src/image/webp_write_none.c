#include "image/write.h"

bool gn_webp_is_lossless(const uint8_t *data, size_t size) {
    (void)data, (void)size;
    return false;
}

bool gn_picture_encode_webp(const uint8_t *rgba, int width_px, int height_px, bool lossless,
                            struct gn_bytes *out, struct gn_err *err) {
    (void)rgba, (void)width_px, (void)height_px, (void)lossless, (void)out;
    return gn_fail(err, "WebP: this build has no libwebp");
}
