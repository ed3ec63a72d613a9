#include "caption/layout.h"

#include <string.h>

#include "caption/script.h"

enum { REPLACEMENT = 0xfffd };

/* ---- UTF-8 (Unicode 15, table 3-7) ---- */

static uint32_t decode_character(const char **text, const char *end) {
    const uint8_t *at = (const uint8_t *)*text;
    const uint8_t lead = at[0];
    if (lead < 0xc2 || lead > 0xf4) { /* ASCII, or no first byte of a character */
        ++*text;
        return lead < 0x80 ? lead : REPLACEMENT;
    }
    const int length = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    /* the range of the second byte */
    uint8_t least = lead == 0xe0   ? 0xa0
                    : lead == 0xf0 ? 0x90
                                   : 0x80,
            most = lead == 0xed   ? 0x9f
                   : lead == 0xf4 ? 0x8f
                                  : 0xbf;
    uint32_t code = lead & (0x7fu >> length);
    for (int i = 1; i < length; i++) {
        if ((const char *)at + i == end || at[i] < least || at[i] > most) {
            *text += i; /* the next character may be valid */
            return REPLACEMENT;
        }
        code = code << 6 | (at[i] & 0x3f);
        least = 0x80, most = 0xbf;
    }
    *text += length;
    return code;
}

uint32_t gn_layout_next(const char **text, const char *end) {
    while (*text < end && **text) {
        const uint32_t code = decode_character(text, end);
        if (code == '\t') return ' ';
        const bool invisible = /* controls, direction marks and variation selectors */
            (code < 0x20 && code != '\n') || (code >= 0x7f && code < 0xa0) || code == 0xad ||
            code == 0x200b || (code >= 0x200e && code <= 0x200f) ||
            (code >= 0x2028 && code <= 0x202e) || (code >= 0x2060 && code <= 0x206f) ||
            (code >= 0xfe00 && code <= 0xfe0f) || code == 0xfeff || code >= 0xe0000;
        if (!invisible) return code;
    }
    return 0;
}

bool gn_layout_is_joiner(uint32_t code) { return code == 0x200c || code == 0x200d; }

/* ---- lines ---- */

int32_t gn_layout_width_px(const struct gn_layout_opts *opts, const char *begin, const char *end) {
    int32_t width = 0;
    if (opts->line_px) return opts->line_px(opts->data, begin, end);
    for (uint32_t code; (code = gn_layout_next(&begin, end)) != 0;)
        width += opts->advance_px(opts->data, code);
    return width;
}

static bool is_space(char c) { return c == ' ' || c == '\t'; }

static const char *trim_spaces(const char *begin, const char *end) {
    while (end > begin && is_space(end[-1])) end--;
    return end;
}

/* The end of a line of at most `room` pixels: after the last word that fits, or within the first
 * word. The line has at least one character, so that a layout ends. */
static const char *break_at(const struct gn_layout_opts *opts, const char *begin, const char *end,
                            int32_t room, bool words) {
    const char *at = begin, *word = begin, *letter = begin;
    int32_t width = 0;
    bool breaks = false; /* the character before is one that lines break behind */
    while (at < end) {
        const char *next = at;
        const uint32_t code = gn_layout_next(&next, end);
        if (code == 0) return end;
        width += opts->advance_px(opts->data, code);
        if (code == ' ' || (breaks && gn_script_breaks(code))) word = at;
        if (!gn_script_is_mark(code)) letter = at;
        if (width > room) return words && word > begin ? word : letter > begin ? letter : next;
        breaks = gn_script_breaks(code);
        at = next;
    }
    return end;
}

/* Likewise; characters together may be wider than apart. */
static const char *break_line(const struct gn_layout_opts *opts, const char *begin, const char *end,
                              int32_t room, bool words) {
    for (int32_t less = room;; less -= room / 16 + 1) {
        const char *at = break_at(opts, begin, end, less, words);
        if (less <= room / 2 || gn_layout_width_px(opts, begin, at) <= room) return at;
    }
}

static void cut_line(const struct gn_layout_opts *opts, struct gn_layout_line *line,
                     const char *end) {
    const int32_t gap =
        (int32_t)strlen(GN_LAYOUT_GAP) * opts->advance_px(opts->data, GN_LAYOUT_GAP[0]);
    const int32_t room = opts->width_px - gap;
    line->cut = true;
    if (gn_layout_width_px(opts, line->begin, end) > room)
        end = room > 0 ? break_line(opts, line->begin, end, room, false) : line->begin;
    line->end = trim_spaces(line->begin, end);
    line->width_px = gn_layout_width_px(opts, line->begin, line->end) + gap;
}

uint32_t gn_layout_build(const struct gn_layout_opts *opts, const char *text, const char *end,
                         struct gn_layout_line *lines) {
    uint32_t count = 0;
    end = text + strnlen(text, (size_t)(end - text));
    while (text < end && count < opts->most_lines) {
        struct gn_layout_line *line = &lines[count++];
        const char *newline = memchr(text, '\n', (size_t)(end - text));
        const char *stop = newline ? newline : end;
        *line = (struct gn_layout_line){.begin = text, .end = trim_spaces(text, stop)};
        line->width_px = gn_layout_width_px(opts, line->begin, line->end);
        const char *next = stop + (stop < end);
        if (line->width_px > opts->width_px && opts->wraps) {
            const char *at = break_line(opts, text, line->end, opts->width_px, true);
            for (next = at; next < stop && is_space(*next);) next++;
            if (next == stop) next += stop < end;
            line->end = trim_spaces(text, at);
            line->width_px = gn_layout_width_px(opts, text, line->end);
        } else if (line->width_px > opts->width_px) {
            cut_line(opts, line, line->end);
        }
        if (count == opts->most_lines && next < end && !line->cut)
            cut_line(opts, line, opts->wraps && next < stop ? stop : line->end);
        text = next;
    }
    return count;
}
