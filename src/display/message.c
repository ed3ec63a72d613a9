#include "display/message.h"

#include <string.h>

#include "core/dot_font.h"

/* ---- drawing ---- */

static const uint32_t ground = 0x00202428, ink = 0x00e8e8e8;

/* Width and height as seen, with the rotation applied. */
static uint32_t upright_width(const struct gn_message_picture *p) {
    return p->turn_deg % 180 ? p->height_px : p->width_px;
}

static uint32_t upright_height(const struct gn_message_picture *p) {
    return p->turn_deg % 180 ? p->width_px : p->height_px;
}

static void draw_glyph(const struct gn_message_picture *p, char c, uint32_t left, uint32_t top,
                       uint32_t scale) {
    const uint32_t width = upright_width(p), height = upright_height(p);
    const uint8_t *rows = gn_dot_font_rows((unsigned char)c);
    if (!rows) rows = gn_dot_font_rows('?');
    for (uint32_t i = 0; i < GN_DOT_FONT_ROWS * scale; i++)
        for (uint32_t k = 0; k < GN_DOT_FONT_COLUMNS * scale; k++) {
            const uint32_t x = left + k, y = top + i;
            uint32_t at_x = x, at_y = y;
            if (!(rows[i / scale] >> (GN_DOT_FONT_COLUMNS - 1 - k / scale) & 1)) continue;
            if (x >= width || y >= height) continue;
            if (p->turn_deg == 90) at_x = p->width_px - 1 - y, at_y = x;
            if (p->turn_deg == 180) at_x = p->width_px - 1 - x, at_y = p->height_px - 1 - y;
            if (p->turn_deg == 270) at_x = y, at_y = p->height_px - 1 - x;
            memcpy(p->pixels + at_y * p->stride + 4ul * at_x, &ink, sizeof ink);
        }
}

/* Number of characters for a line of `room` characters. */
static size_t line_length(const char *text, size_t room) {
    const size_t length = strlen(text);
    if (length <= room) return length;
    for (size_t at = room; at > 0; at--)
        if (text[at] == ' ') return at;
    return room;
}

void gn_message_draw(const struct gn_message_picture *p, const char *text) {
    const uint32_t width = upright_width(p), height = upright_height(p);
    const uint32_t scale =
        height / 24 / GN_DOT_FONT_HEIGHT > 0 ? height / 24 / GN_DOT_FONT_HEIGHT : 1;
    const size_t all = width / (GN_DOT_FONT_WIDTH * scale), room = all > 4 ? all - 4 : 1;
    for (uint32_t y = 0; y < p->height_px; y++)
        for (uint32_t x = 0; x < p->width_px; x++)
            memcpy(p->pixels + y * p->stride + 4ul * x, &ground, sizeof ground);
    uint32_t lines = 0;
    for (const char *at = text; *at; lines++) {
        at += line_length(at, room);
        while (*at == ' ') at++;
    }
    const uint32_t tall = lines * GN_DOT_FONT_HEIGHT * scale;
    for (uint32_t y = height > tall ? (height - tall) / 2 : 0; *text;
         y += GN_DOT_FONT_HEIGHT * scale) {
        const size_t length = line_length(text, room);
        const uint32_t wide = (uint32_t)length * GN_DOT_FONT_WIDTH * scale;
        for (size_t i = 0; i < length; i++)
            draw_glyph(p, text[i],
                       (width > wide ? (width - wide) / 2 : 0) +
                           (uint32_t)i * GN_DOT_FONT_WIDTH * scale,
                       y, scale);
        text += length;
        while (*text == ' ') text++;
    }
}
