/* How the texels of a picture lie in memory where it goes to the GPU as its file has it: those
 * formats of KTX2 that every OpenGL ES 3.0 reads. */
#ifndef GN_IMAGE_PACKING_H
#define GN_IMAGE_PACKING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum gn_packing {
    GN_PACKING_RGBA8,    /* rows of texels, without gaps */
    GN_PACKING_ETC2_RGB, /* from here on: rows of blocks of 4 x 4 texels. ETC1 is a part of it */
    GN_PACKING_ETC2_RGBA1,
    GN_PACKING_ETC2_RGBA,
    GN_PACKING_EAC_R,
    GN_PACKING_EAC_R_SIGNED,
    GN_PACKING_EAC_RG,
    GN_PACKING_EAC_RG_SIGNED,
    GN_PACKING_COUNT,
};
extern const char *const gn_packing_names[GN_PACKING_COUNT]; /* "RGBA8", "ETC2 RGB", .. */

/* Sides of a level, 0 being the largest; at least 1. */
static inline uint32_t gn_level_px(uint32_t px, uint32_t level) {
    return level < 32 && px >> level > 0 ? px >> level : 1;
}
/* Bytes of a row of texels or blocks of a level that wide, and the number of such rows. */
uint64_t gn_packing_row_bytes(enum gn_packing packing, uint32_t width_px);
uint32_t gn_packing_rows(enum gn_packing packing, uint32_t height_px);
/* Bytes of the level, and of so many from level 0 on. */
uint64_t gn_packing_bytes(enum gn_packing packing, const uint32_t px[2], uint32_t level);
uint64_t gn_packing_all_bytes(enum gn_packing packing, const uint32_t px[2], uint32_t count);
/* Of the texel x, y of a level of that width. */
uint8_t gn_packing_alpha(enum gn_packing packing, const uint8_t *level, uint32_t width_px,
                         uint32_t x, uint32_t y);
/* Some texel of that level is not opaque. */
bool gn_packing_has_alpha(enum gn_packing packing, const uint8_t *level, const uint32_t px[2]);

#endif
