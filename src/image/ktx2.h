/* Reading KTX2 (KTX file format 2.0): one picture with its smaller levels, of 8-bit channels, ETC2
 * or EAC, plain or compressed by zstd (where libzstd was there to build with) or zlib. */
#ifndef GN_IMAGE_KTX2_H
#define GN_IMAGE_KTX2_H

#include "core/err.h"
#include "image/packing.h"
#include "image/read.h"

#define GN_KTX2_BASIS                                                                              \
    "KTX2 of Basis Universal is not read: export the scene with PNG or JPEG pictures; "            \
    "KTX-Software's \"ktx extract --transcode rgba8 in.ktx2 out.png\" makes PNG of it"
#define GN_KTX2_MAGIC "\xabKTX 20\xbb\r\n\x1a\n"

struct gn_ktx2 {
    enum gn_packing packing; /* of what is read: 1 to 3 channels of 8 bits become RGBA */
    uint32_t px[2];
    uint32_t level_count; /* 1 or more, each half as large as the one before */
    bool basis;           /* set with a failure: it is Basis Universal's */
    uint8_t channels;     /* of the file's texels; 4 if it is compressed into blocks */
    uint32_t scheme;      /* of supercompression: 0 none, 2 zstd, 3 zlib */
};

/* Checks the header and where the levels are. */
bool gn_ktx2_open(const uint8_t *data, size_t size, struct gn_ktx2 *out, struct gn_err *err);
/* The levels from `first` on, one behind the other: gn_packing_all_bytes of that level's size. */
bool gn_ktx2_read_levels(const uint8_t *data, size_t size, const struct gn_ktx2 *ktx2,
                         uint32_t first, uint8_t *out, struct gn_err *err);
/* Bytes that it takes beside them. */
uint64_t gn_ktx2_level_work_bytes(const struct gn_ktx2 *ktx2);

/* As in read.h: the largest level alone, which is not compressed into blocks; shrink is 0. */
bool gn_ktx2_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err);
uint64_t gn_ktx2_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]);
bool gn_ktx2_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                  uint8_t *rgba, struct gn_err *err);
uint64_t gn_ktx2_row_bytes(const uint8_t *data, size_t size, const uint32_t px[2]);
bool gn_ktx2_rows(const uint8_t *data, size_t size, const uint32_t px[2], gn_picture_row *row,
                  void *user, struct gn_err *err);

/* Unpacks exactly out_size bytes, or fails; false everywhere in a build without libzstd. */
bool gn_zstd_is_built(void);
bool gn_zstd_unpack(const uint8_t *data, size_t size, uint8_t *out, size_t out_size,
                    struct gn_err *err);

#endif
