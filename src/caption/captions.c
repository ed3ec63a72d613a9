#include "caption/captions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "caption/atlas.h"
#include "caption/fade.h"
#include "caption/layout.h"
#include "caption/page.h"
#include "caption/shape.h"
#include "core/arena.h"

enum {
    TEXT_BYTES = 2048,
    QUADS_MAX = 4096, /* more are not drawn */
    MARK_SHARE = 80,  /* so many marks fill the picture's shorter side */
};

/* Others come and go with what they are about. */
static const bool rises[GN_CAPTION_KIND_COUNT] = {[GN_CAPTION_INFO] = true,
                                                  [GN_CAPTION_MODE] = true,
                                                  [GN_CAPTION_TEXT] = true,
                                                  [GN_CAPTION_CARD] = true};

struct caption {
    char text[TEXT_BYTES];
    struct gn_caption_fade fade;
};
struct gn_captions {
    struct gn_captions_opts opts;
    struct caption captions[GN_CAPTION_KIND_COUNT];
    struct gn_font *font; /* NULL: not yet */
    struct gn_atlas atlas;
    struct gn_page page;   /* that was laid out last */
    struct gn_shape shape; /* of the line that was looked at last */
    struct gn_caption_run run, sample;
    struct gn_caption_quad quads[QUADS_MAX];
    char missing[512];    /* packages of fonts, and libraqm */
    uint32_t bar_percent; /* filled, plus 1; 0: no bar */
    double split;         /* place of the line of a split screen; below 0: none */
    uint32_t bottom_px;   /* height in use at the picture's lower edge */
    int32_t page_px[2];   /* the first column right of the page, and row below; 0: none */
    int64_t shown_ns;     /* time of the last run */
    bool changed;         /* since then */
    bool stale;           /* the quads show other texts */
};

