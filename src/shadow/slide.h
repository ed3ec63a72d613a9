/* The slide of a spot light (a gobo): the position of a point of the world in its picture. Pure.
 * The slide is perpendicular to the light's axis and centred on it: seen from the light its right
 * is the node's +X and its top the node's +Y, so it rolls with the node. */
#ifndef GN_SHADOW_SLIDE_H
#define GN_SHADOW_SLIDE_H

#include "scene/pose.h"

enum gn_slide { /* what is outside the slide's frame, and between the light and the slide */
                GN_SLIDE_NONE,
                GN_SLIDE_DARK, /* a projector: no light, its housing blocks it */
                GN_SLIDE_LIT, /* a film in front of a light: the light that does not pass through it
                               */
                GN_SLIDE_COUNT,
};

struct gn_slide_view {
    /* Of a point (p, 1), world space: u w, v w and w. (u, v) are 0..1 over the slide from its upper
     * left corner, as glTF has them; w is the depth along the light's axis in metres. */
    vec4 u, v, w;
    float near_m; /* depth of the slide, above 0: only what is farther is behind it */
};

/* GN_SLIDE_NONE if the light has none. */
enum gn_slide gn_slide_of(const struct gn_light *light);
/* Of a spot. Size 0, 0: as large as the cone is there (cones are cut at 80 degrees, as maps are),
 * square, or with an aspect (width through height) over 0 its longer side is. Distance 0: at the
 * light itself, or, if it has a size, where its longer side spans the cone.
 */
void gn_slide_build(const struct gn_pose *pose, uint32_t light, float aspect,
                    struct gn_slide_view *view);

#endif
