/* Captions ready to be drawn: rectangles, in their order. Plain data. */
#ifndef GN_CAPTION_RUN_H
#define GN_CAPTION_RUN_H

#include <stdbool.h>
#include <stdint.h>

enum gn_caption_kind {
    GN_CAPTION_INFO,  /* a page: several lines, top left, until removed */
    GN_CAPTION_MODE,  /* a name: one line, bottom left, for 2 s */
    GN_CAPTION_ERROR, /* an error message: wrapped, bottom left, until removed */
    GN_CAPTION_KIND_COUNT,
};

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
};
struct gn_caption_run {
    uint32_t width_px, height_px; /* of the picture that it was laid out for, before it is turned */
    const struct gn_caption_quad *quads;
    uint32_t quad_count;
    float alpha[GN_CAPTION_KIND_COUNT]; /* 0: invisible, 1: opaque */
    const struct gn_caption_atlas *atlas;
};

#endif