struct gn_captions *gn_captions_create(const struct gn_captions_opts *opts) {
    struct gn_captions *c = gn_xalloc(1, sizeof *c);
    c->opts = *opts;
    if (c->opts.least_ns == 0) c->opts.least_ns = GN_CAPTION_MODE_NS;
    c->split = -1.0;
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

/* A bar needs no text. */
static bool is_there(const struct gn_captions *c, enum gn_caption_kind kind) {
    return c->captions[kind].text[0] || (kind == GN_CAPTION_TEXT && c->bar_percent > 0);
}

static void drop(struct gn_captions *c, enum gn_caption_kind kind) {
    c->captions[kind].text[0] = '\0';
    if (kind == GN_CAPTION_TEXT) c->bar_percent = 0;
    c->captions[kind].fade = (struct gn_caption_fade){0};
    c->stale = c->changed = true;
}

static void end_caption(struct gn_captions *c, enum gn_caption_kind kind, int64_t now_ns) {
    struct caption *caption = &c->captions[kind];
    if (!is_there(c, kind)) return;
    caption->fade = gn_caption_end(&caption->fade, now_ns);
    c->changed = true;
    if (!c->opts.rises || !rises[kind]) drop(c, kind);
}

static void begin_caption(struct gn_captions *c, enum gn_caption_kind kind, int64_t now_ns) {
    struct caption *caption = &c->captions[kind];
    const int64_t lasts_ns = kind == GN_CAPTION_MODE
                                 ? gn_caption_read_ns(caption->text, c->opts.least_ns)
                             : kind == GN_CAPTION_CARD ? GN_CAPTION_CARD_NS
                                                       : 0;
    caption->fade = gn_caption_begin(&caption->fade, lasts_ns, now_ns);
    if (!c->opts.rises || !rises[kind]) caption->fade.begun_ns = now_ns - GN_CAPTION_RISE_NS;
    c->changed = true;
}

void gn_captions_set(struct gn_captions *c, enum gn_caption_kind kind, const char *text,
                     int64_t now_ns) {
    struct caption *caption = &c->captions[kind];
    const size_t length = text ? strnlen(text, TEXT_BYTES - 1) : 0;
    const bool stays = caption->fade.ends_ns == INT64_MAX,
               equal = strlen(caption->text) == length &&
                       memcmp(caption->text, text ? text : "", length) == 0;
    if (length == 0) {
        if (caption->text[0]) end_caption(c, kind, now_ns);
        return;
    }
    if (equal && stays) return;
    if (!equal) {
        if (kind == GN_CAPTION_TEXT && !stays) c->bar_percent = 0; /* it falls with the old text */
        memcpy(caption->text, text, length);
        caption->text[length] = '\0';
        c->stale = true;
    }
    begin_caption(c, kind, now_ns);
}

void gn_captions_set_least(struct gn_captions *c, int64_t least_ns) { c->opts.least_ns = least_ns; }

void gn_captions_set_bar(struct gn_captions *c, double share, int64_t now_ns) {
    struct caption *caption = &c->captions[GN_CAPTION_TEXT];
    const uint32_t percent = share >= 1.0 ? 101 : 1 + (uint32_t)(100.0 * fmax(share, 0.0));
    const bool falls = is_there(c, GN_CAPTION_TEXT) && caption->fade.ends_ns < INT64_MAX;
    if (share < 0.0) {
        if (c->bar_percent == 0 || falls) return;
        if (!caption->text[0]) {
            end_caption(c, GN_CAPTION_TEXT, now_ns);
            return;
        }
    } else if (falls) {
        drop(c, GN_CAPTION_TEXT);
    }
    const uint32_t next = share < 0.0 ? 0 : percent;
    if (c->bar_percent == next) return;
    const bool begins = !is_there(c, GN_CAPTION_TEXT);
    c->bar_percent = next;
    c->stale = c->changed = true;
    if (begins) begin_caption(c, GN_CAPTION_TEXT, now_ns);
}

void gn_captions_set_split(struct gn_captions *c, double at) {
    if (c->split == at) return;
    c->split = at;
    c->stale = c->changed = true;
}

/* ---- time ---- */

static float alpha_at(const struct gn_captions *c, enum gn_caption_kind kind, int64_t now_ns) {
    return is_there(c, kind) ? gn_caption_alpha(&c->captions[kind].fade, now_ns) : 0.0f;
}

int64_t gn_captions_next_ns(const struct gn_captions *c) {
    int64_t next_ns = INT64_MAX;
    if (c->changed) return 0;
    for (int kind = 0; kind < GN_CAPTION_KIND_COUNT; kind++) {
        const int64_t at_ns = is_there(c, kind)
                                  ? gn_caption_next_ns(&c->captions[kind].fade, c->shown_ns)
                                  : INT64_MAX;
        if (at_ns < next_ns) next_ns = at_ns;
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
    return gn_layout_is_joiner(code) ? 0 : gn_atlas_glyph(&c->atlas, c->font, code)->advance_px;
}

static int32_t width_of(void *data, const char *begin, const char *end) {
    struct gn_captions *c = data;
    gn_shape_line(&c->atlas, c->font, begin, end, false, &c->shape);
    return c->shape.width_px;
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
    const int32_t base = line->rect.y + (int32_t)line->size.ascent_px;
    if (c->font->line_px != line->size.line_px) gn_font_resize(c->font, line->size.line_px);
    gn_shape_line(&c->atlas, c->font, line->begin, line->end, line->cut, &c->shape);
    for (uint32_t i = 0; i < c->shape.count; i++) {
        const struct gn_font_place *place = &c->shape.places[i];
        const struct gn_atlas_glyph *g = gn_atlas_glyph(&c->atlas, c->font, place->glyph);
        push_quad(c, (struct gn_caption_quad){.x = line->rect.x + place->x_px + g->left,
                                              .y = base - place->y_px - g->top,
                                              .width = g->width_px,
                                              .height = g->height_px,
                                              .atlas_x = g->x,
                                              .atlas_y = g->y,
                                              .caption = (uint8_t)kind,
                                              .faint = line->is_label ? GN_CAPTION_WEAK : 0});
    }
}

/* A rectangle with round corners, of rows where they are: its edge there is fainter. */
static void push_round(struct gn_captions *c, struct gn_caption_quad like,
                       const struct gn_page_rect *r, int32_t radius) {
    like.x = r->x, like.y = r->y + radius;
    like.width = r->width, like.height = r->height - 2 * radius;
    push_quad(c, like);
    like.height = 1;
    for (int32_t i = 0; i < 2 * radius; i++) { /* from above and from below by turns */
        const int32_t row = i / 2;
        const double up = radius - row - 0.5,
                     inset = radius - sqrt((double)radius * radius - up * up);
        const int32_t whole = (int32_t)ceil(inset);
        like.y = i % 2 ? r->y + r->height - 1 - row : r->y + row;
        like.x = r->x + whole, like.width = r->width - 2 * whole, like.faint = 0;
        push_quad(c, like);
        like.faint = (uint8_t)(255.0 * (1.0 - (whole - inset)));
        if (like.faint > 250 || whole == 0) continue;
        like.x = r->x + whole - 1, like.width = 1;
        push_quad(c, like);
        like.x = r->x + r->width - whole;
        push_quad(c, like);
    }
}

static void push_ground(struct gn_captions *c, enum gn_caption_kind kind,
                        const struct gn_page_rect *ground) {
    const struct gn_caption_quad like = {.caption = (uint8_t)kind, .ground = true};
    push_round(c, like, ground, (int32_t)c->font->line_px / 5);
}

static void lay_out(struct gn_captions *c, enum gn_caption_kind kind) {
    const bool has_bar = kind == GN_CAPTION_TEXT && c->bar_percent > 0;
    const struct gn_page_font font = {
        .resize = resize_font, .advance_px = advance_of, .line_px = width_of, .data = c};
    const bool beside = kind == GN_CAPTION_LEFT || kind == GN_CAPTION_RIGHT;
    const struct gn_page_style placed =
        beside ? gn_page_beside(kind, c->run.width_px, c->run.height_px, c->split)
               : gn_page_styles[kind];
    const struct gn_page_style *style = &placed;
    struct gn_page *page = &c->page;
    gn_page_build(style, &font, c->captions[kind].text, c->run.width_px, c->run.height_px,
                  style->at_top ? 0 : c->bottom_px, has_bar, page);
    const struct gn_page_rect *ground = &page->ground;
    if (ground->width == 0 || ground->y < c->page_px[1]) return;
    if (kind == GN_CAPTION_INFO) {
        c->page_px[0] = ground->x + ground->width;
        c->page_px[1] = ground->y + ground->height;
    }
    push_ground(c, kind, ground);
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

/* Says once what each text lacks that is shown. */
static void find_missing(struct gn_captions *c) {
    const size_t before = strlen(c->missing);
    for (int kind = 0; kind < GN_CAPTION_KIND_COUNT; kind++)
        if (kind != GN_CAPTION_MARK)
            gn_shape_find_missing(c->font, c->captions[kind].text, c->missing, sizeof c->missing);
    const char *more = c->missing + before;
    if (*more)
        gn_warn(c->opts.warnings, "texts: missing here: %s; install the packages in brackets",
                more + (before ? strspn(more, ", ") : 0));
}

const char *gn_captions_missing(const struct gn_captions *c) { return c->missing; }

/* White on a dark rim, where no page lies. */
static void lay_out_handle(struct gn_captions *c) {
    const struct gn_page_rect rim = gn_page_handle(c->run.width_px, c->run.height_px, c->split);
    if (rim.x < c->page_px[0] && rim.y < c->page_px[1]) return;
    const int32_t wide = rim.width / 8 + 1, side = rim.width - 2 * wide;
    const struct gn_page_rect disc = {rim.x + wide, rim.y + wide, side, side};
    struct gn_caption_quad like = {.caption = GN_CAPTION_RIGHT, .ground = true};
    push_round(c, like, &rim, rim.width / 2);
    gn_font_resize(c->font, 2 * (uint32_t)side); /* a solid is half a line high */
    const struct gn_atlas_glyph *g = gn_atlas_glyph(&c->atlas, c->font, GN_ATLAS_SOLID);
    like.ground = false;
    like.atlas_x = g->x;
    like.atlas_y = g->y;
    if (g->width_px >= side) push_round(c, like, &disc, side / 2);
}

/* Side by side at one height. */
static void lay_out_split(struct gn_captions *c) {
    const uint32_t bottom_px = c->bottom_px;
    lay_out(c, GN_CAPTION_LEFT);
    const uint32_t left_px = c->bottom_px;
    c->bottom_px = bottom_px;
    lay_out(c, GN_CAPTION_RIGHT);
    if (c->bottom_px < left_px) c->bottom_px = left_px;
    lay_out_handle(c);
}

/* A page, and what has room below it; from below: the text, above it the card, labels of a split
 * screen and the mode, which is drawn last. The page has what a card and a mark are about. */
static void lay_out_all(struct gn_captions *c) {
    const bool page = c->captions[GN_CAPTION_INFO].text[0];
    c->bottom_px = 0;
    c->page_px[0] = c->page_px[1] = 0;
    c->run.quad_count = 0;
    if (c->captions[GN_CAPTION_INFO].text[0]) lay_out(c, GN_CAPTION_INFO);
    if (is_there(c, GN_CAPTION_TEXT)) lay_out(c, GN_CAPTION_TEXT);
    if (c->captions[GN_CAPTION_CARD].text[0] && !page) lay_out(c, GN_CAPTION_CARD);
    if (c->captions[GN_CAPTION_RIGHT].text[0] && c->split >= 0.0) lay_out_split(c);
    if (c->captions[GN_CAPTION_MODE].text[0]) lay_out(c, GN_CAPTION_MODE);
    if (c->captions[GN_CAPTION_MARK].text[0] && !page) lay_out_mark(c);
}

static void need_font(struct gn_captions *c) {
    struct gn_err err = {0};
    if (!gn_captions_open_font(c, &err))
        gn_warn(c->opts.warnings, "font: %s; texts are shown in the built-in font", err.text);
}

const struct gn_caption_run *gn_captions_sample(struct gn_captions *c, uint32_t width_px,
                                                uint32_t height_px) {
    static const struct gn_caption_quad pixel = {.width = 1, .height = 1};
    need_font(c);
    if (!c->atlas.picture.generation) { /* the first text's size begins another */
        gn_atlas_glyph(&c->atlas, c->font, GN_ATLAS_SOLID);
        gn_atlas_seal(&c->atlas);
    }
    c->sample = (struct gn_caption_run){.width_px = width_px,
                                        .height_px = height_px,
                                        .quads = &pixel,
                                        .quad_count = 1,
                                        .alpha = {1.0f},
                                        .atlas = &c->atlas.picture};
    return &c->sample;
}

const struct gn_caption_run *gn_captions_run(struct gn_captions *c, uint32_t width_px,
                                             uint32_t height_px, int64_t now_ns) {
    bool seen = false;
    for (int kind = 0; kind < GN_CAPTION_KIND_COUNT; kind++) {
        if (is_there(c, kind) && now_ns >= c->captions[kind].fade.ends_ns) drop(c, kind);
        c->run.alpha[kind] = alpha_at(c, kind, now_ns);
        seen |= c->run.alpha[kind] > 0.0f;
    }
    c->shown_ns = now_ns;
    c->changed = false;
    if (!seen) return NULL;
    need_font(c);
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
        find_missing(c);
        gn_atlas_seal(&c->atlas);
        c->stale = false;
    }
    c->run.quads = c->quads;
    c->run.atlas = &c->atlas.picture;
    return c->run.quad_count && c->run.atlas->generation ? &c->run : NULL;
}
