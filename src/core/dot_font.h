/* The font inside the program: ASCII from ' ' to '~', seven rows of five dots over the base line
 * and two under it, standing in cells of 6 x 10. */
#ifndef GN_CORE_DOT_FONT_H
#define GN_CORE_DOT_FONT_H

#include <stdint.h>

enum {
    GN_DOT_FONT_ROWS = 9,
    GN_DOT_FONT_ASCENT = 7, /* of them over the base line */
    GN_DOT_FONT_COLUMNS = 5,
    GN_DOT_FONT_WIDTH = 6,   /* from character to character */
    GN_DOT_FONT_HEIGHT = 10, /* from line to line */
};
/* The rows of a character, top first, the leftmost dot in bit 4; NULL: it has none. */
const uint8_t *gn_dot_font_rows(uint32_t code);

#endif
