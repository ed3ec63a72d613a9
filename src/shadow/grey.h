/* A map as a grey picture: near dark, far white. Distances are linear; hardware depth is crowded at
 * the far end, so its contrast is raised by the fourth power. */
#ifndef GN_SHADOW_GREY_H
#define GN_SHADOW_GREY_H

#include "shadow/fit.h"

/* grey = clamp(code * scale + offset, 0, 1) ^ power, already sRGB-encoded. */
struct gn_shadow_grey {
    float scale, offset, power;
};
struct gn_shadow_grey gn_shadow_grey_of(const struct gn_shadow_view *view);
float gn_shadow_grey_at(const struct gn_shadow_grey *grey, float code);

#endif
