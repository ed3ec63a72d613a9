/* Another rasteriser, to count what triangles shade: it clips nothing, but has edges and depth as
 * functions of homogeneous corners (Olano, Greer 1997), in double precision, and asks every sample
 * of every pixel but those of blocks that are outside an edge as a whole. */
#ifndef GN_TESTS_UNIT_PLAIN_RASTER_H
#define GN_TESTS_UNIT_PLAIN_RASTER_H

#include <stdbool.h>
#include <stdint.h>

enum { GN_PLAIN_WIDTH = 96, GN_PLAIN_HEIGHT = 70, GN_PLAIN_SAMPLES = 4 };
struct gn_plain_raster {
    double depth[GN_PLAIN_HEIGHT][GN_PLAIN_WIDTH][GN_PLAIN_SAMPLES];
    int samples;
    uint64_t pixels, lanes; /* added to */
};
/* All depths far; 1, 2 or 4 samples. free() it. */
struct gn_plain_raster *gn_plain_create(int samples);
/* cull: enum gn_raster_cull. writes: whether it hides what comes later. */
void gn_plain_triangle(struct gn_plain_raster *raster, const double clip[3][4], int cull,
                       bool writes);

#endif
