/* Shared by the scenes of the book: parts, materials, textures. One file each. */
#ifndef GN_BOOK_H
#define GN_BOOK_H

#include "form.h"
#include "glb.h"
#include "lamp.h"
#include "paint.h"
#include "shape/outline.h"
#include "shape/shapes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define GN_RADIANS  (float)(M_PI / 180)
#define GN_COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

struct gn_book {
    struct gn_glb *glb;
    struct gn_shape shape; /* of the next part */
    int parent;            /* node of the next parts */
};

/* Begins a shape; returns it. `uv_per_m` as in shapes.h. */
struct gn_shape *gn_book_begin(struct gn_book *book, float uv_per_m);
/* Makes a mesh of it. */
int gn_book_mesh(struct gn_book *book, const char *name, int material);
/* Makes a mesh and a node of it. `keys`: a JSON object or NULL. Returns the node. */
int gn_book_put(struct gn_book *book, const char *name, int material, const char *keys);

struct gn_spot {
    float x, y, z, yaw_deg;
    float scale; /* 0: 1 */
};
/* A node with the mesh. */
int gn_book_stand(struct gn_book *book, const char *name, int mesh, struct gn_spot at,
                  const char *keys);

/* Textures; they finish nothing that is not theirs. */
int gn_book_texture(struct gn_book *book, const char *name, struct gn_image *image);
int gn_book_picture(struct gn_book *book, const char *name, const int size[2], int channels,
                    gn_paint_fn *paint, const void *what);
int gn_book_relief(struct gn_book *book, const char *name, int size_px, float depth,
                   gn_paint_fn *height, const void *what);

/* A turn of `node` about the axis ('x', 'y' or 'z'), `turns` whole ones in `seconds`, from
 * `start_deg`, in a clip of its own. */
void gn_book_spin(struct gn_book *book, const char *clip, int node, char axis, float start_deg,
                  float turns, float seconds);

/* Lathe of a smooth profile (gn_profile_smooth). */
void gn_book_lathe(struct gn_shape *shape, const float (*points)[2], int count, int steps,
                   int around);

/* A floor that becomes a wall in a curve: as wide as `size[0]`, from z = size[1] / 2 back to
 * -size[1] / 2, where it rises to size[2]. */
void gn_book_backdrop(struct gn_shape *shape, const float size[3], float radius);

/* A wooden chair, its back towards -z: 0.5 m wide, 1 m high. */
void gn_book_chair(struct gn_shape *shape);

/* common surfaces */
void gn_book_grain(float u, float v, const void *what, float out[4]);   /* cloudy stone: grey */
void gn_book_wood(float u, float v, const void *what, float out[4]);    /* planks: RGB */
void gn_book_plaster(float u, float v, const void *what, float out[4]); /* height of a wall */
void gn_book_marble(float u, float v, const void *what, float out[4]);  /* white: RGB */

/* the scenes */
void gn_book_make_watch(struct gn_book *book);
void gn_book_make_room(struct gn_book *book);
void gn_book_make_carousel(struct gn_book *book);
void gn_book_make_foliage(struct gn_book *book);
void gn_book_make_product(struct gn_book *book);
void gn_book_make_architecture(struct gn_book *book);
void gn_book_make_studio(struct gn_book *book);
void gn_book_make_window(struct gn_book *book);

#endif
