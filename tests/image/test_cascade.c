/* Cascades: 5 m to 400 m in one view. Against the ray caster; at the splits; and under a moving
 * eye, which leaves each cascade's map bit for bit the same, shifted by whole texels. GN_FULL=1:
 * every technique with every number of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "frame/frame.h"
#include "image/shot.h"
#include "image/truth.h"
#include "plan/field_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH_PX = 640, HEIGHT_PX = 360, PIXELS = WIDTH_PX * HEIGHT_PX, MAP_PX = 1024 };

static struct help_stage stage;
static struct gn_truth truth;
static float *band_px, *edge_px, *aov;

static void open_all(const char *backend) {
    const struct gn_truth_opts opts = {.width_px = WIDTH_PX, .height_px = HEIGHT_PX};
    struct gn_err err = {0};
    help_stage_open(&stage, gn_field_scene_make, backend, NULL, NULL);
    if (!gn_truth_make(&truth, stage.scene, &opts, &err)) fail_msg("%s", err.text);
    band_px = gn_xalloc(PIXELS, sizeof *band_px);
    edge_px = gn_xalloc(PIXELS, sizeof *edge_px);
    aov = gn_xalloc(4 * PIXELS, sizeof *aov);
    truth.mask.band_px = band_px;
    gn_mask_edges(&truth.mask, edge_px);
}

static int open_egl(void **state) {
    (void)state;
    open_all("egl");
    return 0;
}

static int open_osmesa(void **state) {
    (void)state;
    open_all("osmesa");
    return 0;
}

static int close_all(void **state) {
    (void)state;
    free(band_px);
    free(edge_px);
    free(aov);
    gn_truth_finish(&truth);
    help_stage_close(&stage);
    return 0;
}

/* ---- against truth ---- */

/* Along the view: the camera looks down by .08. */
static double depth_at(int pixel) {
    const struct gn_ray_eye *eye = &truth.frame.eye;
    double depth = 0;
    for (int k = 0; k < 3; k++)
        depth +=
            ((double)truth.mask.point_ws[3 * pixel + k] - eye->position_ws[k]) * eye->forward[k];
    return depth;
}

/* The coarsest cascade that may be asked at this depth. */
static const struct gn_shadow_cascade *cascade_at(const struct gn_shadow_view *view, double depth) {
    uint32_t i = 0;
    while (i + 1 < view->map.cascade_count && depth >= (double)view->cascades[i + 1].begin_m) i++;
    return &view->cascades[i];
}

/* With cascades. Edges are two texels wide, as in truth.h, of the texel that there is; where a map
 * is blurred, as wide as it is. */
static void set_bands(const struct gn_shadow_view *view) {
    for (int i = 0; i < PIXELS; i++) {
        band_px[i] = 2.0f;
        if (truth.mask.item[i] < 0 || view->map.cascade_count == 0) continue;
        double point[3];
        for (int k = 0; k < 3; k++) point[k] = (double)truth.mask.point_ws[3 * i + k];
        const double pixel_m = gn_ray_eye_pixel_m(&truth.frame.eye, point);
        const struct gn_shadow_cascade *c = cascade_at(view, depth_at(i));
        const double texels = fmax(2.0, (double)c->blur_px + 1.5);
        band_px[i] = fmaxf(2.0f, (float)(texels * (double)c->texel / pixel_m));
    }
}

