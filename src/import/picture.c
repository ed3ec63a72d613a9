/* Images are copied unchanged. Only alpha is examined, and a separate opacity map is merged into
 * the base image's alpha, where glTF expects it. */
#include <stdlib.h>
#include <string.h>

#include "image/format.h"
#include "image/packing.h"
#include "image/write.h"
#include "import/private.h"

enum { MOST_TEXELS = 67108864, MOST_DECODED = 10 }; /* of one; of all, as so many of the largest */

struct pixels {
    uint32_t px[2];
    uint8_t *rgba;
    bool has_alpha;
};

const char *gn_import_picture_type(const struct gn_bytes *picture) {
    const enum gn_format kind = gn_format_of(picture->data, picture->size);
    return kind == GN_FORMAT_PNG || kind == GN_FORMAT_JPEG ? gn_format_mime(kind) : NULL;
}

/* Of a PNG or a JPEG that may be decoded, which counts as done. */
static bool open_picture(struct gn_import *import, const struct gn_bytes *picture,
                         struct gn_picture_file *file) {
    struct gn_err unused;
    *file = (struct gn_picture_file){.data = picture->data, .size = picture->size};
    file->kind = gn_format_of(picture->data, picture->size);
    if (!gn_import_picture_type(picture) || !gn_picture_size(file, &unused)) return false;
    const uint64_t texels = (uint64_t)file->px[0] * file->px[1];
    if (texels == 0 || texels > MOST_TEXELS ||
        import->read_texels + texels > (uint64_t)MOST_DECODED * MOST_TEXELS)
        return false;
    import->read_texels += texels;
    return true;
}

static bool has_alpha(const struct gn_picture_file *file) {
    return file->kind == GN_FORMAT_PNG && gn_png_has_alpha(file->data, file->size);
}

/* Halved until its texels are a share of the limit on memory that leaves room for three of them. */
static bool read_pixels(struct gn_import *import, const struct gn_bytes *picture,
                        struct pixels *out) {
    struct gn_err unused;
    struct gn_picture_file file;
    *out = (struct pixels){0};
    if (!open_picture(import, picture, &file)) return false;
    const uint64_t most = ((uint64_t)import->opts->memory_mb << 20) / 32;
    uint32_t level = 0;
    do
        for (int k = 0; k < 2; k++) out->px[k] = gn_level_px(file.px[k], level);
    while ((uint64_t)out->px[0] * out->px[1] > most && ++level);
    const uint32_t shrinks = gn_picture_most_shrink(&file);
    out->has_alpha = has_alpha(&file);
    out->rgba = gn_import_alloc(4 * (size_t)out->px[0] * out->px[1]);
    if (gn_picture_decode(&file, level < shrinks ? level : shrinks, GN_SCALE_COLOR, out->rgba,
                          out->px, &unused))
        return true;
    free(out->rgba);
    *out = (struct pixels){0};
    return false;
}

/* ---- alpha ---- */

struct count { /* of texels that are nearly clear, and of those between */
    uint32_t width_px;
    size_t clear, soft;
};

static void count_row(void *user, const uint8_t *rgba) {
    struct count *count = user;
    for (uint32_t x = 0; x < count->width_px; x++) {
        count->clear += rgba[4 * x + 3] < 25;
        count->soft += rgba[4 * x + 3] >= 25 && rgba[4 * x + 3] < 230;
    }
}

struct gn_import_alpha gn_import_picture_alpha(struct gn_import *import,
                                               const struct gn_bytes *picture) {
    struct count count = {0};
    struct gn_picture_file file;
    struct gn_err unused;
    struct pixels pixels;
    if (!gn_import_picture_type(picture) || !open_picture(import, picture, &file) ||
        !has_alpha(&file))
        return (struct gn_import_alpha){0};
    count.width_px = file.px[0];
    if (!gn_png_is_interlaced(file.data)) {
        if (!gn_png_rows(file.data, file.size, file.px, file.px[1], count_row, &count, &unused))
            count = (struct count){0};
    } else if (read_pixels(import, picture, &pixels)) {
        count.width_px = pixels.px[0];
        for (size_t y = 0; y < pixels.px[1]; y++)
            count_row(&count, pixels.rgba + 4 * y * pixels.px[0]);
        free(pixels.rgba);
    }
    /* foliage and fences have few soft texels around holes; glass is soft everywhere */
    return (struct gn_import_alpha){.has_alpha = count.clear + count.soft > 0,
                                    .soft = 2 * count.soft > count.clear};
}

/* ---- opacity ---- */

bool gn_import_picture_merge(struct gn_import *import, const struct gn_bytes *base,
                             const struct gn_bytes *opacity, struct gn_bytes *png) {
    uint8_t white[4] = {255, 255, 255, 255};
    struct pixels alpha, colour = {.px = {1, 1}, .rgba = white};
    *png = (struct gn_bytes){0};
    if (!read_pixels(import, opacity, &alpha)) return false;
    bool ok = !base || read_pixels(import, base, &colour);
    if (ok) { /* both are resampled to the larger size, nearest texel */
        const struct pixels *larger = alpha.px[0] > colour.px[0] ? &alpha : &colour;
        struct pixels both = {.px = {larger->px[0], larger->px[1]}};
        both.rgba = gn_import_alloc(4 * (size_t)both.px[0] * both.px[1]);
        for (size_t i = 0; i < (size_t)both.px[0] * both.px[1]; i++) {
            const size_t x = i % both.px[0], y = i / both.px[0];
            const size_t cx = x * colour.px[0] / both.px[0], cy = y * colour.px[1] / both.px[1],
                         ax = x * alpha.px[0] / both.px[0], ay = y * alpha.px[1] / both.px[1];
            memcpy(both.rgba + 4 * i, colour.rgba + 4 * (cy * colour.px[0] + cx), 3);
            both.rgba[4 * i + 3] =
                alpha.rgba[4 * (ay * alpha.px[0] + ax) + (alpha.has_alpha ? 3 : 0)];
        }
        struct gn_err unused;
        ok = gn_picture_encode_png_rgba(both.rgba, (int)both.px[0], (int)both.px[1], png, &unused);
        if (!ok) gn_bytes_finish(png);
        free(both.rgba);
    }
    free(alpha.rgba);
    if (colour.rgba != white) free(colour.rgba);
    return ok;
}
