/* Sizes of packed levels, and the alpha of their texels (OpenGL ES 3.0, appendix C). */
#include "image/packing.h"

const char *const gn_packing_names[GN_PACKING_COUNT] = {
    [GN_PACKING_RGBA8] = "RGBA8",           [GN_PACKING_ETC2_RGB] = "ETC2 RGB",
    [GN_PACKING_ETC2_RGBA1] = "ETC2 RGBA1", [GN_PACKING_ETC2_RGBA] = "ETC2 RGBA",
    [GN_PACKING_EAC_R] = "EAC R",           [GN_PACKING_EAC_R_SIGNED] = "EAC R signed",
    [GN_PACKING_EAC_RG] = "EAC RG",         [GN_PACKING_EAC_RG_SIGNED] = "EAC RG signed",
};

/* Of a texel of RGBA8, else of a block. */
static const uint8_t unit_bytes[GN_PACKING_COUNT] = {
    [GN_PACKING_RGBA8] = 4,      [GN_PACKING_ETC2_RGB] = 8,       [GN_PACKING_ETC2_RGBA1] = 8,
    [GN_PACKING_ETC2_RGBA] = 16, [GN_PACKING_EAC_R] = 8,          [GN_PACKING_EAC_R_SIGNED] = 8,
    [GN_PACKING_EAC_RG] = 16,    [GN_PACKING_EAC_RG_SIGNED] = 16,
};

static uint32_t unit_px(enum gn_packing packing) { return packing == GN_PACKING_RGBA8 ? 1 : 4; }

uint64_t gn_packing_row_bytes(enum gn_packing packing, uint32_t width_px) {
    const uint32_t side = unit_px(packing);
    return ((uint64_t)width_px + side - 1) / side * unit_bytes[packing];
}

uint32_t gn_packing_rows(enum gn_packing packing, uint32_t height_px) {
    const uint32_t side = unit_px(packing);
    return height_px / side + (height_px % side > 0);
}

uint64_t gn_packing_bytes(enum gn_packing packing, const uint32_t px[2], uint32_t level) {
    return gn_packing_row_bytes(packing, gn_level_px(px[0], level)) *
           gn_packing_rows(packing, gn_level_px(px[1], level));
}

uint64_t gn_packing_all_bytes(enum gn_packing packing, const uint32_t px[2], uint32_t count) {
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < count; i++) bytes += gn_packing_bytes(packing, px, i);
    return bytes;
}

/* ---- alpha ---- */

static uint8_t eac_alpha(const uint8_t block[8], uint32_t texel) {
    static const int modifiers[16][8] = {
        {-3, -6, -9, -15, 2, 5, 8, 14}, {-3, -7, -10, -13, 2, 6, 9, 12},
        {-2, -5, -8, -13, 1, 4, 7, 12}, {-2, -4, -6, -13, 1, 3, 5, 12},
        {-3, -6, -8, -12, 2, 5, 7, 11}, {-3, -7, -9, -11, 2, 6, 8, 10},
        {-4, -7, -8, -11, 3, 6, 7, 10}, {-3, -5, -8, -11, 2, 4, 7, 10},
        {-2, -6, -8, -10, 1, 5, 7, 9},  {-2, -5, -8, -10, 1, 4, 7, 9},
        {-2, -4, -8, -10, 1, 3, 7, 9},  {-2, -5, -7, -10, 1, 4, 6, 9},
        {-3, -4, -7, -10, 2, 3, 6, 9},  {-1, -2, -3, -10, 0, 1, 2, 9},
        {-4, -6, -8, -9, 3, 5, 7, 8},   {-3, -5, -7, -9, 2, 4, 6, 8}};
    uint64_t indices = 0;
    for (int i = 2; i < 8; i++) indices = indices << 8 | block[i];
    const int modifier = modifiers[block[1] & 15][indices >> (45 - 3 * texel) & 7];
    const int alpha = block[0] + modifier * (block[1] >> 4);
    return (uint8_t)(alpha < 0 ? 0 : alpha > 255 ? 255 : alpha);
}

/* A base of 5 bits and its difference of 3 leave the range: a mark of another mode. */
static bool overflows(uint8_t byte) {
    const int sum = (byte >> 3) + (byte & 3) - (byte & 4);
    return sum < 0 || sum > 31;
}

/* Texels of index 2 are holes, unless the block says that it has none, or is planar. */
static uint8_t punched_alpha(const uint8_t block[8], uint32_t texel) {
    const bool opaque = block[3] & 2;
    const bool planar = !overflows(block[0]) && !overflows(block[1]) && overflows(block[2]);
    const unsigned high = (unsigned)(block[4] << 8 | block[5]) >> texel & 1;
    const unsigned low = (unsigned)(block[6] << 8 | block[7]) >> texel & 1;
    return !opaque && !planar && high == 1 && low == 0 ? 0 : 255;
}

uint8_t gn_packing_alpha(enum gn_packing packing, const uint8_t *level, uint32_t width_px,
                         uint32_t x, uint32_t y) {
    const uint32_t side = unit_px(packing), texel = x % side * 4 + y % side;
    const uint8_t *unit = level + gn_packing_row_bytes(packing, width_px) * (y / side) +
                          (uint64_t)unit_bytes[packing] * (x / side);
    switch (packing) {
    case GN_PACKING_RGBA8: return unit[3];
    case GN_PACKING_ETC2_RGBA1: return punched_alpha(unit, texel);
    case GN_PACKING_ETC2_RGBA: return eac_alpha(unit, texel);
    default: return 255;
    }
}

/* Said by the block itself: most are so where a picture is. */
static bool is_opaque_block(enum gn_packing packing, const uint8_t *block) {
    if (packing == GN_PACKING_ETC2_RGBA1) return block[3] & 2;
    return block[0] == 255 && block[1] >> 4 == 0;
}

bool gn_packing_has_alpha(enum gn_packing packing, const uint8_t *level, const uint32_t px[2]) {
    if (packing != GN_PACKING_RGBA8 && packing != GN_PACKING_ETC2_RGBA1 &&
        packing != GN_PACKING_ETC2_RGBA)
        return false;
    const uint64_t units = gn_packing_row_bytes(packing, px[0]) / unit_bytes[packing] *
                           gn_packing_rows(packing, px[1]);
    if (packing == GN_PACKING_RGBA8) {
        for (uint64_t i = 0; i < units; i++)
            if (level[4 * i + 3] != 255) return true;
        return false;
    }
    const uint64_t blocks_wide = gn_packing_row_bytes(packing, px[0]) / unit_bytes[packing];
    for (uint64_t i = 0; i < units; i++) {
        if (is_opaque_block(packing, level + i * unit_bytes[packing])) continue;
        const uint32_t x0 = (uint32_t)(4 * (i % blocks_wide)),
                       y0 = (uint32_t)(4 * (i / blocks_wide));
        for (uint32_t y = y0; y < px[1] && y < y0 + 4; y++)
            for (uint32_t x = x0; x < px[0] && x < x0 + 4; x++)
                if (gn_packing_alpha(packing, level, px[0], x, y) != 255) return true;
    }
    return false;
}
