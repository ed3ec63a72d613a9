/* Pictures of one scene, in this process: by what draws for `gnomon render`, whose start takes
 * longer than most pictures. */
#ifndef GN_IMAGE_DRAWER_H
#define GN_IMAGE_DRAWER_H

#include <stdbool.h>

#include "scene/pose.h"

struct gn_drawer;
struct gn_drawer *gn_drawer_create(const char *scene);
/* Of the pictures from now on; 0 by itself. */
void gn_drawer_set_time(struct gn_drawer *drawer, int64_t time_ns);
/* That of the last picture. */
const struct gn_pose *gn_drawer_pose(const struct gn_drawer *drawer);
/* args: as render has them, up to NULL, with --size; an AOV. rgba: 4 floats for each pixel, row 0
 * on top. */
bool gn_drawer_draw(struct gn_drawer *drawer, const char *const args[], float *rgba,
                    struct gn_err *err);
void gn_drawer_destroy(struct gn_drawer *drawer);

#endif
