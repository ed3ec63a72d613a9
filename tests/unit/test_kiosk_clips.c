/* The machine's clips: one that plays once, and those that a mode begins anew. */
#include "unit/check.h"

#include "unit/kiosk_help.h"

static struct gn_kiosk play(const struct gn_kiosk_rules *r, struct gn_kiosk s, int64_t at,
                            int clip) {
    return gn_kiosk_step(r, &s,
                         &(struct gn_kiosk_event){.kind = GN_KIOSK_ACTION,
                                                  .time_ns = at,
                                                  .action = GN_ACTION_PLAY,
                                                  .pressed = true,
                                                  .clip = clip,
                                                  .clip_ns = 3 * S});
}

static void a_clip_plays_once_and_the_scene_goes_on_where_it_was(void **state) {
    (void)state;
    struct gn_kiosk s = on(&three, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
    s = on(&three, s, GN_KIOSK_FRAME, 12 * S);
    s = play(&three, s, 12 * S, 4);
    struct gn_kiosk_view view = gn_kiosk_view(&three, &s, 13 * S);
    assert_int_equal(view.clip, 4);
    assert_int_equal(view.clip_ns, S);
    assert_int_equal(view.time_ns, 2 * S);
    s = on(&three, s, GN_KIOSK_FRAME, 14 * S);
    assert_int_equal(gn_kiosk_view(&three, &s, 14 * S).clip_ns, 2 * S);
    view = gn_kiosk_view(&three, &s, 16 * S); /* its last second, and one of the scene */
    assert_int_equal(view.clip, -1);
    assert_int_equal(view.time_ns, 3 * S);
    s = on(&three, s, GN_KIOSK_FRAME, 16 * S);
    assert_int_equal(s.play.clip_plus_1, 0);
    assert_int_equal(gn_kiosk_view(&three, &s, 17 * S).time_ns, 4 * S);
}

/* Where nothing moves there is no frame for minutes. */
static void a_clip_begins_at_its_start_after_a_still_hour(void **state) {
    (void)state;
    struct gn_kiosk s = on(&three, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
    s = play(&three, s, 3610 * S, 4);
    struct gn_kiosk_view view = gn_kiosk_view(&three, &s, 3611 * S);
    assert_int_equal(view.clip, 4);
    assert_int_equal(view.clip_ns, S);
    assert_int_equal(view.time_ns, 3600 * S);
}

static void a_press_begins_the_clip_anew_or_is_ignored(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
    s = on(&r, play(&r, s, 10 * S, 0), GN_KIOSK_FRAME, 12 * S);
    assert_int_equal(play(&r, s, 12 * S, 1).play.time_ns, 0);
    assert_int_equal(play(&r, s, 12 * S, 1).play.clip_plus_1, 2);
    assert_int_equal(play(&r, s, 12 * S, -1).play.clip_plus_1, 1); /* no such clip */
    assert_int_equal(act(&r, s, 12 * S, GN_ACTION_NEXT).wanted.mode, 1);
    r.plays_alone = true;
    assert_int_equal(play(&r, s, 12 * S, 1).play.time_ns, 2 * S);
    struct gn_kiosk_event next = {
        .kind = GN_KIOSK_ACTION, .time_ns = 12 * S, .action = GN_ACTION_NEXT, .pressed = true};
    assert_int_equal(gn_kiosk_step(&r, &s, &next).wanted.mode, 0);
    next.pressed = false; /* a command */
    assert_int_equal(gn_kiosk_step(&r, &s, &next).wanted.mode, 1);
    s = on(&r, s, GN_KIOSK_FRAME, 14 * S); /* it has ended */
    next.pressed = true;
    assert_int_equal(gn_kiosk_step(&r, &s, &next).wanted.mode, 1);
}

static void a_mode_may_begin_its_clips_anew(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    r.restarts = 1u << 1;
    struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
    s = on(&r, s, GN_KIOSK_FRAME, 12 * S);
    assert_int_equal(gn_kiosk_view(&r, &s, 12 * S).clips_begun_ns, 0);
    s = ready(&r, act(&r, s, 13 * S, GN_ACTION_NEXT), 15 * S, 1, 0); /* no frame since 12 s */
    struct gn_kiosk_view view = gn_kiosk_view(&r, &s, 16 * S);
    assert_int_equal(view.clips_begun_ns, 5 * S);
    assert_int_equal(view.time_ns, 6 * S);
    s = on(&r, s, GN_KIOSK_FRAME, 20 * S);
    s = ready(&r, act(&r, s, 20 * S, GN_ACTION_NEXT), 20 * S, 2, 0);
    assert_int_equal(gn_kiosk_view(&r, &s, 20 * S).clips_begun_ns, 0); /* as if it never was */
    s = act(&r, s, 21 * S, GN_ACTION_PAUSE);
    s = ready(&r, act(&r, s, 25 * S, GN_ACTION_PREV), 30 * S, 1, 0);
    view = gn_kiosk_view(&r, &s, 40 * S); /* they stand at their start */
    assert_true(view.stands && view.time_ns == view.clips_begun_ns);
}

/* Its button starts the story again; that of another mode does not. */
static void a_mode_that_is_named_again_begins_its_clips(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    r.restarts = 1u << 1;
    struct gn_kiosk_event again = {
        .kind = GN_KIOSK_ACTION, .time_ns = 3600 * S, .action = GN_ACTION_MODE, .mode = 1};
    struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
    s = ready(&r, act(&r, s, 13 * S, GN_ACTION_NEXT), 15 * S, 1, 0);
    s = gn_kiosk_step(&r, &s, &again); /* after an hour without a frame */
    struct gn_kiosk_view view = gn_kiosk_view(&r, &s, 3601 * S);
    assert_int_equal(view.time_ns - view.clips_begun_ns, S);
    s = ready(&r, act(&r, s, 3610 * S, GN_ACTION_NEXT), 3610 * S, 2, 0);
    again.mode = 2;
    s = gn_kiosk_step(&r, &s, &again);
    assert_int_equal(gn_kiosk_view(&r, &s, 3611 * S).clips_begun_ns, 0);
}

/* A scene that offers its clip alone: each press plays it from its start. */
static void the_only_mode_may_be_entered_again(void **state) {
    (void)state;
    struct gn_kiosk_rules r = {.mode_count = 1, .restarts = 1, .caption_ns = S};
    for (int replays = 0; replays <= 1; replays++)
        for (int action = GN_ACTION_NEXT; action <= GN_ACTION_PREV; action++) {
            struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
            r.replays = replays;
            s = on(&r, s, GN_KIOSK_FRAME, 12 * S);
            s = act(&r, s, 15 * S, (enum gn_action_kind)action);
            const struct gn_kiosk_view view = gn_kiosk_view(&r, &s, 16 * S);
            assert_int_equal(view.time_ns, 6 * S);
            assert_int_equal(view.clips_begun_ns, replays ? 5 * S : 0);
            assert_int_equal(gn_kiosk_view(&r, &s, 15 * S).caption, GN_KIOSK_CAPTION_MODE);
        }
}

static void another_mode_ends_a_clip_and_a_pause_holds_it(void **state) {
    (void)state;
    struct gn_kiosk s = on(&three, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
    s = on(&three, play(&three, s, 10 * S, 0), GN_KIOSK_FRAME, 11 * S);
    const struct gn_kiosk held = act(&three, s, 11 * S, GN_ACTION_PAUSE);
    assert_int_equal(gn_kiosk_view(&three, &held, 99 * S).clip_ns, S);
    assert_true(gn_kiosk_view(&three, &held, 99 * S).stands);
    assert_false(play(&three, held, 50 * S, 0).paused);
    s = act(&three, s, 11 * S, GN_ACTION_NEXT);
    assert_int_equal(s.play.clip_plus_1, 1); /* until the mode is there */
    assert_int_equal(ready(&three, s, 12 * S, 1, 0).play.clip_plus_1, 0);
}

/* The clip was asked for later than the mode, whose programs take a while. */
static void a_clip_goes_on_in_the_mode_that_was_wanted_before(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
    const struct gn_kiosk waits = play(&r, act(&r, s, 10 * S, GN_ACTION_NEXT), 10 * S, 4);
    s = ready(&r, on(&r, waits, GN_KIOSK_FRAME, 11 * S), 11 * S, 1, 0);
    assert_int_equal(s.shown.mode, 1);
    assert_int_equal(gn_kiosk_view(&r, &s, 12 * S).clip, 4);
    assert_int_equal(gn_kiosk_view(&r, &s, 12 * S).clip_ns, 2 * S);
    s = ready(&r, act(&r, waits, 11 * S, GN_ACTION_NEXT), 12 * S, 2, 0);
    assert_int_equal(s.play.clip_plus_1, 0); /* but not in one that was wanted since */
    r.own_scene[1] = 2;
    s = ready(&r, waits, 11 * S, 1, 1);
    assert_int_equal(s.play.clip_plus_1, 0); /* the number of a clip of another scene */
}

static void the_idle_timeout_begins_at_the_end_of_a_clip(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    r.idle = GN_IDLE_NEXT;
    r.idle_after_ns = 2 * S;
    struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 10 * S);
    s = play(&r, on(&r, s, GN_KIOSK_TICK, 10 * S), 10 * S, 0);
    assert_true(gn_kiosk_deadline(&r, &s) > 100 * S);
    s = on(&r, on(&r, s, GN_KIOSK_FRAME, 12900 * S / 1000), GN_KIOSK_TICK, 12900 * S / 1000);
    assert_int_equal(s.wanted.mode, 0);
    s = on(&r, s, GN_KIOSK_FRAME, 13 * S);
    assert_int_equal(gn_kiosk_deadline(&r, &s), 15 * S);
    assert_int_equal(on(&r, s, GN_KIOSK_TICK, 15 * S).wanted.mode, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_clip_plays_once_and_the_scene_goes_on_where_it_was),
        cmocka_unit_test(a_clip_begins_at_its_start_after_a_still_hour),
        cmocka_unit_test(a_press_begins_the_clip_anew_or_is_ignored),
        cmocka_unit_test(a_mode_may_begin_its_clips_anew),
        cmocka_unit_test(a_mode_that_is_named_again_begins_its_clips),
        cmocka_unit_test(the_only_mode_may_be_entered_again),
        cmocka_unit_test(another_mode_ends_a_clip_and_a_pause_holds_it),
        cmocka_unit_test(a_clip_goes_on_in_the_mode_that_was_wanted_before),
        cmocka_unit_test(the_idle_timeout_begins_at_the_end_of_a_clip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
