/* Radiance pictures (.hdr, .pic) to rows of RGBE: three mantissas that share an exponent. Ward,
 * "Real Pixels" (Graphics Gems II); runs as in Radiance's color.c: whole pixels (old), or channel
 * by channel (new, rows of 8 to 32767 pixels). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/read.h"

enum { SIDE_MAX = 16384, PIXELS_MAX = 8192 * 4096, NEW_WIDTH_MIN = 8, NEW_WIDTH_MAX = 32767 };

struct hdr {
    const uint8_t *at, *end;
    uint32_t width, y;
    struct gn_err *err;
};

/* The next line of the header without its end, or NULL. */
static const char *next_line(struct hdr *h, size_t *length) {
    const uint8_t *end = memchr(h->at, '\n', (size_t)(h->end - h->at));
    const char *line = (const char *)h->at;
    if (!end) return NULL;
    *length = (size_t)(end - h->at);
    h->at = end + 1;
    return line;
}

/* "-Y 512 +X 1024" */
static bool parse_size(const char *line, size_t length, uint32_t px[2]) {
    char text[64], *end;
    if (length >= sizeof text || strncmp(line, "-Y ", 3) != 0) return false;
    memcpy(text, line, length);
    text[length] = '\0';
    const unsigned long height = strtoul(text + 3, &end, 10);
    if (strncmp(end, " +X ", 4) != 0) return false;
    const unsigned long width = strtoul(end + 4, &end, 10);
    if (*end && *end != '\r') return false;
    px[0] = width < UINT32_MAX ? (uint32_t)width : UINT32_MAX;
    px[1] = height < UINT32_MAX ? (uint32_t)height : UINT32_MAX;
    return true;
}

static bool read_header(struct hdr *h, uint32_t px[2]) {
    static const char format[] = "FORMAT=";
    const char *line;
    size_t length = 0;
    if (h->end - h->at < 2 || memcmp(h->at, "#?", 2) != 0)
        return gn_fail(h->err, "HDR: not a Radiance picture (no #? at its start)");
    while ((line = next_line(h, &length)) && length > 0 && !(length == 1 && *line == '\r')) {
        if (length < sizeof format - 1 || memcmp(line, format, sizeof format - 1) != 0) continue;
        const char *value = line + sizeof format - 1;
        if (length - (sizeof format - 1) < 15 || memcmp(value, "32-bit_rle_rgbe", 15) != 0)
            return gn_fail(h->err, "HDR: only FORMAT=32-bit_rle_rgbe is supported");
    }
    if (line) line = next_line(h, &length);
    if (!line) return gn_fail(h->err, "HDR: truncated in its header");
    if (!parse_size(line, length, px))
        return gn_fail(h->err, "HDR: the size must be written as -Y HEIGHT +X WIDTH");
    if (px[0] == 0 || px[1] == 0) return gn_fail(h->err, "HDR: width or height is 0");
    if (px[0] > SIDE_MAX || px[1] > SIDE_MAX || (uint64_t)px[0] * px[1] > PIXELS_MAX)
        return gn_fail(h->err,
                       "HDR: %ux%u pixels; at most %d to a side and %d in all are supported", px[0],
                       px[1], SIDE_MAX, PIXELS_MAX);
    return true;
}

bool gn_hdr_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err) {
    struct hdr h = {.at = data, .end = data + size, .err = err};
    return read_header(&h, px);
}

static bool fail_row(const struct hdr *h, const char *what) {
    return gn_fail(h->err, "HDR: %s in row %u", what, h->y);
}

/* Channel by channel: a count over 128 repeats one byte, another is followed by so many. */
static bool read_new_row(struct hdr *h, uint8_t *rgbe) {
    for (int channel = 0; channel < 4; channel++)
        for (uint32_t x = 0; x < h->width;) {
            if (h->end - h->at < 2) return fail_row(h, "truncated");
            const bool repeats = *h->at > 128;
            const uint32_t count = repeats ? *h->at - 128u : *h->at;
            h->at++;
            if (count == 0) return fail_row(h, "a run of 0 pixels");
            if (count > h->width - x) return fail_row(h, "a run over its end");
            if (!repeats && (size_t)(h->end - h->at) < count) return fail_row(h, "truncated");
            for (uint32_t i = 0; i < count; i++)
                rgbe[4 * (x + i) + (uint32_t)channel] = repeats ? h->at[0] : h->at[i];
            h->at += repeats ? 1 : count;
            x += count;
        }
    return true;
}

/* Pixel by pixel; 1 1 1 N repeats the one before N times, a further such N times 256. */
static bool read_old_row(struct hdr *h, uint8_t *rgbe) {
    unsigned shift = 0;
    for (uint32_t x = 0; x < h->width;) {
        if (h->end - h->at < 4) return fail_row(h, "truncated");
        const uint8_t *p = h->at;
        h->at += 4;
        if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
            memcpy(rgbe + 4 * x++, p, 4);
            shift = 0;
            continue;
        }
        const uint64_t count = (uint64_t)p[3] << shift;
        if (x == 0) return fail_row(h, "a run without a pixel to repeat");
        if (count > h->width - x) return fail_row(h, "a run over its end");
        for (uint64_t i = 0; i < count; i++, x++) memcpy(rgbe + 4 * x, rgbe + 4 * (x - 1), 4);
        shift = shift < 24 ? shift + 8 : shift;
    }
    return true;
}

bool gn_hdr_read(const uint8_t *data, size_t size, gn_hdr_row *row, void *user,
                 struct gn_err *err) {
    struct hdr h = {.at = data, .end = data + size, .err = err};
    uint32_t px[2] = {0};
    if (!read_header(&h, px) || px[0] == 0) return false;
    uint8_t *rgbe = malloc(4ul * px[0]);
    if (!rgbe) return gn_fail(err, "HDR: out of memory");
    h.width = px[0];
    bool ok = true;
    for (; ok && h.y < px[1]; h.y++) {
        const bool is_new = h.width >= NEW_WIDTH_MIN && h.width <= NEW_WIDTH_MAX &&
                            h.end - h.at >= 4 && h.at[0] == 2 && h.at[1] == 2 && h.at[2] < 128;
        if (is_new && (uint32_t)(h.at[2] << 8 | h.at[3]) != h.width)
            ok = fail_row(&h, "another width");
        if (is_new) h.at += 4;
        ok = ok && (is_new ? read_new_row(&h, rgbe) : read_old_row(&h, rgbe));
        if (ok) row(user, h.y, rgbe);
    }
    free(rgbe);
    return ok;
}

void gn_hdr_color(const uint8_t rgbe[4], float rgb[3]) {
    const float scale = rgbe[3] ? ldexpf(1.0f, rgbe[3] - (128 + 8)) : 0.0f;
    for (int k = 0; k < 3; k++) rgb[k] = (float)rgbe[k] * scale;
}
