#include "caption/page.h"

#include <math.h>
#include <string.h>

#include "caption/layout.h"
#include "caption/script.h"

enum {
    LINE_MIN_PX = 8,
    LINE_MAX_PX = 160,
    TWO_COLUMNS_PX = 900,
    TITLE_LINES = 2,
    VALUE_LINES = 3,
    HANDLE_SHARE = 24, /* so many handles fill the picture's shorter side */
    ROOM_LINES = 3,    /* a label has at least so many heights of a line */
    WRAPPED_MAX = 32,
};

const struct gn_page_style gn_page_styles[GN_CAPTION_KIND_COUNT] = {
    [GN_CAPTION_INFO] = {.title_share = 18, .share = 30, .columns = true, .at_top = true},
    [GN_CAPTION_MODE] = {.share = 18, .most_lines = 2, .wraps = true},
    [GN_CAPTION_TEXT] = {.share = 24, .most_lines = 8, .wraps = true},
    [GN_CAPTION_LEFT] = {.share = 24, .most_lines = 2, .wraps = true, .at_right = true},
    [GN_CAPTION_RIGHT] = {.share = 24, .most_lines = 2, .wraps = true},
    [GN_CAPTION_CARD] = {.title_share = 18, .share = 30, .most_lines = 10, .wraps = true},
};

struct build {
    const struct gn_page_style *style;
    const struct gn_page_font *font;
    struct gn_page *out;
    int32_t width, height; /* that lines may take */
    int32_t wide, y;       /* taken */
    struct gn_page_size size;
};

static uint32_t line_px_of(uint32_t share, uint32_t width, uint32_t height) {
    const uint32_t line = (width < height ? width : height) / share;
    return line < LINE_MIN_PX ? LINE_MIN_PX : line > LINE_MAX_PX ? LINE_MAX_PX : line;
}

static const char *line_end(const char *text) { return text + strcspn(text, "\n"); }

static int32_t width_of(const struct build *b, const char *begin, const char *end) {
    const struct gn_layout_opts opts = {
        .advance_px = b->font->advance_px, .line_px = b->font->line_px, .data = b->font->data};
    return gn_layout_width_px(&opts, begin, end);
}

/* At most `most` lines of that text, at x; how wide the widest is. */
static int32_t add_lines(struct build *b, const char *begin, const char *end, int32_t x,
                         int32_t room, uint32_t most, bool wraps) {
    struct gn_layout_line lines[WRAPPED_MAX];
    const struct gn_layout_opts opts = {.width_px = room,
                                        .most_lines = most < WRAPPED_MAX ? most : WRAPPED_MAX,
                                        .wraps = wraps,
                                        .advance_px = b->font->advance_px,
                                        .line_px = b->font->line_px,
                                        .data = b->font->data};
    const uint32_t count = gn_layout_build(&opts, begin, end, lines);
    int32_t widest = 0;
    for (uint32_t i = 0; i < count && b->out->count < GN_PAGE_LINES_MAX; i++) {
        b->out->lines[b->out->count++] =
            (struct gn_page_line){.begin = lines[i].begin,
                                  .end = lines[i].end,
                                  .cut = lines[i].cut,
                                  .rect = {x, b->y, lines[i].width_px, (int32_t)b->size.line_px},
                                  .size = b->size};
        if (lines[i].width_px > widest) widest = lines[i].width_px;
        b->y += (int32_t)b->size.line_px;
    }
    return widest;
}

/* ---- columns ---- */

struct column {
    int32_t labels, values; /* their widths */
};

static struct column measure(const struct build *b, const char *begin, const char *end) {
    struct column c = {0};
    for (const char *at = begin; at < end; at = line_end(at) + 1) {
        const char *stop = line_end(at), *tab = memchr(at, '\t', (size_t)(stop - at));
        const int32_t label = tab ? width_of(b, at, tab) : 0,
                      value = width_of(b, tab ? tab + 1 : at, stop);
        if (label > c.labels) c.labels = label;
        if (value > c.values) c.values = value;
    }
    return c;
}

