/* Lights and cameras that stand somewhere and look at something. */
#ifndef GN_ASSETS_LAMP_H
#define GN_ASSETS_LAMP_H

#include "glb.h"

struct gn_lamp {
    const char *name; /* NULL: "light" */
    enum gn_glb_light_kind kind;
    float at[3], aim[3]; /* metres */
    float radius;        /* of the emitter, as gnomon_radius; 0: not said */
    float intensity;     /* lux or candela */
    float cone_deg;      /* spot: half angle */
    float rgb[3];        /* linear; all 0 means white */
    float range;         /* metres; 0 means unlimited */
    const char *keys;    /* more members of the light's extras: "\"gnomon_map_px\":2048", or NULL */
};
void gn_lamp_add(struct gn_glb *glb, const struct gn_lamp *lamp);

struct gn_view {
    const char *name; /* NULL: "camera" */
    float eye[3], aim[3];
    float aspect; /* of its picture; 0: 16 / 9 */
    float yfov_deg;
    float znear, zfar; /* metres; 0: .1, 200 */
};
void gn_view_add(struct gn_glb *glb, const struct gn_view *view);

#endif
