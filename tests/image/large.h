/* Large scenes, made: grids of triangles, a mesh for each node, a material with a picture of its
 * own for each texture. */
#ifndef GN_IMAGE_LARGE_H
#define GN_IMAGE_LARGE_H

#include <stdbool.h>
#include <stdint.h>

#include "core/err.h"

struct gn_large {
    uint32_t triangles, nodes; /* in all; of which each mesh has its share */
    uint32_t textures, texture_px;
};
/* Writes it as .glb. */
bool gn_large_write(const struct gn_large *large, const char *path, struct gn_err *err);

#endif
