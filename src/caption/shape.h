/* A line of text to glyphs and where they stand. The text is untrusted UTF-8, as in layout.h. */
#ifndef GN_CAPTION_SHAPE_H
#define GN_CAPTION_SHAPE_H

#include "caption/atlas.h"
#include "caption/font.h"

struct gn_shape {
    struct gn_font_place places[GN_FONT_PLACES_MAX];
    uint32_t count;
    int32_t width_px; /* of all of the text */
};
/* At the font's size. Scripts that need it are shaped as a whole, in their direction, where the
 * font can; else, and beyond GN_FONT_PLACES_MAX, character stands behind character. With `cut`
 * GN_LAYOUT_GAP follows the text. */
void gn_shape_line(struct gn_atlas *atlas, struct gn_font *font, const char *begin, const char *end,
                   bool cut, struct gn_shape *out);
/* Adds to `out` what this machine lacks to draw a text, with the Debian packages that have it:
 * "Thai (fonts-noto-core), Korean (fonts-noto-cjk), letters that join (libraqm0)"; each name once.
 * False: `out` is still empty. */
extern const char gn_shape_samples[]; /* a letter of each script that caption/script.h knows */
bool gn_shape_find_missing(struct gn_font *font, const char *text, char *out, size_t size);

#endif
