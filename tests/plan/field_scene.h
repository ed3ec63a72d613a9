/* A scene of 400 m, made in memory: what one map is too coarse for. */
#ifndef GN_TESTS_PLAN_FIELD_SCENE_H
#define GN_TESTS_PLAN_FIELD_SCENE_H

#include "scene/scene.h"

enum gn_field_camera {
    GN_FIELD_STANDING,     /* 1.7 m over the ground, looks along it */
    GN_FIELD_INSIDE,       /* within the nearest block */
    GN_FIELD_SUNWARDS,     /* looks along the light */
    GN_FIELD_ORTHOGRAPHIC, /* from above */
};

/* A flat ground of 900 m and blocks from 5 to 400 m before the eye, larger farther off, and a row
 * of poles; one sun; the cameras above. scale: of all lengths. */
struct gn_scene *gn_field_scene_make_scaled(float scale);
struct gn_scene *gn_field_scene_make(void);
/* The first camera comes straight down from that height in 4 s. */
struct gn_scene *gn_field_scene_make_flown(float from_m);

#endif
