#include "shadow/grey.h"

#include <math.h>

struct gn_shadow_grey gn_shadow_grey_of(const struct gn_shadow_view *view) {
    if (view->empty) return (struct gn_shadow_grey){0.0f, 1.0f, 1.0f};
    if (gn_encoding_is_depth(view->encoding)) return (struct gn_shadow_grey){1.0f, 0.0f, 4.0f};
    if (view->encoding == GN_ENCODING_MEAN)
        return (struct gn_shadow_grey){view->penumbra.scale, view->penumbra.bias, 1.0f};
    const float range_m = view->code.far_m - view->code.near_m;
    const float scale = 1.0f / (view->code.scale * range_m);
    return (struct gn_shadow_grey){scale, -view->code.offset * scale - view->code.near_m / range_m,
                                   1.0f};
}

float gn_shadow_grey_at(const struct gn_shadow_grey *grey, float code) {
    float x = code * grey->scale + grey->offset;
    return powf(fminf(fmaxf(x, 0.0f), 1.0f), grey->power);
}