static const struct gn_shadow_view *draw_visibility(enum gn_technique technique,
                                                    enum gn_encoding encoding, uint32_t cascades,
                                                    struct gn_picture *shot) {
    const struct gn_frame_opts opts = {
        .output.width_px = WIDTH_PX,
        .output.height_px = HEIGHT_PX,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = technique,
                       .map_px = MAP_PX,
                       .map_format = GN_MAP_FORMAT(encoding, GN_MOMENTS_NONE)},
        .shadow.cascades = cascades,
        .debug.aov = GN_AOV_VISIBILITY};
    struct gn_err err = {0};
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    if (!gn_gl_read_f32(stage.gl, aov, &err)) fail_msg("%s", err.text);
    gn_picture_init(shot, WIDTH_PX, HEIGHT_PX, 1);
    for (int i = 0; i < PIXELS; i++) shot->data[i] = aov[4 * i];
    assert_int_equal(plan->shadows[0].map.cascade_count, cascades == 1 ? 0 : cascades);
    set_bands(&plan->shadows[0]);
    return &plan->shadows[0];
}

/* The limits of tests/image/table.c for one scene. */
static void expect_true(enum gn_technique technique, enum gn_encoding encoding) {
    struct gn_picture shot;
    struct gn_mask_score score;
    if (!(gn_caps_encodings(gn_gl_caps(stage.gl)) >> encoding & 1)) return;
    draw_visibility(technique, encoding, 4, &shot);
    gn_mask_compare(&truth.mask, shot.data, shot.channels, &score);
    printf("%-6s %-6s acne %.4f %%, leak %.4f %%, gap %.3f %%, wrong %.3f %%; dark %lu of %lu\n",
           gn_techniques[technique].name, gn_encodings[encoding].name, gn_mask_acne(&score),
           gn_mask_leak(&score), gn_mask_gap(&score), gn_mask_wrong(&score),
           (unsigned long)score.away_dark, (unsigned long)(score.away_dark + score.away_lit));
    const bool good = gn_mask_acne(&score) <= .02 && gn_mask_leak(&score) <= .02 &&
                      (technique != GN_TECHNIQUE_HARD || gn_mask_gap(&score) <= 5);
    if (!good) gn_mask_save(NULL, gn_techniques[technique].name, &truth.mask, &shot);
    assert_true(good);
    assert_true(score.away_dark > 800 && score.away_lit > 20000);
    gn_picture_finish(&shot);
}

static void test_from_5_to_400_m_it_is_true(void **state) {
    (void)state;
    expect_true(GN_TECHNIQUE_HARD, GN_ENCODING_R16F);
    expect_true(GN_TECHNIQUE_HARD, GN_ENCODING_DEPTH);
    expect_true(GN_TECHNIQUE_PCF, GN_ENCODING_DEPTH);
    expect_true(GN_TECHNIQUE_PCF3, GN_ENCODING_R32UI);
    expect_true(GN_TECHNIQUE_PCSS, GN_ENCODING_R16F);
    for (int t = GN_TECHNIQUE_VSM; t <= GN_TECHNIQUE_SMSM; t++)
        expect_true((enum gn_technique)t, GN_ENCODING_R32UI);
}

static double wrong_with(enum gn_technique technique, uint32_t cascades) {
    struct gn_picture shot;
    struct gn_mask_score score;
    draw_visibility(technique, GN_ENCODING_R32UI, cascades, &shot);
    gn_mask_compare(&truth.mask, shot.data, shot.channels, &score);
    gn_picture_finish(&shot);
    return gn_mask_wrong(&score);
}

/* Of all pixels, edges as well. */
static void test_the_more_the_truer(void **state) {
    (void)state;
    for (int t = gn_shot_full() ? GN_TECHNIQUE_HARD : GN_TECHNIQUE_MSM; t <= GN_TECHNIQUE_SMSM;
         t++) {
        double wrong[GN_CASCADES_MAX];
        printf("%-7s wrong:", gn_techniques[t].name);
        for (uint32_t i = 0; i < GN_CASCADES_MAX; i++) {
            wrong[i] = wrong_with((enum gn_technique)t, i + 1);
            printf(" %.3f %%", wrong[i]);
        }
        printf("\n");
        assert_true(wrong[1] < wrong[0] && wrong[2] < 0.65 * wrong[0] && wrong[3] < wrong[0] / 2);
    }
}

/* ---- at the splits ---- */

