/* The glyphs that captions have used so far, side by side in one picture of 8 bits. */
#ifndef GN_CAPTION_ATLAS_H
#define GN_CAPTION_ATLAS_H

#include "caption/font.h"
#include "caption/run.h"

enum { GN_ATLAS_GLYPHS_MAX = 512, GN_ATLAS_SIDE_MAX = 2048 };
/* No character: a square that is covered wholly, half a line of the font high. */
#define GN_ATLAS_SOLID UINT32_C(0xffffffff)

struct gn_atlas_glyph {
    uint32_t code, line_px;                   /* which, how large */
    int16_t left, top;                        /* as in gn_glyph */
    uint16_t x, y;                            /* in the atlas */
    uint16_t width_px, height_px, advance_px; /* width 0: invisible */
};
struct gn_atlas {
    struct gn_caption_atlas picture; /* its memory belongs to the atlas */
    struct gn_atlas_glyph glyphs[GN_ATLAS_GLYPHS_MAX];
    uint32_t count;
    uint32_t shelf_x, shelf_y, shelf_px; /* where the next glyph goes, and how high its shelf is */
    bool changed;                        /* since it was sealed */
    bool full;                           /* a glyph did not fit since the last reset */
};

/* Zeroed is empty. Forgets all glyphs, and their memory. */
void gn_atlas_reset(struct gn_atlas *atlas);
/* Call after glyphs were looked up: updates the picture's generation if its content changed. */
void gn_atlas_seal(struct gn_atlas *atlas);
/* A character at the font's size; a box if the font lacks it. Without room left in the atlas a
 * glyph keeps its advance and is invisible. Valid until the reset. */
const struct gn_atlas_glyph *gn_atlas_glyph(struct gn_atlas *atlas, struct gn_font *font,
                                            uint32_t code);

#endif
