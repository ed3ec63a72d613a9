/* KTX2, by its specification (Khronos, KTX 2.0, sections 3 and 4). All of it is little-endian. */
#include "image/ktx2.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "core/file.h"

enum { HEADER = 80, LEVEL = 24, LEVELS_MAX = 32 };
enum scheme { SCHEME_NONE, SCHEME_BASIS, SCHEME_ZSTD, SCHEME_ZLIB };
enum { MODEL_ETC1S = 163, MODEL_UASTC = 166 };       /* of the data format descriptor */
enum { WORK_BYTES = 1 << 18, ZLIB_BYTES = 1 << 16 }; /* a decoder's own, at the most */

static const struct format { /* of Vulkan; that and the next in sRGB mean the same here */
    uint32_t vk, srgb;
    enum gn_packing packing;
    uint8_t channels;
} formats[] = {{9, 15, GN_PACKING_RGBA8, 1},           {16, 22, GN_PACKING_RGBA8, 2},
               {23, 29, GN_PACKING_RGBA8, 3},          {37, 43, GN_PACKING_RGBA8, 4},
               {147, 148, GN_PACKING_ETC2_RGB, 4},     {149, 150, GN_PACKING_ETC2_RGBA1, 4},
               {151, 152, GN_PACKING_ETC2_RGBA, 4},    {153, 153, GN_PACKING_EAC_R, 4},
               {154, 154, GN_PACKING_EAC_R_SIGNED, 4}, {155, 155, GN_PACKING_EAC_RG, 4},
               {156, 156, GN_PACKING_EAC_RG_SIGNED, 4}};

static uint64_t read_u64(const uint8_t *p) {
    return gn_u32_at(p) | (uint64_t)gn_u32_at(p + 4) << 32;
}

/* ---- the header ---- */

static bool is_basis(const uint8_t *data, size_t size, uint32_t vk, uint32_t scheme) {
    enum { MODEL_AT = 12 }; /* behind the descriptor's size and two words */
    const uint32_t at = gn_u32_at(data + 48);
    const int model =
        at >= HEADER && size > MODEL_AT && at < size - MODEL_AT ? data[at + MODEL_AT] : 0;
    return scheme == SCHEME_BASIS || (vk == 0 && (model == MODEL_ETC1S || model == MODEL_UASTC));
}

static bool find_format(uint32_t vk, struct gn_ktx2 *out) {
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (formats[i].vk != vk && formats[i].srgb != vk) continue;
        out->packing = formats[i].packing;
        out->channels = formats[i].channels;
        return true;
    }
    return false;
}

static uint64_t file_bytes(const struct gn_ktx2 *k, uint32_t level) {
    return gn_packing_bytes(k->packing, k->px, level) / 4 * k->channels;
}

static bool check_level(const uint8_t *data, size_t size, const struct gn_ktx2 *k, uint32_t i,
                        struct gn_err *err) {
    const uint8_t *entry = data + HEADER + (size_t)LEVEL * i;
    const uint64_t at = read_u64(entry), bytes = read_u64(entry + 8), all = read_u64(entry + 16);
    const uint64_t right = file_bytes(k, i);
    if (at > size || bytes > size - at)
        return gn_fail(err, "KTX2: level %" PRIu32 " lies outside of the file: truncated?", i);
    if (all != right || (k->scheme == SCHEME_NONE && bytes != right))
        return gn_fail(err, "KTX2: level %" PRIu32 " of %" PRIu64 " bytes, not %" PRIu64, i,
                       all != right ? all : bytes, right);
    return true;
}

