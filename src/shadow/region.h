/* Rectangles in plane coordinates with a range of depths, for fitting. */
#ifndef GN_SHADOW_REGION_H
#define GN_SHADOW_REGION_H

#include "shadow/fit.h"

static const struct gn_shadow_region nothing = {
    {INFINITY, INFINITY}, {-INFINITY, -INFINITY}, INFINITY, -INFINITY, 0.0f};

/* As fminf() and fmaxf(), but inline, and not for NaN. */
static inline float least(float a, float b) { return a < b ? a : b; }
static inline float most(float a, float b) { return a > b ? a : b; }

static inline bool region_is_empty(const struct gn_shadow_region *r) {
    return r->min[0] > r->max[0] || r->min[1] > r->max[1];
}

static inline bool regions_meet(const struct gn_shadow_region *a,
                                const struct gn_shadow_region *b) {
    return a->min[0] <= b->max[0] && b->min[0] <= a->max[0] && a->min[1] <= b->max[1] &&
           b->min[1] <= a->max[1];
}

static inline struct gn_shadow_region intersect(const struct gn_shadow_region *a,
                                                const struct gn_shadow_region *b) {
    struct gn_shadow_region r = *a;
    for (int k = 0; k < 2; k++) {
        r.min[k] = most(a->min[k], b->min[k]);
        r.max[k] = least(a->max[k], b->max[k]);
    }
    return r;
}

static inline void unite(struct gn_shadow_region *a, const struct gn_shadow_region *b) {
    if (region_is_empty(b)) return;
    for (int k = 0; k < 2; k++) {
        a->min[k] = least(a->min[k], b->min[k]);
        a->max[k] = most(a->max[k], b->max[k]);
    }
    a->near = least(a->near, b->near);
    a->far = most(a->far, b->far);
    a->far_radial = most(a->far_radial, b->far_radial);
}

static inline struct gn_shadow_region grown(const struct gn_shadow_region *region, float by) {
    struct gn_shadow_region r = *region;
    for (int k = 0; k < 2; k++) {
        r.min[k] -= by;
        r.max[k] += by;
    }
    return r;
}

#endif
