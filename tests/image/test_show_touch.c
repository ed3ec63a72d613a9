/* Moves by hand on a kiosk without a window: they turn the view as whoever looks at the screen sees
 * it, however that is rotated; the turntable rests meanwhile; a dark screen is only lit. */
#include "unit/check.h"

#include "core/clock.h"
#include "input/private.h"
#include "kiosk/private.h"
#include "unit/show_help.h"
#include <math.h>

#define SECONDS(n) ((n)*GN_NS_PER_S)

static int64_t clock_ns;

static struct gn_show *run_by_hand(struct gn_show *show) {
    clock_ns = gn_clock_monotonic_ns();
    gn_loop_fake_clock(show->loop, &clock_ns);
    return show;
}

static struct gn_show *open_show(const char *config) {
    return run_by_hand(help_show_of(config, (const char *const[]){"--no-animation", NULL}));
}

static void run_for(struct gn_show *show, int64_t ns) {
    const int64_t end_ns = clock_ns + ns;
    struct gn_timer end = {.due_ns = end_ns};
    gn_loop_add_timer(show->loop, &end);
    while (clock_ns < end_ns) help_show_step(show);
    gn_loop_remove_timer(&end);
}

static const struct gn_orbit *orbit_of(const struct gn_show *show) {
    return &show->screen.stage.shown.opts.view.orbit;
}

static float turntable_of(const struct gn_show *show) {
    return show->screen.stage.shown.opts.view.turntable_rad;
}

/* As events leave it, which are read in the step that follows. */
static void drag(struct gn_show *show, struct gn_touch_moves *moves, float right, float up) {
    moves->turn[0] += right;
    moves->turn[1] += up;
    moves->used = true;
    help_show_step(show);
}

static struct gn_devices *devices_of(const struct gn_show *show) {
    return &show->buttons.input->devices;
}

static void assert_turned(const struct gn_show *show, double yaw_rad, double pitch_rad) {
    assert_float_equal((double)orbit_of(show)->yaw_rad, yaw_rad, 1e-5);
    assert_float_equal((double)orbit_of(show)->pitch_rad, pitch_rad, 1e-5);
}

/* ---- a rotated screen ---- */

static const struct {
    const char *rotate, *size; /* of the panel, as it is scanned out; the picture is 64x48 */
    float right[2], up[2];     /* where the picture's are on it */
} screens[] = {
    {"0", "64x48", {1, 0}, {0, 1}},
    {"90", "48x64", {0, -1}, {1, 0}},
    {"180", "64x48", {-1, 0}, {0, -1}},
    {"270", "48x64", {0, 1}, {-1, 0}},
};

static void a_hand_turns_the_model_as_its_owner_sees_it(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct gn_show *show = run_by_hand(help_show((const char *const[]){
            "--no-animation", "--size", screens[i].size, "--rotate", screens[i].rotate, NULL}));
        const struct gn_screen *screen = &show->screen.stage.display.screen;
        assert_int_equal(screen->rotate_deg, 90 * i);
        help_show_step(show);

        /* a quarter of the picture's height to the right, an eighth down: 12 and 6 pixels */
        float px[2];
        for (int k = 0; k < 2; k++) px[k] = 12 * screens[i].right[k] - 6 * screens[i].up[k];
        drag(show, &devices_of(show)->glass, px[0] / (float)screen->width_px,
             px[1] / (float)screen->height_px);
        assert_turned(show, -M_PI / 4, M_PI / 8);

        /* the same in a window's unit, back; and a mouse's, which is not rotated with the screen */
        struct gn_pointer *pointer = &show->screen.stage.display.screen.pointer;
        for (int k = 0; k < 2; k++) pointer->turn[k] = -px[k] / (float)screen->height_px;
        help_show_step(show);
        assert_turned(show, 0, 0);
        drag(show, &devices_of(show)->mouse, .25f, -.125f);
        assert_turned(show, -M_PI / 4, M_PI / 8);
        gn_show_close(show);
    }
}

static void fingers_zoom_and_pan(void **state) {
    (void)state;
    struct gn_show *show = open_show("");
    help_show_step(show);
    devices_of(show)->glass.zoom = .4f;
    help_show_step(show);
    assert_float_equal((double)orbit_of(show)->zoom, .4, 1e-5);
    devices_of(show)->glass.pan[0] = .1f;
    help_show_step(show);
    assert_false(orbit_of(show)->shift_m[0] == 0 && orbit_of(show)->shift_m[2] == 0);
    devices_of(show)->mouse.wheel = -4; /* notches of a tenth */
    help_show_step(show);
    assert_float_equal((double)orbit_of(show)->zoom, 0, 1e-5);
    gn_show_close(show);
}