/* From row to row of the ground within 1.5 zones of a split, where truth is the same in both rows:
 * the largest step of a row's mean over what is away from edges, and of a pixel. */
static void test_no_split_is_seen(void **state) {
    (void)state;
    static const enum gn_technique techniques[] = {
        GN_TECHNIQUE_PCF,  GN_TECHNIQUE_PCF5, GN_TECHNIQUE_POISSON,
        GN_TECHNIQUE_PCSS, GN_TECHNIQUE_VSM,  GN_TECHNIQUE_EVSM,
        GN_TECHNIQUE_MSM,  GN_TECHNIQUE_VSSM, GN_TECHNIQUE_SMSM,
    };
    for (size_t t = 0; t < sizeof techniques / sizeof *techniques; t++) {
        struct gn_picture shot;
        long all_away = 0;
        const struct gn_shadow_view *view =
            draw_visibility(techniques[t], GN_ENCODING_DEPTH, 4, &shot);
        for (uint32_t split = 0; split + 1 < view->map.cascade_count; split++) {
            const double end = (double)view->cascades[split].end_m,
                         begin = (double)view->cascades[split + 1].begin_m;
            const double zone = end - begin;
            double worst = 0, near_edges = 0;
            long away = 0, edges = 0;
            for (int i = WIDTH_PX; i < PIXELS; i++) {
                if (truth.mask.item[i] < 0) continue;
                const double depth = depth_at(i);
                if (depth < begin - 0.5 * zone || depth > end + 0.5 * zone) continue;
                const double off = fabs((double)shot.data[i] - (double)truth.mask.lit[i]);
                if (edge_px[i] > band_px[i]) {
                    worst = fmax(worst, off);
                    away++;
                } else {
                    near_edges += off;
                    edges++;
                }
            }
            printf("%-7s split at %6.2f m: %5ld pixels away from edges, the worst off by %.3f; "
                   "%5ld near edges, off by %.3f on average\n",
                   gn_techniques[techniques[t]].name, end, away, worst, edges,
                   edges ? near_edges / (double)edges : 0.0);
            assert_true(away + edges > 500);
            all_away += away;
            assert_true(worst <= 0.1);
        }
        assert_true(all_away > 4000);
        gn_picture_finish(&shot);
    }
}

/* ---- a moving eye ---- */

enum { SMALL_PX = 256, ATLAS_PX = 2 * SMALL_PX, EYES = 24 };
static struct shot {
    struct gn_shadow_view view;
    float *codes;
} shots[EYES];

/* Longer and longer steps, for larger and larger texels. */
static struct gn_orbit orbit_at(int eye) {
    struct gn_orbit orbit = {.zoom = 0.0f};
    orbit.shift_m[0] = (eye % 3 ? 0.15f : -0.2f) * powf(1.22f, (float)eye);
    orbit.shift_m[2] = -0.2f * powf(1.25f, (float)eye);
    return orbit;
}

static void draw_maps(enum gn_encoding encoding, int eye) {
    const struct gn_frame_opts opts = {
        .output.width_px = 160,
        .output.height_px = 90,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = GN_TECHNIQUE_PCF,
                       .map_px = SMALL_PX,
                       .map_format = GN_MAP_FORMAT(encoding, GN_MOMENTS_NONE)},
        .view.orbit = orbit_at(eye)};
    struct gn_err err = {0};
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    shots[eye].view = plan->shadows[0];
    assert_int_equal(shots[eye].view.map.cascade_count, 4);
    if (!gn_gl_read_map(stage.gl, 0, shots[eye].codes, &err)) fail_msg("%s", err.text);
}

