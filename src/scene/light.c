#include "scene/light.h"

const struct gn_light_type_row gn_light_types[GN_LIGHT_TYPE_COUNT] = {
#define GN_X(NAME, text, its_unit, its_radius, ...)                                                \
    {.name = text, .glsl = "LIGHT_" #NAME, .unit = its_unit, .radius = its_radius, __VA_ARGS__},
    GN_LIGHT_TYPES(GN_X)
#undef GN_X
};
