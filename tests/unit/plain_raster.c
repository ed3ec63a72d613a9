#include "unit/plain_raster.h"

#include <math.h>
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

/* A triangle as it is drawn: its edges, and the sign that makes them positive inside. */
struct setup {
    double edges[3][3], sign;
    const double (*clip)[4];
    bool writes;
};

static bool covers(const struct setup *setup, const double ndc[2], double *depth) {
    double weight[3], w = 0, z = 0;
    for (int i = 0; i < 3; i++) {
        weight[i] = setup->sign * (setup->edges[i][0] * ndc[0] + setup->edges[i][1] * ndc[1] +
                                   setup->edges[i][2]);
        if (weight[i] < 0) return false;
    }
    for (int i = 0; i < 3; i++) {
        w += weight[i] * setup->clip[i][3];
        z += weight[i] * setup->clip[i][2];
    }
    *depth = z / w / 2 + .5;
    return w > 0 && *depth >= 0 && *depth <= 1;
}

static bool shade_pixel(struct gn_plain_raster *p, const struct setup *setup, int x, int y) {
    bool shown = false;
    for (int k = 0; k < p->samples; k++) {
        double ndc[2], depth;
        place_sample(p->samples, k, x, y, ndc);
        if (!covers(setup, ndc, &depth) || depth > p->depth[y][x][k]) continue;
        if (setup->writes) p->depth[y][x][k] = depth;
        shown = true;
    }
    return shown;
}

/* Whether no sample of these pixels can be inside: an edge is negative at all corners, by more than
 * rounding. */
static bool is_outside(const struct setup *setup, const int from[2], const int size[2]) {
    const double half[2] = {(double)size[0] / GN_PLAIN_WIDTH, (double)size[1] / GN_PLAIN_HEIGHT};
    const double centre[2] = {2. * from[0] / GN_PLAIN_WIDTH - 1 + half[0],
                              2. * from[1] / GN_PLAIN_HEIGHT - 1 + half[1]};
    for (int i = 0; i < 3; i++) {
        const double *edge = setup->edges[i];
        double most = fabs(edge[0]) * half[0] + fabs(edge[1]) * half[1] +
                      setup->sign * (edge[0] * centre[0] + edge[1] * centre[1] + edge[2]);
        if (most < -1e-9 * (fabs(edge[0]) + fabs(edge[1]) + fabs(edge[2]))) return true;
    }
    return false;
}

static void shade_quad(struct gn_plain_raster *p, const struct setup *setup, const int at[2]) {
    unsigned shown = 0;
    for (int i = 0; i < 4; i++) shown += shade_pixel(p, setup, at[0] + i % 2, at[1] + i / 2);
    p->pixels += shown;
    p->lanes += shown ? 4 : 0;
}

/* Halves what may be inside, along its longer side, down to 2x2 pixels; its sides are even. */
static void shade(struct gn_plain_raster *p, const struct setup *setup, const int from[2],
                  const int size[2]) {
    const int axis = size[1] > size[0];
    int rest[2] = {from[0], from[1]}, part[2] = {size[0], size[1]};
    if (is_outside(setup, from, size)) return;
    if (size[axis] == 2) {
        shade_quad(p, setup, from);
        return;
    }
    part[axis] = size[axis] / 4 * 2;
    shade(p, setup, from, part);
    rest[axis] += part[axis];
    part[axis] = size[axis] - part[axis];
    shade(p, setup, rest, part);
}

/* The determinant's sign says how it winds, also where corners are behind the eye. */
void gn_plain_triangle(struct gn_plain_raster *p, const double clip[3][4], int cull, bool writes) {
    struct setup setup = {.clip = clip, .writes = writes};
    double corner[3][3], det = 0;
    for (int i = 0; i < 3; i++)
        memcpy(corner[i], (double[]){clip[i][0], clip[i][1], clip[i][3]}, sizeof corner[i]);
    for (int i = 0; i < 3; i++) cross(corner[(i + 1) % 3], corner[(i + 2) % 3], setup.edges[i]);
    for (int k = 0; k < 3; k++) det += corner[0][k] * setup.edges[0][k];
    if ((cull == GN_RASTER_CULL_BACK && det < 0) || (cull == GN_RASTER_CULL_FRONT && det > 0))
        return;
    setup.sign = det < 0 ? -1 : 1;
    shade(p, &setup, (int[]){0, 0}, (int[]){GN_PLAIN_WIDTH, GN_PLAIN_HEIGHT});
}
