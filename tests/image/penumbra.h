/* Soft shadows against truth: scenes with one light of some size, and the share of it that every
 * pixel sees, by rays. */
#ifndef GN_IMAGE_PENUMBRA_H
#define GN_IMAGE_PENUMBRA_H

#include "image/picture.h"
#include "scene/scene.h"
#include "truth/penumbra.h"

enum {
    GN_PENUMBRA_LOW,    /* a plate 1 m above the ground, a lamp of .3 m 9 m up */
    GN_PENUMBRA_MIDDLE, /* 2 m, .8 m */
    GN_PENUMBRA_HIGH,   /* 4 m, 1.5 m */
    GN_PENUMBRA_BOX,    /* a box 2.5 m up, .6 m */
    GN_PENUMBRA_BARS,   /* own: three bars 1, 2 and 3 m up under a large sun */
    GN_PENUMBRA_LEAN,   /* own: a plate that touches the ground and leans over it, .6 m */
    GN_PENUMBRA_BULB,   /* own: a plate 2 m up and a bar 1 m up below a point light of .6 m */
    GN_PENUMBRA_SEAM,   /* own: a plate and a bar under a point light of .4 m aside: the shadow lies
                           across an edge of two tiles of its map */
    GN_PENUMBRA_FIELD,  /* own: a wall and a bar from the eye's feet to 250 m, and posts, under a
                           large  sun that has cascades */
    GN_PENUMBRA_EDGE,   /* a half-plane 3 m up under a large sun, seen from above: the exact case */
    GN_PENUMBRA_COUNT,
    /* of the open benchmark alone: thin bars and a trellis high over low posts and walls */
    GN_PENUMBRA_THIN_SUN = GN_PENUMBRA_COUNT,
    GN_PENUMBRA_THIN_SPOT,
    GN_PENUMBRA_THIN_POINT,
    GN_PENUMBRA_ALL,
};
extern const char *const gn_penumbra_names[GN_PENUMBRA_ALL];
enum gn_light_type gn_penumbra_light(int scene);
/* The edge's: its penumbra on the ground is GN_PENUMBRA_EDGE_M to each side of x = 0. */
#define GN_PENUMBRA_EDGE_M (3 * 0.15)

/* Writes the scene; free() the path. */
char *gn_penumbra_write(int scene, struct gn_err *err);
/* The share, 0..1, one channel; 1 on the background. Of light 0 and camera 0 of any scene; a light
 * of no size when `point`. */
void gn_penumbra_truth_of(struct gn_picture *truth, const struct gn_scene *scene, bool point,
                          int width_px, int height_px);
bool gn_penumbra_truth(struct gn_picture *truth, const char *path, bool point, int width_px,
                       int height_px, struct gn_err *err);

void gn_penumbra_score(const struct gn_picture *truth, const struct gn_picture *shot,
                       struct gn_penumbra_score *score);

struct gn_penumbra_edge {      /* of GN_PENUMBRA_EDGE, averaged along the edge; metres */
    double width, width_truth; /* between 10 % and 90 % */
    double energy; /* integral of shot - truth across the edge, as a share of the width */
    double grain;  /* largest standard deviation along the edge */
    double rise;   /* largest step back against the edge's direction: 0 is monotone */
};
void gn_penumbra_edge(const struct gn_picture *truth, const struct gn_picture *shot,
                      struct gn_penumbra_edge *edge);

#endif
