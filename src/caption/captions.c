#include "caption/captions.h"

#include <stdlib.h>
#include <string.h>

#include "caption/atlas.h"
#include "caption/layout.h"
#include "caption/page.h"
#include "core/arena.h"

enum {
    TEXT_BYTES = 2048,
    QUADS_MAX = 2560, /* more are not drawn */
    MARK_SHARE = 80,  /* so many marks fill the picture's shorter side */
};

static const int64_t lasts_ns[GN_CAPTION_KIND_COUNT] = {/* 0: until it is removed */
                                                        [GN_CAPTION_MODE] = GN_CAPTION_MODE_NS,
                                                        [GN_CAPTION_CARD] = GN_CAPTION_CARD_NS};

struct caption {
    char text[TEXT_BYTES];
    int64_t set_ns;
};
struct gn_captions {
    struct gn_captions_opts opts;
    struct caption captions[GN_CAPTION_KIND_COUNT];
    struct gn_font *font; /* NULL: not yet */
    struct gn_atlas atlas;
    struct gn_page page; /* that was laid out last */
    struct gn_caption_run run;
    struct gn_caption_quad quads[QUADS_MAX];
    uint32_t bar_percent; /* filled, plus 1; 0: no bar */
    uint32_t bottom_px;   /* height in use at the picture's lower edge */
    int32_t page_px;      /* the first row below the page; 0: there is none */
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
    if (lasts_ns[kind] && length) c->changed = true;
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
    const int64_t left_ns = lasts_ns[kind] - age_ns;
    if (lasts_ns[kind] == 0 || left_ns >= GN_CAPTION_FADE_NS) return 1.0f;
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
        const int64_t fades_ns = caption->set_ns + lasts_ns[kind] - GN_CAPTION_FADE_NS;
        if (lasts_ns[kind] == 0 || alpha <= 0.0f) continue;
        if (alpha < 1.0f) return 0;
        if (fades_ns < next_ns) next_ns = fades_ns;
    }
    return next_ns;
}

/* ---- laying out ---- */

static struct gn_page_size resize_font(void *data, uint32_t line_px) {
    struct gn_captions *c = data;
    gn_font_resize(c->font, line_px);
    return (struct gn_page_size){c->font->line_px, c->font->ascent_px};
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

static int32_t push_text(struct gn_captions *c, struct gn_caption_quad like, const char *begin,
                         const char *end) {
    const int32_t base = like.y;
    for (uint32_t code; (code = gn_layout_next(&begin, end)) != 0;) {
        const struct gn_atlas_glyph *g = gn_atlas_glyph(&c->atlas, c->font, code);
        struct gn_caption_quad quad = like;
        quad.x += g->left;
        quad.y = base - g->top;
        quad.width = g->width_px;
        quad.height = g->height_px;
        quad.atlas_x = g->x;
        quad.atlas_y = g->y;
        push_quad(c, quad);
        like.x += g->advance_px;
    }
    return like.x;
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

/* The filled part is as high as the bar, the rest a thin line. */
static void push_bar(struct gn_captions *c, enum gn_caption_kind kind,
                     const struct gn_page_rect *bar) {
    const int32_t thin = bar->height / 4 + 1,
                  filled = bar->width * (int32_t)(c->bar_percent - 1) / 100;
    push_solid(
        c, kind,
        (struct gn_caption_quad){.x = bar->x, .y = bar->y, .width = filled, .height = bar->height});
    push_solid(c, kind,
               (struct gn_caption_quad){.x = bar->x + filled,
                                        .y = bar->y + bar->height - thin,
                                        .width = bar->width - filled,
                                        .height = thin});
}

static void push_line(struct gn_captions *c, enum gn_caption_kind kind,
                      const struct gn_page_line *line) {
    static const char gap[] = GN_LAYOUT_GAP;
    struct gn_caption_quad like = {.x = line->rect.x,
                                   .y = line->rect.y + (int32_t)line->size.ascent_px,
                                   .caption = (uint8_t)kind,
                                   .weak = line->is_label};
    if (c->font->line_px != line->size.line_px) gn_font_resize(c->font, line->size.line_px);
    like.x = push_text(c, like, line->begin, line->end);
    if (line->cut) push_text(c, like, gap, gap + sizeof gap - 1);
}

static void lay_out(struct gn_captions *c, enum gn_caption_kind kind) {
    const bool has_bar = kind == GN_CAPTION_TEXT && c->bar_percent > 0;
    const struct gn_page_font font = {.resize = resize_font, .advance_px = advance_of, .data = c};
    const struct gn_page_style *style = &gn_page_styles[kind];
    struct gn_page *page = &c->page;
    gn_page_build(style, &font, c->captions[kind].text, c->run.width_px, c->run.height_px,
                  style->at_top ? 0 : c->bottom_px, has_bar, page);
    const struct gn_page_rect *ground = &page->ground;
    if (ground->width == 0 || ground->y < c->page_px) return;
    if (kind == GN_CAPTION_INFO) c->page_px = ground->y + ground->height;
    push_quad(c, (struct gn_caption_quad){.x = ground->x,
                                          .y = ground->y,
                                          .width = ground->width,
                                          .height = ground->height,
                                          .caption = (uint8_t)kind,
                                          .ground = true});
    for (uint32_t i = 0; i < page->count; i++) push_line(c, kind, &page->lines[i]);
    if (has_bar) push_bar(c, kind, &page->bar);
    if (!style->at_top) c->bottom_px += (uint32_t)ground->height + c->font->line_px * 7 / 20;
}

/* A white square on a ground that is twice as wide. */
static void lay_out_mark(struct gn_captions *c) {
    const uint32_t width = c->run.width_px, height = c->run.height_px;
    const int32_t side = (int32_t)((width < height ? width : height) / MARK_SHARE + 1),
                  x = (int32_t)(width - width / 20) - 2 * side, y = (int32_t)(height / 20 + 1);
    gn_font_resize(c->font, 3 * (uint32_t)side); /* a solid is half a line high */
    push_quad(c, (struct gn_caption_quad){.x = x,
                                          .y = y,
                                          .width = 2 * side,
                                          .height = 2 * side,
                                          .caption = GN_CAPTION_MARK,
                                          .ground = true});
    push_solid(c, GN_CAPTION_MARK,
               (struct gn_caption_quad){
                   .x = x + side / 2, .y = y + side / 2, .width = side, .height = side});
}

/* A page, and what has room below it; from below: the text, above it the card and the mode. The
 * page has what a card and a mark are about. */
static void lay_out_all(struct gn_captions *c) {
    static const enum gn_caption_kind order[] = {GN_CAPTION_INFO, GN_CAPTION_TEXT, GN_CAPTION_CARD,
                                                 GN_CAPTION_MODE};
    const bool page = c->captions[GN_CAPTION_INFO].text[0];
    c->bottom_px = 0;
    c->page_px = 0;
    c->run.quad_count = 0;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++)
        if (c->captions[order[i]].text[0] && !(page && order[i] == GN_CAPTION_CARD))
            lay_out(c, order[i]);
    if (c->captions[GN_CAPTION_MARK].text[0] && !page) lay_out_mark(c);
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
