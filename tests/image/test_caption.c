/* Captions: each pixel is what the run says, by blending worked out in double precision, and the
 * rest of the picture is as it was. */
#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "caption/captions.h"
#include "core/arena.h"
#include "frame/frame.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH = 640, HEIGHT = 360, PIXELS = WIDTH * HEIGHT };
#define MS INT64_C(1000000)

static struct help_stage stage;
static struct gn_frame_opts opts;
static struct gn_captions *captions;
static struct gn_err err;
static struct gn_light many_lights[GN_LIGHTS_MAX + 2];
static uint8_t bare[PIXELS][4], shown[PIXELS][4], other[PIXELS][4];

static void open_with(const char *backend, const char *without) {
    help_stage_open(&stage, gn_stage_scene_make, backend, without, NULL);
    glm_vec3_copy((vec3){1, 1, 1}, stage.scene->environment.background); /* the worst for white */
}

HELP_OPENS(open_egl, "egl", NULL)
HELP_OPENS(open_osmesa, "osmesa", NULL)
HELP_OPENS(open_egl_without_srgb, "egl", "srgb")
HELP_OPENS(open_osmesa_without_srgb, "osmesa", "srgb")

static int close_all(void **state) {
    (void)state;
    help_stage_close(&stage);
    return 0;
}

/* The packaged font, where there is one. */
static int setup(void **state) {
    (void)state;
    help_stage_light(&stage, NULL, 3);
    opts = (struct gn_frame_opts){.output.width_px = WIDTH,
                                  .output.height_px = HEIGHT,
                                  .shadow.any = {.given = GN_LIGHT_GIVEN(map_px), .map_px = 120}};
    captions = gn_captions_create(&(struct gn_captions_opts){0});
    gn_captions_set(captions, GN_CAPTION_INFO, "gnomon 0.1.0\nFrames: 59.9 a second", 0);
    gn_captions_set(captions, GN_CAPTION_MODE, "Soft \xc3\xa4\xe4\xb8\x80", 0);
    gn_captions_set(captions, GN_CAPTION_TEXT,
                    "kiosk.ini:14: shadow = pfc: no such technique; did you mean pcf? It goes on "
                    "with what was there before",
                    0);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    gn_captions_destroy(captions);
    return 0;
}

static const struct gn_plan *draw(const struct gn_caption_run *run, uint8_t picture[PIXELS][4]) {
    opts.cover.captions = run;
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    if (picture && !gn_gl_read_rgba8(stage.gl, &picture[0][0], &err)) fail_msg("%s", err.text);
    return plan;
}

static const struct gn_caption_run *run_at(int64_t now_ns) {
    const struct gn_caption_run *run = gn_captions_run(captions, WIDTH, HEIGHT, now_ns);
    assert_non_null(run);
    return run;
}

/* ---- the oracle ---- */

static bool encodes(void) { return gn_gl_caps(stage.gl)->has & 1u << GN_CAP_SRGB; }

