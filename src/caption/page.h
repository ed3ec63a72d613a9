/* Where the lines of a page stand: a title, wrapped text, or rows of two columns. Pure: sizes and
 * widths of characters in, rectangles in pixels of the picture out, top row first. All sizes are
 * shares of the picture's shorter side; nothing is outside of 5 % of its sides. */
#ifndef GN_CAPTION_PAGE_H
#define GN_CAPTION_PAGE_H

#include <stdbool.h>
#include <stdint.h>

#include "caption/run.h"

/* Lines that begin from right to left end at the ground's right. The text: with a title that is the
 * first line. In columns a line "LABEL\tVALUE" is a row, others
 * are headings, and an empty line ends a group. Groups flow into two columns side by side where the
 * picture is at least 900 pixels wide. */
struct gn_page_style {
    uint32_t title_share; /* this many lines of the title fill the shorter side; 0: no title */
    uint32_t share;       /* and of the rest */
    uint32_t most_lines;  /* of the rest; 0: as many as there is room for */
    bool wraps;           /* lines are broken between words; else cut */
    bool columns, at_top;
    bool at_right;          /* stands at the right of its place */
    int32_t from_px, to_px; /* its place, left to right; 0, 0: all within the margins */
};
extern const struct gn_page_style gn_page_styles[GN_CAPTION_KIND_COUNT];

struct gn_page_size {
    uint32_t line_px, ascent_px; /* from base line to base line; from a line's top to its own */
};
struct gn_page_font {
    struct gn_page_size (*resize)(void *data, uint32_t line_px); /* the size nearest to that */
    /* at that size; as in struct gn_layout_opts */
    int32_t (*advance_px)(void *data, uint32_t code);
    int32_t (*line_px)(void *data, const char *begin, const char *end);
    void *data;
};
struct gn_page_rect {
    int32_t x, y, width, height;
};
struct gn_page_line {
    const char *begin, *end; /* in the text */
    bool cut;                /* GN_LAYOUT_GAP follows */
    bool is_label;           /* drawn weaker */
    struct gn_page_rect rect;
    struct gn_page_size size;
};
enum { GN_PAGE_LINES_MAX = 96 };
struct gn_page {
    struct gn_page_rect ground, bar; /* width 0: nothing is shown; no bar */
    struct gn_page_line lines[GN_PAGE_LINES_MAX];
    uint32_t count;
};

/* The place of a label beside the line of a split screen, which is at that share of the width, 0 to
 * 1: it hugs the line, and is nothing where there is no room for a word. */
struct gn_page_style gn_page_beside(enum gn_caption_kind kind, uint32_t width_px,
                                    uint32_t height_px, double at);
/* The round handle on that line, half way up: its side is its diameter. */
struct gn_page_rect gn_page_handle(uint32_t width_px, uint32_t height_px, double at);

/* used_px: height in use above the lower margin. The font keeps the size of the last line. */
void gn_page_build(const struct gn_page_style *style, const struct gn_page_font *font,
                   const char *text, uint32_t width_px, uint32_t height_px, uint32_t used_px,
                   bool has_bar, struct gn_page *out);

#endif
