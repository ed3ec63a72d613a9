/* What the two cascades of a split say of the same penumbra. Each picture is drawn twice: with the
 * nearer one up to the split's end, and with the farther one from its beginning on. Judged are
 * blocks that in truth are wholly penumbra, where a shadow's edge of a texel's width is no matter.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frame/frame.h"
#include "image/penumbra.h"
#include "image/picture.h"
#include "shadow/cascade.h"
#include "unit/check.h"
#include "unit/gl_help.h"

#include "../../shaders_es/blocks.glsl"

enum { WIDTH_PX = 640, HEIGHT_PX = 360, PIXELS = WIDTH_PX * HEIGHT_PX, MAP_PX = 1024 };
enum { BLOCK_WIDTH_PX = 16, BLOCK_HEIGHT_PX = 6, LEAST_PIXELS = 32 };

static struct help_stage stage;
static struct gn_picture truth;
static float depth_m[PIXELS], nearer[PIXELS], farther[PIXELS], aov[4 * PIXELS];

static struct gn_scene *load(void) {
    struct gn_err err = {0};
    char *path = gn_penumbra_write(GN_PENUMBRA_FIELD, &err);
    struct gn_scene *scene = path ? gn_scene_load(path, NULL, NULL, &err) : NULL;
    if (!scene) fail_msg("%s", err.text);
    free(path);
    return scene;
}

static int open_all(void **state) {
    (void)state;
    help_stage_open(&stage, load, "egl", NULL, NULL);
    return 0;
}

static int close_all(void **state) {
    (void)state;
    help_stage_close(&stage);
    return 0;
}

static void read_picture(float *to) {
    struct gn_err err = {0};
    if (!gn_gl_read_f32(stage.gl, aov, &err)) fail_msg("%s", err.text);
    for (int i = 0; i < PIXELS; i++) to[i] = aov[4 * i];
}

static const struct gn_plan *draw(enum gn_technique technique, enum gn_aov what, float *to) {
    const struct gn_frame_opts opts = {
        .output.width_px = WIDTH_PX,
        .output.height_px = HEIGHT_PX,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                       .technique = technique,
                       .map_px = MAP_PX},
        .debug.aov = what};
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    read_picture(to);
    return plan;
}

/* The picture once more, the zone before a split made as much narrower or wider. */
static void draw_moved(const struct gn_plan *plan, uint32_t split, float factor, float *to) {
    float constants[PASS_SIZE][4];
    struct gn_err err = {0};
    struct gn_pass *last = &plan->passes[plan->pass_count - 1];
    const struct gn_pass before = *last;
    assert_int_equal(last->target.kind, GN_TARGET_OUTPUT);
    assert_in_range(last->constant_count, PASS_CASCADES + 1, PASS_SIZE);
    memcpy(constants, before.constants, last->constant_count * sizeof *constants);
    constants[PASS_CASCADES + CASCADES_ZONES][split] *= factor;
    last->constants = (const float(*)[4])constants;
    if (!gn_gl_run(stage.gl, plan, NULL, &err)) fail_msg("%s", err.text);
    *last = before;
    read_picture(to);
}

/* Along the view. */
static void find_depths(void) {
    draw(GN_TECHNIQUE_HARD, GN_AOV_DISTANCE, depth_m);
    const float tangent = tanf(0.5f * stage.scene->cameras[0].yfov_rad);
    for (int y = 0; y < HEIGHT_PX; y++)
        for (int x = 0; x < WIDTH_PX; x++) {
            const float u = ((float)(2 * x + 1 - WIDTH_PX)) / HEIGHT_PX * tangent,
                        v = ((float)(2 * y + 1 - HEIGHT_PX)) / HEIGHT_PX * tangent;
            depth_m[y * WIDTH_PX + x] /= sqrtf(1.0f + u * u + v * v);
        }
}

/* How far apart the two are over a block's pixels between two distances; NAN: these are few, or not
 * all are penumbra. */
static double apart(int x, int y, float from_m, float to_m) {
    double sum = 0;
    int count = 0;
    for (int k = 0; k < BLOCK_WIDTH_PX * BLOCK_HEIGHT_PX; k++) {
        const int i = (y + k / BLOCK_WIDTH_PX) * WIDTH_PX + x + k % BLOCK_WIDTH_PX;
        if (depth_m[i] < from_m || depth_m[i] > to_m) continue;
        if (truth.data[i] < .01f || truth.data[i] > .99f) return NAN;
        sum += (double)(nearer[i] - farther[i]);
        count++;
    }
    return count < LEAST_PIXELS ? NAN : fabs(sum / count);
}

static long check_split(const struct gn_shadow_view *view, uint32_t split) {
    const float begin_m = view->cascades[split + 1].begin_m, end_m = view->cascades[split].end_m;
    double worst = 0;
    long blocks = 0;
    for (int y = 0; y + BLOCK_HEIGHT_PX <= HEIGHT_PX; y++)
        for (int x = 0; x + BLOCK_WIDTH_PX <= WIDTH_PX; x++) {
            const double d = apart(x, y, begin_m, end_m);
            if (isnan(d)) continue;
            worst = fmax(worst, d);
            blocks++;
        }
    print_message("radius %g, %s: split at %.1f m: at most %.3f apart, %ld blocks\n",
                  (double)stage.scene->lights[0].radius, gn_techniques[view->technique].name,
                  (double)end_m, worst, blocks);
    assert_true(worst <= .1);
    return blocks;
}

static void check_radius(float radius) {
    static const enum gn_technique techniques[] = {GN_TECHNIQUE_PCSS, GN_TECHNIQUE_CONE,
                                                   GN_TECHNIQUE_VSSM, GN_TECHNIQUE_SMSM};
    stage.scene->lights[0].radius = radius;
    gn_penumbra_truth_of(&truth, stage.scene, false, WIDTH_PX, HEIGHT_PX);
    find_depths();
    for (size_t t = 0; t < sizeof techniques / sizeof *techniques; t++) {
        const struct gn_plan *plan = draw(techniques[t], GN_AOV_VISIBILITY, nearer);
        const struct gn_shadow_view *view = &plan->shadows[0];
        long blocks = 0;
        assert_int_equal(view->map.cascade_count, 4);
        for (uint32_t split = 0; split < 2; split++) { /* beyond the third nothing is wide */
            draw_moved(plan, split, 1 - GN_CASCADE_FADE, nearer);
            draw_moved(plan, split, 1 / (1 - GN_CASCADE_FADE), farther);
            blocks += check_split(view, split);
        }
        assert_true(blocks > 400);
    }
    gn_picture_finish(&truth);
}

static void test_both_see_the_same_penumbra(void **state) {
    (void)state;
    check_radius(.05f);
    check_radius(.1f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_both_see_the_same_penumbra, open_all, close_all),
    };
    return cmocka_run_group_tests_name("splits", tests, NULL, NULL);
}
