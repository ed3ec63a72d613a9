/* Shapes for fitting: boxes, convex polygons and the eye's frustum. */
#ifndef GN_SHADOW_PRIVATE_H
#define GN_SHADOW_PRIVATE_H

#include "shadow/fit.h"

#define GN_POLYGON_MAX 20 /* a quad or triangle clipped by up to 12 planes */
struct gn_polygon {
    int count;
    vec3 at[GN_POLYGON_MAX];
};
/* Keeps the part where dot(plane, (p,1)) >= 0; may leave nothing. */
void gn_polygon_clip(struct gn_polygon *polygon, const vec4 plane);

/* The eight corners of a box under a transform: bit 0 of the index is x, 1 y, 2 z. */
void gn_box_corners(const struct gn_box *box, mat4 to, vec3 corners[8]);
/* Face 0..5 of eight such corners. */
void gn_box_face(vec3 corners[8], int face, struct gn_polygon *out);
/* The six inward planes of the convex body of eight such corners. A flat body gives planes that cut
 * nothing. */
void gn_box_planes(vec3 corners[8], vec4 planes[6]);

#endif
