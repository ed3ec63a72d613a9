/* Coarse meshes with smooth normals, as modellers make them for boards: the angle between the
 * normal of a vertex and those of its faces is large. */
#ifndef GN_ASSETS_COARSE_H
#define GN_ASSETS_COARSE_H

#include "shape/shapes.h"

/* A head that looks along the pen's +z, its chin at y = 0: brow, eyes, nose, chin, neck; hollows
 * and ridges. Normals are the mean of the faces', by angle. */
void gn_coarse_head(struct gn_shape *shape, float height, int around, int down);

#endif
