/* Animation clips in a kiosk: nothing is drawn while they stand, no change of them jumps, and a
 * mode may start them anew. */
#include "unit/check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "unit/gl_help.h"
#include "unit/show_help.h"

#define PATIENCE_NS (60 * GN_NS_PER_S) /* of the processor */

/* A kiosk of that configuration; its scene is the default one, with the clips hoop and gull. */
static struct gn_show *open_show(const char *ini) {
    return help_show_of(ini, (const char *const[]){NULL});
}

static void draw_frame(struct gn_show *show) {
    const uint64_t before = show->counts.frames;
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    while (show->counts.frames == before) {
        help_show_step(show);
        assert_true(gn_clock_process_cpu_ns() - begun_ns < PATIENCE_NS);
    }
}

/* Until no frame is wanted any more. */
static void until_still(struct gn_show *show) {
    const int64_t begun_ns = gn_clock_process_cpu_ns();
    help_show_until_warm(show);
    while (help_show_changes(show)) {
        help_show_step(show);
        assert_true(gn_clock_process_cpu_ns() - begun_ns < PATIENCE_NS);
    }
}

static void act(struct gn_show *show, enum gn_action_kind kind, const char *name) {
    gn_show_act(&show->screen, &(struct gn_action){.kind = kind, .name = name},
                gn_clock_monotonic_ns());
}

/* The sum of where nodes are: it differs between two poses. */
static double pose_sum(const struct gn_show *show) {
    double sum = 0;
    for (uint32_t i = 0; i < show->screen.stage.scene->node_count; i++)
        for (int k = 0; k < 12; k++)
            sum += fabs((double)show->screen.stage.pose.world_from_node[i][k / 3][k % 3]) * (1 + k);
    return sum;
}

static void clips_that_stand_draw_nothing(void **state) {
    (void)state;
    static const char *const inis[] = {"[scene]\nanimation_loop = once\ntime = 1000\n",
                                       "[scene]\nanimation_speed = 0\nanimation_start = 2\n"};
    for (int i = 0; i < 2; i++) {
        char ini[200];
        snprintf(ini, sizeof ini, "%s[mode \"A\"]\nshadow = pcf\n[kiosk]\ncaptions = no\n",
                 inis[i]);
        struct gn_show *show = open_show(ini);
        until_still(show);
        act(show, GN_ACTION_PLAY, "gull");
        assert_true(gn_show_wants_frame(&show->screen));
        draw_frame(show);
        show->screen.kiosk.play.time_ns = show->screen.kiosk.play.length_ns; /* it ends */
        until_still(show);
        assert_int_equal(show->screen.stage.pose.at.over, -1);
        gn_show_close(show);
    }
}

static void play_past_its_fade(struct gn_show *show) {
    act(show, GN_ACTION_PLAY, "gull");
    draw_frame(show);
    show->screen.clips_begun_ns -= 5 * GN_NS_PER_S; /* the fade is over */
    show->screen.kiosk.play.time_ns = GN_NS_PER_S;
    draw_frame(show);
    draw_frame(show);
    assert_true(show->screen.stage.pose.at.fade == 1 && show->screen.stage.pose.at.over >= 0);
}

static void the_same_clip_anew_or_at_another_speed_fades(void **state) {
    (void)state;
    struct gn_show *show = open_show("[scene]\ntime = 3\n[mode \"A\"]\nshadow = pcf\n"
                                     "[mode \"B\"]\nshadow = pcf\nanimation_speed = .6\n"
                                     "[kiosk]\ncaptions = no\nclip_fade = 5\n");
    help_show_until_warm(show);
    draw_frame(show);
    assert_true(show->screen.stage.pose.at.fade == 1);
    double before = pose_sum(show);
    act(show, GN_ACTION_NEXT, NULL);
    while (show->screen.drawn.mode != 1) draw_frame(show);
    assert_true(show->screen.stage.pose.at.fade < 1);
    assert_float_equal(pose_sum(show), before, 1e-2 * before);
    play_past_its_fade(show);
    before = pose_sum(show);
    act(show, GN_ACTION_PLAY, "gull");
    draw_frame(show);
    assert_true(show->screen.stage.pose.at.fade < 1);
    assert_float_equal(pose_sum(show), before, 1e-2 * before);
    gn_show_close(show);
}

/* What takes a mode's settings anew, as ctl set does, is no replay of the clip that plays: the last
 * frame is of the time at which it is seen, which is later than now. */
static void settings_that_change_start_no_clip_again(void **state) {
    (void)state;
    struct gn_show *show = open_show("[mode \"A\"]\nshadow = pcf\n"
                                     "[kiosk]\ncaptions = no\nclip_fade = 5\n");
    help_show_until_warm(show);
    play_past_its_fade(show);
    for (int i = 0; i < 20; i++) {
        gn_show_enter(&show->screen);
        draw_frame(show);
        assert_true(show->screen.stage.pose.at.fade == 1);
    }
    gn_show_close(show);
}

static int64_t clip_ns(const struct gn_show *show) {
    return gn_pose_clip_ns(&show->screen.stage.pose.at.run, INT64_MAX,
                           show->screen.stage.pose.at.time_ns -
                               show->screen.stage.pose.at.begun_ns);
}

static void a_mode_that_restarts_begins_its_clips(void **state) {
    (void)state;
    struct gn_show *show = open_show("[mode \"A\"]\nshadow = pcf\n"
                                     "[mode \"B\"]\nshadow = pcf\nanimation_restart = yes\n"
                                     "animation_loop = once\nanimation_start = 1\n"
                                     "[kiosk]\ncaptions = no\nclip_fade = 0\n");
    help_show_until_warm(show);
    show->screen.kiosk.scene_ns += 1000 * GN_NS_PER_S;
    act(show, GN_ACTION_NEXT, NULL);
    while (show->screen.drawn.mode != 1) draw_frame(show);
    const int64_t first_ns = clip_ns(show);
    assert_true(first_ns >= GN_NS_PER_S && first_ns < 3 * GN_NS_PER_S);
    show->screen.kiosk.scene_ns += 1000 * GN_NS_PER_S; /* its end */
    until_still(show);
    act(show, GN_ACTION_MODE, "B");
    assert_true(gn_show_wants_frame(&show->screen));
    draw_frame(show);
    assert_true(clip_ns(show) < 3 * GN_NS_PER_S);
    act(show, GN_ACTION_PREV, NULL);
    while (show->screen.drawn.mode != 0) draw_frame(show);
    assert_true(clip_ns(show) > 1999 * GN_NS_PER_S);
    gn_show_close(show);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clips_that_stand_draw_nothing),
        cmocka_unit_test(the_same_clip_anew_or_at_another_speed_fades),
        cmocka_unit_test(settings_that_change_start_no_clip_again),
        cmocka_unit_test(a_mode_that_restarts_begins_its_clips),
    };
    return RUN(tests);
}
