/* A directional map under a moving eye: shifted back by whole texels, it is the same map, bit for
 * bit. And what it covers is what rays along the light's direction hit: it is where it should be.
 */
#include <cglm/cglm.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "frame/frame.h"
#include "plan/stage_scene.h"
#include "truth/raycast.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { MAP_PX = 256, PATHS = 5, STEPS = 16, EYES = PATHS * STEPS };

static struct help_stage stage;
static struct shot {
    struct gn_shadow_view view;
    float *codes;
} shots[EYES];

static void open_all(const char *backend) {
    help_stage_open(&stage, gn_stage_scene_make, backend, NULL, NULL);
    for (int i = 0; i < EYES; i++) shots[i].codes = gn_xalloc(MAP_PX * MAP_PX, sizeof(float));
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
    for (int i = 0; i < EYES; i++) free(shots[i].codes);
    help_stage_close(&stage);
    return 0;
}

/* Ways through the scene, as what is looked at moves: along either axis, both diagonals, and one
 * looking closely. */
static struct gn_orbit orbit_at(int path, int step) {
    const float along = -3.0f + 0.4f * (float)step;
    struct gn_orbit orbit = {.zoom = 0.9f};
    orbit.shift_m[0] = path == 1 ? 0.0f : along;
    orbit.shift_m[2] = path == 0 ? 0.0f : path == 3 ? -along : along;
    if (path < 4) return orbit;
    orbit.zoom = 1.6f;
    glm_vec3_scale(orbit.shift_m, 0.2f, orbit.shift_m);
    return orbit;
}

static void draw_map(enum gn_encoding encoding, const struct gn_orbit *orbit, struct shot *shot) {
    struct gn_frame_opts opts = {
        .output.width_px = 80,
        .output.height_px = 120,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px) |
                                GN_LIGHT_GIVEN(map_format),
                       .technique = GN_TECHNIQUE_HARD,
                       .map_px = MAP_PX,
                       .map_format = GN_MAP_FORMAT(encoding, GN_MOMENTS_NONE)},
        .shadow.cascades = 1,
        .view.orbit = *orbit};
    struct gn_err err = {0};
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    if (!gn_gl_read_map(stage.gl, 0, shot->codes, &err)) fail_msg("%s", err.text);
    shot->view = plan->shadows[0];
    assert_int_equal(shot->view.encoding, encoding);
    assert_false(shot->view.empty);
}

static bool is_drawn(const struct gn_shadow_view *view, int x, int y) {
    const int px[2] = {x, y};
    for (int k = 0; k < 2; k++) {
        const int at = px[k] - (int)view->raster.drawn.px[k];
        if (at < 0 || at >= (int)view->raster.drawn.size_px[k]) return false;
    }
    return true;
}

/* The corner that the view names is where it is looked up; what is not drawn is cleared, and the
 * map's edge is that. */
static void expect_window(const struct shot *shot) {
    const struct gn_shadow_view *view = &shot->view;
    for (int k = 0; k < 2; k++) {
        assert_true(fabs(view->raster.drawn.corner_texels[k] +
                         (double)view->lookup.map_from_world[3][k] * MAP_PX) < 0.02);
        assert_true(view->raster.drawn.px[k] >= 1);
        assert_true(view->raster.drawn.px[k] + view->raster.drawn.size_px[k] < MAP_PX);
    }
    for (int y = 0; y < MAP_PX; y++)
        for (int x = 0; x < MAP_PX; x++)
            if (!is_drawn(view, x, y))
                assert_true(shot->codes[y * MAP_PX + x] >= view->code.far_end);
}

struct agreement {
    long compared, covered, different; /* texels of both maps; that hold something; not bit-equal */
    int pairs, moved[2], diagonal; /* of eyes with one size of texel; shifted along x, y, both */
};

