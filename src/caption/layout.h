/* Breaks a text into lines that fit. Pure. The text is untrusted UTF-8: invalid bytes become
 * U+FFFD, control characters and direction marks are dropped, a tab becomes a space. */
#ifndef GN_CAPTION_LAYOUT_H
#define GN_CAPTION_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GN_LAYOUT_GAP "..." /* replaces what is cut */

/* The character at *text, which moves on behind it; 0: the text ends. Only characters that are
 * drawn, and '\n'. */
uint32_t gn_layout_next(const char **text, const char *end);
/* U+200C or U+200D, which keep letters apart or join them: of no width, and nothing to draw. */
bool gn_layout_is_joiner(uint32_t code);

struct gn_layout_opts {
    int32_t width_px; /* width of a line */
    uint32_t most_lines;
    bool wraps; /* breaks lines between words, and words longer than a line; else lines are cut */
    int32_t (*advance_px)(void *data, uint32_t code); /* of a character alone: where to break */
    /* of characters together, with kerning and joined letters; NULL: the sum of their advances */
    int32_t (*line_px)(void *data, const char *begin, const char *end);
    void *data;
};
struct gn_layout_line {
    const char *begin, *end; /* in the text, without the spaces around */
    int32_t width_px;        /* with the gap, where it is cut */
    bool cut;                /* a gap follows */
};
int32_t gn_layout_width_px(const struct gn_layout_opts *opts, const char *begin, const char *end);
/* Marks stay on the line of their letter; Chinese and Japanese break anywhere. The lines of a text,
 * into `lines` (most_lines of them); how many. Each fits into width_px, unless a single character
 * does not. Text that does not fit is cut off the last line. */
uint32_t gn_layout_build(const struct gn_layout_opts *opts, const char *text, const char *end,
                         struct gn_layout_line *lines);

#endif
