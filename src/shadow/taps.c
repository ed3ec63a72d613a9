#include "shadow/taps.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "poisson.h"

/* That of 4 k points is after those of 4 to 4 (k - 1), a pair's first point each. */
static const float (*poisson_of(int count))[2] {
    const int k = count / 4;
    return poisson_disks + k * (k - 1);
}

int gn_taps_count(enum gn_taps kind, int wanted) {
    if (kind == GN_TAPS_NONE) return 0;
    if (kind != GN_TAPS_RINGS) return wanted ? wanted : GN_TAPS_DEFAULT;
    if (wanted == 0) return 4 * GN_RINGS_DEFAULT;
    return wanted < 8 ? 8 : wanted > 4 * GN_RINGS_MAX ? 4 * GN_RINGS_MAX : wanted;
}

void gn_taps_build(enum gn_taps kind, int count, float (*out)[2]) {
    assert(count >= 4 && count <= GN_TAPS_MAX && count % 4 == 0);
    if (kind == GN_TAPS_POISSON) {
        memcpy(out, poisson_of(count), (size_t)count / 2 * sizeof *out);
        return;
    }
    for (int i = 0; i < count / 2; i++) {
        double radius = sqrt((2 * i + 1.0) / count), angle = i * 2.399963229728653;
        out[i][0] = (float)(radius * cos(angle));
        out[i][1] = (float)(radius * sin(angle));
    }
}

/* Turned by up to a quarter of a circle, the share of the points on one side of a straight edge is
 * as near as can be to the disk's: RMSE over edges .050, .034, .026; with radii of equal area .053,
 * .037, .028. By a random search among points that share products (shaders_es/shadow/cone.glsl):
 * the first and the last of three or four lie on the x axis, the second of two or three on the
 * diagonal, those of four between them mirror each other. */
static const struct {
    double radius, angle_deg;
} rings[GN_RINGS_MAX + 1][GN_RINGS_MAX] = {
    [2] = {{.5277, 0}, {.7988, 45}},
    [3] = {{.3598, 0}, {.7919, 45}, {.8228, 0}},
    [4] = {{.3032, 0}, {.7611, 30.6}, {.7611, -30.6}, {.8168, 0}},
};

void gn_taps_rings(int count, float (*out)[2]) {
    assert(count >= 2 && count <= GN_RINGS_MAX);
    for (int i = 0; i < count; i++) {
        const double angle = rings[count][i].angle_deg * M_PI / 180;
        out[i][0] = (float)(rings[count][i].radius * cos(angle));
        out[i][1] = (float)(rings[count][i].radius * sin(angle));
    }
}
