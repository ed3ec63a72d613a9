/* Pictures whose cost is not in the size of their file. */
#ifndef GN_TESTS_FUZZ_BOMB_PICTURES_H
#define GN_TESTS_FUZZ_BOMB_PICTURES_H

#include "unit/gltf_maker.h"

/* A PNG of one value in all texels. depth: bits of a grey level, 1 to 16; 32: RGBA of 8 bits.
 * text_size: bytes of a compressed text chunk before the texels. */
struct gn_bomb_png {
    uint32_t width_px, height_px;
    int depth;
    bool interlaced;
    size_t text_size;
    bool ramp; /* instead of one value: the column's number, of 8 bits */
};
struct gn_made gn_bomb_png_make(const struct gn_bomb_png *png);

/* A grey progressive JPEG without a flaw: each further scan refines all coefficients, which are 0,
 * in 15 bits for 16384 blocks. */
struct gn_made gn_bomb_jpeg_scans(int side, int scans);
/* A progressive JPEG of one colour; samplings: an enum TJSAMP. */
struct gn_made gn_bomb_jpeg_progressive(int width, int height, int sampling);

/* Of one value in all texels, in a few bytes: JPEG whose arithmetic-coded data ends at once,
 * lossless WebP whose symbols take no bits, KTX2 of zlib. components: 1 or 3; of KTX2 1 to 4. */
struct gn_made gn_bomb_jpeg_arithmetic(int width, int height, int components, bool progressive);
struct gn_made gn_bomb_webp(int width, int height);
struct gn_made gn_bomb_ktx2(int width, int height, int channels);

#endif
