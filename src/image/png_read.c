/* Any PNG to RGBA of 8 or 16 bits. libpng reports errors by longjmp: it is called only from here,
 * and state that must survive the jump is in struct reader. */
#include "image/read.h"

#include <png.h>
#include <setjmp.h>
#include <string.h>

enum { IHDR_END = 8 + 8 + 13 };

static uint32_t big_endian(const uint8_t *p) {
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | (uint32_t)p[3];
}

bool gn_png_size(const uint8_t *data, size_t size, uint32_t px[2], struct gn_err *err) {
    static const uint8_t channels[] = {1, 0, 3, 1, 2, 0, 4};
    if (size < IHDR_END || memcmp(data + 12, "IHDR", 4) != 0) return gn_fail(err, "PNG: truncated");
    px[0] = big_endian(data + 16);
    px[1] = big_endian(data + 20);
    if (px[0] > INT32_MAX || px[1] > INT32_MAX)
        return gn_fail(err, "PNG: width or height out of range");
    /* deflate expands at most 1032 times: refuse a larger size before memory is allocated for it */
    uint64_t bits = (uint64_t)data[24] * (data[25] < sizeof channels ? channels[data[25]] : 1);
    if (bits > 64) bits = 64;
    if ((uint64_t)px[0] * px[1] / 8 * bits / 1100 > size) return gn_fail(err, "PNG: truncated");
    /* so, too, if a chunk before the pixels is longer than the file: libpng would allocate and
     * clear that length (up to 2 GB) before it reads */
    for (size_t at = 8; size - at >= 12 && memcmp(data + at + 4, "IDAT", 4) != 0;) {
        const size_t length = big_endian(data + at);
        if (length > size - at - 12) return gn_fail(err, "PNG: truncated");
        at += 12 + length;
    }
    return true;
}

bool gn_png_has_alpha(const uint8_t *data, size_t size) {
    enum { COLOR_TYPE = 25, WITH_ALPHA = 4 };
    for (size_t at = 8; size - at >= 12 && memcmp(data + at + 4, "IDAT", 4) != 0;
         at += 12 + big_endian(data + at))
        if (memcmp(data + at + 4, "tRNS", 4) == 0) return true;
    return data[COLOR_TYPE] & WITH_ALPHA;
}

bool gn_png_is_deep(const uint8_t *data) { return data[24] > 8; }

bool gn_png_is_interlaced(const uint8_t *data) { return data[IHDR_END - 1] != 0; }

/* libpng has two rows of up to 8 bytes a texel, and the tables of zlib. */
static uint64_t library_bytes(const uint32_t px[2]) { return UINT64_C(16) * px[0] + (1 << 16); }

uint64_t gn_png_work_bytes(const uint8_t *data, size_t size, const uint32_t px[2]) {
    (void)data, (void)size;
    return (uint64_t)px[1] * sizeof(png_bytep) + library_bytes(px);
}

struct reader {
    const uint8_t *data;
    size_t left;
    jmp_buf leave;
    png_structp png;
    png_infop info;
    png_bytep *rows;
    png_bytep row;
    struct gn_err *err;
};

static void read_bytes(png_structp png, png_bytep out, size_t size) {
    struct reader *reader = png_get_io_ptr(png);
    if (size > reader->left) png_error(png, "truncated");
    memcpy(out, reader->data, size);
    reader->data += size;
    reader->left -= size;
}

static void on_error(png_structp png, png_const_charp message) {
    struct reader *reader = png_get_error_ptr(png);
    gn_fail(reader->err, "PNG: %s", message);
    longjmp(reader->leave, 1);
}

static void on_warning(png_structp png, png_const_charp message) {
    (void)png;
    (void)message;
}

/* Everything before the first row. texel_bytes: 4 or 8; filled: each pass of an interlaced picture
 * has all rows and columns. */
static void begin_png(struct reader *reader, const uint32_t px[2], size_t texel_bytes,
                      bool filled) {
    png_set_read_fn(reader->png, reader, read_bytes);
    png_set_user_limits(reader->png, px[0], px[1]);
    png_set_chunk_cache_max(reader->png, 64);
    png_set_chunk_malloc_max(reader->png, 1 << 20);
    png_set_keep_unknown_chunks(reader->png, PNG_HANDLE_CHUNK_NEVER, NULL, 0);
    png_read_info(reader->png, reader->info);
    png_set_expand(reader->png);
    if (texel_bytes == 8) {
        png_set_expand_16(reader->png);
        if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__) png_set_swap(reader->png);
    } else {
        png_set_scale_16(reader->png);
    }
    png_set_gray_to_rgb(reader->png);
    png_set_add_alpha(reader->png, texel_bytes == 8 ? 65535 : 255, PNG_FILLER_AFTER);
    if (filled) png_set_interlace_handling(reader->png);
    png_read_update_info(reader->png, reader->info);
    if (png_get_rowbytes(reader->png, reader->info) != texel_bytes * px[0] ||
        png_get_image_height(reader->png, reader->info) != px[1])
        png_error(reader->png, "size differs from its header");
}

