/* Shelf packing: glyphs stand in rows, left to right, in the order in which they come. */
#include "caption/atlas.h"

#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "core/hash.h"

enum { FIRST_HEIGHT_PX = 128 };

void gn_atlas_reset(struct gn_atlas *atlas) {
    free((void *)atlas->picture.coverage);
    *atlas = (struct gn_atlas){0};
}

void gn_atlas_seal(struct gn_atlas *atlas) {
    struct gn_caption_atlas *p = &atlas->picture;
    if (!atlas->changed) return;
    atlas->changed = false;
    p->generation = gn_hash(GN_HASH_INIT, p->coverage, (size_t)p->width_px * p->height_px) | 1;
}

static void fill_glyph(struct gn_atlas *atlas, struct gn_atlas_glyph *g,
                       const struct gn_glyph *from) {
    struct gn_caption_atlas *p = &atlas->picture;
    g->advance_px = (uint16_t)from->advance_px;
    g->left = (int16_t)from->left;
    g->top = (int16_t)from->top;
    if (!from->coverage || from->width_px == 0 || from->height_px == 0) return;

    /* room for it: on this shelf, or on a new one */
    if (atlas->shelf_x + from->width_px > p->width_px && atlas->shelf_px > 0) {
        atlas->shelf_y += atlas->shelf_px;
        atlas->shelf_x = atlas->shelf_px = 0;
    }
    while (atlas->shelf_y + from->height_px > p->height_px) {
        /* doubles the height; the first time it is as wide as about twenty characters */
        const uint32_t before = p->height_px, height = before ? 2 * before : FIRST_HEIGHT_PX;
        if (height > GN_ATLAS_SIDE_MAX) {
            atlas->full = true;
            return;
        }
        if (!before) p->width_px = g->line_px <= 24 ? 256 : g->line_px <= 48 ? 512 : 1024;
        uint8_t *more = gn_xrealloc((void *)p->coverage, height, p->width_px);
        memset(more + (size_t)before * p->width_px, 0, (size_t)(height - before) * p->width_px);
        p->coverage = more;
        p->height_px = height;
    }
    if (atlas->shelf_x + from->width_px > p->width_px) {
        atlas->full = true;
        return;
    }
    g->width_px = (uint16_t)from->width_px;
    g->height_px = (uint16_t)from->height_px;
    g->x = (uint16_t)atlas->shelf_x;
    g->y = (uint16_t)atlas->shelf_y;
    atlas->shelf_x += g->width_px;
    if (g->height_px > atlas->shelf_px) atlas->shelf_px = g->height_px;
    atlas->changed = true;

    const size_t stride = p->width_px;
    uint8_t *to = (uint8_t *)p->coverage + g->y * stride + g->x;
    for (uint32_t row = 0; row < g->height_px; row++)
        memcpy(to + row * stride, from->coverage + row * from->stride, g->width_px);
}

const struct gn_atlas_glyph *gn_atlas_glyph(struct gn_atlas *atlas, struct gn_font *font,
                                            uint32_t code) {
    static const struct gn_atlas_glyph none = {0};
    struct gn_glyph from;
    for (uint32_t i = 0; i < atlas->count; i++)
        if (atlas->glyphs[i].code == code && atlas->glyphs[i].line_px == font->line_px)
            return &atlas->glyphs[i];
    if (atlas->count == GN_ATLAS_GLYPHS_MAX) {
        atlas->full = true;
        return &none;
    }
    struct gn_atlas_glyph *g = &atlas->glyphs[atlas->count++];
    *g = (struct gn_atlas_glyph){.code = code, .line_px = font->line_px};
    if (code == GN_ATLAS_SOLID) {
        const uint32_t side = g->line_px / 2 + 1;
        uint8_t *coverage = gn_xalloc((size_t)side * side, 1);
        memset(coverage, 255, (size_t)side * side);
        from = (struct gn_glyph){
            .width_px = side, .height_px = side, .stride = side, .coverage = coverage};
        fill_glyph(atlas, g, &from);
        free(coverage);
        return g;
    }
    if (gn_font_glyph(font, code, &from)) {
        fill_glyph(atlas, g, &from);
        return g;
    }

    /* the font has no such character: a hollow rectangle, three fifths of a line high */
    const uint32_t height = g->line_px * 3 / 5 + 1, width = height * 2 / 3 + 1;
    const uint32_t rim = g->line_px / 14 + 1;
    uint8_t *coverage = gn_xalloc((size_t)width * height, 1);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            if (x < rim || y < rim || x + rim >= width || y + rim >= height)
                coverage[y * width + x] = 255;
    fill_glyph(atlas, g,
               &(struct gn_glyph){.left = (int32_t)rim,
                                  .top = (int32_t)height,
                                  .width_px = width,
                                  .height_px = height,
                                  .advance_px = (int32_t)(width + 2 * rim),
                                  .stride = width,
                                  .coverage = coverage});
    free(coverage);
    return g;
}
