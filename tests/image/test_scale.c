/* A scene that is drawn at a share of the picture's size: the picture is that smaller one, made
 * larger by a linear filter; captions are as sharp as over a scene of full size. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "caption/captions.h"
#include "frame/frame.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH = 320, HEIGHT = 180, PIXELS = WIDTH * HEIGHT, WINDOW_PX = 16 }; /* as OSMesa's */

static struct help_stage stage;
static struct gn_frame_opts opts;
static struct gn_captions *captions;
static struct gn_err err;
static struct gn_light many_lights[GN_LIGHTS_MAX + 2];
static uint8_t small[PIXELS][4], shown[PIXELS][4], other[PIXELS][4], again[PIXELS][4];

static void open_with(const char *backend, const char *without) {
    help_stage_open(&stage, gn_stage_scene_make, backend, without, NULL);
}

HELP_OPENS(open_egl, "egl", NULL)
HELP_OPENS(open_osmesa, "osmesa", NULL)
HELP_OPENS(open_egl_without_srgb, "egl", "srgb")

static int close_all(void **state) {
    (void)state;
    help_stage_close(&stage);
    return 0;
}

static int setup(void **state) {
    (void)state;
    help_stage_light(&stage, NULL, 3);
    opts = (struct gn_frame_opts){.output = {.width_px = WIDTH, .height_px = HEIGHT},
                                  .shadow.any = {.given = GN_LIGHT_GIVEN(map_px), .map_px = 120}};
    captions = gn_captions_create(&(struct gn_captions_opts){0});
    gn_captions_set(captions, GN_CAPTION_INFO, "gnomon\nFrames: 60", 0);
    gn_captions_set(captions, GN_CAPTION_MODE, "Soft", 0);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    gn_captions_destroy(captions);
    return 0;
}

static const struct gn_plan *draw(uint8_t picture[PIXELS][4]) {
    const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
    if (!gn_gl_read_rgba8(stage.gl, &picture[0][0], &err)) fail_msg("%s", err.text);
    return plan;
}

/* ---- the oracle ---- */

static double linear_of(int byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static int byte_of(double c) {
    return (int)lround(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055));
}

/* Between the four pixels around it. GL interpolates what is stored, or light: either is right, and
 * what lies between. */
static void expect_pixel(uint32_t w, uint32_t h, size_t x, size_t y, int channel) {
    const double u = fmin(fmax(((double)x + 0.5) * w / WIDTH - 0.5, 0), w - 1),
                 v = fmin(fmax(((double)y + 0.5) * h / HEIGHT - 0.5, 0), h - 1);
    double stored = 0, light = 0;
    for (int i = 0; i < 4; i++) {
        const double px = floor(u) + i % 2, py = floor(v) + i / 2;
        const double weight = fmax(1 - fabs(u - px), 0) * fmax(1 - fabs(v - py), 0);
        if (weight <= 0) continue;
        const int byte = small[(size_t)py * w + (size_t)px][channel];
        stored += weight * byte;
        light += weight * linear_of(byte);
    }
    const int a = (int)lround(stored), b = byte_of(light), got = shown[y * WIDTH + x][channel];
    if (got < (a < b ? a : b) - 2 || got > (a > b ? a : b) + 2)
        fail_msg("at %zu, %zu: %d, not %d to %d", x, y, got, a, b);
}

static void expect_larger(float scale) {
    const uint32_t w = gn_frame_scaled_px(WIDTH, scale), h = gn_frame_scaled_px(HEIGHT, scale);
    opts.output.scale = 0;
    opts.output.width_px = w, opts.output.height_px = h;
    draw(small);
    opts.output.width_px = WIDTH, opts.output.height_px = HEIGHT;
    draw(other);
    opts.output.scale = scale;
    const struct gn_plan *plan = draw(shown);
    assert_int_equal(plan->width_px, w);
    assert_int_equal(plan->height_px, h);
    assert_int_equal(plan->passes[plan->pass_count - 1].target.kind, GN_TARGET_SCALED);
    for (size_t i = 0; i < PIXELS; i++)
        for (int k = 0; k < 3; k++) expect_pixel(w, h, i % WIDTH, i / WIDTH, k);
    assert_memory_not_equal(shown, other, sizeof shown);
}

static void test_it_is_the_smaller_picture(void **state) {
    (void)state;
    for (uint32_t msaa = 0; msaa <= 4; msaa += 4)
        for (int unencoded = 0; unencoded < 2; unencoded++) {
            opts.output.msaa = msaa;
            opts.output.unencoded = unencoded;
            expect_larger(0.75f);
            expect_larger(0.5f);
        }
}

/* A last pass encodes what lights add up to, or maps its tone. */
static void want_a_last_pass(void) {
    for (uint32_t i = 0; i < GN_LIGHTS_MAX + 2; i++) {
        many_lights[i] = stage.lights[0];
        many_lights[i].technique = "none";
    }
    help_stage_light(&stage, many_lights, GN_LIGHTS_MAX + 2);
    opts.tone = GN_TONE_ACES;
}

