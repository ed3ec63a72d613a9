#include "unit/ktx2_maker.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "image/ktx2.h"

static void put_u32(uint8_t *at, uint32_t value) {
    for (int i = 0; i < 4; i++) at[i] = (uint8_t)(value >> (8 * i));
}

static void put_u64(uint8_t *at, uint64_t value) {
    put_u32(at, (uint32_t)value);
    put_u32(at + 4, (uint32_t)(value >> 32));
}

/* A frame of raw blocks (RFC 8878): it needs no compressor. */
static size_t frame_zstd(const uint8_t *data, size_t size, uint8_t *out) {
    enum { BLOCK = 100000 };
    uint8_t *at = out;
    put_u32(at, 0xfd2fb528u);
    at[4] = 0xa0; /* a single segment, its size in 4 bytes */
    put_u32(at + 5, (uint32_t)size);
    at += 9;
    for (size_t done = 0, n; done < size; done += n) {
        n = size - done < BLOCK ? size - done : BLOCK;
        const uint32_t head = (uint32_t)n << 3 | (done + n == size);
        for (int i = 0; i < 3; i++) *at++ = (uint8_t)(head >> (8 * i));
        memcpy(at, data + done, n);
        at += n;
    }
    return (size_t)(at - out);
}

static size_t pack(uint32_t scheme, const uint8_t *data, size_t size, uint8_t *out) {
    if (scheme == GN_KTX2_ZSTD) return frame_zstd(data, size, out);
    uLongf packed = compressBound(size);
    if (scheme == GN_KTX2_ZLIB) compress(out, &packed, data, size);
    if (scheme == GN_KTX2_ZLIB) return packed;
    memcpy(out, data, size);
    return size;
}

struct gn_made gn_maker_ktx2(const struct gn_ktx2_spec *spec) {
    enum { HEADER = 80, LEVEL = 24, DESCRIPTOR = 44, ROOM = 1000 };
    const uint32_t count = spec->levels ? spec->levels : 1, side = spec->unit_px;
    const size_t start = HEADER + LEVEL * (size_t)count;
    const size_t units = ((size_t)spec->px[0] / side + 1) * ((size_t)spec->px[1] / side + 1);
    uint8_t *plain = calloc(units, spec->unit_bytes);
    struct gn_made made = {
        calloc(start + DESCRIPTOR + count * (2 * units * spec->unit_bytes + ROOM), 1),
        start + DESCRIPTOR};
    memcpy(made.data, GN_KTX2_MAGIC, 12);
    const uint32_t head[] = {spec->vk,  1, spec->px[0],  spec->px[1],  0,
                             0,         1, spec->levels, spec->scheme, (uint32_t)start,
                             DESCRIPTOR};
    for (size_t i = 0; i < sizeof head / sizeof head[0]; i++)
        put_u32(made.data + 12 + 4 * i, head[i]);
    put_u32(made.data + start, DESCRIPTOR);
    made.data[start + 12] = spec->model;
    for (uint32_t level = 0; level < count; level++) {
        const size_t across = (gn_level_px(spec->px[0], level) + side - 1) / side;
        const size_t down = (gn_level_px(spec->px[1], level) + side - 1) / side;
        const size_t size = across * down * spec->unit_bytes;
        for (size_t i = 0; i < across * down; i++)
            memcpy(plain + i * spec->unit_bytes, spec->units + level * spec->unit_bytes,
                   spec->unit_bytes);
        const size_t packed = pack(spec->scheme, plain, size, made.data + made.size);
        uint8_t *entry = made.data + HEADER + LEVEL * level;
        put_u64(entry, made.size);
        put_u64(entry + 8, packed);
        put_u64(entry + 16, size);
        made.size += packed;
    }
    free(plain);
    return made;
}

/* Both halves of the block have the base n, and all texels the modifier + 2 of the first table. */
void gn_maker_etc2(const uint8_t n[3], uint8_t block[8]) {
    memset(block, 0, 8);
    for (int k = 0; k < 3; k++) block[k] = (uint8_t)(n[k] << 4 | n[k]);
}

/* The modifier 0 of the 14th table. */
void gn_maker_etc2_alpha(const uint8_t n[3], uint8_t alpha, uint8_t block[16]) {
    static const uint8_t all_4[6] = {0x92, 0x49, 0x24, 0x92, 0x49, 0x24};
    block[0] = alpha;
    block[1] = 1 << 4 | 13;
    memcpy(block + 2, all_4, sizeof all_4);
    gn_maker_etc2(n, block + 8);
}

struct gn_made gn_maker_ktx2_etc2(uint32_t width, uint32_t height, uint32_t levels, uint32_t scheme,
                                  uint8_t alpha) {
    enum { LEVELS = 7 };
    uint8_t blocks[LEVELS][16];
    for (uint8_t i = 0; i < LEVELS; i++)
        gn_maker_etc2_alpha((uint8_t[]){(uint8_t)(2 * (i + 1)), 7, 3}, alpha, blocks[i]);
    const struct gn_ktx2_spec spec = {.vk = GN_VK_ETC2_RGBA_SRGB,
                                      .px = {width, height},
                                      .levels = levels,
                                      .scheme = scheme,
                                      .units = blocks[0],
                                      .unit_bytes = 16,
                                      .unit_px = 4};
    return gn_maker_ktx2(&spec);
}
