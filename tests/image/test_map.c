/* A directional map under a moving eye: shifted back by whole texels, it is the same map. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "frame/plan.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { MAP_PX = 512, RIM = 1 };

static struct help_stage stage;

static int open_all(void **state) {
    (void)state;
    help_stage_open(&stage, gn_stage_scene_make, "egl", NULL, NULL);
    return 0;
}

static int close_all(void **state) {
    (void)state;
    help_stage_close(&stage);
    return 0;
}

/* The sun's map seen by an eye turned by this much: MAP_PX x MAP_PX codes. The view is narrow, so
 * that it limits the window. */
static struct gn_shadow_view draw_map(enum gn_encoding encoding, float turn_rad, float *codes) {
    struct gn_frame_opts opts = {.width_px = 40,
                                 .height_px = 300,
                                 .technique_given = true,
                                 .technique = GN_TECHNIQUE_HARD,
                                 .encoding = encoding,
                                 .map_px = MAP_PX,
                                 .turntable_rad = turn_rad};
    struct gn_err err = {0};
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    if (!gn_gl_read_map(stage.gl, 0, codes, &err)) fail_msg("%s", err.text);
    assert_int_equal(plan->shadows[0].encoding, encoding);
    return plan->shadows[0];
}

/* By how many texels the window of `to` lies beyond that of `from`. */
static void shift_between(const struct gn_shadow_view *from, const struct gn_shadow_view *to,
                          int shift[2]) {
    for (int k = 0; k < 2; k++) {
        double texels =
            ((double)from->map_from_world[3][k] - (double)to->map_from_world[3][k]) * MAP_PX;
        shift[k] = (int)lround(texels);
        assert_true(fabs(texels - shift[k]) < 0.02);
    }
}

struct agreement {
    long covered, different; /* texels that hold something; of them not bit-equal */
    long flipped;            /* something in one, nothing in the other */
    double worst_m;          /* largest difference of the others */
};

static void compare(const float *a, const float *b, const int shift[2],
                    const struct gn_shadow_view *view, struct agreement *sum) {
    double metres = view->encoding == GN_ENCODING_DEPTH ? view->far_m : 1.0 / view->distance_scale;
    for (int y = RIM; y < MAP_PX - RIM; y++)
        for (int x = RIM; x < MAP_PX - RIM; x++) {
            int u = x + shift[0], v = y + shift[1];
            if (u < RIM || v < RIM || u >= MAP_PX - RIM || v >= MAP_PX - RIM) continue;
            float before = a[v * MAP_PX + u], after = b[y * MAP_PX + x];
            bool was = before < view->far_code, is = after < view->far_code;
            sum->covered += was || is;
            sum->flipped += was != is;
            sum->different += memcmp(&before, &after, sizeof before) != 0;
            if (was && is)
                sum->worst_m = fmax(sum->worst_m, fabs((double)before - (double)after) * metres);
        }
}

/* What the rasteriser covers must not change, or shadows would crawl. The distance of a texel is
 * interpolated from an origin that moves with the window, so its last bit may: by less than what
 * the encoding's bias allows for. */
static void expect_same_map(enum gn_encoding encoding) {
    float *still = gn_xalloc(MAP_PX * MAP_PX, sizeof *still),
          *moved = gn_xalloc(MAP_PX * MAP_PX, sizeof *moved);
    struct agreement sum = {0};
    struct gn_shadow_view from = draw_map(encoding, 0.0f, still);
    int compared = 0;
    for (int step = 1; step <= 40; step++) {
        struct gn_shadow_view to = draw_map(encoding, 0.0008f * (float)step, moved);
        int shift[2];
        if (to.texel != from.texel) continue;
        shift_between(&from, &to, shift);
        if (shift[0] == 0 && shift[1] == 0) continue;
        compare(still, moved, shift, &from, &sum);
        compared++;
    }
    printf("%-6s %d eyes: of %ld texels %.4f %% not bit-equal, by %.2g m at most (a step of the "
           "encoding: %.2g m); %ld covered in one only\n",
           gn_encodings[encoding].name, compared, sum.covered,
           100.0 * (double)sum.different / (double)sum.covered, sum.worst_m, (double)from.ulp_m,
           sum.flipped);
    assert_true(compared >= 5);
    assert_true(sum.covered > 10000);
    assert_true((double)sum.flipped <= 1e-5 * (double)sum.covered);
    assert_true(sum.worst_m <= (double)from.ulp_m);
    free(still);
    free(moved);
}

static void test_r16f(void **state) { (void)state, expect_same_map(GN_ENCODING_R16F); }
static void test_depth(void **state) { (void)state, expect_same_map(GN_ENCODING_DEPTH); }
static void test_r32ui(void **state) { (void)state, expect_same_map(GN_ENCODING_R32UI); }

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_r16f, open_all, close_all),
        cmocka_unit_test_setup_teardown(test_depth, open_all, close_all),
        cmocka_unit_test_setup_teardown(test_r32ui, open_all, close_all),
    };
    return RUN(tests);
}
