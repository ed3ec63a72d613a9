#include "fuzz/bomb_pictures.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>
#include <zlib.h>

#include "core/arena.h"

/* ---- PNG ---- */

static void append_bytes(png_structp png, png_bytep data, size_t size) {
    struct gn_made *made = png_get_io_ptr(png);
    made->data = gn_xrealloc(made->data, made->size + size, 1);
    memcpy(made->data + made->size, data, size);
    made->size += size;
}

static void flush_nothing(png_structp png) { (void)png; }

struct gn_made gn_bomb_png_make(const struct gn_bomb_png *p) {
    struct gn_made made = {0};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    const int bits = p->depth, type = bits == 32 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_GRAY;
    png_set_write_fn(png, &made, append_bytes, flush_nothing);
    png_set_compression_level(png, 1);
    png_set_filter(png, 0, PNG_FILTER_NONE);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_set_IHDR(png, info, p->width_px, p->height_px, bits == 32 ? 8 : bits, type,
                 p->interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    char *text = p->text_size ? gn_xalloc(p->text_size + 1, 1) : NULL;
    if (text) {
        memset(text, 'x', p->text_size);
        png_text chunk = {
            .compression = PNG_TEXT_COMPRESSION_zTXt, .key = (png_charp) "x", .text = text};
        png_set_text(png, info, &chunk, 1);
    }
    png_write_info(png, info);
    uint8_t *row = gn_xalloc(((size_t)p->width_px * (size_t)bits + 7) / 8, 1);
    for (uint32_t x = 0; p->ramp && x < p->width_px; x++) row[x] = (uint8_t)x;
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; pass++)
        for (uint32_t y = 0; y < p->height_px; y++) png_write_row(png, row);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    free(row);
    free(text);
    return made;
}

/* ---- JPEG ---- */

struct gn_made gn_bomb_jpeg_scans(int side, int scans) {
    static const uint8_t start[128] = {
        [0] = 0xff,
        0xd8,
        0xff,
        0xdb,
        0,
        67,
        0, /* a table of ones follows */
        [71] = 0xff,
        0xc2,
        0,
        11,
        8,
        0,
        0,
        0,
        0,
        1,
        1,
        0x11,
        0,
        [84] = 0xff,
        0xc4,
        0,
        20,
        0,
        1, /* DC: 0 is 0 */
        [106] = 0xff,
        0xc4,
        0,
        20,
        0x10,
        1,
        [127] = 0xe0, /* AC: 0 is 16384 blocks or more */
    };
    const size_t blocks = (size_t)side * (size_t)side / 64, first = 10 + (blocks + 7) / 8;
    const size_t each = 10 + ((blocks + 16383) / 16384 * 15 + 7) / 8;
    struct gn_made made = {.size = sizeof start + first + (size_t)scans * each + 2};
    uint8_t *at = made.data = gn_xalloc(made.size, 1);
    memcpy(at, start, sizeof start);
    memset(at + 7, 1, 64);
    at[76] = at[78] = (uint8_t)(side >> 8);
    at[77] = at[79] = (uint8_t)side;
    at += sizeof start;
    memcpy(at, (uint8_t[]){0xff, 0xda, 0, 8, 1, 1, 0, 0, 0, 0}, 10);
    at += first;
    for (int i = 0; i < scans; i++, at += each)
        memcpy(at, (uint8_t[]){0xff, 0xda, 0, 8, 1, 1, 0, 1, 63, i % 2 ? 0x10 : 1}, 10);
    memcpy(at, (uint8_t[]){0xff, 0xd9}, 2);
    return made;
}

struct gn_made gn_bomb_jpeg_progressive(int width, int height, int sampling) {
    struct gn_made made = {0};
    unsigned char *data = NULL;
    unsigned long size = 0;
    uint8_t *rgb = gn_xalloc((size_t)width * (size_t)height, 3);
    tjhandle handle = tjInitCompress();
    tjCompress2(handle, rgb, width, 0, height, TJPF_RGB, &data, &size, sampling, 50,
                TJFLAG_PROGRESSIVE);
    tjDestroy(handle);
    free(rgb);
    made.data = gn_xalloc(size, 1);
    made.size = size;
    memcpy(made.data, data, size);
    tjFree(data);
    return made;
}

