/* A sphere for tests, in a file that is being made. */
#ifndef GN_IMAGE_BALL_H
#define GN_IMAGE_BALL_H

#include "unit/gltf_maker.h"

/* Three accessors, of which the first is returned: positions, normals, indices. Its centre is the
 * origin; at most 64 x 32 facets. It is watertight. */
int gn_ball_add(struct gn_maker *maker, float radius_m);

/* A Radiance file: the same radiance from everywhere, a power of two. False if it cannot be
 * written. */
bool gn_uniform_write(const char *path, int power);

#endif