static void test_with_a_last_pass(void **state) {
    (void)state;
    want_a_last_pass();
    expect_larger(0.75f);
}

/* ---- texts ---- */

/* Over a scene that has one colour the pictures are the same, byte by byte. */
static void test_captions_are_sharp(void **state) {
    (void)state;
    opts.view.camera = 1; /* looks away */
    for (unsigned deg = 0; deg < 360; deg += 90)
        for (uint32_t msaa = 0; msaa <= 4; msaa += 4) {
            opts.output = (struct gn_frame_output_opts){.width_px = deg % 180 ? HEIGHT : WIDTH,
                                                        .height_px = deg % 180 ? WIDTH : HEIGHT,
                                                        .turn_deg = deg,
                                                        .msaa = msaa};
            opts.cover.captions = gn_captions_run(captions, WIDTH, HEIGHT, 0);
            opts.view.shift_px[0] = 3, opts.view.shift_px[1] = -2;
            draw(other);
            opts.output.scale = 0.5f;
            draw(shown);
            assert_memory_equal(shown, other, sizeof shown);
        }
    assert_memory_not_equal(shown, shown + 1, sizeof shown - 4); /* it has captions */
}

static void test_dimmed(void **state) {
    (void)state;
    opts.view.camera = 1; /* looks away */
    opts.cover.dimmed = 0.5f;
    draw(other);
    opts.output.scale = 0.75f;
    draw(shown);
    assert_memory_equal(shown, other, sizeof shown);
}

/* ---- where it stands ---- */

/* Where a pixel of the upright picture stands in the turned one. */
static size_t place(unsigned turn_deg, size_t x, size_t y) {
    switch (turn_deg) {
    case 90: return x * HEIGHT + (HEIGHT - 1 - y);
    case 180: return (HEIGHT - 1 - y) * WIDTH + (WIDTH - 1 - x);
    default: return (WIDTH - 1 - x) * HEIGHT + y;
    }
}

static void test_turned(void **state) {
    (void)state;
    opts.output.scale = 0.5f;
    draw(shown);
    for (unsigned deg = 90; deg < 360; deg += 90) {
        opts.output.turn_deg = deg;
        opts.output.width_px = deg % 180 ? HEIGHT : WIDTH;
        opts.output.height_px = deg % 180 ? WIDTH : HEIGHT;
        draw(other);
        unsigned apart = 0; /* edges of triangles fall differently, by a pixel */
        for (size_t y = 0; y < HEIGHT; y++)
            for (size_t x = 0; x < WIDTH; x++)
                apart += abs(shown[y * WIDTH + x][1] - other[place(deg, x, y)][1]) > 8;
        if (apart > PIXELS / 50) fail_msg("turned by %u: %u pixels differ", deg, apart);
    }
}

/* Whole pixels of the screen are half ones of the scene. */
static void test_shifted_by_pixels_of_the_screen(void **state) {
    (void)state;
    opts.output = (struct gn_frame_output_opts){.width_px = WIDTH / 2, .height_px = HEIGHT / 2};
    opts.view.shift_px[0] = 2, opts.view.shift_px[1] = -1;
    draw(small);
    opts.output = (struct gn_frame_output_opts){
        .width_px = WIDTH, .height_px = HEIGHT, .scale = 0.5f, .scaled_later = true};
    opts.view.shift_px[0] = 4, opts.view.shift_px[1] = -2;
    const struct gn_plan *plan = draw(other);
    assert_false(gn_plan_scales(plan));
    assert_memory_equal(small, other, sizeof small / 4);
    opts.view.shift_px[0] = 5;
    draw(other);
    assert_memory_not_equal(small, other, sizeof small / 4);
}

/* ---- what goes on over it ---- */

static void test_kept_at_the_size_that_is_shown(void **state) {
    (void)state;
    opts.output.scale = 0.75f;
    opts.cover.captions = gn_captions_run(captions, WIDTH, HEIGHT, 0);
    draw(shown);
    if (!gn_gl_keep(stage.gl, &err)) fail_msg("%s", err.text);
    opts.view.camera = 1;
    draw(other);
    gn_gl_lay_part(stage.gl, &(struct gn_rect){0, 0, WIDTH / 2, HEIGHT});
    gn_gl_fill(stage.gl, &(struct gn_rect){WIDTH - 4, 0, 4, HEIGHT}, 1.0f);
    if (!gn_gl_read_rgba8(stage.gl, &small[0][0], &err)) fail_msg("%s", err.text);
    for (size_t y = 0; y < HEIGHT; y++) {
        assert_memory_equal(small[y * WIDTH], shown[y * WIDTH], 4 * WIDTH / 2);
        assert_memory_equal(small[y * WIDTH + WIDTH / 2], other[y * WIDTH + WIDTH / 2],
                            4 * (WIDTH / 2 - 4));
        assert_int_equal(small[y * WIDTH + WIDTH - 1][1], 255);
    }
    gn_gl_lay_over(stage.gl, 1.0f);
    if (!gn_gl_read_rgba8(stage.gl, &small[0][0], &err)) fail_msg("%s", err.text);
    assert_memory_equal(small, shown, sizeof small);
}

