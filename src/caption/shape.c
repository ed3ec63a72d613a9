#include "caption/shape.h"

#include <stdio.h>
#include <string.h>

#include "caption/layout.h"
#include "caption/script.h"
#include "caption/shaper.h"
#include "core/text.h"

enum { NO_CHARACTER = 0xfffd }; /* in place of bytes that are none */

/* Up to GN_FONT_PLACES_MAX characters; how many. */
static uint32_t read_codes(const char *begin, const char *end, bool cut, uint32_t *codes) {
    static const char gap[] = GN_LAYOUT_GAP;
    uint32_t count = 0;
    for (uint32_t code; count < GN_FONT_PLACES_MAX && (code = gn_layout_next(&begin, end)) != 0;)
        codes[count++] = code;
    for (const char *c = gap; cut && *c && count < GN_FONT_PLACES_MAX; c++)
        codes[count++] = (uint8_t)*c;
    return count;
}

static bool needs_shaping(const uint32_t *codes, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (gn_script_is_complex(codes[i])) return true;
    return false;
}

/* Character behind character. */
static void put_in_order(struct gn_atlas *atlas, struct gn_font *font, const uint32_t *codes,
                         uint32_t count, struct gn_shape *out) {
    for (uint32_t i = 0; i < count; i++) {
        if (gn_layout_is_joiner(codes[i])) continue;
        if (i > 0) out->width_px += gn_font_kern_px(font, codes[i - 1], codes[i]);
        out->places[out->count++] =
            (struct gn_font_place){.glyph = codes[i], .x_px = out->width_px};
        out->width_px += gn_atlas_glyph(atlas, font, codes[i])->advance_px;
    }
}

void gn_shape_line(struct gn_atlas *atlas, struct gn_font *font, const char *begin, const char *end,
                   bool cut, struct gn_shape *out) {
    uint32_t codes[GN_FONT_PLACES_MAX];
    const uint32_t count = read_codes(begin, end, cut, codes);
    out->count = 0;
    out->width_px = 0;
    if (needs_shaping(codes, count))
        out->count = gn_font_shape(font, codes, count, out->places, &out->width_px);
    if (out->count == 0) {
        out->width_px = 0;
        put_in_order(atlas, font, codes, count, out);
    }
}

/* ---- what is missing ---- */

const char gn_shape_samples[] = "ΩЯԲאبकকਕકକகకಕകකกກကბሀកㄱ한漢あ☀🌞";

/* The last row that names its script is the one whose package has most of it. */
static void name_script(uint32_t code, char *out, size_t size) {
    const struct gn_script *named = NULL;
    for (const struct gn_script *row = NULL; (row = gn_script_next(row, code));)
        if (row->name) named = row;
    if (named)
        snprintf(out, size, "%s (%s)", named->name, named->package);
    else
        snprintf(out, size, "U+%04X (no package is known)", (unsigned)code);
}

static void add_once(char *out, size_t size, const char *name) {
    if (!strstr(out, name)) gn_text_add(out, size, "%s%s", *out ? ", " : "", name);
}

bool gn_shape_find_missing(struct gn_font *font, const char *text, char *out, size_t size) {
    const char *end = text + strlen(text);
    bool shapes = false;
    for (uint32_t code; (code = gn_layout_next(&text, end)) != 0;) {
        char name[64];
        shapes |= gn_script_is_complex(code) && font->ops->shape;
        if (code < 0x80 || code == NO_CHARACTER || gn_layout_is_joiner(code) ||
            gn_font_has(font, code))
            continue;
        name_script(code, name, sizeof name);
        add_once(out, size, name);
    }
    if (shapes && !gn_shaper_open(NULL)) add_once(out, size, "letters that join (libraqm0)");
    return *out;
}