bool gn_ktx2_open(const uint8_t *data, size_t size, struct gn_ktx2 *out, struct gn_err *err) {
    *out = (struct gn_ktx2){0};
    if (size < HEADER || memcmp(data, GN_KTX2_MAGIC, 12) != 0)
        return gn_fail(err, "KTX2: truncated, or no KTX2");
    const uint32_t vk = gn_u32_at(data + 12), depth = gn_u32_at(data + 28);
    const uint32_t layers = gn_u32_at(data + 32), faces = gn_u32_at(data + 36);
    const uint32_t levels = gn_u32_at(data + 40);
    out->scheme = gn_u32_at(data + 44);
    out->px[0] = gn_u32_at(data + 20);
    out->px[1] = gn_u32_at(data + 24);
    out->level_count = levels > 0 ? levels : 1;
    out->basis = is_basis(data, size, vk, out->scheme);
    if (out->basis) return gn_fail(err, "%s", GN_KTX2_BASIS);
    if (!find_format(vk, out))
        return gn_fail(err,
                       "KTX2: texels of vkFormat %" PRIu32 " are not read, only 8-bit channels, "
                       "ETC2 and EAC",
                       vk);
    if (out->scheme != SCHEME_NONE && out->scheme != SCHEME_ZSTD && out->scheme != SCHEME_ZLIB)
        return gn_fail(err, "KTX2: supercompression scheme %" PRIu32 " is not read", out->scheme);
    if (out->px[0] == 0 || out->px[1] == 0) return gn_fail(err, "KTX2: width or height is 0");
    if (depth > 0 || layers > 1 || faces != 1)
        return gn_fail(err, "KTX2: a volume, an array or a cube; one picture is read");
    const uint32_t longer = out->px[0] > out->px[1] ? out->px[0] : out->px[1];
    if (longer > 1u << 20 || out->level_count > LEVELS_MAX || longer >> (out->level_count - 1) == 0)
        return gn_fail(err, "KTX2: %" PRIu32 " levels of %" PRIu32 "x%" PRIu32 " texels", levels,
                       out->px[0], out->px[1]);
    if (size - HEADER < (size_t)LEVEL * out->level_count)
        return gn_fail(err, "KTX2: truncated within the list of levels");
    for (uint32_t i = 0; i < out->level_count; i++)
        if (!check_level(data, size, out, i, err)) return false;
    return true;
}

/* ---- the levels ---- */

static bool unpack_zlib(const uint8_t *data, size_t size, uint8_t *out, size_t out_size,
                        struct gn_err *err) {
    uLongf got = out_size;
    const int status = uncompress(out, &got, data, size);
    return (status == Z_OK && got == out_size) ||
           gn_fail(err, "KTX2: zlib: %s", status == Z_MEM_ERROR ? "out of memory" : "damaged");
}

/* In place, from the end: what is written never reaches what is still to be read. */
static void widen_texels(uint8_t *texels, uint64_t count, unsigned channels) {
    for (uint64_t i = count; i-- > 0;) {
        uint8_t in[4] = {0, 0, 0, 255};
        memcpy(in, texels + i * channels, channels);
        memcpy(texels + 4 * i, in, 4);
    }
}

static bool read_level(const uint8_t *data, const struct gn_ktx2 *k, uint32_t level, uint8_t *out,
                       struct gn_err *err) {
    const uint8_t *entry = data + HEADER + (size_t)LEVEL * level;
    const uint8_t *from = data + read_u64(entry);
    const size_t size = (size_t)read_u64(entry + 8), bytes = (size_t)file_bytes(k, level);
    if (k->scheme == SCHEME_NONE)
        memcpy(out, from, bytes);
    else if (!(k->scheme == SCHEME_ZSTD ? gn_zstd_unpack : unpack_zlib)(from, size, out, bytes,
                                                                        err))
        return false;
    if (k->channels > 0 && k->channels < 4) widen_texels(out, bytes / k->channels, k->channels);
    return true;
}

bool gn_ktx2_read_levels(const uint8_t *data, size_t size, const struct gn_ktx2 *ktx2,
                         uint32_t first, uint8_t *out, struct gn_err *err) {
    (void)size; /* gn_ktx2_open has checked it */
    for (uint32_t i = first; i < ktx2->level_count; i++) {
        if (!read_level(data, ktx2, i, out, err)) return false;
        out += gn_packing_bytes(ktx2->packing, ktx2->px, i);
    }
    return true;
}

uint64_t gn_ktx2_level_work_bytes(const struct gn_ktx2 *ktx2) {
    return ktx2->scheme == SCHEME_NONE ? 0 : ktx2->scheme == SCHEME_ZSTD ? WORK_BYTES : ZLIB_BYTES;
}

/* ---- one picture ---- */

