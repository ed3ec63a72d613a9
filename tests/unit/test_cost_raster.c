/* What triangles shade, against a rasteriser that shares nothing with the one tested
 * (unit/plain_raster.h). Corners are not placed on a grid there, so few pixels differ.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cost/raster.h"
#include "unit/check.h"
#include "unit/plain_raster.h"

enum { WIDTH = GN_PLAIN_WIDTH, HEIGHT = GN_PLAIN_HEIGHT, LARGE_PX = 100 };

static uint32_t seed = 1;
static double random_in(double least, double most) {
    seed = seed * 1664525u + 1013904223u;
    return least + (most - least) * (seed >> 8) / 16777216.0;
}

static void assert_close(uint64_t a, uint64_t b, double share) {
    if (fabs((double)a - (double)b) > share * (double)b + 2)
        fail_msg("%llu, not %llu", (unsigned long long)a, (unsigned long long)b);
}

/* Triangles of a size, in pixels; large ones through the near plane, too, and beyond the picture:
 * what is clipped there is two triangles, whose common quads are shaded twice. */
static void compare(double size_px, int samples, int cull, int count) {
    struct gn_plain_raster *plain = gn_plain_create(samples);
    struct gn_raster raster;
    gn_raster_create(&raster, WIDTH, HEIGHT, samples);
    raster.tests_depth = raster.writes_depth = true;
    raster.cull = (enum gn_raster_cull)cull;
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
        gn_plain_triangle(plain, (const double(*)[4])clip, cull, true);
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