static void limits_of_the_camera_hold(void **state) {
    (void)state;
    struct gn_show *show = open_show("[camera]\nphi = 60\ntheta = 0\nphi_min = 50\nphi_max = 80\n");
    help_show_step(show);
    drag(show, &devices_of(show)->glass, 0, 5);
    assert_turned(show, 0, -M_PI / 9); /* 20 degrees lower */
    drag(show, &devices_of(show)->glass, 0, -5);
    assert_turned(show, 0, M_PI / 18);
    gn_show_close(show);
}

/* ---- the turntable, and who comes after ---- */

static void the_turntable_rests_and_goes_on_from_there(void **state) {
    (void)state;
    struct gn_show *show = open_show("[scene]\nturntable = 30\nturntable_rest = 4\n"
                                     "[kiosk]\ncaptions = no\n[mode \"a\"]\nshadow = none\n");
    run_for(show, SECONDS(20)); /* all programs are made */
    drag(show, &devices_of(show)->glass, .25f, 0);
    run_for(show, SECONDS(1));
    const float before = turntable_of(show);
    const uint64_t frames = show->counts.frames;
    assert_true(before != 0);
    run_for(show, SECONDS(2));
    assert_true(turntable_of(show) == before);
    assert_int_equal(show->counts.frames, frames); /* nothing moves, nothing is drawn */
    drag(show, &devices_of(show)->glass, .25f, 0);
    run_for(show, SECONDS(3)); /* the rest began anew */
    assert_true(turntable_of(show) == before);
    run_for(show, SECONDS(2)); /* 4 of 5 seconds it rested */
    assert_true(show->counts.frames > frames + 10);
    const double by = remainder((double)(turntable_of(show) - before), 2 * M_PI);
    assert_float_equal(by, M_PI / 6, .05);
    assert_turned(show, -M_PI / 2, 0);
    gn_show_close(show);
}

static void a_finger_that_stays_down_keeps_it_at_rest(void **state) {
    (void)state;
    struct gn_show *show = open_show("[scene]\nturntable = 30\nturntable_rest = 2\n"
                                     "[mode \"a\"]\nshadow = none\n");
    run_for(show, SECONDS(20));
    struct gn_pointer *pointer = &show->screen.stage.display.screen.pointer;
    pointer->pressed = true; /* as a window's button is */
    help_show_step(show);
    run_for(show, SECONDS(1));
    const float before = turntable_of(show);
    run_for(show, SECONDS(10));
    assert_true(turntable_of(show) == before);
    pointer->released = true;
    help_show_step(show);
    run_for(show, SECONDS(4));
    assert_true(turntable_of(show) != before);
    gn_show_close(show);
}

static void the_idle_timeout_gives_the_view_back(void **state) {
    (void)state;
    struct gn_show *show = open_show("[kiosk]\nidle = first\nidle_after = 60\n"
                                     "[mode \"a\"]\nshadow = none\n");
    run_for(show, SECONDS(50));
    drag(show, &devices_of(show)->glass, .25f, .125f);
    run_for(show, SECONDS(50)); /* the timeout began anew */
    assert_turned(show, -M_PI / 4, -M_PI / 8);
    const uint64_t frames = show->counts.frames;
    run_for(show, SECONDS(11));
    assert_true(gn_orbit_is_zero(orbit_of(show)));
    assert_true(show->counts.frames > frames);
    gn_show_close(show);
}

static void a_touch_of_a_dark_screen_lights_it_and_turns_nothing(void **state) {
    (void)state;
    struct gn_show *show = open_show("[mode \"a\"]\nshadow = none\n");
    help_show_step(show);
    gn_show_act(&show->screen, &(struct gn_action){.kind = GN_ACTION_BLANK}, clock_ns);
    run_for(show, SECONDS(1));
    assert_true(gn_kiosk_is_dark(&show->screen.kiosk));
    assert_true(devices_of(show)->suppresses_taps);
    drag(show, &devices_of(show)->glass, .25f, 0);
    assert_false(gn_kiosk_is_dark(&show->screen.kiosk));
    assert_false(devices_of(show)->suppresses_taps);
    assert_true(gn_orbit_is_zero(orbit_of(show)));
    drag(show, &devices_of(show)->glass, .25f, 0);
    assert_turned(show, -M_PI / 4, 0);
    gn_show_close(show);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hand_turns_the_model_as_its_owner_sees_it),
        cmocka_unit_test(fingers_zoom_and_pan),
        cmocka_unit_test(limits_of_the_camera_hold),
        cmocka_unit_test(the_turntable_rests_and_goes_on_from_there),
        cmocka_unit_test(a_finger_that_stays_down_keeps_it_at_rest),
        cmocka_unit_test(the_idle_timeout_gives_the_view_back),
        cmocka_unit_test(a_touch_of_a_dark_screen_lights_it_and_turns_nothing),
    };
    return RUN(tests);
}
