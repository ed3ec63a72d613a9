/* Small procedural pictures, for the generators of this folder. All except the window tile. */
#ifndef GN_ASSETS_PAINT_H
#define GN_ASSETS_PAINT_H

#include <stddef.h>

struct gn_image {
    int width, height, channels; /* 1 grey, 3 RGB, 4 RGBA; 8 bits, sRGB */
    unsigned char *pixels;       /* rows from the top */
};

void gn_image_init(struct gn_image *image, int width, int height, int channels);
void gn_image_finish(struct gn_image *image);
/* The picture as a PNG file in memory; the caller frees it. */
void *gn_image_png(const struct gn_image *image, size_t *size);

/* Noise for pictures. A hash of two numbers, 0..1. */
float gn_paint_hash(int x, int y, unsigned seed);
/* Value noise of period 1 in both directions, with `cells` cells per period. */
float gn_paint_noise(float u, float v, int cells, unsigned seed);
/* Octaves of it. */
float gn_paint_fractal(float u, float v, int cells, int octaves, unsigned seed);
/* 0 at or below `low`, 1 at or above `high`. */
float gn_paint_ramp(float low, float high, float v);

/* A texel at (u, v), v = 0 at the top: 0..1, as many as the picture has channels. */
typedef void gn_paint_fn(float u, float v, const void *what, float out[4]);
void gn_paint_fill(struct gn_image *image, int width, int height, int channels, gn_paint_fn *paint,
                   const void *what);
/* Normal map of a relief: `height` gives texel[0], which is `depth` deep in widths of the picture.
 */
void gn_paint_relief(struct gn_image *image, int size_px, float depth, gn_paint_fn *height,
                     const void *what);

/* Grey, near white, to be multiplied by a base colour. `contrast` 0..1: 1 - value of the darkest
 * grain. */
void gn_paint_grain(struct gn_image *image, int size_px, float contrast, unsigned seed);
/* Grey: rough-hewn setts, 4 courses of 4 stones. */
void gn_paint_paving(struct gn_image *image, int size_px, unsigned seed);
/* Grey: grain of wood along v. */
void gn_paint_wood(struct gn_image *image, int size_px, unsigned seed);
/* Grey: small leaves of a hedge or a lawn. */
void gn_paint_hedge(struct gn_image *image, int size_px, unsigned seed);
/* Grey: grass from above, without anything large that would show where it repeats. */
void gn_paint_grass(struct gn_image *image, int size_px, unsigned seed);
/* RGBA: a diagonal lattice of laths with holes between them. */
void gn_paint_lattice(struct gn_image *image, int size_px, int meshes, unsigned seed);
/* RGBA: a twig with leaves, growing from the middle of the bottom edge. */
void gn_paint_branch(struct gn_image *image, int size_px, unsigned seed);
/* RGB: a round-headed window of leaded glass with a mullion and transoms, black outside of it;
 * height 1.5 times the width. A slide for light that falls through it. */
void gn_paint_window(struct gn_image *image, int width_px, unsigned seed);

#endif