struct gn_made gn_bomb_jpeg_arithmetic(int width, int height, int components, bool progressive) {
    struct gn_made made = {0};
    char *text;
    FILE *file = open_memstream(&text, &made.size);
    fwrite((uint8_t[]){0xff, 0xd8, 0xff, 0xdb, 0, 67, 0}, 7, 1, file);
    for (int i = 0; i < 64; i++) fputc(1, file); /* the table of factors */
    fwrite((uint8_t[]){0xff, progressive ? 0xca : 0xc9, 0, (uint8_t)(8 + 3 * components), 8,
                       (uint8_t)(height >> 8), (uint8_t)height, (uint8_t)(width >> 8),
                       (uint8_t)width, (uint8_t)components},
           10, 1, file);
    for (int i = 1; i <= components; i++) fwrite((uint8_t[]){(uint8_t)i, 0x11, 0}, 3, 1, file);
    fwrite((uint8_t[]){0xff, 0xda, 0, (uint8_t)(6 + 2 * components), (uint8_t)components}, 5, 1,
           file);
    for (int i = 1; i <= components; i++) fwrite((uint8_t[]){(uint8_t)i, 0}, 2, 1, file);
    fwrite((uint8_t[]){0, progressive ? 0 : 63, 0, 0xff, 0xd9}, 5, 1, file);
    fclose(file);
    made.data = (uint8_t *)text;
    return made;
}

/* ---- WebP ---- */

/* The bits of VP8L: sides, alpha, version; no transform, no cache, one group of codes; then five
 * codes of one symbol of 8 bits each. */
struct gn_made gn_bomb_webp(int width, int height) {
    const uint32_t head[][2] = {{(uint32_t)width - 1, 14},
                                {(uint32_t)height - 1, 14},
                                {1, 1},
                                {0, 3},
                                {0, 1},
                                {0, 1},
                                {0, 1}};
    uint8_t bits[96] = {0}, data[20] = {0x2f};
    int count = 0;
    for (size_t i = 0; i < sizeof head / sizeof *head; i++)
        for (uint32_t k = 0; k < head[i][1]; k++) bits[count++] = head[i][0] >> k & 1;
    for (int symbol = 0; symbol < 5; symbol++, count += 8) {
        bits[count++] = 1; /* simple */
        bits[count++] = 0; /* of one symbol */
        bits[count++] = 1; /* of 8 bits, which are 0 */
    }
    for (int i = 0; i < count; i++) data[1 + i / 8] |= (uint8_t)(bits[i] << i % 8);
    struct gn_made made = {.data = gn_xalloc(20 + sizeof data, 1), .size = 20 + sizeof data};
    memcpy(made.data, "RIFF\x20\0\0\0WEBPVP8L\x14\0\0\0", 20);
    memcpy(made.data + 20, data, sizeof data);
    return made;
}

/* ---- KTX2 ---- */

struct gn_made gn_bomb_ktx2(int width, int height, int channels) {
    static const uint32_t formats[] = {9, 16, 23, 37}; /* of Vulkan */
    enum { HEADER = 80, START = HEADER + 24, ZLIB = 3 };
    const uint64_t bytes = (uint64_t)width * (uint64_t)height * (uint64_t)channels;
    uint8_t *zeros = gn_xalloc(bytes, 1);
    uLongf size = compressBound(bytes);
    struct gn_made made = {.data = gn_xalloc(START + size, 1)};
    compress2(made.data + START, &size, zeros, bytes, 1);
    free(zeros);
    made.size = START + size;
    const uint32_t head[] = {
        formats[channels - 1], 1, (uint32_t)width, (uint32_t)height, 0, 0, 1, 1, ZLIB};
    const uint64_t level[] = {START, size, bytes};
    memcpy(made.data, "\xabKTX 20\xbb\r\n\x1a\n", 12);
    memcpy(made.data + 12, head, sizeof head);
    memcpy(made.data + HEADER, level, sizeof level);
    return made;
}
