#include "caption/font.h"

#include <assert.h>

void gn_font_close(struct gn_font *font) {
    if (font) font->ops->close(font);
}

bool gn_font_resize(struct gn_font *font, uint32_t line_px) {
    assert(line_px > 0);
    return font->ops->resize(font, line_px);
}

/* The file is untrusted: checks what it says about its glyphs. */
bool gn_font_glyph(struct gn_font *font, uint32_t code, struct gn_glyph *out) {
    enum { MOST = GN_FONT_GLYPH_PX_MAX };
    *out = (struct gn_glyph){0};
    if (!font->ops->glyph(font, code, out)) return false;
    return out->width_px <= MOST && out->height_px <= MOST && out->advance_px >= 0 &&
           out->advance_px <= MOST && out->left >= -MOST && out->left <= MOST &&
           out->top >= -MOST && out->top <= MOST;
}

bool gn_font_has(struct gn_font *font, uint32_t code) { return font->ops->has(font, code); }

int32_t gn_font_kern_px(struct gn_font *font, uint32_t left, uint32_t right) {
    const int32_t most = (int32_t)font->line_px / 2,
                  by = font->ops->kern_px ? font->ops->kern_px(font, left, right) : 0;
    return by < -most ? -most : by > most ? most : by;
}

/* Likewise: a line is no wider, and no glyph farther off, than that many of the largest glyphs. */
uint32_t gn_font_shape(struct gn_font *font, const uint32_t *codes, uint32_t count,
                       struct gn_font_place *out, int32_t *width_px) {
    const int32_t most = GN_FONT_PLACES_MAX * GN_FONT_GLYPH_PX_MAX;
    if (!font->ops->shape || count == 0 || count > GN_FONT_PLACES_MAX) return 0;
    const uint32_t kept = font->ops->shape(font, codes, count, out, width_px);
    bool ok = *width_px >= 0 && *width_px <= most;
    for (uint32_t i = 0; i < kept; i++)
        ok &= out[i].x_px >= -most && out[i].x_px <= most && out[i].y_px >= -most &&
              out[i].y_px <= most;
    return kept > 0 && ok ? kept : 0;
}
