/* [sun] hours: a kiosk gathers for how many hours of the day each surface sees the sun. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "options/args.h"
#include "stage/hours_picture.h"
#include "unit/check.h"
#include "unit/folder.h"
#include "unit/gltf_maker.h"
#include "unit/show_help.h"

#define PATIENCE_NS (240 * GN_NS_PER_S)
enum { WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT };

static char folder[] = "/tmp/gnomon-sun-hours-XXXXXX", path[sizeof folder + 20];

/* Houses of several heights on a ground whose edges the picture shows. */
static void make_scene(void) {
    struct gn_maker m;
    struct gn_err err = {0};
    char node[200];
    gn_maker_init(&m);
    gn_maker_square(&m);
    gn_maker_cube(&m);
    gn_maker_set(&m, "cameras", "[{'type':'perspective','perspective':{'yfov':0.1,'znear':1}}]");
    gn_maker_set(&m, "nodes", "[{'mesh':0,'scale':[2.9,1,2.2]}]");
    gn_maker_add(&m, "nodes",
                 "{'camera':0,'translation':[0,60,0],'rotation':[-0.70710678,0,0,0.70710678]}");
    for (int i = 0; i < 6; i++) {
        const double high = .3 + .15 * i;
        snprintf(node, sizeof node, "{'mesh':1,'translation':[%g,%g,%g],'scale':[0.25,%g,0.2]}",
                 i % 3 - 1.1, high / 2, i / 3 * 1.3 - .6, high / 2);
        gn_maker_add(&m, "nodes", node);
    }
    gn_maker_set(&m, "scenes", "[{'nodes':[0,1,2,3,4,5,6,7]}]");
    snprintf(path, sizeof path, "%s/houses.glb", folder);
    if (!gn_maker_write(&m, path, &err)) fail_msg("%s", err.text);
}

static float hours[PIXELS];
static uint8_t picture[4 * PIXELS];

/* What `gnomon render --aov sun-hours` writes. */
static void draw_file(void) {
    const char *argv[] = {"gnomon", "render",     "-o",      "none.png",  "--backend", "egl",
                          "--size", "96x72",      "--aov",   "sun-hours", "--sun",     "52.5,13.4",
                          "--date", "2026-03-20", "--floor", "none",      path};
    struct gn_stage stage = {0};
    struct gn_options options;
    struct gn_sun_hours sun;
    struct gn_sun_hours_picture drawn = {0};
    struct gn_err err = {0};
    if (!gn_args_parse(&options, sizeof argv / sizeof *argv, (char *const *)(uintptr_t)argv, NULL,
                       &err) ||
        !gn_stage_load(&stage, options.settings, NULL, &err) ||
        !gn_stage_open(&stage, NULL, &err) ||
        !gn_sun_hours_build(&sun, options.settings, stage.scene, &err) ||
        !gn_sun_hours_draw(&sun, &stage, 0, &drawn, NULL, &err))
        fail_msg("%s", err.text);
    memcpy(hours, drawn.hours, sizeof hours);
    gn_hours_picture_draw(&sun, &drawn, options.settings, picture, WIDTH, HEIGHT, NULL);
    gn_sun_hours_finish(&drawn);
    gn_stage_close(&stage);
    gn_options_finish(&options);
}

#define CONFIG                                                                                     \
    "[kiosk]\ncaptions = no\n[sun]\nlatitude = 52.5\nlongitude = 13.4\ndate = 2026-03-20\n"        \
    "speed = 0\n[render]\nenvironment = none\n[mode \"hours\"]\nsun_hours = yes\n[mode "           \
    "\"plain\"]\nshadow = hard\n"

static struct gn_show *open_kiosk(const char *rotate) {
    const bool lies = strcmp(rotate, "90") == 0 || strcmp(rotate, "270") == 0;
    return help_show_of(CONFIG,
                        (const char *const[]){"--size", lies ? "72x96" : "96x72", "--floor", "none",
                                              "--turntable", "0", "--rotate", rotate, path, NULL});
}

static void wait_for(struct gn_show *show) {
    const struct gn_show_still *still = &show->screen.still;
    const int64_t until_ns = gn_clock_monotonic_ns() + PATIENCE_NS;
    while (still->sun.hours.count == 0 || still->sun.painted < still->sun.hours.count ||
           help_show_changes(show)) {
        help_show_step(show);
        if (gn_clock_monotonic_ns() > until_ns)
            fail_msg("%u positions, share %.2f", still->sun.added, (double)still->share);
    }
}

