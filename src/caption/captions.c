#include "caption/captions.h"

#include <stdlib.h>
#include <string.h>

#include "caption/atlas.h"
#include "caption/layout.h"
#include "core/arena.h"

enum {
    TEXT_BYTES = 2048,
    LINES_MAX = 32,
    QUADS_MAX = 1536, /* more are not drawn */
    LINE_MIN_PX = 8,
    LINE_MAX_PX = 128,
};

/* Place and size of each kind. */
static const struct row {
    uint32_t lines_a_side; /* this many lines fill the picture's shorter side */
    uint32_t most_lines;   /* 0: as many as there is room for */
    bool wraps, at_top;
    int64_t lasts_ns; /* 0: until it is removed */
} rows[GN_CAPTION_KIND_COUNT] = {
    [GN_CAPTION_INFO] = {.lines_a_side = 30, .at_top = true},
    [GN_CAPTION_MODE] = {.lines_a_side = 24, .most_lines = 1, .lasts_ns = GN_CAPTION_MODE_NS},
    [GN_CAPTION_ERROR] = {.lines_a_side = 24, .most_lines = 8, .wraps = true},
};

struct caption {
    char text[TEXT_BYTES];
    int64_t set_ns;
};
struct gn_captions {
    struct gn_captions_opts opts;
    struct caption captions[GN_CAPTION_KIND_COUNT];
    struct gn_font *font; /* NULL: not yet */
    struct gn_atlas atlas;
    struct gn_caption_run run;
    struct gn_caption_quad quads[QUADS_MAX];
    uint32_t bar_percent; /* filled, plus 1; 0: no bar */
    uint32_t bottom_px;   /* height in use at the picture's lower edge */
    int64_t shown_ns;     /* time of the last run */
    bool changed;         /* since then */
    bool stale;           /* the quads show other texts */
};

struct gn_captions *gn_captions_create(const struct gn_captions_opts *opts) {
    struct gn_captions *c = gn_xalloc(1, sizeof *c);
    c->opts = *opts;
    return c;
}

void gn_captions_destroy(struct gn_captions *c) {
    if (!c) return;
    gn_font_close(c->font);
    gn_atlas_reset(&c->atlas);
    free(c);
}

bool gn_captions_open_font(struct gn_captions *c, struct gn_err *err) {
    const char *path = c->opts.font;
    if (c->font) return true;
    if (!path || *path) c->font = gn_font_open_file(path, err);
    if (c->font) return true;
    c->font = gn_font_open_dots();
    return !path || !*path;
}

void gn_captions_set(struct gn_captions *c, enum gn_caption_kind kind, const char *text,
                     int64_t now_ns) {
    struct caption *caption = &c->captions[kind];
    const size_t length = text ? strnlen(text, TEXT_BYTES - 1) : 0;
    if (strlen(caption->text) != length || memcmp(caption->text, text ? text : "", length) != 0) {
        if (length) memcpy(caption->text, text, length);
        caption->text[length] = '\0';
        c->stale = c->changed = true;
    }
    if (rows[kind].lasts_ns && length) c->changed = true;
    caption->set_ns = now_ns;
}

void gn_captions_set_bar(struct gn_captions *c, double share) {
    const uint32_t percent = share < 0.0 ? 0 : 1 + (share >= 1.0 ? 100 : (uint32_t)(100.0 * share));
    if (c->bar_percent == percent) return;
    c->bar_percent = percent;
    c->stale = c->changed = true;
}

/* ---- time ---- */

float gn_caption_alpha(enum gn_caption_kind kind, int64_t age_ns) {
    const int64_t left_ns = rows[kind].lasts_ns - age_ns;
    if (rows[kind].lasts_ns == 0 || left_ns >= GN_CAPTION_FADE_NS) return 1.0f;
    return left_ns > 0 ? (float)left_ns / (float)GN_CAPTION_FADE_NS : 0.0f;
}

static float alpha_at(const struct caption *caption, enum gn_caption_kind kind, int64_t now_ns) {
    return caption->text[0] ? gn_caption_alpha(kind, now_ns - caption->set_ns) : 0.0f;
}

