/* Images are copied unchanged. Only alpha is examined, and a separate opacity map is merged into
 * the base image's alpha, where glTF expects it. */
#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

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

static bool fits_limit(uint64_t width, uint64_t height) {
    return width && height && width * height <= MOST_TEXELS;
}

static bool read_png(const struct gn_bytes *picture, struct pixels *out) {
    png_image png = {.version = PNG_IMAGE_VERSION};
    bool ok = png_image_begin_read_from_memory(&png, picture->data, picture->size) &&
              fits_limit(png.width, png.height);
    if (ok) {
        *out = (struct pixels){.width_px = png.width,
                               .height_px = png.height,
                               .has_alpha = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0};
        png.format = PNG_FORMAT_RGBA;
        out->rgba = gn_import_alloc(4 * (size_t)png.width * png.height);
        ok = png_image_finish_read(&png, NULL, out->rgba, 0, NULL);
    }
    png_image_free(&png);
    return ok;
}

static bool read_jpeg(const struct gn_bytes *picture, struct pixels *out) {
    tjhandle jpeg = tjInitDecompress();
    int width = 0, height = 0, sampling, space;
    bool ok = jpeg &&
              tjDecompressHeader3(jpeg, picture->data, picture->size, &width, &height, &sampling,
                                  &space) == 0 &&
              width > 0 && height > 0 && fits_limit((uint64_t)width, (uint64_t)height);
    if (ok) {
        *out = (struct pixels){.width_px = (uint32_t)width, .height_px = (uint32_t)height};
        out->rgba = gn_import_alloc(4 * (size_t)width * (size_t)height);
        ok = tjDecompress2(jpeg, picture->data, picture->size, out->rgba, width, 0, height,
                           TJPF_RGBA, TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING) == 0;
    }
    if (jpeg) tjDestroy(jpeg);
    return ok;
}

static bool read_pixels(const struct gn_bytes *picture, struct pixels *out) {
    *out = (struct pixels){0};
    const char *type = gn_import_picture_type(picture);
    bool ok =
        type && (strcmp(type, "image/png") == 0 ? read_png(picture, out) : read_jpeg(picture, out));
    if (ok) return true;
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
        png_image header = {.version = PNG_IMAGE_VERSION,
                            .width = both.width_px,
                            .height = both.height_px,
                            .format = PNG_FORMAT_RGBA,
                            .flags = PNG_IMAGE_FLAG_FAST};
        png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
        png->data = gn_import_alloc(size);
        ok = png_image_write_to_memory(&header, png->data, &size, 0, both.rgba, 0, NULL);
        png->size = ok ? size : 0;
        free(both.rgba);
    }
    free(alpha.rgba);
    if (colour.rgba != white) free(colour.rgba);
    return ok;
}
