/* Images are copied unchanged. Only alpha is examined, and a separate opacity map is merged into
 * the base image's alpha, where glTF expects it. */
#include <stdlib.h>
#include <string.h>

#include "image/read.h"
#include "image/write.h"
#include "import/private.h"

enum { MOST_TEXELS = 67108864 };

struct pixels {
    uint32_t width_px, height_px;
    uint8_t *rgba;
    bool has_alpha;
};

const char *gn_import_picture_type(const struct gn_bytes *picture) {
    if (picture->size >= 8 && memcmp(picture->data, "\x89PNG\r\n\x1a\n", 8) == 0)
        return "image/png";
    if (picture->size >= 3 && memcmp(picture->data, "\xff\xd8\xff", 3) == 0) return "image/jpeg";
    return NULL;
}

static bool read_pixels(const struct gn_bytes *picture, struct pixels *out) {
    struct gn_err unused;
    uint32_t px[2];
    const uint8_t *data = picture->data;
    const char *type = gn_import_picture_type(picture);
    const bool is_png = type && strcmp(type, "image/png") == 0;
    *out = (struct pixels){0};
    if (!type || !(is_png ? gn_png_size : gn_jpeg_size)(data, picture->size, px, &unused) ||
        px[0] == 0 || px[1] == 0 || (uint64_t)px[0] * px[1] > MOST_TEXELS)
        return false;
    out->width_px = px[0];
    out->height_px = px[1];
    out->has_alpha = is_png && gn_png_has_alpha(data, picture->size);
    out->rgba = gn_import_alloc(4 * (size_t)px[0] * px[1]);
    if ((is_png ? gn_png_read : gn_jpeg_read)(data, picture->size, px, 0, out->rgba, &unused))
        return true;
    free(out->rgba);
    *out = (struct pixels){0};
    return false;
}

struct gn_import_alpha gn_import_picture_alpha(const struct gn_bytes *picture) {
    struct pixels pixels = {0};
    size_t clear = 0, soft = 0;
    const char *type = gn_import_picture_type(picture);
    if (type && strcmp(type, "image/png") == 0 && read_pixels(picture, &pixels) && pixels.has_alpha)
        for (size_t i = 0; i < (size_t)pixels.width_px * pixels.height_px; i++) {
            uint8_t alpha = pixels.rgba[4 * i + 3];
            clear += alpha < 25;
            soft += alpha >= 25 && alpha < 230;
        }
    free(pixels.rgba);
    /* foliage and fences have few soft texels around holes; glass is soft everywhere */
    return (struct gn_import_alpha){.has_alpha = clear + soft > 0, .soft = 2 * soft > clear};
}

bool gn_import_picture_merge(const struct gn_bytes *base, const struct gn_bytes *opacity,
                             struct gn_bytes *png) {
    uint8_t white[4] = {255, 255, 255, 255};
    struct pixels alpha, colour = {.width_px = 1, .height_px = 1, .rgba = white};
    *png = (struct gn_bytes){0};
    if (!read_pixels(opacity, &alpha)) return false;
    bool ok = !base || read_pixels(base, &colour);
    if (ok) { /* both are resampled to the larger size, nearest texel */
        const struct pixels *larger = alpha.width_px > colour.width_px ? &alpha : &colour;
        struct pixels both = {.width_px = larger->width_px, .height_px = larger->height_px};
        both.rgba = gn_import_alloc(4 * (size_t)both.width_px * both.height_px);
        for (size_t i = 0; i < (size_t)both.width_px * both.height_px; i++) {
            const size_t x = i % both.width_px, y = i / both.width_px;
            const size_t cx = x * colour.width_px / both.width_px,
                         cy = y * colour.height_px / both.height_px,
                         ax = x * alpha.width_px / both.width_px,
                         ay = y * alpha.height_px / both.height_px;
            memcpy(both.rgba + 4 * i, colour.rgba + 4 * (cy * colour.width_px + cx), 3);
            both.rgba[4 * i + 3] =
                alpha.rgba[4 * (ay * alpha.width_px + ax) + (alpha.has_alpha ? 3 : 0)];
        }
        struct gn_err unused;
        ok = gn_picture_encode_png_rgba(both.rgba, (int)both.width_px, (int)both.height_px, png,
                                        &unused);
        if (!ok) gn_bytes_finish(png);
        free(both.rgba);
    }
    free(alpha.rgba);
    if (colour.rgba != white) free(colour.rgba);
    return ok;
}