bool gn_ktx2_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err) {
    struct gn_ktx2 ktx2;
    if (!gn_ktx2_open(data, size, &ktx2, err)) return false;
    px[0] = ktx2.px[0];
    px[1] = ktx2.px[1];
    return true;
}

uint64_t gn_ktx2_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]) {
    (void)data, (void)size, (void)px;
    return WORK_BYTES;
}

static bool open_pixels(const uint8_t *data, size_t size, struct gn_ktx2 *ktx2,
                        struct gn_err *err) {
    return gn_ktx2_open(data, size, ktx2, err) &&
           (ktx2->packing == GN_PACKING_RGBA8 ||
            gn_fail(err, "KTX2: %s goes to the GPU only", gn_packing_names[ktx2->packing]));
}

bool gn_ktx2_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                  uint8_t *rgba, struct gn_err *err) {
    struct gn_ktx2 ktx2;
    (void)px, (void)shrink;
    return open_pixels(data, size, &ktx2, err) && read_level(data, &ktx2, 0, rgba, err);
}

/* zstd has no rows: its level is unpacked as a whole. */
uint64_t gn_ktx2_row_bytes(const uint8_t *data, size_t size, const uint32_t px[2]) {
    struct gn_ktx2 ktx2;
    const bool whole = gn_ktx2_open(data, size, &ktx2, NULL) && ktx2.scheme == SCHEME_ZSTD;
    return WORK_BYTES + UINT64_C(8) * px[0] + (whole ? file_bytes(&ktx2, 0) : 0);
}

struct unpacker {
    uint32_t scheme;
    const uint8_t *next; /* the row, unless it is zlib's */
    uint8_t *whole;      /* zstd's */
    z_stream zlib;
};

static bool open_unpacker(struct unpacker *u, const uint8_t *data, const struct gn_ktx2 *k,
                          struct gn_err *err) {
    const uint8_t *entry = data + HEADER, *from = data + read_u64(entry);
    const size_t size = (size_t)read_u64(entry + 8), bytes = (size_t)file_bytes(k, 0);
    *u = (struct unpacker){.scheme = k->scheme, .next = from};
    if (k->scheme == SCHEME_ZLIB) {
        u->zlib.next_in = (Bytef *)(uintptr_t)from;
        u->zlib.avail_in = size < UINT_MAX ? (uInt)size : UINT_MAX;
        return inflateInit(&u->zlib) == Z_OK || gn_fail(err, "KTX2: zlib: out of memory");
    }
    if (k->scheme != SCHEME_ZSTD) return true;
    u->next = u->whole = malloc(bytes);
    return u->whole ? gn_zstd_unpack(from, size, u->whole, bytes, err)
                    : gn_fail(err, "KTX2: out of memory");
}

static bool unpack_row(struct unpacker *u, uint8_t *out, size_t bytes, struct gn_err *err) {
    if (u->scheme != SCHEME_ZLIB) {
        memcpy(out, u->next, bytes);
        u->next += bytes;
        return true;
    }
    u->zlib.next_out = out;
    u->zlib.avail_out = (uInt)bytes;
    const int status = inflate(&u->zlib, Z_SYNC_FLUSH);
    return ((status == Z_OK || status == Z_STREAM_END) && u->zlib.avail_out == 0) ||
           gn_fail(err, "KTX2: zlib: damaged");
}

bool gn_ktx2_rows(const uint8_t *data, size_t size, const uint32_t px[2], gn_picture_row *row,
                  void *user, struct gn_err *err) {
    struct gn_ktx2 k;
    struct unpacker unpacker = {0};
    if (!open_pixels(data, size, &k, err)) return false;
    uint8_t *texels = malloc((size_t)4 * px[0]);
    if (!texels) return gn_fail(err, "KTX2: out of memory");
    const bool opened = open_unpacker(&unpacker, data, &k, err);
    bool done = opened;
    for (uint32_t y = 0; done && y < px[1]; y++) {
        done = unpack_row(&unpacker, texels, (size_t)k.channels * px[0], err);
        if (!done) break;
        if (k.channels < 4) widen_texels(texels, px[0], k.channels);
        row(user, texels);
    }
    if (opened && k.scheme == SCHEME_ZLIB) inflateEnd(&unpacker.zlib);
    free(unpacker.whole);
    free(texels);
    return done;
}