static int32_t gap_of(const struct build *b) { return (int32_t)b->size.line_px * 3 / 5; }

/* A column of so many pixels. Labels stand to the right, as wide as they are, values behind them.
 */
static int32_t add_rows(struct build *b, const char *begin, const char *end, int32_t x,
                        int32_t room) {
    const struct column c = measure(b, begin, end);
    const int32_t labels = c.labels < room / 2 ? c.labels : room / 2,
                  values_x = x + labels + (labels ? gap_of(b) : 0);
    int32_t widest = 0;
    for (const char *at = begin; at < end; at = line_end(at) + 1) {
        const char *stop = line_end(at), *tab = memchr(at, '\t', (size_t)(stop - at));
        const int32_t y = b->y;
        if (tab) {
            const uint32_t first = b->out->count;
            const int32_t label = add_lines(b, at, tab, x, labels, 1, false);
            for (uint32_t i = first; i < b->out->count; i++) {
                b->out->lines[i].rect.x += labels - label;
                b->out->lines[i].is_label = true;
            }
            b->y = y;
        }
        const int32_t from = tab ? values_x : x;
        const int32_t wide =
            from - x +
            add_lines(b, tab ? tab + 1 : at, stop, from, x + room - from, VALUE_LINES, true);
        if (wide > widest) widest = wide;
        if (b->y == y) b->y += (int32_t)b->size.line_px; /* an empty one */
    }
    return widest;
}

/* The end of the group that the first half of the lines ends in; the text's, if that is the last.
 */
static const char *find_half(const char *text) {
    uint32_t count = 0, half = 0;
    for (const char *at = text; *at; at = *line_end(at) ? line_end(at) + 1 : line_end(at)) count++;
    for (const char *at = text; *at; at = *line_end(at) ? line_end(at) + 1 : line_end(at))
        if (*at == '\n' && 2 * half++ >= count - 2)
            return at;
        else if (*at != '\n')
            half++;
    return text + strlen(text);
}

static void add_columns(struct build *b, const char *text) {
    const char *end = text + strlen(text), *half = find_half(text);
    const int32_t between = 2 * (int32_t)b->size.line_px, y = b->y, room = (b->width - between) / 2;
    if (half == end || b->width < TWO_COLUMNS_PX * 9 / 10 ||
        measure(b, text, end).labels > room / 2) {
        b->wide = add_rows(b, text, end, 0, b->width);
        return;
    }
    const int32_t left = add_rows(b, text, half, 0, room), bottom = b->y, from = left + between;
    b->y = y;
    b->wide = from + add_rows(b, half + 1, end, from, room);
    if (b->y < bottom) b->y = bottom;
}

/* ---- beside the line of a split screen ---- */

struct gn_page_rect gn_page_handle(uint32_t width_px, uint32_t height_px, double at) {
    const int32_t side =
                      (int32_t)((width_px < height_px ? width_px : height_px) / HANDLE_SHARE + 8) /
                      2 * 2,
                  line = (int32_t)lround(at * width_px);
    return (struct gn_page_rect){line - side / 2, ((int32_t)height_px - side) / 2, side, side};
}

struct gn_page_style gn_page_beside(enum gn_caption_kind kind, uint32_t width_px,
                                    uint32_t height_px, double at) {
    struct gn_page_style style = gn_page_styles[kind];
    const int32_t margin = (int32_t)width_px / 20 + 1, most = (int32_t)width_px - margin,
                  handle = gn_page_handle(width_px, height_px, at).width,
                  line = (int32_t)lround(at * width_px);
    const int32_t left_to = line - handle / 4, right_from = line + handle / 4;
    style.from_px = style.at_right || right_from < margin ? margin : right_from;
    style.to_px = !style.at_right || left_to > most ? most : left_to < 1 ? 1 : left_to;
    return style;
}

/* ---- a page ---- */

static struct gn_page_size resize(struct build *b, uint32_t line_px) {
    return b->size = b->font->resize(b->font->data, line_px);
}