int64_t gn_captions_next_ns(const struct gn_captions *c) {
    int64_t next_ns = INT64_MAX;
    if (c->changed) return 0;
    for (int kind = 0; kind < GN_CAPTION_KIND_COUNT; kind++) {
        const struct caption *caption = &c->captions[kind];
        const float alpha = alpha_at(caption, kind, c->shown_ns);
        const int64_t fades_ns = caption->set_ns + rows[kind].lasts_ns - GN_CAPTION_FADE_NS;
        if (rows[kind].lasts_ns == 0 || alpha <= 0.0f) continue;
        if (alpha < 1.0f) return 0;
        if (fades_ns < next_ns) next_ns = fades_ns;
    }
    return next_ns;
}

/* ---- laying out ---- */

static uint32_t line_px_of(const struct row *row, uint32_t width, uint32_t height) {
    const uint32_t line = (width < height ? width : height) / row->lines_a_side;
    return line < LINE_MIN_PX ? LINE_MIN_PX : line > LINE_MAX_PX ? LINE_MAX_PX : line;
}

static int32_t advance_of(void *data, uint32_t code) {
    struct gn_captions *c = data;
    return gn_atlas_glyph(&c->atlas, c->font, code)->advance_px;
}

/* Clips the quad to the picture and adds it. */
static void push_quad(struct gn_captions *c, struct gn_caption_quad quad) {
    const int32_t right = quad.x + quad.width, bottom = quad.y + quad.height;
    const int32_t width = (int32_t)c->run.width_px, height = (int32_t)c->run.height_px;
    if (right <= 0 || bottom <= 0 || quad.x >= width || quad.y >= height) return;
    if (quad.width <= 0 || quad.height <= 0 || c->run.quad_count == QUADS_MAX) return;
    if (quad.x < 0) quad.atlas_x = (uint16_t)(quad.atlas_x - quad.x), quad.x = 0;
    if (quad.y < 0) quad.atlas_y = (uint16_t)(quad.atlas_y - quad.y), quad.y = 0;
    quad.width = (right < width ? right : width) - quad.x;
    quad.height = (bottom < height ? bottom : height) - quad.y;
    c->quads[c->run.quad_count++] = quad;
}

static int32_t push_text(struct gn_captions *c, enum gn_caption_kind kind, const char *begin,
                         const char *end, int32_t x, int32_t base) {
    for (uint32_t code; (code = gn_layout_next(&begin, end)) != 0;) {
        const struct gn_atlas_glyph *g = gn_atlas_glyph(&c->atlas, c->font, code);
        push_quad(c, (struct gn_caption_quad){.x = x + g->left,
                                              .y = base - g->top,
                                              .width = g->width_px,
                                              .height = g->height_px,
                                              .atlas_x = g->x,
                                              .atlas_y = g->y,
                                              .caption = (uint8_t)kind});
        x += g->advance_px;
    }
    return x;
}

/* A white rectangle, of squares that are a line high at most. */
static void push_solid(struct gn_captions *c, enum gn_caption_kind kind, struct gn_caption_quad q) {
    const struct gn_atlas_glyph *g = gn_atlas_glyph(&c->atlas, c->font, GN_ATLAS_SOLID);
    const int32_t right = q.x + q.width;
    if (g->width_px == 0) return; /* the atlas is full */
    for (; q.x < right; q.x += g->width_px) {
        q.width = right - q.x < g->width_px ? right - q.x : g->width_px;
        q.atlas_x = g->x;
        q.atlas_y = g->y;
        q.caption = (uint8_t)kind;
        push_quad(c, q);
    }
}

/* The filled part is a third of a line high, the rest a thin line. */
static void lay_out_bar(struct gn_captions *c, enum gn_caption_kind kind, int32_t x, int32_t y,
                        int32_t width) {
    const int32_t line = (int32_t)c->font->line_px, height = line / 3, thin = line / 12 + 1;
    const int32_t filled = width * (int32_t)(c->bar_percent - 1) / 100;
    push_solid(c, kind,
               (struct gn_caption_quad){.x = x, .y = y, .width = filled, .height = height});
    push_solid(
        c, kind,
        (struct gn_caption_quad){
            .x = x + filled, .y = y + height - thin, .width = width - filled, .height = thin});
}

/* The ground under the lines is half a line wider on each side than they are, and a quarter higher.
 */
