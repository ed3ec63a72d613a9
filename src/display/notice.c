#include "display/notice.h"

#include <string.h>

/* ---- the font: seven rows of five dots each, the leftmost is bit 4; from ' ' to '~' ---- */

enum { FIRST = ' ', LAST = '~', ROWS = 7, COLUMNS = 5, CELL_WIDTH = 6, CELL_HEIGHT = 10 };

/* clang-format off */
static const uint8_t glyphs[LAST - FIRST + 1][ROWS] = {
    {0}, {4, 4, 4, 4, 4, 0, 4}, {10, 10, 0, 0, 0, 0, 0}, {10, 10, 31, 10, 31, 10, 10},
    {4, 15, 20, 14, 5, 30, 4}, {24, 25, 2, 4, 8, 19, 3}, {12, 18, 20, 8, 21, 18, 13},
    {4, 4, 0, 0, 0, 0, 0}, {2, 4, 8, 8, 8, 4, 2}, {8, 4, 2, 2, 2, 4, 8},
    {0, 4, 21, 14, 21, 4, 0}, {0, 4, 4, 31, 4, 4, 0}, {0, 0, 0, 0, 12, 4, 8},
    {0, 0, 0, 31, 0, 0, 0}, {0, 0, 0, 0, 0, 12, 12}, {0, 1, 2, 4, 8, 16, 0},
    {14, 17, 19, 21, 25, 17, 14}, {4, 12, 4, 4, 4, 4, 14}, {14, 17, 1, 2, 4, 8, 31},
    {31, 2, 4, 2, 1, 17, 14}, {2, 6, 10, 18, 31, 2, 2}, {31, 16, 30, 1, 1, 17, 14},
    {6, 8, 16, 30, 17, 17, 14}, {31, 1, 2, 4, 8, 8, 8}, {14, 17, 17, 14, 17, 17, 14},
    {14, 17, 17, 15, 1, 2, 12}, {0, 12, 12, 0, 12, 12, 0}, {0, 12, 12, 0, 12, 4, 8},
    {2, 4, 8, 16, 8, 4, 2}, {0, 0, 31, 0, 31, 0, 0}, {8, 4, 2, 1, 2, 4, 8},
    {14, 17, 1, 2, 4, 0, 4}, {14, 17, 1, 13, 21, 21, 14},
    /* A-Z */
    {14, 17, 17, 31, 17, 17, 17}, {30, 17, 17, 30, 17, 17, 30}, {14, 17, 16, 16, 16, 17, 14},
    {28, 18, 17, 17, 17, 18, 28}, {31, 16, 16, 30, 16, 16, 31}, {31, 16, 16, 30, 16, 16, 16},
    {14, 17, 16, 23, 17, 17, 15}, {17, 17, 17, 31, 17, 17, 17}, {14, 4, 4, 4, 4, 4, 14},
    {7, 2, 2, 2, 2, 18, 12}, {17, 18, 20, 24, 20, 18, 17}, {16, 16, 16, 16, 16, 16, 31},
    {17, 27, 21, 21, 17, 17, 17}, {17, 17, 25, 21, 19, 17, 17}, {14, 17, 17, 17, 17, 17, 14},
    {30, 17, 17, 30, 16, 16, 16}, {14, 17, 17, 17, 21, 18, 13}, {30, 17, 17, 30, 20, 18, 17},
    {15, 16, 16, 14, 1, 1, 30}, {31, 4, 4, 4, 4, 4, 4}, {17, 17, 17, 17, 17, 17, 14},
    {17, 17, 17, 17, 17, 10, 4}, {17, 17, 17, 21, 21, 21, 10}, {17, 17, 10, 4, 10, 17, 17},
    {17, 17, 17, 10, 4, 4, 4}, {31, 1, 2, 4, 8, 16, 31},
    {14, 8, 8, 8, 8, 8, 14}, {0, 16, 8, 4, 2, 1, 0}, {14, 2, 2, 2, 2, 2, 14},
    {4, 10, 17, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 31}, {8, 4, 2, 0, 0, 0, 0},
    /* a-z */
    {0, 0, 14, 1, 15, 17, 15}, {16, 16, 22, 25, 17, 17, 30}, {0, 0, 14, 16, 16, 17, 14},
    {1, 1, 13, 19, 17, 17, 15}, {0, 0, 14, 17, 31, 16, 14}, {6, 9, 8, 28, 8, 8, 8},
    {0, 15, 17, 17, 15, 1, 14}, {16, 16, 22, 25, 17, 17, 17}, {4, 0, 12, 4, 4, 4, 14},
    {2, 0, 6, 2, 2, 18, 12}, {16, 16, 18, 20, 24, 20, 18}, {12, 4, 4, 4, 4, 4, 14},
    {0, 0, 26, 21, 21, 17, 17}, {0, 0, 22, 25, 17, 17, 17}, {0, 0, 14, 17, 17, 17, 14},
    {0, 0, 30, 17, 30, 16, 16}, {0, 0, 13, 19, 15, 1, 1}, {0, 0, 22, 25, 16, 16, 16},
    {0, 0, 14, 16, 14, 1, 30}, {8, 8, 28, 8, 8, 9, 6}, {0, 0, 17, 17, 17, 19, 13},
    {0, 0, 17, 17, 17, 10, 4}, {0, 0, 17, 17, 21, 21, 10}, {0, 0, 17, 10, 4, 10, 17},
    {0, 0, 17, 17, 15, 1, 14}, {0, 0, 31, 2, 4, 8, 31},
    {2, 4, 4, 8, 4, 4, 2}, {4, 4, 4, 4, 4, 4, 4}, {8, 4, 4, 2, 4, 4, 8}, {0, 0, 8, 21, 2, 0, 0},
};
/* clang-format on */

