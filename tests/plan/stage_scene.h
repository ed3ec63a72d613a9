/* A small scene with one of everything that a plan treats differently, made in memory. */
#ifndef GN_TESTS_PLAN_STAGE_SCENE_H
#define GN_TESTS_PLAN_STAGE_SCENE_H

#include "scene/scene.h"

/* A 20 m ground; five boxes that share a geometry (two colours, one of them mirrored, one moving
 * along +X by 1 m/s), a masked card, a blended pane, an unlit sign; a sun, a spot and a point
 * light; a camera in front and one that looks away. */
struct gn_scene *gn_stage_scene_make(void);

#endif
