/* The triangles of a glTF file at a time, posed in double precision by a reader of its own, which
 * shares no code with the loader and the pose that it tests: skins, morph targets, clips. */
#ifndef GN_IMAGE_POSED_H
#define GN_IMAGE_POSED_H

#include <stdbool.h>
#include <stdint.h>

#include "truth/bvh.h"

struct gn_posed {
    struct gn_bvh_triangle *triangles; /* malloc'ed; item: the primitive's number in the walk;
                                          flags: 1 where only its front is seen */
    uint32_t count;
    double size;   /* diagonal of their box */
    int clips;     /* of the file */
    double last_s; /* key of the clip that was played */
};

/* A .glb, or a .gltf with files beside it or data in it. clip -1: none. False: it has something
 * that is not read here. */
bool gn_posed_read(struct gn_posed *posed, const char *path, int clip, double time_s);
void gn_posed_finish(struct gn_posed *posed);

#endif
