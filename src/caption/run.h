/* Captions ready to be drawn: rectangles, in their order. Plain data. */
#ifndef GN_CAPTION_RUN_H
#define GN_CAPTION_RUN_H

#include <stdbool.h>
#include <stdint.h>

enum gn_caption_kind {
    GN_CAPTION_INFO,  /* a page: a title and rows of two columns, top left, until removed */
    GN_CAPTION_MODE,  /* a name: two lines at most, bottom left, for 2 s or longer */
    GN_CAPTION_TEXT,  /* wrapped, bottom left, until removed; a bar may be below it */
    GN_CAPTION_CARD,  /* a title and what follows, wrapped, bottom left, for 30 s */
    GN_CAPTION_LEFT,  /* beside the line of a split screen, on its left, while that is there */
    GN_CAPTION_RIGHT, /* on its right */
    GN_CAPTION_MARK,  /* a square in the upper right corner, whatever the text, until removed */
    GN_CAPTION_KIND_COUNT,
};

#define GN_CAPTION_WEAK 77 /* of labels: how faint they are */

struct gn_caption_atlas {         /* how much of a pixel each glyph covers */
    uint32_t width_px, height_px; /* width: a multiple of 4 */
    const uint8_t *coverage;      /* 0..255, first row first */
    uint64_t generation; /* of what it holds: another number, another picture; 0: nothing yet */
};
struct gn_caption_quad {
    int32_t x, y, width, height; /* pixels of the picture, top row first; never outside it */
    uint16_t atlas_x, atlas_y;   /* where its upper left pixel stands; of a ground nothing */
    uint8_t caption;             /* gn_caption_kind */
    bool ground;                 /* darkens the picture; else covers it with white */
    uint8_t faint;               /* 255ths of its opacity that it lacks */
};
struct gn_caption_run {
    uint32_t width_px, height_px; /* of the picture that it was laid out for, before it is turned */
    const struct gn_caption_quad *quads;
    uint32_t quad_count;
    float alpha[GN_CAPTION_KIND_COUNT]; /* 0: invisible, 1: opaque */
    const struct gn_caption_atlas *atlas;
};

#endif