/* The pixel of a screen that stands turned clockwise, at that one of the upright picture. */
static int place_of(int turn, int u, int v) {
    switch (turn) {
    case 90: return u * HEIGHT + HEIGHT - 1 - v;
    case 180: return (HEIGHT - 1 - v) * WIDTH + WIDTH - 1 - u;
    case 270: return (WIDTH - 1 - u) * HEIGHT + v;
    default: return v * WIDTH + u;
    }
}

/* Within a minute on all surfaces; and the picture with its legend, also on a turned screen. */
static void hours_are_those_of_render(void **state) {
    static const char *const turns[] = {"0", "90", "180", "270"};
    static uint8_t shown[4 * PIXELS];
    (void)state;
    for (int turn = 0; turn < 4; turn++) {
        long near = 0, surfaces = 0, same = 0;
        double most = 0;
        struct gn_show *show = open_kiosk(turns[turn]);
        const int64_t begun_ns = gn_clock_monotonic_ns();
        wait_for(show);
        const double took_s = (double)(gn_clock_monotonic_ns() - begun_ns) * 1e-9;
        help_show_picture(show, shown);
        const struct gn_sun_gather *sun = &show->screen.still.sun;
        assert_in_range(sun->hours.count, 700, 720); /* at the horizon a part of the disk is down */
        for (int i = 0; i < PIXELS; i++) {
            const uint8_t *at = shown + 4 * place_of(90 * turn, i % WIDTH, i / WIDTH);
            const double off_h = fabs((double)(sun->seen.hours[i] - hours[i]));
            bool differs = false;
            for (int k = 0; k < 3; k++) differs |= abs(picture[4 * i + k] - at[k]) > 2;
            surfaces += hours[i] >= 0;
            near += hours[i] >= 0 && off_h <= 1 / 60.0;
            same += !differs;
            most = fmax(most, off_h);
        }
        print_message("turned %s: %ld of %ld surfaces within a minute, at most %.2f min; %ld of %d "
                      "pixels as in the file; %.1f s\n",
                      turns[turn], near, surfaces, 60 * most, same, PIXELS, took_s);
        assert_true(surfaces > 3500 && near == surfaces && same == PIXELS);
        gn_show_close(show);
    }
}

/* So many milliseconds, however many steps those are. */
static void wait_ms(struct gn_show *show, int ms) {
    const int64_t until_ns = gn_clock_monotonic_ns() + (int64_t)ms * 1000000;
    while (gn_clock_monotonic_ns() < until_ns)
        if (gn_show_screen_due_ns(&show->screen) <= gn_clock_monotonic_ns()) help_show_step(show);
}

/* Frames until the mean is gone. */
static void expect_anew(struct gn_show *show) {
    const struct gn_show_still *still = &show->screen.still;
    help_show_frames(show, 1);
    assert_int_equal(still->sun.drawn, 0);
    assert_false(still->painted);
}

static void it_begins_anew_when_camera_day_or_mode_change(void **state) {
    (void)state;
    struct gn_show *show = open_kiosk("0");
    struct gn_show_screen *s = &show->screen;
    wait_for(show);
    const uint64_t frames = show->counts.frames;
    wait_ms(show, 400); /* complete: nothing is drawn, and nothing gathered */
    assert_int_equal(show->counts.frames, frames);
    assert_int_equal(show->counts.allocations, 0);
    const double winter_h = s->still.sun.hours.count * s->still.sun.hours.step_h;

    s->stage.shown.opts.view.orbit.yaw_rad = .1f;
    s->changed = true;
    expect_anew(show);
    wait_for(show);

    gn_show_act(s, &(struct gn_action){.kind = GN_ACTION_SUN, .name = "+92d"}, 0);
    expect_anew(show);
    wait_for(show);
    const double summer_h = s->still.sun.hours.count * s->still.sun.hours.step_h;
    print_message("%.2f h, 92 days later %.2f h\n", winter_h, summer_h);
    assert_true(summer_h > winter_h + 4);

    help_show_act(show, GN_ACTION_NEXT);
    while (s->kiosk.shown.mode != 1) help_show_step(show);
    help_show_frames(show, 1);
    assert_true(s->still.share <= 0.0f && !s->still.painted);
    gn_show_close(show);
}

static int set_up(void **state) {
    (void)state;
    if (!mkdtemp(folder)) return 1;
    make_scene();
    draw_file();
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    return gn_test_remove_folder(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hours_are_those_of_render),
        cmocka_unit_test(it_begins_anew_when_camera_day_or_mode_change),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
