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
