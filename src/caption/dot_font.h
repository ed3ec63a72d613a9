/* Built-in bitmap font: ASCII ' ' to '~', 5 x 7 dots above the base line and two rows below it, in
 * cells of 6 x 10. */
#ifndef GN_CAPTION_DOT_FONT_H
#define GN_CAPTION_DOT_FONT_H

#include <stdint.h>

enum {
    GN_DOT_FONT_ROWS = 9,
    GN_DOT_FONT_ASCENT = 7, /* rows above the base line */
    GN_DOT_FONT_COLUMNS = 5,
    GN_DOT_FONT_WIDTH = 6,   /* advance */
    GN_DOT_FONT_HEIGHT = 10, /* line spacing */
};
/* The rows of a character, top first, the leftmost dot in bit 4; NULL: no such character. */
const uint8_t *gn_dot_font_rows(uint32_t code);

#endif