/* Of the inner part of tile i; NAN outside what is drawn. */
static float code_at(const struct shot *shot, uint32_t i, int x, int y) {
    const struct gn_shadow_cascade *c = &shot->view.cascades[i];
    const int at[2] = {x, y};
    for (int k = 0; k < 2; k++) {
        const int drawn = at[k] - (int)c->drawn.px[k];
        if (drawn < 0 || drawn >= (int)c->drawn.size_px[k]) return NAN;
    }
    const uint32_t u = shot->view.raster.tiles[i].x_px + shot->view.map.gutter_px + (uint32_t)x,
                   v = shot->view.raster.tiles[i].y_px + shot->view.map.gutter_px + (uint32_t)y;
    return shot->codes[v * ATLAS_PX + u];
}

struct agreement {
    long compared, covered, different, pairs, moved;
};

static void compare(const struct shot *a, const struct shot *b, uint32_t i, struct agreement *sum) {
    const struct gn_shadow_cascade *before = &a->view.cascades[i], *after = &b->view.cascades[i];
    if (a->view.raster.tiles[i].empty || b->view.raster.tiles[i].empty ||
        before->texel != after->texel)
        return;
    int shift[2];
    for (int k = 0; k < 2; k++)
        shift[k] = (int)(after->drawn.corner_texels[k] - before->drawn.corner_texels[k]);
    sum->pairs++;
    sum->moved += shift[0] || shift[1];
    for (int y = 0; y < (int)b->view.map.inner_px; y++)
        for (int x = 0; x < (int)b->view.map.inner_px; x++) {
            const float old = code_at(a, i, x + shift[0], y + shift[1]), new = code_at(b, i, x, y);
            if (isnan(old) || isnan(new)) continue;
            sum->compared++;
            sum->covered += new < b->view.code.far_end;
            sum->different += memcmp(&old, &new, sizeof new) != 0;
        }
}

/* Wherever nothing is drawn: nothing of an earlier eye is left in the gutters, nor in the fourth
 * tile of three cascades. */
static void expect_cleared(const struct shot *shot) {
    const struct gn_shadow_view *view = &shot->view;
    const int gutter = (int)view->map.gutter_px;
    for (uint32_t v = 0; v < view->map.height_px; v++)
        for (uint32_t u = 0; u < view->map.width_px; u++) {
            const uint32_t i = v / SMALL_PX * 2 + u / SMALL_PX;
            const int x = (int)(u % SMALL_PX) - gutter, y = (int)(v % SMALL_PX) - gutter;
            const bool empty = i >= view->map.cascade_count || view->raster.tiles[i].empty;
            if (empty || isnan(code_at(shot, i, x, y)))
                assert_true(shot->codes[v * ATLAS_PX + u] >= view->code.far_end);
        }
}

static void expect_same_maps(enum gn_encoding encoding) {
    struct agreement sums[GN_CASCADES_MAX] = {0};
    if (!(gn_caps_encodings(gn_gl_caps(stage.gl)) >> encoding & 1)) skip();
    for (int eye = 0; eye < EYES; eye++) {
        shots[eye].codes = gn_xalloc((size_t)ATLAS_PX * ATLAS_PX, sizeof(float));
        draw_maps(encoding, eye);
        expect_cleared(&shots[eye]);
        for (uint32_t i = 0; i < GN_CASCADES_MAX; i++)
            for (int old = 0; old < eye; old++) compare(&shots[old], &shots[eye], i, &sums[i]);
    }
    long moved = 0;
    for (int eye = 0; eye < EYES; eye++) free(shots[eye].codes);
    for (uint32_t i = 0; i < GN_CASCADES_MAX; i++) {
        const struct agreement *sum = &sums[i];
        printf("%-6s cascade %u: %ld pairs of eyes, %ld moved: of %ld texels, %ld of them "
               "covered, %ld not bit-equal\n",
               gn_encodings[encoding].name, i + 1, sum->pairs, sum->moved, sum->compared,
               sum->covered, sum->different);
        assert_int_equal(sum->different, 0);
        assert_true(sum->pairs > EYES && sum->covered > 1000);
        assert_true(i > 1 || sum->moved > 5);
        moved += sum->moved;
    }
    assert_true(moved > EYES);
}

