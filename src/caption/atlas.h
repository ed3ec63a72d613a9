/* The glyphs that captions have needed so far, side by side in one picture of 8 bits. */
#ifndef GN_CAPTION_ATLAS_H
#define GN_CAPTION_ATLAS_H

#include "caption/font.h"
#include "caption/run.h"

enum { GN_ATLAS_GLYPHS_MAX = 512, GN_ATLAS_SIDE_MAX = 2048 };

struct gn_atlas_glyph {
    uint32_t code, line_px;                   /* which, how large */
    int16_t left, top;                        /* as in gn_glyph */
    uint16_t x, y;                            /* in the atlas */
    uint16_t width_px, height_px, advance_px; /* width 0: nothing to be seen */
};
struct gn_atlas {
    struct gn_caption_atlas picture; /* its memory is ours */
    struct gn_atlas_glyph glyphs[GN_ATLAS_GLYPHS_MAX];
    uint32_t count;
    uint32_t shelf_x, shelf_y, shelf_px; /* where the next glyph goes, and how high its shelf is */
    bool changed;                        /* since it was sealed */
    bool full;                           /* something had no room since it was reset */
};

/* Zeroed is empty. Forgets all glyphs, and their memory. */
void gn_atlas_reset(struct gn_atlas *atlas);
/* To be called when glyphs were asked for: the picture's generation is that of what it holds. */
void gn_atlas_seal(struct gn_atlas *atlas);
/* A character at the font's size; one that it lacks is a box. What has no room any more has its
 * advance, and nothing to be seen. Valid until the reset. */
const struct gn_atlas_glyph *gn_atlas_glyph(struct gn_atlas *atlas, struct gn_font *font,
                                            uint32_t code);

#endif