static double linear_from_srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static double srgb_from_linear(double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

/* How much of the light that was there is left, and of white is added, by all quads at each pixel,
 * in full; and how strong that is. */
static struct { double left, added, strength; } light[PIXELS];

static void blend(const struct gn_caption_run *run) {
    const double shade = linear_from_srgb(0.3);
    for (int i = 0; i < PIXELS; i++) light[i].left = 1, light[i].added = light[i].strength = 0;
    for (uint32_t i = 0; i < run->quad_count; i++) {
        const struct gn_caption_quad *q = &run->quads[i];
        for (int y = 0; y < q->height; y++)
            for (int x = 0; x < q->width; x++) {
                const size_t at = (size_t)(q->y + y) * WIDTH + (size_t)(q->x + x);
                const uint8_t *row =
                    run->atlas->coverage + (q->atlas_y + (size_t)y) * run->atlas->width_px;
                const double covered = q->ground ? 0 : row[q->atlas_x + x] / 255.0;
                const double left = q->ground ? shade : 1 - covered;
                light[at].left *= left;
                light[at].added = light[at].added * left + covered;
                light[at].strength =
                    run->alpha[q->caption] * (q->ground ? 1 - q->faint / 255.0 : 1);
            }
    }
}

/* light_is_stored: the target holds light, or encodes what it holds. */
static double expected(size_t at, double before, bool linear, bool light_is_stored) {
    const double strength = light[at].strength;
    if (strength <= 0) return before;
    const double was = linear ? before : linear_from_srgb(before);
    const double full = was * light[at].left + light[at].added;
    if (linear) return was + strength * (full - was);
    if (light_is_stored) return srgb_from_linear(was + strength * (full - was));
    return before + strength * (srgb_from_linear(full) - before);
}

static void expect_blended(const struct gn_caption_run *run, bool linear, int tolerance) {
    blend(run);
    for (size_t i = 0; i < PIXELS; i++)
        for (int k = 0; k < 3; k++) {
            const double wanted =
                255 * expected(i, bare[i][k] / 255.0, linear, encodes() && !opts.output.unencoded);
            const double apart = fabs(shown[i][k] - wanted);
            if (apart > (light[i].strength > 0 ? tolerance + 0.5 : 0))
                fail_msg("at %zu, %zu: %d over %d, not %.1f", i % WIDTH, i / WIDTH, shown[i][k],
                         bare[i][k], wanted);
        }
}

/* ---- what is drawn ---- */

/* Bytes that are blended as they are stored: right on black and white, and near it between. */
static int tolerance(void) { return encodes() && !opts.output.unencoded ? 2 : 8; }

static void test_pixels_are_what_the_run_says(void **state) {
    (void)state;
    for (int unencoded = 0; unencoded < 2; unencoded++) {
        opts.output.unencoded = unencoded;
        draw(NULL, bare);
        draw(run_at(0), shown);
        expect_blended(run_at(0), false, tolerance());
    }
}

static void test_it_is_white_on_dark(void **state) {
    (void)state;
    unsigned white = 0, dark = 0;
    draw(NULL, bare);
    draw(run_at(0), shown);
    blend(run_at(0));
    for (size_t i = 0; i < PIXELS; i++) {
        if (light[i].strength <= 0) continue;
        const double added = light[i].added;
        if (added > 0.9999) {
            assert_true(shown[i][0] == 255 && shown[i][1] == 255 && shown[i][2] == 255);
            white++;
        } else if (added == 0 && light[i].strength >= 1) { /* corners are round */
            const double luminance = linear_from_srgb(shown[i][1] / 255.0);
            assert_true(1.05 / (luminance + 0.05) >= 7); /* WCAG 2.1, 1.4.6 */
            dark++;
        }
    }
    assert_true(white > 400 && dark > 4000);
}

static void test_linear_bytes(void **state) {
    (void)state;
    opts.output.linear = true;
    draw(NULL, bare);
    draw(run_at(0), shown);
    expect_blended(run_at(0), true, 2);
}

static void test_floats(void **state) {
    (void)state;
    static float before[PIXELS][4], after[PIXELS][4];
    opts.output.floats = true;
    if (draw(NULL, NULL)->output != GN_OUTPUT_FLOAT) skip();
    if (!gn_gl_read_f32(stage.gl, &before[0][0], &err)) fail_msg("%s", err.text);
    draw(run_at(0), NULL);
    if (!gn_gl_read_f32(stage.gl, &after[0][0], &err)) fail_msg("%s", err.text);
    blend(run_at(0));
    for (size_t i = 0; i < PIXELS; i++)
        for (int k = 0; k < 3; k++) {
            const double wanted = expected(i, before[i][k], true, true);
            assert_true(fabs(after[i][k] - wanted) <= (light[i].strength > 0 ? 2e-3 : 0));
        }
}

static void test_antialiased(void **state) {
    (void)state;
    opts.output.msaa = 4;
    draw(NULL, bare);
    draw(run_at(0), shown);
    expect_blended(run_at(0), false, tolerance() + 1);
}

static void test_a_fade_is_between(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_TEXT, NULL, 0);
    gn_captions_set(captions, GN_CAPTION_INFO, NULL, 0);
    draw(NULL, bare);
    draw(run_at(0), other);
    draw(run_at(1800 * MS), shown);
    expect_blended(run_at(1800 * MS), false, tolerance());
    unsigned changed = 0;
    for (size_t i = 0; i < PIXELS; i++)
        for (int k = 0; k < 3; k++) {
            const int a = bare[i][k], b = other[i][k], c = shown[i][k];
            assert_true(c >= (a < b ? a : b) - 1 && c <= (a > b ? a : b) + 1);
            changed += a != b && c != a && c != b;
        }
    assert_true(changed > 1000);
}

