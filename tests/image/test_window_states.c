/* A window whose GPU is reset, as it tells by its robustness interface: the same picture stands in
 * another window, with another context. And one that is switched off: black, and back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after what it needs */
#include <X11/keysym.h>
#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "display/display.h"
#include "frame/frame.h"
#include "gl/gl.h"
#include "image/compare.h"
#include "image/shot.h"
#include "image/xserver.h"

enum { PATIENCE_S = 60 };

static struct gn_xserver *server;
static bool reset; /* what the GPU says */

static unsigned reset_status(void) { return reset ? 0x8253 /* GUILTY_CONTEXT_RESET */ : 0; }

static const struct gn_display_ops *window;
static gn_display_proc get_proc(struct gn_display *display, const char *name) {
    if (strstr(name, "GetGraphicsResetStatus")) return (gn_display_proc)reset_status;
    return window->get_proc(display, name);
}

struct kiosk {
    struct gn_display display;
    struct gn_display_ops ops; /* the window's, with our ear in it */
    struct gn_scene *scene;
    struct gn_pose pose;
    struct gn_gl *gl;
    struct gn_frame *frame;
};
static struct gn_screen_opts small = {.width_px = 320, .height_px = 200};

static void start_gl(struct kiosk *k) {
    struct gn_err err = {0};
    const struct gn_gl_opts opts = {.get_proc = gn_display_get_proc, .display = &k->display};
    k->gl = gn_gl_create(&opts, NULL, &err);
    if (!k->gl || !gn_gl_load(k->gl, k->scene, &err)) fail_msg("%s", err.text);
    k->frame = gn_frame_create(k->scene, gn_gl_caps(k->gl));
}

static void stop_gl(struct kiosk *k) {
    gn_frame_destroy(k->frame);
    gn_gl_destroy(k->gl);
}

static void begin(struct kiosk *k) {
    struct gn_err err = {0};
    *k = (struct kiosk){0};
    k->scene = gn_scene_load("assets/sundial.glb", NULL, NULL, &err);
    if (!k->scene) fail_msg("%s", err.text);
    gn_pose_init(&k->pose, k->scene, GN_POSE_NONE);
    gn_pose_step(&k->pose, 0);
    small.loop = gn_loop_open(&err);
    if (!gn_display_open_screen(&k->display, "window", &small, gn_clock_monotonic_ns(), NULL, &err))
        fail_msg("%s", err.text);
    window = k->display.ops;
    k->ops = *window;
    k->ops.get_proc = get_proc;
    k->display.ops = &k->ops;
    reset = false;
    start_gl(k);
}

static void end(struct kiosk *k) {
    stop_gl(k);
    gn_display_close(&k->display);
    gn_loop_close(small.loop);
    gn_pose_finish(&k->pose);
    gn_scene_destroy(k->scene);
}

static void dispatch(struct kiosk *k) {
    struct gn_err err = {0};
    if (!gn_display_dispatch(&k->display, gn_clock_monotonic_ns(), &err)) fail_msg("%s", err.text);
}

static void draw(struct kiosk *k) {
    struct gn_display *d = &k->display;
    struct gn_err err = {0};
    while (!d->screen.may_draw) dispatch(k);
    const struct gn_gl_window target = {d->screen.width_px, d->screen.height_px, d->screen.srgb};
    assert_true(gn_display_begin(d, gn_clock_monotonic_ns(), &err));
    const struct gn_frame_opts opts = {.output.width_px = target.width_px,
                                       .output.height_px = target.height_px,
                                       .output.unencoded = !target.srgb};
    gn_gl_set_window(k->gl, &target);
    if (d->screen.black) {
        gn_gl_black(k->gl);
        assert_true(gn_display_present(d, gn_clock_monotonic_ns(), &err));
        return;
    }
    const struct gn_plan *plan = gn_frame_build(k->frame, &k->pose, &opts, NULL);
    if (!gn_gl_prepare(k->gl, plan, &err) || !gn_gl_run(k->gl, plan, NULL, &err))
        fail_msg("%s", err.text);
    assert_true(gn_display_present(d, gn_clock_monotonic_ns(), &err));
}

static bool is_seen(const struct gn_picture *expected) {
    const gn_xwindow now = gn_xserver_find(server, "gnomon", PATIENCE_S);
    struct gn_picture picture = {0};
    struct gn_difference d = {0};
    const bool same = now && gn_xserver_grab(server, now, &picture) &&
                      picture.width_px == expected->width_px &&
                      gn_compare(&picture, expected, 1.001 / 255, &d) && d.share <= .001;
    gn_picture_finish(&picture);
    return same;
}