static void compare(const struct shot *a, const struct shot *b, struct agreement *sum) {
    int shift[2];
    for (int k = 0; k < 2; k++)
        shift[k] =
            (int)(b->view.raster.drawn.corner_texels[k] - a->view.raster.drawn.corner_texels[k]);
    if (a->view.lookup.texel != b->view.lookup.texel) return;
    sum->pairs++;
    for (int k = 0; k < 2; k++) sum->moved[k] += shift[k] != 0;
    sum->diagonal += shift[0] && shift[1];
    for (int y = 0; y < MAP_PX; y++)
        for (int x = 0; x < MAP_PX; x++) {
            const int u = x + shift[0], v = y + shift[1];
            if (!is_drawn(&b->view, x, y) || !is_drawn(&a->view, u, v)) continue;
            const float *before = &a->codes[v * MAP_PX + u], *after = &b->codes[y * MAP_PX + x];
            sum->compared++;
            sum->covered += *before < a->view.code.far_end;
            sum->different += memcmp(before, after, sizeof *before) != 0;
        }
}

/* How the windows lay in the lattice's pages. */
struct lay {
    int paged, straight, wraps[2], four; /* in pages; in one; across an edge along x, y; of four */
    int before[2], after[2];             /* the corner below 0, above */
};

static void add_lay(const struct gn_shadow_view *view, struct lay *lay) {
    const struct gn_shadow_page *first = &view->raster.drawn.pages[0],
                                *last =
                                    &view->raster.drawn.pages[view->raster.drawn.page_count - 1];
    *(view->raster.drawn.paged ? &lay->paged : &lay->straight) += 1;
    lay->four += view->raster.drawn.page_count == 4;
    for (int k = 0; k < 2; k++) {
        lay->wraps[k] += first->corner[k] != last->corner[k];
        *(view->raster.drawn.corner_texels[k] < 0 ? &lay->before[k] : &lay->after[k]) += 1;
    }
}

static void expect_same_map(enum gn_encoding encoding) {
    struct agreement sum = {0};
    struct lay lay = {0};
    if (!(gn_caps_encodings(gn_gl_caps(stage.gl)) >> encoding & 1)) skip();
    for (int i = 0; i < EYES; i++) {
        const struct gn_orbit orbit = orbit_at(i / STEPS, i % STEPS);
        draw_map(encoding, &orbit, &shots[i]);
        expect_window(&shots[i]);
        add_lay(&shots[i].view, &lay);
        int first = 0;
        while (shots[first].view.lookup.texel != shots[i].view.lookup.texel) first++;
        if (first < i) compare(&shots[first], &shots[i], &sum);
        if (first + 1 < i) compare(&shots[i - 1], &shots[i], &sum);
    }
    printf("%-8s %d pairs of eyes, %d diagonal: of %ld texels, %ld of them covered, %ld not "
           "bit-equal; %d maps of pages, %d of four, %d of one\n",
           gn_encodings[encoding].name, sum.pairs, sum.diagonal, sum.compared, sum.covered,
           sum.different, lay.paged, lay.four, lay.straight);
    assert_int_equal(sum.different, 0);
    assert_true(sum.pairs > EYES && sum.covered > 100000 && sum.compared > 2 * sum.covered);
    assert_true(sum.moved[0] > 20 && sum.moved[1] > 20 && sum.diagonal > 20);
    assert_true(lay.paged > 20 && lay.straight > 0 && lay.four > 5);
    for (int k = 0; k < 2; k++)
        assert_true(lay.wraps[k] > 5 && lay.before[k] > 5 && lay.after[k] > 5);
}

static void test_r16f(void **state) { (void)state, expect_same_map(GN_ENCODING_R16F); }
static void test_r16f_raw(void **state) { (void)state, expect_same_map(GN_ENCODING_R16F_RAW); }
static void test_depth(void **state) { (void)state, expect_same_map(GN_ENCODING_DEPTH); }
static void test_r32ui(void **state) { (void)state, expect_same_map(GN_ENCODING_R32UI); }
static void test_rgba8(void **state) { (void)state, expect_same_map(GN_ENCODING_RGBA8); }

/* ---- where it is ---- */