static void test_what_is_gone_leaves_every_byte(void **state) {
    (void)state;
    struct gn_caption_run unseen = *run_at(0);
    memset(unseen.alpha, 0, sizeof unseen.alpha);
    draw(NULL, bare);
    const uint32_t passes = draw(NULL, bare)->pass_count;
    assert_int_equal(draw(&unseen, shown)->pass_count, passes);
    assert_memory_equal(bare, shown, sizeof bare);
    unseen.width_px++; /* of a picture that is of another size by now */
    unseen.alpha[GN_CAPTION_TEXT] = 1;
    assert_int_equal(draw(&unseen, shown)->pass_count, passes);
    assert_memory_equal(bare, shown, sizeof bare);
}

static void test_aovs_have_none(void **state) {
    (void)state;
    static float before[PIXELS][4], after[PIXELS][4];
    for (int aov = GN_AOV_VISIBILITY; aov < GN_AOV_COUNT; aov++) {
        opts.debug.aov = aov;
        draw(NULL, NULL);
        if (!gn_gl_read_f32(stage.gl, &before[0][0], &err)) fail_msg("%s", err.text);
        assert_null(draw(run_at(0), NULL)->atlas);
        if (!gn_gl_read_f32(stage.gl, &after[0][0], &err)) fail_msg("%s", err.text);
        assert_memory_equal(before, after, sizeof before);
    }
}

/* With so many that light is added in halves and a pass encodes them where no target does. */
static void test_over_many_lights(void **state) {
    (void)state;
    for (uint32_t i = 0; i < GN_LIGHTS_MAX + 2; i++) {
        many_lights[i] = stage.lights[0];
        many_lights[i].technique = "none";
        many_lights[i].color[0] *= 3.0f; /* what is over white must not shine through */
    }
    help_stage_light(&stage, many_lights, GN_LIGHTS_MAX + 2);
    for (uint32_t msaa = 0; msaa <= 4; msaa += 4) {
        opts.output.msaa = msaa;
        const struct gn_plan *plan = draw(NULL, bare);
        assert_true(encodes() || plan->output == GN_OUTPUT_FLOAT);
        plan = draw(run_at(0), shown);
        const struct gn_pass *last = &plan->passes[plan->pass_count - 1];
        assert_true(last->picture.reads_atlas);
        assert_int_equal(last->target.kind, encodes() ? GN_TARGET_OUTPUT : GN_TARGET_ENCODED);
        expect_blended(run_at(0), false, tolerance() + 1);
    }
}

/* Where a pixel of the upright picture stands in the turned one. */
static size_t place(unsigned turn_deg, size_t x, size_t y) {
    switch (turn_deg) {
    case 90: return x * HEIGHT + (HEIGHT - 1 - y);
    case 180: return (HEIGHT - 1 - y) * WIDTH + (WIDTH - 1 - x);
    default: return (WIDTH - 1 - x) * HEIGHT + y;
    }
}