static void assert_shows(struct kiosk *k, const char *size) {
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_S * GN_NS_PER_S;
    struct gn_picture expected = {0};
    const char *args[] = {"--size", size, "--no-animation", NULL};
    struct gn_err err = {0};
    if (!gn_shot(&expected, NULL, &err, "png", "assets/sundial.glb", args))
        fail_msg("%s", err.text);
    do {
        draw(k);
        usleep(30000);
    } while (!is_seen(&expected) && gn_clock_monotonic_ns() < until_ns);
    const bool seen = is_seen(&expected);
    gn_picture_finish(&expected);
    if (!seen) fail_msg("not the picture of render at %s", size);
}

static void lose_and_renew(struct kiosk *k) {
    struct gn_display *d = &k->display;
    struct gn_err err = {0};
    const uint32_t generation = d->screen.generation;
    assert_false(gn_gl_is_lost(k->gl));
    reset = true;
    assert_true(gn_gl_is_lost(k->gl));
    assert_true(gn_display_lose(d, gn_clock_monotonic_ns()));
    assert_true(d->screen.lost);
    assert_false(d->screen.may_draw || d->screen.lit);
    dispatch(k);
    assert_true(d->screen.lost);
    stop_gl(k);
    if (!gn_display_renew(d, gn_clock_monotonic_ns(), &err)) fail_msg("%s", err.text);
    reset = false;
    assert_false(d->screen.lost);
    assert_true(d->screen.has_context && d->screen.damaged);
    assert_true(d->screen.generation > generation);
    start_gl(k);
}

static void test_the_picture_comes_back(void **state) {
    (void)state;
    struct kiosk k;
    begin(&k);
    assert_shows(&k, "320x200");
    for (int i = 0; i < 3; i++) {
        lose_and_renew(&k);
        assert_shows(&k, "320x200");
    }
    end(&k);
}

static void wait_for_width(struct kiosk *k, uint32_t width_px) {
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_S * GN_NS_PER_S;
    while (k->display.screen.width_px != width_px && gn_clock_monotonic_ns() < until_ns) {
        usleep(10000);
        dispatch(k);
    }
    assert_int_equal(k->display.screen.width_px, width_px);
}

static void test_full_screen_stays_full_screen(void **state) {
    (void)state;
    struct kiosk k;
    begin(&k);
    assert_shows(&k, "320x200");
    gn_xserver_key(server, gn_xserver_find(server, "gnomon", PATIENCE_S), XK_F11);
    wait_for_width(&k, GN_XSERVER_WIDTH_PX);
    assert_shows(&k, "1024x768");
    lose_and_renew(&k);
    wait_for_width(&k, GN_XSERVER_WIDTH_PX);
    assert_shows(&k, "1024x768");
    gn_xserver_key(server, gn_xserver_find(server, "gnomon", PATIENCE_S), XK_F11);
    wait_for_width(&k, 320);
    assert_shows(&k, "320x200");
    end(&k);
}

static bool is_black(void) {
    const gn_xwindow now = gn_xserver_find(server, "gnomon", PATIENCE_S);
    struct gn_picture p = {0};
    bool black = now && gn_xserver_grab(server, now, &p);
    for (int i = 0; black && i < p.width_px * p.height_px * p.channels; i++) black = p.data[i] == 0;
    gn_picture_finish(&p);
    return black;
}

static void assert_becomes_black(struct kiosk *k) {
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_S * GN_NS_PER_S;
    draw(k);
    while (!is_black() && gn_clock_monotonic_ns() < until_ns) {
        usleep(30000);
        dispatch(k);
        if (k->display.screen.may_draw) draw(k);
    }
    assert_true(is_black());
}

static void test_switched_off_it_is_black(void **state) {
    (void)state;
    struct kiosk k;
    begin(&k);
    assert_shows(&k, "320x200");
    gn_display_blank(&k.display, true, gn_clock_monotonic_ns());
    assert_true(k.display.screen.blank && k.display.screen.black);
    assert_false(k.display.screen.lit);
    assert_becomes_black(&k);
    usleep(100000);
    dispatch(&k);
    assert_false(k.display.screen.black || k.display.screen.may_draw); /* nothing more to draw */
    gn_xserver_cover(server);
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_S * GN_NS_PER_S;
    while (!k.display.screen.black && gn_clock_monotonic_ns() < until_ns) dispatch(&k);
    assert_becomes_black(&k);
    gn_display_blank(&k.display, false, gn_clock_monotonic_ns());
    assert_true(k.display.screen.lit && k.display.screen.damaged);
    assert_false(k.display.screen.blank || k.display.screen.black);
    assert_shows(&k, "320x200");
    end(&k);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_picture_comes_back),
        cmocka_unit_test(test_full_screen_stays_full_screen),
        cmocka_unit_test(test_switched_off_it_is_black),
    };
    server = gn_xserver_start();
    const int failures = cmocka_run_group_tests(tests, NULL, NULL);
    gn_xserver_stop(server);
    return failures;
}