/* ---- drawing ---- */

static const uint32_t ground = 0x00202428, ink = 0x00e8e8e8;

/* A picture on its side is as wide as it is high. */
static uint32_t upright_width(const struct gn_notice_picture *p) {
    return p->turn_deg % 180 ? p->height_px : p->width_px;
}

static uint32_t upright_height(const struct gn_notice_picture *p) {
    return p->turn_deg % 180 ? p->width_px : p->height_px;
}

static void put(const struct gn_notice_picture *p, uint32_t x, uint32_t y) {
    uint32_t at_x = x, at_y = y;
    if (x >= upright_width(p) || y >= upright_height(p)) return;
    if (p->turn_deg == 90) at_x = p->width_px - 1 - y, at_y = x;
    if (p->turn_deg == 180) at_x = p->width_px - 1 - x, at_y = p->height_px - 1 - y;
    if (p->turn_deg == 270) at_x = y, at_y = p->height_px - 1 - x;
    memcpy(p->pixels + at_y * p->stride + 4ul * at_x, &ink, sizeof ink);
}

static void draw_glyph(const struct gn_notice_picture *p, char c, uint32_t x, uint32_t y,
                       uint32_t scale) {
    const uint8_t *rows = glyphs[(c < FIRST || c > LAST ? '?' : c) - FIRST];
    for (uint32_t i = 0; i < ROWS * scale; i++)
        for (uint32_t k = 0; k < COLUMNS * scale; k++)
            if (rows[i / scale] >> (COLUMNS - 1 - k / scale) & 1) put(p, x + k, y + i);
}

/* How much of the text goes on a line of so many characters. */
static size_t line_length(const char *text, size_t room) {
    const size_t length = strlen(text);
    if (length <= room) return length;
    for (size_t at = room; at > 0; at--)
        if (text[at] == ' ') return at;
    return room;
}

static size_t count_lines(const char *text, size_t room) {
    size_t count = 0;
    for (; *text; count++) {
        text += line_length(text, room);
        while (*text == ' ') text++;
    }
    return count;
}

void gn_notice_draw(const struct gn_notice_picture *p, const char *text) {
    const uint32_t width = upright_width(p), height = upright_height(p);
    const uint32_t scale = height / 24 / CELL_HEIGHT > 0 ? height / 24 / CELL_HEIGHT : 1;
    const size_t all = width / (CELL_WIDTH * scale), room = all > 4 ? all - 4 : 1;
    for (uint32_t y = 0; y < p->height_px; y++)
        for (uint32_t x = 0; x < p->width_px; x++)
            memcpy(p->pixels + y * p->stride + 4ul * x, &ground, sizeof ground);
    const uint32_t tall = (uint32_t)count_lines(text, room) * CELL_HEIGHT * scale;
    for (uint32_t y = height > tall ? (height - tall) / 2 : 0; *text; y += CELL_HEIGHT * scale) {
        const size_t length = line_length(text, room);
        const uint32_t wide = (uint32_t)length * CELL_WIDTH * scale;
        for (size_t i = 0; i < length; i++)
            draw_glyph(p, text[i],
                       (width > wide ? (width - wide) / 2 : 0) + (uint32_t)i * CELL_WIDTH * scale,
                       y, scale);
        text += length;
        while (*text == ' ') text++;
    }
}
