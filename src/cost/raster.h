/* Counts what a GPU shades when it draws triangles: pixels, and the lanes of the quads of 2 x 2
 * pixels that it shades them in, of which some are outside the triangle or hidden. After the rules
 * of OpenGL ES 3.0 (section 3.6: samples in a triangle, top-left edges) and of a GPU that tests the
 * depth of each sample before it shades a pixel. No GL. */
#ifndef GN_COST_RASTER_H
#define GN_COST_RASTER_H

#include <stdbool.h>
#include <stdint.h>

struct gn_raster_count {
    uint64_t triangles; /* that reach a sample of the viewport, hidden or not */
    uint64_t pixels;    /* with a sample that is in front of what was drawn before */
    uint64_t lanes;     /* 4 for each quad with such a pixel, for each triangle */
};
struct gn_raster_vertex {
    double clip[4];
    double attributes[3]; /* u, v and alpha of the vertex: of masked ones, else unused */
};
struct gn_raster_rect {
    int x, y, width, height; /* pixels, first row at the bottom */
};
enum gn_raster_cull { GN_RASTER_BOTH, GN_RASTER_CULL_BACK, GN_RASTER_CULL_FRONT };

struct gn_raster { /* a target and the state it is drawn with */
    int width_px, height_px;
    int samples;  /* of a pixel: 1, 2 or 4, where D3D 11 and all GPUs have them */
    float *depth; /* of each sample, 0 near to 1 far; gn_raster_create() makes it */
    struct gn_raster_rect viewport, scissor; /* in the target */
    bool tests_depth, writes_depth;          /* by LEQUAL */
    enum gn_raster_cull cull;
    bool mirrored; /* front faces wind clockwise */
    /* Whether the surface has a hole there: shaded, but it hides nothing. NULL: never. */
    bool (*is_hole)(const void *context, const double attributes[3]);
    const void *context;
    struct gn_raster_count count; /* added to */
};

/* Everything of `raster` but its size and samples is the caller's to set. */
void gn_raster_create(struct gn_raster *raster, int width_px, int height_px, int samples);
void gn_raster_destroy(struct gn_raster *raster);
void gn_raster_clear(struct gn_raster *raster, const struct gn_raster_rect *rect);
void gn_raster_triangle(struct gn_raster *raster, const struct gn_raster_vertex corners[3]);

#endif