static void lay_out(struct gn_captions *c, enum gn_caption_kind kind) {
    static const char gap[] = GN_LAYOUT_GAP;
    const struct row *row = &rows[kind];
    const char *text = c->captions[kind].text;
    const uint32_t width = c->run.width_px, height = c->run.height_px;
    struct gn_layout_line lines[LINES_MAX];
    if (!gn_font_resize(c->font, line_px_of(row, width, height))) return;

    /* the margin is a large line: televisions do not show the edges of a picture */
    const int32_t margin = (int32_t)line_px_of(&rows[GN_CAPTION_MODE], width, height);
    const int32_t line = (int32_t)c->font->line_px, beside = line / 2, above = line / 4;
    const int32_t lowest = (int32_t)height - margin - (int32_t)c->bottom_px;
    const int32_t fit = (lowest - margin - 2 * above) / line;
    const int32_t most = row->most_lines ? (int32_t)row->most_lines : LINES_MAX;
    const struct gn_layout_opts opts = {
        .width_px = (int32_t)width - 2 * (margin + beside),
        .most_lines = (uint32_t)(fit < 1      ? 1
                                 : fit < most ? fit
                                              : most),
        .wraps = row->wraps,
        .advance_px = advance_of,
        .data = c,
    };
    const uint32_t count = gn_layout_build(&opts, text, text + strlen(text), lines);
    int32_t widest = 0;
    for (uint32_t i = 0; i < count; i++)
        if (lines[i].width_px > widest) widest = lines[i].width_px;
    if (widest == 0) return;

    const bool has_bar = kind == GN_CAPTION_ERROR && c->bar_percent > 0;
    if (has_bar) widest = opts.width_px;
    const int32_t tall = (int32_t)count * line + 2 * above + (has_bar ? line * 2 / 3 : 0);
    const int32_t y = row->at_top ? margin : lowest - tall;
    push_quad(c, (struct gn_caption_quad){.x = margin,
                                          .y = y,
                                          .width = widest + 2 * beside,
                                          .height = tall,
                                          .caption = (uint8_t)kind,
                                          .ground = true});
    for (uint32_t i = 0; i < count; i++) {
        const int32_t base = y + above + (int32_t)(i * c->font->line_px + c->font->ascent_px);
        const int32_t end = push_text(c, kind, lines[i].begin, lines[i].end, margin + beside, base);
        if (lines[i].cut) push_text(c, kind, gap, gap + sizeof gap - 1, end, base);
    }
    if (has_bar)
        lay_out_bar(c, kind, margin + beside, y + above + (int32_t)count * line + line / 6, widest);
    if (!row->at_top) c->bottom_px += (uint32_t)(tall + above);
}

/* From below: the error, above it the mode, which is drawn last. */
static void lay_out_all(struct gn_captions *c) {
    static const enum gn_caption_kind order[GN_CAPTION_KIND_COUNT] = {
        GN_CAPTION_ERROR, GN_CAPTION_INFO, GN_CAPTION_MODE};
    c->bottom_px = 0;
    c->run.quad_count = 0;
    for (int i = 0; i < GN_CAPTION_KIND_COUNT; i++)
        if (c->captions[order[i]].text[0]) lay_out(c, order[i]);
}

const struct gn_caption_run *gn_captions_run(struct gn_captions *c, uint32_t width_px,
                                             uint32_t height_px, int64_t now_ns) {
    bool seen = false;
    for (int kind = 0; kind < GN_CAPTION_KIND_COUNT; kind++) {
        c->run.alpha[kind] = alpha_at(&c->captions[kind], kind, now_ns);
        seen |= c->run.alpha[kind] > 0.0f;
    }
    c->shown_ns = now_ns;
    c->changed = false;
    if (!seen) return NULL;
    struct gn_err err = {0};
    if (!gn_captions_open_font(c, &err))
        gn_warn(c->opts.warnings, "font: %s; texts are shown in the built-in font", err.text);
    if (c->stale || c->run.width_px != width_px || c->run.height_px != height_px) {
        const bool other_size = c->run.width_px != width_px || c->run.height_px != height_px;
        c->run.width_px = width_px;
        c->run.height_px = height_px;
        if (other_size) gn_atlas_reset(&c->atlas);
        lay_out_all(c);
        if (c->atlas.full) { /* with glyphs that are no longer used */
            gn_atlas_reset(&c->atlas);
            lay_out_all(c);
        }
        gn_atlas_seal(&c->atlas);
        c->stale = false;
    }
    c->run.quads = c->quads;
    c->run.atlas = &c->atlas.picture;
    return c->run.quad_count && c->run.atlas->generation ? &c->run : NULL;
}