/* From the upper left corner, in lines of that size, and a title in proportion. */
static void add_all(struct build *b, const char *text, uint32_t line_px) {
    const struct gn_page_style *style = b->style;
    b->out->count = 0;
    b->wide = b->y = 0;
    if (style->title_share > 0) {
        const char *end = line_end(text);
        resize(b, line_px * style->share / style->title_share);
        const int32_t title = add_lines(b, text, end, 0, b->width, TITLE_LINES, true);
        text = end + (*end == '\n');
        b->wide = title;
    }
    resize(b, line_px);
    const int32_t title = b->wide, line = (int32_t)b->size.line_px;
    int32_t wide;
    if (style->columns) {
        add_columns(b, text);
        wide = b->wide;
    } else {
        const int32_t fit = (b->height - b->y) / line,
                      most = style->most_lines ? (int32_t)style->most_lines : WRAPPED_MAX;
        wide = add_lines(b, text, text + strlen(text), 0, b->width,
                         (uint32_t)(fit < 1      ? 1
                                    : fit < most ? fit
                                                 : most),
                         style->wraps);
    }
    b->wide = wide > title ? wide : title;
}

/* By its first letter. */
static bool runs_from_right(const struct gn_page_line *line) {
    const char *at = line->begin;
    for (uint32_t code; (code = gn_layout_next(&at, line->end)) != 0;)
        if (gn_script_is_rtl(code) || code >= 'A') return gn_script_is_rtl(code);
    return false;
}

void gn_page_build(const struct gn_page_style *style, const struct gn_page_font *font,
                   const char *text, uint32_t width_px, uint32_t height_px, uint32_t used_px,
                   bool has_bar, struct gn_page *out) {
    uint32_t line_px = line_px_of(style->share, width_px, height_px);
    struct build b = {.style = style, .font = font, .out = out};
    const int32_t margin_x = (int32_t)width_px / 20 + 1, margin_y = (int32_t)height_px / 20 + 1,
                  lowest = (int32_t)height_px - margin_y - (int32_t)used_px;
    const int32_t left = style->to_px ? style->from_px : margin_x,
                  right = style->to_px ? style->to_px : (int32_t)width_px - margin_x;
    int32_t beside = 0, above = 0, bar = 0;
    for (;; line_px = line_px * 9 / 10) { /* a page that is too high gets smaller lines */
        resize(&b, line_px);
        beside = (int32_t)b.size.line_px * 3 / 5, above = (int32_t)b.size.line_px * 7 / 20;
        bar = has_bar ? (int32_t)b.size.line_px * 2 / 3 : 0;
        b.width = right - left - 2 * beside;
        b.height = lowest - margin_y - 2 * above - bar;
        add_all(&b, text, line_px);
        if (!style->columns || b.y <= b.height || line_px * 9 / 10 < LINE_MIN_PX) break;
    }
    out->ground = out->bar = (struct gn_page_rect){0};
    if (style->to_px && b.width < ROOM_LINES * (int32_t)b.size.line_px) out->count = 0;
    if (!has_bar && (b.wide == 0 || out->count == 0)) return;
    if (has_bar) b.wide = b.width;
    const int32_t tall = b.y + 2 * above + bar, y = style->at_top ? margin_y : lowest - tall;
    const int32_t x = style->at_right ? right - b.wide - 2 * beside : left;
    out->ground = (struct gn_page_rect){x, y, b.wide + 2 * beside, tall};
    for (uint32_t i = 0; i < out->count; i++) {
        const bool aligned = !style->columns && runs_from_right(&out->lines[i]);
        out->lines[i].rect.x += x + beside + (aligned ? b.wide - out->lines[i].rect.width : 0);
        out->lines[i].rect.y += y + above;
    }
    if (has_bar)
        out->bar = (struct gn_page_rect){x + beside, y + above + b.y + bar / 4, b.wide,
                                         (int32_t)b.size.line_px / 3};
}
