/* What triangles shade, against a rasteriser that shares nothing with the one tested: it clips
 * nothing, but has edges and depth as functions of homogeneous corners (Olano, Greer 1997), in
 * double precision, and asks every sample of every pixel. Corners are not placed on a grid there,
 * so few pixels differ.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cost/raster.h"
#include "unit/check.h"

enum { WIDTH = 96, HEIGHT = 70, MOST_SAMPLES = 4, LARGE_PX = 100 };

struct plain { /* the other one */
    double depth[HEIGHT][WIDTH][MOST_SAMPLES];
    int samples;
    uint64_t pixels, lanes;
};

static uint32_t seed = 1;
static double random_in(double least, double most) {
    seed = seed * 1664525u + 1013904223u;
    return least + (most - least) * (seed >> 8) / 16777216.0;
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
    ndc[0] = 2 * (x + at[0]) / WIDTH - 1;
    ndc[1] = 2 * (y + at[1]) / HEIGHT - 1;
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

static bool shade_pixel(struct plain *p, const double edges[3][3], double sign,
                        const double clip[3][4], int x, int y) {
    bool shown = false;
    for (int k = 0; k < p->samples; k++) {
        double ndc[2], depth;
        place_sample(p->samples, k, x, y, ndc);
        if (!covers(edges, sign, clip, ndc, &depth) || depth > p->depth[y][x][k]) continue;
        p->depth[y][x][k] = depth;
        shown = true;
    }
    return shown;
}

/* The determinant's sign says how it winds, also where corners are behind the eye. */
static void draw_plain(struct plain *p, const double clip[3][4], int cull) {
    double corner[3][3], edges[3][3], det = 0;
    for (int i = 0; i < 3; i++)
        memcpy(corner[i], (double[]){clip[i][0], clip[i][1], clip[i][3]}, sizeof corner[i]);
    for (int i = 0; i < 3; i++) cross(corner[(i + 1) % 3], corner[(i + 2) % 3], edges[i]);
    for (int k = 0; k < 3; k++) det += corner[0][k] * edges[0][k];
    if ((cull == GN_RASTER_CULL_BACK && det < 0) || (cull == GN_RASTER_CULL_FRONT && det > 0))
        return;
    for (int y = 0; y < HEIGHT; y += 2)
        for (int x = 0; x < WIDTH; x += 2) {
            unsigned shown = 0;
            for (int i = 0; i < 4; i++)
                shown += shade_pixel(p, (const double(*)[3])edges, det < 0 ? -1 : 1, clip,
                                     x + i % 2, y + i / 2);
            p->pixels += shown;
            p->lanes += shown ? 4 : 0;
        }
}

static void assert_close(uint64_t a, uint64_t b, double share) {
    if (fabs((double)a - (double)b) > share * (double)b + 2)
        fail_msg("%llu, not %llu", (unsigned long long)a, (unsigned long long)b);
}

/* Triangles of a size, in pixels; large ones through the near plane, too, and beyond the picture:
 * what is clipped there is two triangles, whose common quads are shaded twice. */
static void compare(double size_px, int samples, int cull, int count) {
    struct plain *plain = calloc(1, sizeof *plain);
    struct gn_raster raster;
    gn_raster_create(&raster, WIDTH, HEIGHT, samples);
    raster.tests_depth = raster.writes_depth = true;
    raster.cull = (enum gn_raster_cull)cull;
    plain->samples = samples;
    for (int i = 0; i < WIDTH * HEIGHT * MOST_SAMPLES; i++) (&plain->depth[0][0][0])[i] = 1;
    for (int n = 0; n < count; n++) {
        struct gn_raster_vertex v[3] = {0};
        double clip[3][4];
        const double middle[2] = {random_in(-1.1, 1.1), random_in(-1.1, 1.1)};
        for (int i = 0; i < 3; i++) {
            const double w = random_in(n % 5 || size_px < LARGE_PX ? .6 : -.4, 3),
                         z = random_in(-.8, .9) * fabs(w);
            for (int k = 0; k < 2; k++) {
                const double extent = size_px / (k ? HEIGHT : WIDTH);
                clip[i][k] = w * (middle[k] + random_in(-extent, extent));
            }
            clip[i][2] = z;
            clip[i][3] = w;
            memcpy(v[i].clip, clip[i], sizeof clip[i]);
        }
        draw_plain(plain, (const double(*)[4])clip, cull);
        gn_raster_triangle(&raster, v);
    }
    assert_true(raster.count.pixels > 500);
    assert_close(raster.count.pixels, plain->pixels, .01);
    assert_close(raster.count.lanes, plain->lanes, .01);
    gn_raster_destroy(&raster);
    free(plain);
}

static void test_large(void **state) {
    (void)state;
    compare(120, 1, GN_RASTER_BOTH, 60);
    compare(120, 4, GN_RASTER_BOTH, 60);
    compare(120, 2, GN_RASTER_CULL_BACK, 60);
    compare(120, 1, GN_RASTER_CULL_FRONT, 60);
}

static void test_small(void **state) {
    (void)state;
    compare(3, 1, GN_RASTER_BOTH, 3000);
    compare(3, 4, GN_RASTER_CULL_BACK, 3000);
    compare(12, 4, GN_RASTER_BOTH, 600);
}

static void draw_square(struct gn_raster *r, double z) {
    static const double corners[2][3][2] = {{{-1, -1}, {1, -1}, {1, 1}},
                                            {{-1, -1}, {1, 1}, {-1, 1}}};
    for (int t = 0; t < 2; t++) {
        struct gn_raster_vertex v[3] = {0};
        for (int i = 0; i < 3; i++)
            memcpy(v[i].clip, (double[]){corners[t][i][0], corners[t][i][1], z, 1},
                   sizeof v[i].clip);
        gn_raster_triangle(r, v);
    }
}

/* Two triangles share their edge without a gap or a pixel twice; quads at it are shaded twice. */
static void test_shared_edge(void **state) {
    (void)state;
    for (int samples = 1; samples <= 4; samples *= 2) {
        struct gn_raster r;
        gn_raster_create(&r, 64, 64, samples);
        r.tests_depth = r.writes_depth = true;
        draw_square(&r, 0);
        assert_int_equal(r.count.triangles, 2);
        if (samples == 1) assert_int_equal(r.count.pixels, 64 * 64);
        assert_int_equal(r.count.lanes, 64 * 64 + 32 * 4);
        /* hidden by what was drawn; in a scissor; a hole hides nothing */
        r.count = (struct gn_raster_count){0};
        draw_square(&r, .5);
        assert_int_equal(r.count.lanes, 0);
        r.scissor = (struct gn_raster_rect){8, 8, 16, 16};
        draw_square(&r, -.5);
        assert_int_equal(r.count.lanes, 16 * 16 + 8 * 4);
        gn_raster_destroy(&r);
    }
}

static bool is_left_half(const void *context, const double attributes[3]) {
    (void)context;
    return attributes[0] < .5;
}

/* Attributes are those of perspective: the hole ends where u is one half. */
static void test_holes(void **state) {
    (void)state;
    const double x[3] = {-1, 1, -1}, y[3] = {-1, -1, 3}, w[3] = {1, 3, 1}, u[3] = {0, 1, 0};
    struct gn_raster r;
    struct gn_raster_vertex v[3] = {0};
    gn_raster_create(&r, 64, 64, 1);
    r.tests_depth = r.writes_depth = true;
    r.is_hole = is_left_half;
    for (int i = 0; i < 3; i++) {
        memcpy(v[i].clip, (double[]){x[i] * w[i], y[i] * w[i], 0, w[i]}, sizeof v[i].clip);
        v[i].attributes[0] = u[i];
    }
    gn_raster_triangle(&r, v);
    uint64_t solid = 0;
    for (int row = 0; row < 64; row++)
        for (int column = 0; column < 64; column++) solid += r.depth[row * 64 + column] == .5f;
    uint64_t wanted = 0;
    for (int row = 0; row < 64; row++)
        for (int column = 48; column < 64; column++)
            wanted += (row + .5) / 128 + (column + .5) / 64 < 1;
    assert_close(solid, wanted, .05);
    gn_raster_destroy(&r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_large),
        cmocka_unit_test(test_small),
        cmocka_unit_test(test_shared_edge),
        cmocka_unit_test(test_holes),
    };
    return RUN(tests);
}
