/* Extruded polygons, and fences made of them. */
#ifndef GN_SHAPE_OUTLINE_H
#define GN_SHAPE_OUTLINE_H

#include <stdbool.h>

struct gn_shape;

struct gn_outline {
    const float (*points)[2]; /* simple polygon, counter-clockwise */
    int count;
    const float (*hole)[2]; /* one hole, counter-clockwise as well; may be NULL */
    int hole_count;
};
/* The outline is in the pen's xy plane and extruded in z from -depth/2 to depth/2. */
void gn_shape_extrude(struct gn_shape *shape, const struct gn_outline *outline, float depth);

/* The same with round edges of radius `bevel`, of `steps` cells. */
void gn_shape_bevel(struct gn_shape *shape, const struct gn_outline *outline, float depth,
                    float bevel, int steps);

struct gn_fence {
    float length, height; /* metres, along +x from the pen, standing on y = 0 */
    float pitch;          /* distance between pales, metres */
    float pale, depth;    /* width and thickness of a pale */
    bool pointed;
};
/* Pales and two rails behind them. */
void gn_shape_fence(struct gn_shape *shape, const struct gn_fence *fence);

#endif
