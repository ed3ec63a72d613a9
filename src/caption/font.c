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
