/* What options set for a light, or for all lights: struct gn_light_opts. */
#ifndef GN_SHADOW_LIGHT_OPTS_H
#define GN_SHADOW_LIGHT_OPTS_H

#include <stddef.h>

#include "shadow/technique.h"

/* The format of a map: an encoding for techniques that read the map itself, moments for those that
 * filter it, either for those that read both (cone). */
#define GN_MAP_FORMAT(encoding, moments) ((int)(encoding) | (int)(moments) << 8)
#define GN_MAP_FORMAT_ENCODING(format)   ((enum gn_encoding)((format)&0xff))
#define GN_MAP_FORMAT_MOMENTS(format)    ((enum gn_moments)((format) >> 8))

/* A field holds a value where its bits of `given` are set; zero: nothing is given. Fields consist
 * of words of 4 bytes, without padding: they are copied word by word (frame/opts.c) and hashed. A
 * row of options/rows.h has the offset of its field (`target`). A number below 0 is automatic: no
 * value, and none of that for all lights either. */
struct gn_light_opts {
    uint32_t light; /* index in the scene */
    uint32_t given; /* GN_LIGHT_GIVEN() of each field that is set */
    enum gn_technique technique;
    int map_format; /* GN_MAP_FORMAT() */
    uint32_t map_px;
    uint32_t cascades; /* so many where the light can have them; 0: as few as are enough */
    int faces;         /* of all casters, that go into maps: 1 + enum gn_cast_faces; 0: as the scene
                          has each. Not of planar lights */
    uint32_t taps;     /* a multiple of 4 to GN_TAPS_MAX; cone: 8 to 16; 0: 16, cone 12 */
    float strength;    /* as shadow_strength in gn_light */
    float specular;    /* share of highlights that the shadow leaves; automatic: as of the rest */
    float bias_texels; /* automatic: the technique's */
    float filter_radius_px;    /* of a filter that can have another one; automatic, 0: its own */
    float slide_far_m;         /* as in gn_light; automatic: the scene's */
    uint32_t slide_as_picture; /* shape of a slide without a size: 1: its picture's, 0: square */
    float radius;              /* as in gn_light */
    float color[3];            /* as in gn_light. Colours do not change an automatic exposure */
    int hue;         /* 0xRRGGBB, sRGB, of that colour, which stays as bright; automatic: the
                        scene's */
    float intensity; /* the strongest channel of that colour; automatic: the scene's */
    uint32_t on;     /* 0: it does not shine */
};

/* The bits of a field in `given`: one for each of its words. */
#define GN_LIGHT_GIVEN(field)                                                                      \
    (((1u << sizeof(((struct gn_light_opts *)0)->field) / 4) - 1)                                  \
     << offsetof(struct gn_light_opts, field) / 4)
#define GN_LIGHT_HAS(opts, field) (((opts)->given & GN_LIGHT_GIVEN(field)) != 0)
#define GN_LIGHT_SET(opts, field, value)                                                           \
    ((opts)->given |= GN_LIGHT_GIVEN(field), (opts)->field = (value))
_Static_assert(sizeof(struct gn_light_opts) <= 32 * 4, "a bit for each word");

#endif
