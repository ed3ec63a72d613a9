#include <stdlib.h>

#include "caption/dot_font.h"
#include "caption/font.h"
#include "core/arena.h"

enum { SCALE_MAX = 16 };

struct dots {
    struct gn_font font;
    uint32_t scale; /* pixels per dot */
    uint8_t coverage[SCALE_MAX * GN_DOT_FONT_ROWS * SCALE_MAX * GN_DOT_FONT_COLUMNS];
};

/* Dots are a whole number of pixels: the nearest line height. */
static bool resize_dots(struct gn_font *font, uint32_t line_px) {
    struct dots *d = (struct dots *)font;
    const uint32_t scale = (line_px + GN_DOT_FONT_HEIGHT / 2) / GN_DOT_FONT_HEIGHT;
    d->scale = scale < 1 ? 1 : scale > SCALE_MAX ? SCALE_MAX : scale;
    font->line_px = d->scale * GN_DOT_FONT_HEIGHT;
    font->ascent_px = d->scale * (GN_DOT_FONT_ASCENT + 1);
    return true;
}

static bool render_glyph(struct gn_font *font, uint32_t code, struct gn_glyph *out) {
    struct dots *d = (struct dots *)font;
    const uint8_t *rows = gn_dot_font_rows(code);
    const uint32_t width = GN_DOT_FONT_COLUMNS * d->scale, height = GN_DOT_FONT_ROWS * d->scale;
    if (!rows) return false;
    out->advance_px = (int32_t)(GN_DOT_FONT_WIDTH * d->scale);
    if (code == ' ') return true;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            d->coverage[y * width + x] =
                rows[y / d->scale] >> (GN_DOT_FONT_COLUMNS - 1 - x / d->scale) & 1 ? 255 : 0;
    out->top = (int32_t)(GN_DOT_FONT_ASCENT * d->scale);
    out->width_px = width;
    out->height_px = height;
    out->stride = width;
    out->coverage = d->coverage;
    return true;
}

static void close_dots(struct gn_font *font) { free(font); }

static bool has_dots(struct gn_font *font, uint32_t code) {
    (void)font;
    return gn_dot_font_rows(code);
}

struct gn_font *gn_font_open_dots(void) {
    static const struct gn_font_ops ops = {
        .resize = resize_dots, .glyph = render_glyph, .close = close_dots, .has = has_dots};
    struct dots *d = gn_xalloc(1, sizeof *d);
    d->font.ops = &ops;
    resize_dots(&d->font, GN_DOT_FONT_HEIGHT);
    return &d->font;
}
