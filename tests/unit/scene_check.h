/* What every scene that comes out of the loader must hold, whatever went in. */
#ifndef GN_TESTS_UNIT_SCENE_CHECK_H
#define GN_TESTS_UNIT_SCENE_CHECK_H

#include "scene/scene.h"

/* NULL, or what is wrong. Poses the scene at a few times, too. */
const char *gn_scene_check(const struct gn_scene *scene);

#endif
