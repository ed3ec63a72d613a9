/* Smaller pictures by the mean of 2 x 2 texels, in linear light where they are sRGB. For pictures
 * larger than the GPU accepts, and for all levels with a software GPU: llvmpipe takes thirty times
 * as long, most of it to compile; for masks always. No GL. */
#include <stdlib.h>
#include <string.h>

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

/* The mean of texels, of colour by alpha: what is clear has no part in it. False: all are clear. */
static bool mix_by_alpha(const struct gn_gl_curve *curve, const uint8_t *const *in, int count,
                         uint8_t to[4]) {
    uint32_t alpha = 0;
    for (int i = 0; i < count; i++) alpha += in[i][3];
    if (alpha == 0) return false;
    for (int c = 0; c < 3; c++) {
        float sum = 0.0f;
        for (int i = 0; i < count; i++) sum += curve->decode[in[i][c]] * (float)in[i][3];
        to[c] = curve->encode[(int)(4.0f * sum / (float)alpha + 0.5f)];
    }
    to[3] = (uint8_t)((alpha + (uint32_t)count / 2) / (uint32_t)count);
    return true;
}

void gn_gl_image_halve_rows(const struct gn_gl_curve *curve, const struct gn_image *image,
                            uint32_t first, uint32_t count, enum gn_gl_texels texels,
                            uint8_t *out) {
    const uint32_t width = gn_gl_image_half(image).width_px;
    const size_t right = image->width_px > 1 ? 4 : 0;
    const size_t below = image->height_px > 1 ? 4ul * image->width_px : 0;
    uint8_t *to = out + 4ul * first * width;
    for (uint32_t y = first; y < first + count; y++)
        for (uint32_t x = 0; x < width; x++, to += 4) {
            const uint8_t *p = image->rgba + 4 * (2ul * y * image->width_px + 2ul * x);
            const uint8_t *const in[4] = {p, p + right, p + below, p + below + right};
            if (texels >= GN_GL_MASK && mix_by_alpha(curve, in, 4, to)) continue;
            for (int c = 0; c < 4; c++) {
                if (texels == GN_GL_DATA || c == 3) {
                    to[c] = (uint8_t)((in[0][c] + in[1][c] + in[2][c] + in[3][c] + 2) / 4);
                    continue;
                }
                const float sum = curve->decode[in[0][c]] + curve->decode[in[1][c]] +
                                  curve->decode[in[2][c]] + curve->decode[in[3][c]];
                to[c] = curve->encode[(int)(sum + 0.5f)];
            }
        }
}

void gn_gl_image_mask_rows(const struct gn_gl_curve *curve, const struct gn_image *image,
                           uint32_t first, uint32_t count, const uint8_t alpha[256], uint8_t *out) {
    const uint32_t width = image->width_px, height = image->height_px;
    for (uint32_t y = first; y < first + count; y++)
        for (uint32_t x = 0; x < width; x++, out += 4) {
            const uint8_t *texel = image->rgba + 4 * ((size_t)y * width + x);
            memcpy(out, texel, 4);
            if (texel[3] == 0) { /* filters mix it with those beside it */
                const uint8_t *in[9];
                for (int i = 0; i < 9; i++) {
                    const uint32_t u = (x + width + (uint32_t)(i % 3) - 1) % width,
                                   v = (y + height + (uint32_t)(i / 3) - 1) % height;
                    in[i] = image->rgba + 4 * ((size_t)v * width + u);
                }
                mix_by_alpha(curve, in, 9, out);
            }
            out[3] = alpha[texel[3]];
        }
}

uint8_t *gn_gl_image_halve(const struct gn_gl_curve *curve, struct gn_image *image,
                           enum gn_gl_texels texels) {
    struct gn_image half = gn_gl_image_half(image);
    uint8_t *out = malloc(4ul * half.width_px * half.height_px);
    if (!out) return NULL;
    gn_gl_image_halve_rows(curve, image, 0, half.height_px, texels, out);
    half.rgba = out;
    *image = half;
    return out;
}
