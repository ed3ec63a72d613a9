/* A day of the sun in a kiosk, on a fake clock and a fake time of day. */
#include "unit/check.h"

#include <cglm/cglm.h>
#include <math.h>

#include "core/clock.h"
#include "core/sun.h"
#include "kiosk/private.h"
#include "stage/sun.h"
#include "unit/show_help.h"

static int64_t clock_ns, ahead_ns; /* of the time of day */
static const int64_t HOUR_NS = 3600 * GN_NS_PER_S;

static struct gn_show *open_show(const char *config, int64_t utc_s) {
    struct gn_show *show = help_show_of(config, (const char *const[]){"--no-animation", NULL});
    clock_ns = gn_clock_monotonic_ns();
    gn_loop_fake_clock(show->loop, &clock_ns);
    ahead_ns = utc_s * GN_NS_PER_S - clock_ns;
    gn_clock_fake_day(&clock_ns, &ahead_ns);
    show->parts.rows[GN_PART_sun]->reopen(show->parts.of[GN_PART_sun]);
    return show;
}

/* Time goes on by so much; returns the frames. */
static uint64_t run(struct gn_show *show, int64_t ns) {
    const int64_t until_ns = clock_ns + ns;
    const uint64_t before = show->counts.frames;
    struct gn_timer end = {.due_ns = until_ns};
    struct gn_err err = {0};
    gn_loop_add_timer(show->loop, &end);
    while (clock_ns < until_ns)
        if (!gn_show_step(show, &err)) fail_msg("%s", err.text);
    gn_loop_remove_timer(&end);
    return show->counts.frames - before;
}

/* The light is where the sun was at most that many seconds ago. */
static void assert_shown(struct gn_show *show, double utc_s, double late_s) {
    static const struct gn_place berlin = {52.5, 13.4};
    const struct gn_pose *pose = &show->screen.stage.pose;
    const double shown_s = show->screen.stage.shown.opts.view.sun_utc_s;
    const struct gn_sun_view view = gn_sun_view(shown_s, &berlin);
    float to_ws[3];
    if (shown_s > utc_s || shown_s < utc_s - late_s)
        fail_msg("the sun of %.0f s later is shown", shown_s - utc_s);
    gn_sun_direction(view.azimuth_deg, fmax(view.altitude_deg, 0), 0, to_ws);
    for (int k = 0; k < 3; k++) assert_true(fabsf(pose->aim_ws[k] + to_ws[k]) < 1e-5f);
}

static double step_of(const struct gn_show *show) {
    const struct gn_stage *stage = &show->screen.stage;
    const double altitude_deg =
        gn_stage_sun_view(stage->settings, stage->shown.opts.view.sun_utc_s).altitude_deg;
    return gn_stage_sun_step_s(&stage->pose, &stage->shown.opts, altitude_deg);
}

#define PLACE "[sun]\nlatitude = 52.5\nlongitude = 13.4\n"

static void a_day_follows_the_clock_and_its_jumps(void **state) {
    (void)state;
    const int64_t begin_s = 1782014400; /* 21 June 2026, 4 h UTC */
    struct gn_show *show =
        open_show(PLACE "[kiosk]\ncaptions = no\n[render]\ngather = none\nocclusion = none\n"
                        "[mode \"a\"]\nshadow = hard\n",
                  begin_s);
    run(show, 30 * GN_NS_PER_S);
    const double step_s = step_of(show);
    assert_shown(show, (double)(clock_ns + ahead_ns) * 1e-9, step_s + 1);
    for (int hour = 5; hour <= 21; hour += 4) {
        const int64_t then_s = begin_s + (hour - 4) * 3600 + 600;
        ahead_ns = (then_s - 60) * GN_NS_PER_S - clock_ns; /* a jump */
        const uint64_t frames = run(show, 60 * GN_NS_PER_S + GN_NS_PER_S / 2);
        assert_shown(show, (double)then_s + 0.6, 0.6); /* as render --date has it */
        const double now_s = step_of(show);
        printf("%2d:10: a frame each %g s\n", hour, now_s);
        /* a minute's, those of the jump and of its sky among them */
        assert_in_range(frames, (unsigned)(60 / now_s), (unsigned)(60 / now_s) + 9);
    }
    gn_show_close(show);
}

