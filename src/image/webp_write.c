/* WebP by libwebp; a build without it has webp_write_none.c. */
#include <stdlib.h>
#include <string.h>
#include <webp/decode.h>
#include <webp/encode.h>

#include "image/write.h"

enum { QUALITY = 92 };

bool gn_webp_is_lossless(const uint8_t *data, size_t size) {
    enum { LOSSLESS = 2 };
    WebPBitstreamFeatures features;
    return WebPGetFeatures(data, size, &features) == VP8_STATUS_OK && features.format == LOSSLESS;
}

bool gn_picture_encode_webp(const uint8_t *rgba, int width_px, int height_px, bool lossless,
                            struct gn_bytes *out, struct gn_err *err) {
    uint8_t *data = NULL;
    const size_t size =
        lossless ? WebPEncodeLosslessRGBA(rgba, width_px, height_px, 4 * width_px, &data)
                 : WebPEncodeRGBA(rgba, width_px, height_px, 4 * width_px, QUALITY, &data);
    *out = (struct gn_bytes){.data = size > 0 ? malloc(size) : NULL, .size = size};
    if (out->data) memcpy(out->data, data, size);
    WebPFree(data);
    return out->data || gn_fail(err, "WebP: cannot write a picture of %d x %d: out of memory",
                                width_px, height_px);
}
