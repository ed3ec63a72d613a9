/* Smaller pictures by the mean of 2 x 2 texels, in linear light where they are sRGB. For pictures
 * larger than the GPU accepts, and for all levels with a software GPU: llvmpipe takes thirty times
 * as long, most of it to compile. No GL. */
#include <stdlib.h>

#include "core/srgb.h"
#include "gl/private.h"

enum { STEPS = sizeof((struct gn_gl_curve *)0)->encode - 1 };

void gn_gl_curve_init(struct gn_gl_curve *curve) {
    for (int i = 0; i < 256; i++) {
        curve->decode[i] = gn_srgb_decode((float)i / 255) * STEPS / 4;
    }
    for (int i = 0; i <= STEPS; i++) {
        curve->encode[i] = (uint8_t)(gn_srgb_encode((float)i / STEPS) * 255 + 0.5f);
    }
}

struct gn_image gn_gl_image_half(const struct gn_image *image) {
    return (struct gn_image){.width_px = image->width_px > 1 ? image->width_px / 2 : 1,
                             .height_px = image->height_px > 1 ? image->height_px / 2 : 1};
}

void gn_gl_image_halve_rows(const struct gn_gl_curve *curve, const struct gn_image *image,
                            uint32_t first, uint32_t count, bool srgb, uint8_t *out) {
    const uint32_t width = gn_gl_image_half(image).width_px;
    const size_t right = image->width_px > 1 ? 4 : 0;
    const size_t below = image->height_px > 1 ? 4ul * image->width_px : 0;
    uint8_t *to = out + 4ul * first * width;
    for (uint32_t y = first; y < first + count; y++)
        for (uint32_t x = 0; x < width; x++, to += 4) {
            const uint8_t *p = image->rgba + 4 * (2ul * y * image->width_px + 2ul * x);
            const uint8_t *const in[4] = {p, p + right, p + below, p + below + right};
            for (int c = 0; c < 4; c++) {
                if (!srgb || c == 3) {
                    to[c] = (uint8_t)((in[0][c] + in[1][c] + in[2][c] + in[3][c] + 2) / 4);
                    continue;
                }
                const float sum = curve->decode[in[0][c]] + curve->decode[in[1][c]] +
                                  curve->decode[in[2][c]] + curve->decode[in[3][c]];
                to[c] = curve->encode[(int)(sum + 0.5f)];
            }
        }
}

uint8_t *gn_gl_image_halve(const struct gn_gl_curve *curve, struct gn_image *image, bool srgb) {
    struct gn_image half = gn_gl_image_half(image);
    uint8_t *out = malloc(4ul * half.width_px * half.height_px);
    if (!out) return NULL;
    gn_gl_image_halve_rows(curve, image, 0, half.height_px, srgb, out);
    half.rgba = out;
    *image = half;
    return out;
}
