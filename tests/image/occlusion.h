/* Occlusion of models: the volume that shaders read, against rays. */
#ifndef GN_IMAGE_OCCLUSION_H
#define GN_IMAGE_OCCLUSION_H

#include "scene/scene.h"
#include "truth/occlusion.h"

/* Scenes of boxes: eight posts under a roof, a table, a room of double-sided sheets that is open to
 * one side, plates a third of a cube apart. */
enum gn_occlusion_scene {
    GN_OCCLUSION_PAVILION,
    GN_OCCLUSION_TABLE,
    GN_OCCLUSION_ROOM,
    GN_OCCLUSION_PLATES,
    GN_OCCLUSION_SCENES
};
extern const char *const gn_occlusion_names[GN_OCCLUSION_SCENES];
/* As a .glb, into that file. */
bool gn_occlusion_write(enum gn_occlusion_scene which, const char *path, struct gn_err *err);
/* The caller destroys it. NULL, and err, on failure. */
struct gn_scene *gn_occlusion_scene(enum gn_occlusion_scene which, struct gn_err *err);

struct gn_occlusion_score {
    double rmse, none; /* of the volume; of no occlusion at all: noise of the rays taken off */
    double p95, p999;  /* of the volume, with their noise */
    double bias;       /* lighter than the rays: positive */
    uint32_t pixels;   /* items with a volume, seen from two sides */
};
/* In pictures of so many pixels to a side, with so many rays for each, over ten times of the clips,
 * between those that the volume is made of, if there are any. texels NULL: 1 everywhere. */
struct gn_occlusion_score gn_occlusion_measure(const struct gn_scene *scene, int clips,
                                               const struct gn_sky *sky, const int8_t (*texels)[4],
                                               int side_px, uint32_t rays);

#endif
