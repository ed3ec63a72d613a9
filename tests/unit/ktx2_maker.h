/* Makes KTX2 files for tests, and blocks of ETC2 of one colour. */
#ifndef GN_TESTS_UNIT_KTX2_MAKER_H
#define GN_TESTS_UNIT_KTX2_MAKER_H

#include "unit/gltf_maker.h"

enum { GN_VK_R8 = 9, GN_VK_RGBA8 = 37, GN_VK_ETC2_RGB_SRGB = 148, GN_VK_ETC2_RGBA_SRGB = 152 };
enum { GN_KTX2_PLAIN, GN_KTX2_BASIS_LZ, GN_KTX2_ZSTD, GN_KTX2_ZLIB };

struct gn_ktx2_spec {
    uint32_t vk, px[2];
    uint32_t levels; /* as the header has it; 0 has one, too */
    uint32_t scheme;
    const uint8_t *units; /* a texel or a block for each level, which has no other */
    uint32_t unit_bytes, unit_px;
    uint8_t model; /* of the data format descriptor */
};
struct gn_made gn_maker_ktx2(const struct gn_ktx2_spec *spec);

/* A block of ETC2 RGB: 17 n + 2 of each channel, n of 0 to 14; with alpha 16 bytes, the alpha
 * first. */
void gn_maker_etc2(const uint8_t n[3], uint8_t block[8]);
void gn_maker_etc2_alpha(const uint8_t n[3], uint8_t alpha, uint8_t block[16]);

/* Levels of ETC2 RGBA in sRGB, each of one colour: of 2 (level + 1) in red, compressed. */
struct gn_made gn_maker_ktx2_etc2(uint32_t width, uint32_t height, uint32_t levels, uint32_t scheme,
                                  uint8_t alpha);

#endif
