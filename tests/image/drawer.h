/* Pictures of one scene, in this process: by what draws for `gnomon render`, whose start takes
 * longer than most pictures. */
#ifndef GN_IMAGE_DRAWER_H
#define GN_IMAGE_DRAWER_H

#include <stdbool.h>

#include "core/err.h"

struct gn_drawer;
struct gn_drawer *gn_drawer_create(const char *scene);
/* args: as render has them, up to NULL, with --size; an AOV. rgba: 4 floats for each pixel, row 0
 * on top. */
bool gn_drawer_draw(struct gn_drawer *drawer, const char *const args[], float *rgba,
                    struct gn_err *err);
void gn_drawer_destroy(struct gn_drawer *drawer);

#endif