/* Over a picture that is the same everywhere, byte by byte. */
static void test_turned(void **state) {
    (void)state;
    opts.view.camera = 1; /* looks away */
    draw(run_at(0), shown);
    for (unsigned deg = 90; deg < 360; deg += 90) {
        opts.output.turn_deg = deg;
        opts.output.width_px = deg % 180 ? HEIGHT : WIDTH;
        opts.output.height_px = deg % 180 ? WIDTH : HEIGHT;
        draw(run_at(0), other);
        for (size_t y = 0; y < HEIGHT; y++)
            for (size_t x = 0; x < WIDTH; x++)
                if (memcmp(shown[y * WIDTH + x], other[place(deg, x, y)], 4) != 0)
                    fail_msg("turned by %u: %zu, %zu", deg, x, y);
    }
}

/* Against burn-in: with the scene, byte by byte, and never out of the picture. */
static void test_shifted(void **state) {
    (void)state;
    const struct gn_caption_run *run = run_at(0);
    int left_px = WIDTH, above_px = HEIGHT;
    for (uint32_t i = 0; i < run->quad_count; i++) {
        if (run->quads[i].x < left_px) left_px = run->quads[i].x;
        if (run->quads[i].y < above_px) above_px = run->quads[i].y;
    }
    const int by[][2] = {{5, 3}, {-4, -2}, {-WIDTH, HEIGHT}};
    opts.view.camera = 1; /* looks away */
    draw(run, shown);
    for (int i = 0; i < 3; i++) {
        const int right_px = by[i][0] > -left_px ? by[i][0] : -left_px,
                  up_px = by[i][1] < above_px ? by[i][1] : above_px;
        memcpy(opts.view.shift_px, by[i], sizeof by[i]);
        draw(run, other);
        for (int y = above_px; y < HEIGHT - 2; y++)
            for (int x = left_px; x < WIDTH - 5; x++)
                if (memcmp(shown[y * WIDTH + x], other[(y - up_px) * WIDTH + x + right_px], 4) != 0)
                    fail_msg("shifted by %d, %d: %d, %d", by[i][0], by[i][1], x, y);
    }
}

/* With that share of its light, of what was drawn of each target. */
static void expect_dimmed(float left, const uint8_t before[PIXELS][4]) {
    const bool stores_light = encodes() && !opts.output.unencoded;
    for (size_t i = 0; i < PIXELS; i++)
        for (int k = 0; k < 3; k++) {
            const double was = before[i][k] / 255.0;
            const double wanted = stores_light ? srgb_from_linear(linear_from_srgb(was) * left)
                                               : was * srgb_from_linear(left);
            if (fabs(shown[i][k] - 255 * wanted) > 2.5)
                fail_msg("%g at %zu, %zu: %d, not %.1f of %d", left, i % WIDTH, i / WIDTH,
                         shown[i][k], 255 * wanted, before[i][k]);
        }
}

static void test_a_dimmed_picture_has_less_light(void **state) {
    (void)state;
    static const float shares[] = {0.9f, 0.3f, 0.02f};
    for (int unencoded = 0; unencoded < 2; unencoded++) {
        opts.output.unencoded = unencoded;
        draw(NULL, bare);
        draw(run_at(0), other);
        for (int i = 0; i < 3; i++) {
            opts.cover.dimmed = 1.0f - shares[i];
            draw(NULL, shown);
            expect_dimmed(shares[i], bare);
            draw(run_at(0), shown);
            expect_dimmed(shares[i], other);
        }
        opts.cover.dimmed = 0.0f;
        draw(NULL, shown);
        assert_memory_equal(shown, bare, sizeof bare);
    }
}

