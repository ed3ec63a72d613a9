/* Scripts of the world: which characters belong to one, how it is called, and which font and Debian
 * package has it. Pure. */
#ifndef GN_CAPTION_SCRIPT_H
#define GN_CAPTION_SCRIPT_H

#include <stdbool.h>
#include <stdint.h>

struct gn_script {
    uint32_t first, last; /* characters */
    const char *name;     /* for people; NULL: a font with a little of everything */
    const char *file;     /* of the font, without its folder */
    const char *package;  /* of Debian */
};
/* The next row after `row` (NULL: the first) that has that character; NULL: no other. Rows are in
 * the order in which their fonts are tried. */
const struct gn_script *gn_script_next(const struct gn_script *row, uint32_t code);
/* The place of a row in the table, and how many there are. */
extern const struct gn_script gn_scripts[];
extern const uint32_t gn_script_count;

/* Its glyphs depend on the characters beside it, or run from right to left (Unicode 15,
 * Blocks.txt).
 */
bool gn_script_is_complex(uint32_t code);
bool gn_script_is_rtl(uint32_t code);
/* It stands on or around the character before it, or joins it to the next: no line breaks there. */
bool gn_script_is_mark(uint32_t code);
/* A line may be broken before and after it without a space: Chinese, Japanese. */
bool gn_script_breaks(uint32_t code);

#endif
