/* A scene with all that deforms: two figures of one mesh, each with a skin of its own in another
 * pose, up to eight influences, weights that are not 1 together, a joint scaled differently along
 * its axes, morph targets of which one is sparse, weights by a cubic spline; on a ground, in the
 * light of a sun. */
#ifndef GN_IMAGE_CHARACTER_H
#define GN_IMAGE_CHARACTER_H

#include <stdbool.h>

#include "core/err.h"

enum { GN_CHARACTER_S = 2 }; /* its clip lasts this long */
bool gn_character_write(const char *path, struct gn_err *err);
/* A sheet of as many triangles as a skin can have joints, each of which turns by another angle. */
bool gn_many_joints_write(const char *path, struct gn_err *err);
/* 20 figures of 5,000 triangles, which bend at 20 joints each, or turn as they are. */
bool gn_crowd_write(const char *path, bool posed, struct gn_err *err);

#endif
