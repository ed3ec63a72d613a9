/* Types of lights: one row each, which gives the enum below, gn_light_types[] and the constant
 * LIGHT_NAME in shaders. To add one: a row here, and its branches in the shaders. */
#ifndef GN_SCENE_LIGHT_H
#define GN_SCENE_LIGHT_H

#include <stdbool.h>

/* X(NAME, name as in KHR_lights_punctual, unit of its intensity, radius of a light that names none
 * (as in gn_light), fields of gn_light_type_row that are true) */
#define GN_LIGHT_TYPES(X)                                                                          \
    X(DIRECTIONAL, "directional", "lux", .00465f, .has_position = false) /* the sun's */           \
    X(POINT, "point", "candela", .05f, .has_position = true, .shines_around = true)                \
    X(SPOT, "spot", "candela", .05f, .has_position = true, .has_cone = true)

enum gn_light_type {
#define GN_X(NAME, ...) GN_LIGHT_##NAME,
    GN_LIGHT_TYPES(GN_X)
#undef GN_X
        GN_LIGHT_TYPE_COUNT,
};
struct gn_light_type_row {
    const char *name, *glsl, *unit;
    float radius;
    bool has_position;  /* shines from there, dimmer with the distance, to its range; else from
                           infinitely far away, and its map may have cascades */
    bool has_cone;      /* shines within one alone: may project a slide */
    bool shines_around; /* its map has a tile for each of the six directions */
};
extern const struct gn_light_type_row gn_light_types[GN_LIGHT_TYPE_COUNT];

#endif
