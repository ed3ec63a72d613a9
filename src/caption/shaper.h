/* Glyphs of scripts whose letters join, stack or run from right to left: libraqm, which is opened
 * at run time. shaper_none.c stands in where it was not built in. */
#ifndef GN_CAPTION_SHAPER_H
#define GN_CAPTION_SHAPER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/err.h"

struct gn_shaper_glyph {
    const void *face; /* one of those that were given */
    uint32_t index;   /* in it; 0: it has none */
    int32_t x, y;     /* 1/64 pixels from where the line begins on the base line, right and up */
};
/* Opens the library, once. False: it is missing, with the Debian package, or was not built in. */
bool gn_shaper_open(struct gn_err *err);
/* One line in reading order: `count` characters, each with the FT_Face (at its size) that has it.
 * Writes at most `most` glyphs from left to right, and how wide they are in 1/64 pixels. 0: there
 * is no library, or it refused the text. */
size_t gn_shaper_run(const uint32_t *codes, void *const *faces, size_t count,
                     struct gn_shaper_glyph *out, size_t most, int32_t *width);

#endif
