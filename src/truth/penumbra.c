#include "truth/penumbra.h"

#include <math.h>
#include <stdlib.h>

#include "core/arena.h"

/* ---- truth ---- */

enum { FEW = 24, MANY = 768 };

static float share_at(const struct gn_raycast *rays, const struct gn_ray_eye *eye,
                      const struct gn_ray_lamp *lamp, int x, int y, int samples) {
    struct gn_ray_surface surface;
    if (!gn_raycast_eye(rays, eye, x, y, &surface)) return 1;
    return (float)gn_raycast_share(rays, lamp, &surface, samples);
}

static bool is_mixed(const float *few, int w, int h, int x, int y) {
    const float first = few[(size_t)y * (size_t)w + (size_t)x];
    if (first > 0 && first < 1) return true;
    for (int v = y - 3; v <= y + 3; v++)
        for (int u = x - 3; u <= x + 3; u++) {
            if (u < 0 || v < 0 || u >= w || v >= h) continue;
            if (few[(size_t)v * (size_t)w + (size_t)u] != first) return true;
        }
    return false;
}

void gn_penumbra_cast(const struct gn_raycast *rays, const struct gn_ray_eye *eye,
                      const struct gn_ray_lamp *lamp, float *out) {
    const int w = eye->width_px, h = eye->height_px;
    float *few = gn_xalloc((size_t)w * (size_t)h, sizeof *few);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
            few[(size_t)y * (size_t)w + (size_t)x] = share_at(rays, eye, lamp, x, y, FEW);
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            const size_t at = (size_t)y * (size_t)w + (size_t)x;
            out[at] = is_mixed(few, w, h, x, y) ? share_at(rays, eye, lamp, x, y, MANY) : few[at];
        }
    free(few);
}

/* ---- the measure ---- */

static bool is_soft(const float *truth, int w, int h, int x, int y) {
    for (int v = y - 2; v <= y + 2; v++)
        for (int u = x - 2; u <= x + 2; u++) {
            if (u < 0 || v < 0 || u >= w || v >= h) continue;
            const float seen = truth[(size_t)v * (size_t)w + (size_t)u];
            if (seen > .01f && seen < .99f) return true;
        }
    return false;
}

void gn_penumbra_compare(const float *truth, const float *shot, int channels, int width_px,
                         int height_px, struct gn_penumbra_score *score) {
    double sum[2] = {0}, square[2] = {0};
    long count[2] = {0};
    for (int y = 0; y < height_px; y++)
        for (int x = 0; x < width_px; x++) {
            const size_t at = (size_t)y * (size_t)width_px + (size_t)x;
            const double d = (double)shot[at * (size_t)channels] - (double)truth[at];
            const bool soft = is_soft(truth, width_px, height_px, x, y);
            sum[soft] += d;
            square[soft] += d * d;
            count[soft]++;
        }
    const double n = count[1] ? (double)count[1] : 1;
    score->soft_pixels = count[1];
    score->soft = sqrt(square[1] / n);
    score->rest = sqrt(square[0] / (count[0] ? (double)count[0] : 1));
    score->bias = sum[1] / n;
    score->grain = sqrt(fmax(square[1] / n - score->bias * score->bias, 0));
}
