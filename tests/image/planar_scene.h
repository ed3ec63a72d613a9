/* Scenes for planar shadows: a ground, things on it, a light. */
#ifndef GN_IMAGE_PLANAR_SCENE_H
#define GN_IMAGE_PLANAR_SCENE_H

#include "scene/scene.h"

#define GN_PLANAR_POINT "{'type':'point','intensity':100}"
#define GN_PLANAR_SPOT                                                                             \
    "{'type':'spot','intensity':100,'spot':{'outerConeAngle':0.7,'innerConeAngle':0.6}}"
#define GN_PLANAR_SUN "{'type':'directional','intensity':3}"

struct gn_planar_light {
    const char *name, *light, *node;
};
enum { GN_PLANAR_LIGHTS = 3, GN_PLANAR_TURNS = 4 };
extern const struct gn_planar_light gn_planar_lights[GN_PLANAR_LIGHTS]; /* sun, point, spot */

/* How the plane lies: quaternions that turn the whole scene. */
struct gn_planar_turn {
    const char *name, *turn;
};
extern const struct gn_planar_turn
    gn_planar_turns[GN_PLANAR_TURNS]; /* floor, tilted, wall, ceiling */

/* On the plane, over it, and through it; two that overlap; one with holes. */
extern const char gn_planar_things[];

/* A wall behind them, a plane of its own. */
#define GN_PLANAR_WALL                                                                             \
    ",{'mesh':0,'translation':[0,2,-4],'scale':[5,1,2],'rotation':[0.7071068,0,0,0.7071068],"      \
    "'extras':{'gnomon_plane':true}}"

/* A ground of 10 m, the plane, with these things on it (nodes, a comma before each) and a light,
 * seen from 13 m away. Mesh 0 is a square, 1 a cube, both of 2 m, 2 a square with square holes. */
struct gn_scene *gn_planar_scene(const char *turn, const struct gn_planar_light *light,
                                 const char *things);

/* Nothing is named: a floor of 10 m, walls of 5 m behind the things and to the left. */
struct gn_scene *gn_planar_room(const struct gn_planar_light *light);

#endif
