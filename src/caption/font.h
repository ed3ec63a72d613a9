/* A source of glyphs: a font at one size at a time. */
#ifndef GN_CAPTION_FONT_H
#define GN_CAPTION_FONT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

struct gn_glyph {      /* valid until the next glyph */
    int32_t left, top; /* pixels from the pen to the left edge, from the base line up to the top */
    uint32_t width_px, height_px;
    int32_t advance_px;      /* to the next pen; not negative */
    size_t stride;           /* bytes from row to row */
    const uint8_t *coverage; /* 0..255, top row first; NULL where it is empty */
};

/* In place of a character: a glyph by its number, as gn_font_shape() writes it. */
#define GN_FONT_SHAPED UINT32_C(0x80000000)

struct gn_font_place {
    uint32_t glyph;     /* a character, or with GN_FONT_SHAPED a glyph: for gn_font_glyph() */
    int32_t x_px, y_px; /* its pen: from where the line begins on the base line, right and up */
};

struct gn_font;
struct gn_font_ops {
    bool (*resize)(struct gn_font *font, uint32_t line_px);
    bool (*glyph)(struct gn_font *font, uint32_t glyph, struct gn_glyph *out);
    void (*close)(struct gn_font *font);
    bool (*has)(struct gn_font *font, uint32_t code);
    int32_t (*kern_px)(struct gn_font *font, uint32_t left, uint32_t right); /* NULL: none */
    uint32_t (*shape)(struct gn_font *font, const uint32_t *codes, uint32_t count,
                      struct gn_font_place *out, int32_t *width_px); /* NULL: none */
};
struct gn_font {
    const struct gn_font_ops *ops;
    uint32_t line_px;   /* from base line to base line */
    uint32_t ascent_px; /* from a line's upper edge to its base line */
};

/* Larger files and glyphs are rejected. */
enum { GN_FONT_BYTES_MAX = 32 << 20, GN_FONT_GLYPH_PX_MAX = 512, GN_FONT_PLACES_MAX = 2048 };

/* The built-in font, in whole multiples of its dots: ASCII only. Never fails. */
struct gn_font *gn_font_open_dots(void);
/* A font that FreeType reads, hinted, from memory that must outlive it, alone; fails if it cannot
 * be read or FreeType was not built in. */
struct gn_font *gn_font_open_bytes(const uint8_t *data, size_t size, struct gn_err *err);
/* The file of that name; NULL: the first that exists of the paths where packages install DejaVu
 * Sans and similar fonts. A file that is no font, or too large, is a failure that names it.
 * Characters that it lacks come from the fonts of caption/script.h, each opened when a text first
 * needs it, in the same size. */
struct gn_font *gn_font_open_file(const char *path, struct gn_err *err);
/* Likewise; packages' fonts are looked for in that folder instead of /usr/share/fonts. */
struct gn_font *gn_font_open_in(const char *path, const char *folder, struct gn_err *err);
void gn_font_close(struct gn_font *font); /* NULL is legal */

/* Sets the size closest to lines of that many pixels. */
bool gn_font_resize(struct gn_font *font, uint32_t line_px);
/* False: it has no such character. */
bool gn_font_glyph(struct gn_font *font, uint32_t code, struct gn_glyph *out);
bool gn_font_has(struct gn_font *font, uint32_t code); /* it has that character */
/* Pixels by which the second character stands nearer to the first (negative) or farther. */
int32_t gn_font_kern_px(struct gn_font *font, uint32_t left, uint32_t right);
/* A line of at most GN_FONT_PLACES_MAX characters in reading order to glyphs from left to right,
 * joined and stacked as their script has it, and their width; at most GN_FONT_PLACES_MAX. 0: this
 * font cannot: put character behind character. */
uint32_t gn_font_shape(struct gn_font *font, const uint32_t *codes, uint32_t count,
                       struct gn_font_place *out, int32_t *width_px);

#endif
