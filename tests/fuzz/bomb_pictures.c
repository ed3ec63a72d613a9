#include "fuzz/bomb_pictures.h"

#include <png.h>
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

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
