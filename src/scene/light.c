#include "scene/scene.h"

#define SUN_TANGENT   .00465f /* of the sun's angular radius */
#define LAMP_RADIUS_M .05f

const struct gn_light_type_row gn_light_types[] = {
    [GN_LIGHT_DIRECTIONAL] = {.name = "directional",
                              .glsl = "LIGHT_DIRECTIONAL",
                              .unit = "lux",
                              .radius = SUN_TANGENT},
    [GN_LIGHT_POINT] = {.name = "point",
                        .glsl = "LIGHT_POINT",
                        .unit = "candela",
                        .radius = LAMP_RADIUS_M,
                        .has_position = true,
                        .shines_around = true},
    [GN_LIGHT_SPOT] = {.name = "spot",
                       .glsl = "LIGHT_SPOT",
                       .unit = "candela",
                       .radius = LAMP_RADIUS_M,
                       .has_position = true,
                       .has_cone = true},
};
_Static_assert(sizeof gn_light_types / sizeof *gn_light_types == GN_LIGHT_TYPE_COUNT, "a row each");
