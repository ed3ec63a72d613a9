/* A light's influence: a sphere round it (its range, or the whole scene), for a spot light the part
 * of the sphere inside its cone. Pure; every answer is conservative: it may be "inside" wrongly. */
#ifndef GN_SHADOW_REACH_H
#define GN_SHADOW_REACH_H

#include "shadow/fit.h"

struct gn_reach {
    bool everywhere; /* directional */
    bool cone;
    vec3 place_ws, axis_ws;
    float range_m;            /* at most to the scene's farthest corner */
    float sin_cone, cos_cone; /* of the outer half-angle */
};
struct gn_reach_rect { /* pixels, first row at the bottom, ends not included; empty: x0 >= x1 */
    int x0, y0, x1, y1;
};

void gn_reach_build(struct gn_reach *reach, const struct gn_pose *pose, uint32_t light);
/* Whether the light can shine on anything in the box. */
bool gn_reach_touches(const struct gn_reach *reach, const struct gn_box *box_ws);
/* The part of a picture of that size where lit surfaces may be visible. */
struct gn_reach_rect gn_reach_rect(const struct gn_reach *reach, const struct gn_eye *eye,
                                   uint32_t width_px, uint32_t height_px);
struct gn_reach_rect gn_reach_rect_unite(struct gn_reach_rect a, struct gn_reach_rect b);

#endif
