/* WebP by libwebp; a build without it has webp_read_none.c. */
#include "image/read.h"

#include <webp/decode.h>

static const char *status_text(VP8StatusCode status) {
    switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY: return "out of memory";
    case VP8_STATUS_UNSUPPORTED_FEATURE: return "uses a feature that libwebp does not have";
    case VP8_STATUS_NOT_ENOUGH_DATA: return "cut short";
    default: return "damaged";
    }
}

bool gn_webp_is_read(void) { return true; }

bool gn_webp_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err) {
    WebPBitstreamFeatures features;
    const VP8StatusCode status = WebPGetFeatures(data, size, &features);
    if (status != VP8_STATUS_OK) return gn_fail(err, "WebP: %s", status_text(status));
    if (features.has_animation) return gn_fail(err, "WebP: an animation; save one picture of it");
    if (features.width <= 0 || features.height <= 0)
        return gn_fail(err, "WebP: width or height is 0");
    px[0] = (uint32_t)features.width;
    px[1] = (uint32_t)features.height;
    return true;
}

/* libwebp keeps a lossless picture whole, and the alpha of a lossy one, which is lossless; beside
 * that rows and tables. */
uint64_t gn_webp_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]) {
    enum { TABLE_BYTES = 1 << 20, ROW_BYTES = 256, LOSSY = 1, LOSSLESS_TEXEL = 4 };
    WebPBitstreamFeatures features;
    const bool known = WebPGetFeatures(data, size, &features) == VP8_STATUS_OK;
    const bool lossy = known && features.format == LOSSY;
    const uint64_t each = !lossy ? LOSSLESS_TEXEL : features.has_alpha ? LOSSLESS_TEXEL + 1 : 0;
    return each * px[0] * px[1] + ROW_BYTES * (uint64_t)px[0] + TABLE_BYTES;
}

bool gn_webp_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                  uint8_t *rgba, struct gn_err *err) {
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config)) return gn_fail(err, "WebP: another version of libwebp");
    const int width = (int)gn_shrunk_px(px[0], shrink), height = (int)gn_shrunk_px(px[1], shrink);
    config.options.use_scaling = shrink > 0;
    config.options.scaled_width = width;
    config.options.scaled_height = height;
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA =
        (WebPRGBABuffer){.rgba = rgba, .stride = 4 * width, .size = gn_shrunk_bytes(px, shrink)};
    const VP8StatusCode status = WebPDecode(data, size, &config);
    WebPFreeDecBuffer(&config.output);
    return status == VP8_STATUS_OK || gn_fail(err, "WebP: %s", status_text(status));
}