static bool decode_png(struct reader *reader, const uint32_t px[2], uint8_t *rgba,
                       size_t texel_bytes) {
    if (setjmp(reader->leave)) return false;
    begin_png(reader, px, texel_bytes, true);
    reader->rows = png_malloc(reader->png, px[1] * sizeof *reader->rows);
    for (uint32_t y = 0; y < px[1]; y++) reader->rows[y] = rgba + texel_bytes * px[0] * y;
    png_read_image(reader->png, reader->rows);
    return true;
}

static void begin_rows(struct reader *reader, const uint32_t px[2]) {
    begin_png(reader, px, 4, false);
    reader->row = png_malloc(reader->png, 4 * (size_t)px[0]);
}

/* The passes of Adam7 whose pixels lie on a grid of 1 << shrink: the first, and two for each
 * halving of the grid's step from 8 (PNG specification, 8.2). */
static bool decode_passes(struct reader *reader, const uint32_t px[2], uint32_t shrink,
                          uint8_t *rgba) {
    if (setjmp(reader->leave)) return false;
    begin_rows(reader, px);
    const size_t width = gn_shrunk_px(px[0], shrink);
    for (int pass = 0; pass < PNG_INTERLACE_ADAM7_PASSES - 2 * (int)shrink; pass++) {
        const uint32_t columns = PNG_PASS_COLS(px[0], pass), rows = PNG_PASS_ROWS(px[1], pass);
        for (uint32_t y = 0; y < rows && columns > 0; y++) {
            uint8_t *out = rgba + 4 * width * (PNG_ROW_FROM_PASS_ROW(y, pass) >> shrink);
            png_read_row(reader->png, reader->row, NULL);
            for (uint32_t x = 0; x < columns; x++)
                memcpy(out + 4 * ((size_t)PNG_COL_FROM_PASS_COL(x, pass) >> shrink),
                       reader->row + 4 * (size_t)x, 4);
        }
    }
    return true;
}

static bool decode_rows(struct reader *reader, const uint32_t px[2], uint32_t count,
                        gn_picture_row *row, void *user) {
    if (setjmp(reader->leave)) return false;
    begin_rows(reader, px);
    for (uint32_t y = 0; y < count; y++) {
        png_read_row(reader->png, reader->row, NULL);
        row(user, reader->row);
    }
    return true;
}

static bool open_png(struct reader *reader, const uint8_t *data, size_t size, struct gn_err *err) {
    *reader = (struct reader){.data = data, .left = size, .err = err};
    reader->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, reader, on_error, on_warning);
    reader->info = reader->png ? png_create_info_struct(reader->png) : NULL;
    return reader->info || gn_fail(err, "PNG: out of memory");
}

static void close_png(struct reader *reader) {
    if (!reader->png) return;
    png_free(reader->png, reader->rows);
    png_free(reader->png, reader->row);
    png_destroy_read_struct(&reader->png, reader->info ? &reader->info : NULL, NULL);
}

bool gn_png_read(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t shrink,
                 uint8_t *rgba, struct gn_err *err) {
    struct reader reader;
    const bool done =
        open_png(&reader, data, size, err) &&
        (shrink ? decode_passes(&reader, px, shrink, rgba) : decode_png(&reader, px, rgba, 4));
    close_png(&reader);
    return done;
}

bool gn_png_rows(const uint8_t *data, size_t size, const uint32_t px[2], uint32_t count,
                 gn_picture_row *row, void *user, struct gn_err *err) {
    struct reader reader;
    const bool done =
        open_png(&reader, data, size, err) && decode_rows(&reader, px, count, row, user);
    close_png(&reader);
    return done;
}

bool gn_png_read_16(const uint8_t *data, size_t size, const uint32_t px[2], uint16_t *rgba,
                    struct gn_err *err) {
    struct reader reader;
    const bool done =
        open_png(&reader, data, size, err) && decode_png(&reader, px, (uint8_t *)rgba, 8);
    close_png(&reader);
    return done;
}
