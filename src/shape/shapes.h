/* Triangle meshes with outward normals, counter-clockwise seen from outside.
 *
 * Each call appends a piece, placed by the pen (a rotation and a translation, as in turtle
 * graphics). UVs are in metres times `uv_per_m`, so that a tiling texture has the same size on all
 * pieces. */
#ifndef GN_SHAPE_SHAPES_H
#define GN_SHAPE_SHAPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gn_pen {
    float x[3], y[3], z[3], at[3]; /* the piece's axes and origin in the shape */
};

struct gn_vertex {
    float position[3], normal[3], uv[2];
};

struct gn_shape {
    struct gn_vertex *vertices;
    uint32_t *indices;
    size_t vertex_count, index_count;
    size_t vertex_room, index_room;
    struct gn_pen pen;
    float uv_per_m; /* 0 means that the shape has no UVs */
};

/* Free with gn_shape_finish; a zeroed shape may be finished. */
void gn_shape_init(struct gn_shape *shape, float uv_per_m);
void gn_shape_finish(struct gn_shape *shape);

/* The pen. Moves and turns are relative to the pen's own axes; `home` resets it. */
void gn_shape_home(struct gn_shape *shape);
void gn_shape_at(struct gn_shape *shape, float x, float y, float z); /* home, then move */
void gn_shape_move(struct gn_shape *shape, float x, float y, float z);
void gn_shape_turn(struct gn_shape *shape, char axis, float degrees);

/* Adds one vertex, for custom pieces; returns its index. `uv` in metres. */
uint32_t gn_shape_vertex(struct gn_shape *shape, const float position[3], const float normal[3],
                         const float uv[2]);
void gn_shape_triangle(struct gn_shape *shape, uint32_t a, uint32_t b, uint32_t c);

/* Box centred on the pen. 12 triangles. */
void gn_shape_box(struct gn_shape *shape, float sx, float sy, float sz);
/* Box standing on the pen's y = 0. */
void gn_shape_block(struct gn_shape *shape, float sx, float sy, float sz);
/* Single-sided rectangle in the pen's xz plane, facing +y. */
void gn_shape_plane(struct gn_shape *shape, float sx, float sz);
/* Rectangle in the pen's xy plane, facing +z, standing on y = 0, UV 0..1 with v = 0 at the top. */
void gn_shape_card(struct gn_shape *shape, float sx, float sy);
void gn_shape_sphere(struct gn_shape *shape, float radius, int around, int down);
/* Cylinder about +y, standing on y = 0, with caps. */
void gn_shape_cylinder(struct gn_shape *shape, float radius, float height, int around);
/* Flat ring facing +y, in courses whose stones have the same width (see the paving texture of
 * paint.h): each course is one quarter of the texture in v, repeated around the ring a whole number
 * of times. */
void gn_shape_paving(struct gn_shape *shape, float inner, float outer, int courses, int around);
/* Flat ring without UV courses, facing +y. */
void gn_shape_ring(struct gn_shape *shape, float inner, float outer, int around);
/* Surface of revolution about +y of the profile (radius, height) pairs. With the radius to the
 * right and the height up, the outside is to the right of the direction along the profile, i.e. the
 * profile goes up on the outside. Corners sharper than 35 degrees are creased. */
void gn_shape_lathe(struct gn_shape *shape, const float (*profile)[2], int points, int around);
/* The same over the angles from..to degrees (from +x towards -z), of a closed convex profile, with
 * both ends closed. */
void gn_shape_arc(struct gn_shape *shape, const float (*profile)[2], int points, float from,
                  float to, int around);
/* Ring of radius `major` in the pen's xz plane. */
void gn_shape_torus(struct gn_shape *shape, float major, float minor, int around, int section);
/* Round bar through the points, with closed ends. */
void gn_shape_tube(struct gn_shape *shape, const float (*points)[3], int count, float radius,
                   int section);
/* Straight round bar. */
void gn_shape_rod(struct gn_shape *shape, const float from[3], const float to[3], float radius,
                  int section);
/* Wire arch in the pen's xy plane: two posts and a half circle. */
void gn_shape_arch(struct gn_shape *shape, float width, float post, float radius, int section);
/* The (2,3) torus knot of the bench scenes: (tubular + 1)(radial + 1) vertices. */
void gn_shape_knot(struct gn_shape *shape, float radius, float tube, int tubular, int radial);

#endif
