#include "unit/plain_raster.h"

#include <stdlib.h>
#include <string.h>

#include "cost/raster.h"

struct gn_plain_raster *gn_plain_create(int samples) {
    struct gn_plain_raster *p = calloc(1, sizeof *p);
    if (!p) abort();
    p->samples = samples;
    for (int i = 0; i < GN_PLAIN_WIDTH * GN_PLAIN_HEIGHT * GN_PLAIN_SAMPLES; i++)
        (&p->depth[0][0][0])[i] = 1;
    return p;
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Where a sample lies: those of GL's drivers. */
static void place_sample(int samples, int k, int x, int y, double ndc[2]) {
    static const double four[4][2] = {{6, 2}, {14, 6}, {2, 10}, {10, 14}}, /* sixteenths */
        two[2][2] = {{12, 12}, {4, 4}};
    const double at[2] = {samples == 4   ? four[k][0] / 16
                          : samples == 2 ? two[k][0] / 16
                                         : .5,
                          samples == 4   ? four[k][1] / 16
                          : samples == 2 ? two[k][1] / 16
                                         : .5};
    ndc[0] = 2 * (x + at[0]) / GN_PLAIN_WIDTH - 1;
    ndc[1] = 2 * (y + at[1]) / GN_PLAIN_HEIGHT - 1;
}

static bool covers(const double edges[3][3], double sign, const double clip[3][4],
                   const double ndc[2], double *depth) {
    double weight[3], w = 0, z = 0;
    for (int i = 0; i < 3; i++) {
        weight[i] = sign * (edges[i][0] * ndc[0] + edges[i][1] * ndc[1] + edges[i][2]);
        if (weight[i] < 0) return false;
    }
    for (int i = 0; i < 3; i++) {
        w += weight[i] * clip[i][3];
        z += weight[i] * clip[i][2];
    }
    *depth = z / w / 2 + .5;
    return w > 0 && *depth >= 0 && *depth <= 1;
}

static bool shade_pixel(struct gn_plain_raster *p, const double edges[3][3], double sign,
                        const double clip[3][4], int x, int y, bool writes) {
    bool shown = false;
    for (int k = 0; k < p->samples; k++) {
        double ndc[2], depth;
        place_sample(p->samples, k, x, y, ndc);
        if (!covers(edges, sign, clip, ndc, &depth) || depth > p->depth[y][x][k]) continue;
        if (writes) p->depth[y][x][k] = depth;
        shown = true;
    }
    return shown;
}

/* The determinant's sign says how it winds, also where corners are behind the eye. */
void gn_plain_triangle(struct gn_plain_raster *p, const double clip[3][4], int cull, bool writes) {
    double corner[3][3], edges[3][3], det = 0;
    for (int i = 0; i < 3; i++)
        memcpy(corner[i], (double[]){clip[i][0], clip[i][1], clip[i][3]}, sizeof corner[i]);
    for (int i = 0; i < 3; i++) cross(corner[(i + 1) % 3], corner[(i + 2) % 3], edges[i]);
    for (int k = 0; k < 3; k++) det += corner[0][k] * edges[0][k];
    if ((cull == GN_RASTER_CULL_BACK && det < 0) || (cull == GN_RASTER_CULL_FRONT && det > 0))
        return;
    for (int y = 0; y < GN_PLAIN_HEIGHT; y += 2)
        for (int x = 0; x < GN_PLAIN_WIDTH; x += 2) {
            unsigned shown = 0;
            for (int i = 0; i < 4; i++)
                shown += shade_pixel(p, (const double(*)[3])edges, det < 0 ? -1 : 1, clip,
                                     x + i % 2, y + i / 2, writes);
            p->pixels += shown;
            p->lanes += shown ? 4 : 0;
        }
}