static void test_r16f_maps_move_by_whole_texels(void **state) {
    (void)state;
    expect_same_maps(GN_ENCODING_R16F);
}

static void test_depth_maps_move_by_whole_texels(void **state) {
    (void)state;
    expect_same_maps(GN_ENCODING_DEPTH);
}

/* Filters read across: the map is as large with three cascades as with four. */
static void test_beside_a_tile_all_is_clear(void **state) {
    (void)state;
    for (uint32_t cascades = 4; cascades >= 2; cascades--) {
        const struct gn_frame_opts opts = {
            .output.width_px = 160,
            .output.height_px = 90,
            .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                    GN_LIGHT_GIVEN(map_format),
                           .technique = GN_TECHNIQUE_PCSS,
                           .map_px = SMALL_PX,
                           .map_format = GN_MAP_FORMAT(GN_ENCODING_R32UI, GN_MOMENTS_NONE)},
            .shadow.cascades = cascades};
        struct gn_err err = {0};
        struct shot shot = {.view = help_stage_draw(&stage, &opts, NULL)->shadows[0]};
        assert_int_equal(shot.view.map.cascade_count, cascades);
        shot.codes = gn_xalloc((size_t)ATLAS_PX * ATLAS_PX, sizeof(float));
        if (!gn_gl_read_map(stage.gl, 0, shot.codes, &err)) fail_msg("%s", err.text);
        expect_cleared(&shot);
        free(shot.codes);
    }
}

/* How far is read goes with the widest penumbra that can be seen, and so with the eye, and so do
 * gutters; targets do not. */
static void test_a_moving_eye_makes_nothing(void **state) {
    (void)state;
    static const enum gn_technique techniques[] = {GN_TECHNIQUE_PCSS, GN_TECHNIQUE_VSSM};
    float *radius = &stage.scene->lights[0].radius;
    const float before = *radius;
    *radius = 0.01f;
    for (size_t t = 0; t < sizeof techniques / sizeof *techniques; t++) {
        float least_px = INFINITY, most_px = 0.0f;
        uint64_t objects = 0;
        for (int eye = 0; eye < EYES; eye++) {
            const struct gn_frame_opts opts = {
                .output.width_px = 160,
                .output.height_px = 90,
                .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                               .technique = techniques[t],
                               .map_px = SMALL_PX},
                .view.orbit = orbit_at(eye)};
            const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
            assert_int_equal(plan->shadows[0].map.cascade_count, 4);
            least_px = fminf(least_px, plan->shadows[0].lookup.reach_px);
            most_px = fmaxf(most_px, plan->shadows[0].lookup.reach_px);
            const uint64_t now = gn_gl_stats(stage.gl).objects_created;
            if (eye > 0) assert_int_equal(now, objects);
            objects = now;
        }
        printf("%s reads %g to %g texels\n", gn_techniques[techniques[t]].name, (double)least_px,
               (double)most_px);
        assert_true(least_px < most_px);
    }
    *radius = before;
}

#define EACH(test)                                                                                 \
    cmocka_unit_test_setup_teardown(test, open_egl, close_all),                                    \
        cmocka_unit_test_setup_teardown(test, open_osmesa, close_all)

int main(void) {
    const struct CMUnitTest tests[] = {
        EACH(test_from_5_to_400_m_it_is_true),
        cmocka_unit_test_setup_teardown(test_the_more_the_truer, open_egl, close_all),
        EACH(test_no_split_is_seen),
        EACH(test_r16f_maps_move_by_whole_texels),
        EACH(test_depth_maps_move_by_whole_texels),
        cmocka_unit_test_setup_teardown(test_beside_a_tile_all_is_clear, open_egl, close_all),
        cmocka_unit_test_setup_teardown(test_a_moving_eye_makes_nothing, open_egl, close_all),
    };
    return RUN(tests);
}