/* Between two frames the shadow of the scene's highest point moves by at most a pixel of its
 * middle, and by more than a third of one where the step could be longer. */
static void its_step_is_a_pixel_of_shadow(void **state) {
    (void)state;
    static const struct gn_place berlin = {52.5, 13.4};
    const double noon_s = 1782045600; /* 21 June 2026, 12:40 UTC */
    struct gn_show *show =
        open_show(PLACE "[kiosk]\ncaptions = no\n[render]\ngather = none\nocclusion = none\n"
                        "[mode \"a\"]\nshadow = hard\n",
                  (int64_t)noon_s);
    run(show, GN_NS_PER_S);
    const struct gn_stage *stage = &show->screen.stage;
    struct gn_frame_opts opts = stage->shown.opts;
    struct gn_framing framing;
    struct gn_framing_opts as = opts.view.framing;
    const struct gn_pose *pose = &stage->pose;
    const double high_m = (double)(pose->box_ws.max[1] - pose->box_ws.min[1]);
    vec3 middle;
    as.aspect = 16.0f / 9;
    gn_framing_build(pose, (uint32_t)opts.view.camera, &as, &framing);
    glm_vec3_center((float *)pose->box_ws.min, (float *)pose->box_ws.max, middle);
    for (uint32_t px = 90; px <= 2880; px *= 2) {
        opts.output.width_px = px * 16 / 9;
        opts.output.height_px = px;
        const double step_s =
            gn_stage_sun_step_s(pose, &opts, gn_sun_view(noon_s, &berlin).altitude_deg);
        float tip[2][3];
        for (int i = 0; i < 2; i++) { /* of its shadow on the ground */
            const struct gn_sun_view view = gn_sun_view(noon_s + i * step_s, &berlin);
            gn_sun_direction(view.azimuth_deg, view.altitude_deg, 0, tip[i]);
            for (int k = 0; k < 3; k += 2) tip[i][k] *= -(float)high_m / tip[i][1];
        }
        const double moved_m =
                         hypot((double)(tip[1][0] - tip[0][0]), (double)(tip[1][2] - tip[0][2])),
                     pixel_m = 2 * tan((double)framing.camera.yfov_rad / 2) *
                               (double)glm_vec3_distance(middle, framing.eye_ws) / px;
        printf("%4u px: %2g s, %.3f of a pixel\n", px, step_s, moved_m / pixel_m);
        assert_true(moved_m <= 1.3 * pixel_m || step_s <= 1);
        assert_true(moved_m >= pixel_m / 3 || step_s >= 60);
    }
    gn_show_close(show);
}

static void a_time_lapse_runs_from_its_date(void **state) {
    (void)state;
    struct gn_show *show =
        open_show(PLACE "date = 2026-12-21T09:00Z\nspeed = 60\n[kiosk]\ncaptions = no\n[render]\n"
                        "gather = none\n[mode \"a\"]\nshadow = hard\n[mode \"b\"]\nshadow = hard\n"
                        "date = 2026-03-20T12:00Z\nsun_speed = 0\n",
                  0);
    run(show, 10 * GN_NS_PER_S);
    assert_shown(show, 1797843600 + 600, 30);
    run(show, 20 * GN_NS_PER_S);
    assert_shown(show, 1797843600 + 1800, 30);
    gn_show_act(&show->screen, &(struct gn_action){.kind = GN_ACTION_NEXT}, clock_ns);
    run(show, 5 * GN_NS_PER_S);
    assert_shown(show, 1774008000, 0);
    assert_int_equal(run(show, HOUR_NS / 60), 0); /* it stands still */
    gn_show_close(show);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_day_follows_the_clock_and_its_jumps),
        cmocka_unit_test(its_step_is_a_pixel_of_shadow),
        cmocka_unit_test(a_time_lapse_runs_from_its_date),
    };
    return RUN(tests);
}
