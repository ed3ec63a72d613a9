#include "image/read.h"

#include <string.h>
#include <turbojpeg.h>

static bool read_header(tjhandle handle, const uint8_t *data, size_t size, int px[2], int *space,
                        struct gn_err *err) {
    int sampling;
    if (tjDecompressHeader3(handle, data, (unsigned long)size, &px[0], &px[1], &sampling, space) ==
        0)
        return true;
    return gn_fail(err, "JPEG: %s", tjGetErrorStr2(handle));
}

/* A scan may be a few bytes, and costs a step for each coefficient of the picture. Usual files have
 * about ten. */
enum { MOST_SCANS = 64 };

struct scans {
    size_t count;
    bool in_parts; /* the coefficients come in several scans, or might: the first one lacks some */
};

/* Start-of-scan markers before the end of the picture (ITU-T T.81, annex B). */
static struct scans find_scans(const uint8_t *data, size_t size) {
    enum { STUFFED = 0x00, RST0 = 0xd0, RST7 = 0xd7, SOI = 0xd8, EOI = 0xd9, SOS = 0xda };
    enum { SOF0 = 0xc0, DHT = 0xc4, JPG = 0xc8, DAC = 0xcc, SOF15 = 0xcf, PROGRESSIVE = 2 };
    struct scans scans = {0};
    uint8_t components = 0;
    for (size_t at = 0; at + 1 < size;) {
        const uint8_t *mark = memchr(data + at, 0xff, size - at - 1);
        if (!mark) break;
        at = (size_t)(mark - data) + 1;
        const uint8_t type = data[at];
        if (type == EOI) break;
        if (type == 0xff) continue; /* a fill byte */
        at++;
        if (type == STUFFED || (type >= RST0 && type <= SOI)) continue;
        if (type >= SOF0 && type <= SOF15 && type != DHT && type != JPG && type != DAC &&
            size - at > 7) {
            components = data[at + 7];
            scans.in_parts |= (type & 3) == PROGRESSIVE;
        }
        if (type == SOS && scans.count++ == 0 && size - at > 2)
            scans.in_parts |= data[at + 2] < components;
        if (size - at >= 2) at += (size_t)(data[at] << 8 | data[at + 1]);
    }
    return scans;
}

bool gn_jpeg_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err) {
    tjhandle handle = tjInitDecompress();
    int read[2] = {0}, space;
    bool done = handle ? read_header(handle, data, size, read, &space, err)
                       : gn_fail(err, "JPEG: %s", tjGetErrorStr2(NULL));
    if (done && (read[0] <= 0 || read[1] <= 0)) done = gn_fail(err, "JPEG: width or height is 0");
    const size_t scans = done ? find_scans(data, size).count : 0;
    if (scans > MOST_SCANS)
        done = gn_fail(err, "JPEG: %zu scans, at most %d are read: save it again, not progressive",
                       scans, MOST_SCANS);
    px[0] = (uint32_t)read[0];
    px[1] = (uint32_t)read[1];
    if (handle) tjDestroy(handle);
    return done;
}

/* Of one that comes in parts libjpeg keeps the coefficients of the whole picture, two bytes each;
 * else some rows. */
uint64_t gn_jpeg_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]) {
    enum { ROW_BYTES = 128 };
    int read[2], sampling = TJSAMP_444, space = 0;
    if (!find_scans(data, size).in_parts) return ROW_BYTES * (uint64_t)px[0];
    tjhandle handle = tjInitDecompress();
    if (handle)
        tjDecompressHeader3(handle, data, (unsigned long)size, &read[0], &read[1], &sampling,
                            &space);
    if (handle) tjDestroy(handle);
    const unsigned long bytes =
        tjBufSizeYUV2((int)px[0], 4, (int)px[1], sampling < 0 ? TJSAMP_444 : sampling);
    const bool inks = space == TJCS_CMYK || space == TJCS_YCCK;
    return bytes == (unsigned long)-1 ? UINT64_MAX / 4 : (uint64_t)bytes * 2 * (inks ? 4 : 3) / 3;
}

/* shrink: by an inverse transform of fewer coefficients. */
static bool decode_jpeg(tjhandle handle, const uint8_t *data, size_t size, const uint32_t px[2],
                        uint32_t shrink, uint8_t *rgba, struct gn_err *err) {
    int read[2], space;
    if (!read_header(handle, data, size, read, &space, err)) return false;
    if ((uint32_t)read[0] != px[0] || (uint32_t)read[1] != px[1])
        return gn_fail(err, "JPEG: size differs from its header");
    bool inks = space == TJCS_CMYK || space == TJCS_YCCK;
    int failed =
        tjDecompress2(handle, data, (unsigned long)size, rgba, (int)gn_shrunk_px(px[0], shrink), 0,
                      (int)gn_shrunk_px(px[1], shrink), inks ? TJPF_CMYK : TJPF_RGBA,
                      TJFLAG_LIMITSCANS | TJFLAG_STOPONWARNING | TJFLAG_ACCURATEDCT);
    if (failed != 0 && tjGetErrorCode(handle) != TJERR_WARNING)
        return gn_fail(err, "JPEG: %s", tjGetErrorStr2(handle));
    if (failed != 0) return gn_fail(err, "JPEG: damaged: %s", tjGetErrorStr2(handle));
    const uint8_t *end = rgba + gn_shrunk_bytes(px, shrink);
    for (uint8_t *p = rgba; inks && p < end; p += 4) { /* Adobe stores CMYK inverted */
        for (int k = 0; k < 3; k++) p[k] = (uint8_t)((p[k] * p[3] + 127) / 255);
        p[3] = 255;
    }
    return true;
}

bool gn_jpeg_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                  uint8_t *rgba, struct gn_err *err) {
    tjhandle handle = tjInitDecompress();
    if (!handle) return gn_fail(err, "JPEG: %s", tjGetErrorStr2(NULL));
    bool done = decode_jpeg(handle, data, size, px, shrink, rgba, err);
    tjDestroy(handle);
    return done;
}
