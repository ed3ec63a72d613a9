#include "shadow/taps.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "poisson.h"

static const float (*poisson_of(int count))[2] {
    return count == 8    ? poisson_8
           : count == 12 ? poisson_12
           : count == 16 ? poisson_16
                         : poisson_32;
}

void gn_taps_build(enum gn_taps kind, int count, float (*out)[2]) {
    assert(count == 8 || count == 12 || count == 16 || count == 32);
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

/* Found by a random search, which test_taps repeats the measure of: turned by noise_quarter(), the
 * share of a ring's points on one side of a straight edge is as near as can be to the disk's. RMSE
 * over edges .050, .033, .026; with radii of equal area .053, .037, .028. */
static const struct {
    double radius, angle_deg;
} rings[GN_RINGS_MAX + 1][GN_RINGS_MAX] = {
    [2] = {{.5277, 0}, {.7988, 45.14}},
    [3] = {{.3642, 0}, {.8055, 67.72}, {.8054, 24.75}},
    [4] = {{.3032, 0}, {.7326, 61.15}, {.8168, 1.21}, {.7890, 32.37}},
};

void gn_taps_rings(int count, float (*out)[2]) {
    assert(count >= 2 && count <= GN_RINGS_MAX);
    for (int i = 0; i < count; i++) {
        const double angle = rings[count][i].angle_deg * M_PI / 180;
        out[i][0] = (float)(rings[count][i].radius * cos(angle));
        out[i][1] = (float)(rings[count][i].radius * sin(angle));
    }
}