/* Nothing is made again from frame to frame, nor where a window's picture is scaled or not. */
static void test_no_object_is_made_twice(void **state) {
    (void)state;
    opts.output.scale = 0.75f;
    draw(shown);
    const uint64_t made = gn_gl_stats(stage.gl).objects_created;
    for (int i = 0; i < 3; i++) draw(other);
    assert_int_equal(gn_gl_stats(stage.gl).objects_created, made);
    assert_memory_equal(shown, other, sizeof shown);
}

static void draw_to_window(const struct gn_frame_output_opts *output, uint8_t picture[PIXELS][4]) {
    const uint32_t shown_px = output->scaled_later ? WINDOW_PX / 2 : WINDOW_PX;
    opts.output = *output;
    gn_gl_set_window(stage.gl, &(struct gn_gl_window){shown_px, shown_px, false});
    memset(picture, 0, sizeof *picture * PIXELS);
    draw(picture);
}

/* A window's picture is scaled by a blit in one frame, by the display in the next, and not at all
 * in the third: all three are right, and after the first nothing is made. */
static void test_a_window_scaled_in_turn(void **state) {
    (void)state;
    for (uint32_t msaa = 0; msaa <= 4; msaa += 4)
        for (int last_pass = 0; last_pass < 2; last_pass++) {
            if (last_pass) want_a_last_pass();
            const struct gn_frame_output_opts whole = {
                .width_px = WINDOW_PX, .height_px = WINDOW_PX, .msaa = msaa, .unencoded = true};
            struct gn_frame_output_opts blit = whole, later;
            blit.scale = 0.5f;
            later = blit;
            later.scaled_later = true;
            draw_to_window(&whole, other);
            draw_to_window(&blit, shown);
            draw_to_window(&later, small);
            assert_memory_not_equal(small, other, sizeof small);
            const uint64_t made = gn_gl_stats(stage.gl).objects_created;
            draw_to_window(&blit, again);
            assert_memory_equal(again, shown, sizeof again);
            draw_to_window(&later, again);
            assert_memory_equal(again, small, sizeof again);
            assert_int_equal(gn_gl_stats(stage.gl).objects_created, made);
            gn_gl_drop_view(stage.gl, 0);
            draw_to_window(&later, again);
            assert_memory_equal(again, small, sizeof again);
            gn_gl_drop_view(stage.gl, 0);
            draw_to_window(&blit, again);
            draw_to_window(&whole, again);
            assert_memory_equal(again, other, sizeof again);
            gn_gl_drop_view(stage.gl, 0);
        }
    gn_gl_set_window(stage.gl, NULL);
}

static void test_data_are_not_scaled(void **state) {
    (void)state;
    opts.output.scale = 0.5f;
    for (int aov = GN_AOV_VISIBILITY; aov < GN_AOV_COUNT; aov++) {
        opts.debug.aov = aov;
        const struct gn_plan *plan = help_stage_draw(&stage, &opts, NULL);
        assert_false(gn_plan_scales(plan));
        assert_int_equal(plan->width_px, WIDTH);
    }
}

static void test_sides_are_even(void **state) {
    (void)state;
    assert_int_equal(gn_frame_scaled_px(1080, 0.75f), 810);
    assert_int_equal(gn_frame_scaled_px(1920, 2.0f / 3), 1280);
    assert_int_equal(gn_frame_scaled_px(54, 0.75f), 40);
    assert_int_equal(gn_frame_scaled_px(1367, 1.0f), 1367);
    assert_int_equal(gn_frame_scaled_px(1, 0.5f), 1);
    for (uint32_t px = 2; px < 3000; px++)
        for (float scale = 0.5f; scale < 1; scale += 0.01f)
            assert_true(gn_frame_scaled_px(px, scale) <= px && gn_frame_scaled_px(px, scale) > 0);
}

#define CASE(test) cmocka_unit_test_setup_teardown(test, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {
        CASE(test_it_is_the_smaller_picture),
        CASE(test_with_a_last_pass),
        CASE(test_captions_are_sharp),
        CASE(test_dimmed),
        CASE(test_turned),
        CASE(test_shifted_by_pixels_of_the_screen),
        CASE(test_kept_at_the_size_that_is_shown),
        CASE(test_no_object_is_made_twice),
        CASE(test_data_are_not_scaled),
        CASE(test_sides_are_even),
    };
    const struct CMUnitTest of_a_window[] = {CASE(test_a_window_scaled_in_turn)};
    return cmocka_run_group_tests_name("egl", tests, open_egl, close_all) +
           cmocka_run_group_tests_name("osmesa", tests, open_osmesa, close_all) +
           cmocka_run_group_tests_name("a window", of_a_window, open_osmesa, close_all) +
           cmocka_run_group_tests_name("egl without srgb", tests, open_egl_without_srgb, close_all);
}
