/* Depths of a light's view: near and far, their encoding, and the width of penumbrae and blurs that
 * follows from them. */
#include <math.h>

#include "shadow/private.h"
#include "shadow/region.h"

#define NEAREST_STEP (1.0f / 64.0f) /* of a directional light's range of depths */

/* Padded on each side. A directional light's padding is never 0: casters in one plane across its
 * direction span no depth, and in a plane through the world's origin the depth itself is 0. */
void gn_fitter_set_depths(const struct gn_fitter *f, const struct gn_shadow_region *depths,
                          float *near_depth, float *far_depth) {
    struct gn_shadow_view *view = f->view;
    float pad = 1e-3f * (depths->far - depths->near) + 1e-5f * fabsf(depths->far);
    if (!view->perspective) pad = fmaxf(pad, 1e-6f * gn_scene_reach_m(f->pose));
    *near_depth =
        view->perspective ? fmaxf(depths->near - pad, 0.5f * depths->near) : depths->near - pad;
    *far_depth = depths->far + pad;
    view->code.near_m = view->perspective ? *near_depth : 0.0f;
    view->code.far_m = view->perspective ? depths->far_radial + pad : *far_depth - *near_depth;
}

static float half_float_step(float value) {
    return exp2f(floorf(log2f(fmaxf(value, 1e-5f))) - 10.0f);
}

/* The encoding's code of a distance is distance * scale + offset; ulp_m is its coarsest step. */
void gn_fitter_set_code(const struct gn_fitter *f, float near_depth, float far_depth) {
    struct gn_shadow_view *view = f->view;
    float range = view->code.far_m - view->code.near_m;
    float float_step = 7e-7f * view->code.far_m; /* rounding of the interpolated distance */
    /* A directional light's depths may span less than the scene: then the rounding of positions is
     * coarser. */
    if (!view->perspective) float_step = fmaxf(float_step, 2e-7f * gn_scene_reach_m(f->pose));
    view->code.scale = 1.0f;
    view->code.offset = 0.0f;
    view->code.far_end = view->code.far_m;
    view->code.ulp_m = float_step;
    switch (view->encoding) {
    case GN_ENCODING_R16F:
        view->code.scale = 2.0f / range;
        view->code.offset = -(view->code.far_m + view->code.near_m) / range;
        view->code.far_end = 1.0f;
        view->code.ulp_m = 0.5f * range * exp2f(-11.0f) + float_step;
        return;
    case GN_ENCODING_R16F_RAW:
        view->code.ulp_m = half_float_step(view->code.far_m) + float_step;
        /* a half float itself: what the map is cleared to must be what is compared with */
        view->code.far_end = ceilf(view->code.far_m / half_float_step(view->code.far_m)) *
                             half_float_step(view->code.far_m);
        return;
    case GN_ENCODING_RGBA8:
        view->code.scale = 1.0f / range;
        view->code.offset = -view->code.near_m / range;
        view->code.far_end = GN_RGBA8_FAR;
        view->code.ulp_m = range * exp2f(-22.0f) + float_step;
        return;
    case GN_ENCODING_DEPTH:
        view->code.far_end = 1.0f;
        view->code.ulp_m += view->perspective ? far_depth * range / near_depth * exp2f(-23.0f)
                                              : range * exp2f(-22.0f);
        return;
    case GN_ENCODING_DEPTH16: /* which rounds both the map and what is compared with it */
        view->code.far_end = 1.0f;
        view->code.ulp_m +=
            (view->perspective ? far_depth * range / near_depth : range) * exp2f(-16.0f);
        return;
    case GN_ENCODING_R32UI:
        if (!gn_technique_replaces_map(view->technique)) return;
        view->code.scale = 1.0f / range; /* 0 to 1, for moments */
        view->code.offset = -view->code.near_m / range;
        view->code.far_end = 1.0f;
        return;
    case GN_ENCODING_MASK:
    case GN_ENCODING_MEAN:
    case GN_ENCODING_STENCIL:
    case GN_ENCODING_SCREEN:
    case GN_ENCODING_ALL:
    case GN_ENCODING_COUNT: return;
    }
}

/* Behind the blockers of a lamp without a width are no cones, so nothing would be in shadow. They
 * are as wide at the far end of the map as this share of a texel, where taps alone decide. */
#define LEAST_CONE (1.0f / 256.0f)

static void widen_cones(struct gn_shadow_view *view) {
    if (gn_techniques[view->technique].filter == GN_FILTER_CONE && view->penumbra.radius == 0.0f)
        view->penumbra.radius = LEAST_CONE / view->penumbra.scale;
}

/* Similar triangles (Fernando, "Percentage-Closer Soft Shadows", 2005): in plane units a blocker at
 * depth b throws on a receiver at depth r a penumbra of radius (r - b) tan(angular radius) for a
 * directional light, radius (1/b - 1/r) for a spot or point light. */
void gn_fitter_set_penumbra(const struct gn_fitter *f, const struct gn_shadow_region *window,
                            float near_depth, float far_depth) {
    struct gn_shadow_view *view = f->view;
    view->penumbra.radius = f->light_radius / view->lookup.texel;
    view->penumbra.widest_px =
        view->penumbra.radius * gn_fitter_spread(f, window->near, window->far);
    if (view->perspective && gn_encoding_is_depth(view->encoding)) { /* linear in 1 / depth */
        view->penumbra.nearest = -1.0f / near_depth;
        view->penumbra.scale = 1.0f / near_depth - 1.0f / far_depth;
        view->penumbra.bias = -1.0f / near_depth;
        widen_cones(view);
        return;
    }
    view->penumbra.nearest = -1.0f / near_depth;
    if (!view->perspective) view->penumbra.nearest = most(window->near - near_depth, 0.0f);
    const float part =
        NEAREST_STEP * view->code.far_m; /* steps: it stays while the eye moves little */
    if (!view->perspective && !f->is_cascade)
        view->penumbra.nearest = floorf(view->penumbra.nearest / part) * part;
    view->penumbra.farthest = window->far - near_depth;
    view->penumbra.scale =
        gn_encoding_is_depth(view->encoding) ? view->code.far_m : 1.0f / view->code.scale;
    view->penumbra.bias = -view->code.offset / view->code.scale;
    widen_cones(view);
}

/* A blur does not know the distance of blockers. It is as wide as the penumbra that a blocker
 * throws on a receiver at the far end, a quarter of the casters' range of depths behind it, or as
 * is set; within GN_BLUR_LEAST_PX and GN_BLUR_MOST_PX. */
void gn_fitter_set_blur(const struct gn_fitter *f, float near_depth, float far_depth) {
    struct gn_shadow_view *view = f->view;
    if (gn_techniques[view->technique].filter != GN_FILTER_BLUR) return;
    const float behind = 0.25f * (far_depth - near_depth);
    const float spread =
        view->perspective ? 1.0f / (far_depth - behind) - 1.0f / far_depth : behind;
    float blur = f->light_radius * spread;
    if (f->blur_most_m > 0.0f) blur = least(blur, f->blur_most_m); /* else it jumps at each split */
    const float set_px = view->lookup.filter_radius_px,
                blur_px = set_px > 0.0f ? set_px : blur / view->lookup.texel;
    view->penumbra.blur_px = least(most(blur_px, GN_BLUR_LEAST_PX), GN_BLUR_MOST_PX);
}