/* The ground, y = 0, as the light sees it in the middle of a texel; all casters stand on it. */
static struct gn_ray_surface ground_at(const struct gn_shadow_view *view, int x, int y) {
    const double at[2] = {
        (view->raster.drawn.corner_texels[0] + x + 0.5) * (double)view->lookup.texel,
        (view->raster.drawn.corner_texels[1] + y + 0.5) * (double)view->lookup.texel};
    const vec4 *m = view->raster.tiles[0].light_from_world; /* rigid: rows are the light's axes */
    struct gn_ray_surface surface = {.item = GN_RAY_NO_ITEM};
    double p[3];
    for (int c = 0; c < 3; c++) p[c] = at[0] * (double)m[c][0] + at[1] * (double)m[c][1];
    const double along = -p[1] / (double)m[1][2];
    for (int c = 0; c < 3; c++) {
        surface.point_ws[c] = p[c] + along * (double)m[c][2];
        surface.normal_ws[c] = c == 1;
    }
    return surface;
}

static void test_it_covers_what_rays_hit(void **state) {
    (void)state;
    struct gn_raycast rays;
    struct gn_ray_lamp sun;
    long asked = 0, dark = 0, wrong = 0;
    gn_raycast_init(&rays, stage.scene, &stage.pose, NULL);
    gn_ray_lamp_init(&sun, &stage.pose, 0);
    for (int i = 0; i < EYES; i += 3) {
        const struct gn_orbit orbit = orbit_at(i / STEPS, i % STEPS);
        draw_map(GN_ENCODING_DEPTH, &orbit, &shots[i]);
        const struct gn_shadow_view *view = &shots[i].view;
        for (int y = 0; y < MAP_PX; y++)
            for (int x = y % 2; x < MAP_PX; x += 2) {
                if (!is_drawn(view, x, y)) continue;
                const struct gn_ray_surface surface = ground_at(view, x, y);
                const bool lit = gn_raycast_visible(&rays, &sun, &surface);
                asked++;
                dark += !lit;
                wrong += lit != (shots[i].codes[y * MAP_PX + x] >= view->code.far_end);
            }
    }
    gn_raycast_finish(&rays);
    printf("%ld texels, of %ld rays hit something, %ld are wrong\n", asked, dark, wrong);
    assert_true(dark > 20000 && asked > 2 * dark);
    assert_true(wrong <= asked / 5000); /* on edges, by rounding */
}

/* ---- when it is drawn ---- */

/* Of a frame: draws to the map and to what it is filtered into. */
static uint32_t draws_of(struct gn_frame_opts *opts) {
    help_stage_draw(&stage, opts, NULL);
    return gn_gl_stats(stage.gl).shadow_draws;
}

static void test_a_still_scene_makes_no_map_and_no_cones(void **state) {
    (void)state;
    struct gn_frame_opts opts = {
        .output.width_px = 80,
        .output.height_px = 120,
        .shadow.any = {.given = GN_LIGHT_GIVEN(technique) | GN_LIGHT_GIVEN(map_px),
                       .technique = GN_TECHNIQUE_CONE,
                       .map_px = MAP_PX}};
    const uint32_t all = draws_of(&opts);
    assert_true(all > 4);
    assert_int_equal(draws_of(&opts), 0);
    opts.exposure_given = true;
    assert_int_equal(draws_of(&opts), 0);
    GN_LIGHT_SET(&opts.shadow.any, map_px, 2 * MAP_PX);
    assert_true(draws_of(&opts) > 4);
    assert_int_equal(draws_of(&opts), 0);
}

#define EACH(test)                                                                                 \
    cmocka_unit_test_setup_teardown(test, open_egl, close_all),                                    \
        cmocka_unit_test_setup_teardown(test, open_osmesa, close_all)

int main(void) {
    const struct CMUnitTest tests[] = {
        EACH(test_r16f),
        EACH(test_r16f_raw),
        EACH(test_depth),
        EACH(test_r32ui),
        EACH(test_rgba8),
        EACH(test_it_covers_what_rays_hit),
        EACH(test_a_still_scene_makes_no_map_and_no_cones),
    };
    return RUN(tests);
}