static void test_the_pass_says_where_it_draws(void **state) {
    (void)state;
    opts.view.shift_px[0] = 7, opts.view.shift_px[1] = -9;
    draw(NULL, bare);
    const struct gn_plan *plan = draw(run_at(0), shown);
    const struct gn_rect *r = &plan->passes[plan->pass_count - 1].rect;
    assert_true(r->width > 0);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const uint32_t row = HEIGHT - 1 - y;
            if (x < r->x || x >= r->x + r->width || row < r->y || row >= r->y + r->height)
                assert_memory_equal(bare[y * WIDTH + x], shown[y * WIDTH + x], 4);
        }
}

/* ---- work ---- */

static void test_frames_make_nothing(void **state) {
    (void)state;
    gn_captions_set(captions, GN_CAPTION_MODE, "Soft", 0);
    for (int64_t ms = 0; ms < 48; ms += 16) draw(run_at(ms * MS), NULL);
    const uint64_t objects = gn_gl_stats(stage.gl).objects_created;
    const uint32_t calls = gn_gl_stats(stage.gl).gl_calls;
    const unsigned long allocations = gn_alloc_count();
    for (int64_t ms = 48; ms < 480; ms += 16) draw(run_at(ms * MS), NULL);
    assert_int_equal(gn_gl_stats(stage.gl).objects_created, objects);
    assert_int_equal(gn_gl_stats(stage.gl).gl_calls, calls);
    assert_int_equal(gn_alloc_count(), allocations);
}

static bool count_pieces(void *user, uint64_t pieces, int64_t run_ns, struct gn_err *why) {
    (void)run_ns;
    (void)why;
    *(uint64_t *)user = pieces;
    return true;
}

/* Its rectangles cover the picture together, and not each of them. */
static void test_a_text_is_no_long_frame(void **state) {
    (void)state;
    uint64_t pieces = 0;
    gn_gl_set_pause(stage.gl, count_pieces, &pieces);
    draw(NULL, NULL);
    const uint64_t before = pieces;
    draw(NULL, NULL);
    const uint64_t bare_pieces = pieces - before;
    const struct gn_caption_run *run = run_at(0);
    assert_true(run->quad_count > 100);
    draw(run, NULL);
    gn_gl_set_pause(stage.gl, NULL, NULL);
    assert_in_range(pieces - before - bare_pieces, 0, bare_pieces + 1);
}

static void test_a_sample_makes_all_that_a_text_needs(void **state) {
    (void)state;
    const struct gn_caption_run *sample =
        gn_captions_sample(captions, opts.output.width_px, opts.output.height_px);
    const struct gn_plan *plan = draw(sample, NULL);
    const struct gn_program_key key = plan->programs[plan->program_count - 1];
    assert_int_equal(key.kind, GN_PROGRAM_CAPTION);
    const struct gn_plan *text = draw(run_at(0), NULL);
    assert_memory_equal(&text->programs[text->program_count - 1], &key, sizeof key);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, setup, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(test_pixels_are_what_the_run_says),
        TEST(test_it_is_white_on_dark),
        TEST(test_linear_bytes),
        TEST(test_floats),
        TEST(test_antialiased),
        TEST(test_a_fade_is_between),
        TEST(test_what_is_gone_leaves_every_byte),
        TEST(test_aovs_have_none),
        TEST(test_over_many_lights),
        TEST(test_turned),
        TEST(test_shifted),
        TEST(test_a_dimmed_picture_has_less_light),
        TEST(test_the_pass_says_where_it_draws),
        TEST(test_frames_make_nothing),
        TEST(test_a_text_is_no_long_frame),
        TEST(test_a_sample_makes_all_that_a_text_needs),
    };
    int failed = cmocka_run_group_tests_name("egl", tests, open_egl, close_all);
    failed += cmocka_run_group_tests_name("osmesa", tests, open_osmesa, close_all);
    failed +=
        cmocka_run_group_tests_name("egl without srgb", tests, open_egl_without_srgb, close_all);
    failed += cmocka_run_group_tests_name("osmesa without srgb", tests, open_osmesa_without_srgb,
                                          close_all);
    return failed;
}
