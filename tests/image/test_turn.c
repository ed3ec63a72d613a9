/* A picture that is turned in its output is the same picture, panels and marks too. */
#include <stdlib.h>
#include <string.h>

#include "frame/frame.h"
#include "plan/stage_scene.h"
#include "unit/check.h"
#include "unit/gl_help.h"

enum { WIDTH = 320, HEIGHT = 192, PIXELS = WIDTH * HEIGHT };

static struct gn_display display;
static struct gn_gl *gl;
static struct gn_scene *scene;
static struct gn_pose pose;
static struct gn_frame *frame;
static struct gn_err err;
static uint8_t upright[PIXELS * 4], turned[PIXELS * 4];

static int open_all(void **state) {
    (void)state;
    help_open(&display, "egl");
    gl = help_gl(&display, &(struct gn_gl_opts){0}, NULL);
    scene = gn_stage_scene_make();
    if (!gn_gl_load(gl, scene, &err)) fail_msg("%s", err.text);
    gn_pose_init(&pose, scene, GN_POSE_DEFAULT);
    gn_pose_step(&pose, 0);
    frame = gn_frame_create(scene, gn_gl_caps(gl));
    return 0;
}

static int close_all(void **state) {
    (void)state;
    gn_frame_destroy(frame);
    gn_pose_finish(&pose);
    gn_gl_destroy(gl);
    gn_scene_destroy(scene);
    gn_display_close(&display);
    return 0;
}

static void draw(unsigned turn_deg, bool overlays, uint8_t *out) {
    const bool on_side = turn_deg % 180 != 0;
    const struct gn_frame_opts opts = {
        .output.width_px = on_side ? HEIGHT : WIDTH,
        .output.height_px = on_side ? WIDTH : HEIGHT,
        .output.turn_deg = turn_deg,
        .shadow.any = {.given = GN_LIGHT_GIVEN(map_px), .map_px = 256},
        .debug.show_lights = overlays,
        .debug.show_maps = overlays};
    const struct gn_plan *plan = gn_frame_build(frame, &pose, &opts, NULL);
    assert_null(gn_plan_check(plan));
    if (!gn_gl_prepare(gl, plan, &err) || !gn_gl_run(gl, plan, NULL, &err) ||
        !gn_gl_read_rgba8(gl, out, &err))
        fail_msg("%s", err.text);
}

/* Where a pixel of the upright picture stands in the turned one. */
static size_t place(unsigned turn_deg, int x, int y) {
    switch (turn_deg) {
    case 90: return (size_t)x * HEIGHT + (size_t)(HEIGHT - 1 - y);
    case 180: return (size_t)(HEIGHT - 1 - y) * WIDTH + (size_t)(WIDTH - 1 - x);
    case 270: return (size_t)(WIDTH - 1 - x) * HEIGHT + (size_t)y;
    default: return (size_t)y * WIDTH + (size_t)x;
    }
}

static unsigned count_different(unsigned turn_deg, int tolerance) {
    unsigned count = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const uint8_t *a = &upright[4 * ((size_t)y * WIDTH + (size_t)x)],
                          *b = &turned[4 * place(turn_deg, x, y)];
            bool differs = false;
            for (int k = 0; k < 3; k++) differs |= abs(a[k] - b[k]) > tolerance;
            count += differs;
        }
    return count;
}

static void check_turns(bool overlays, unsigned most) {
    draw(0, overlays, upright);
    for (unsigned deg = 90; deg < 360; deg += 90) {
        draw(deg, overlays, turned);
        const unsigned count = count_different(deg, 2);
        if (count > most) fail_msg("turned by %u, %u pixels are others", deg, count);
    }
}

/* What falls just on an edge may fall to the other side. */
static void test_turned_picture(void **state) {
    (void)state;
    check_turns(false, PIXELS / 500);
}

static void test_turned_overlays(void **state) {
    (void)state;
    check_turns(true, PIXELS / 100);
}

/* It would be no test if the upright one were as good. */
static void test_a_turn_is_a_turn(void **state) {
    (void)state;
    draw(0, false, upright);
    draw(180, false, turned);
    assert_true(count_different(0, 2) > PIXELS / 4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_turned_picture),
        cmocka_unit_test(test_turned_overlays),
        cmocka_unit_test(test_a_turn_is_a_turn),
    };
    return cmocka_run_group_tests(tests, open_all, close_all);
}
