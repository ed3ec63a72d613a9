/* The machine that decides what a kiosk shows: by hand, then at random against what must hold. */
#include "unit/check.h"

#include <stdlib.h>
#include <string.h>

#include "options/binding.h"
#include "unit/kiosk_help.h"

static void the_old_mode_is_shown_until_the_new_one_is_ready(void **state) {
    (void)state;
    struct gn_kiosk s = act(&three, (struct gn_kiosk){0}, S, GN_ACTION_NEXT);
    assert_true(gn_kiosk_waits(&s));
    assert_int_equal(gn_kiosk_view(&three, &s, S).mode, 0);
    assert_int_equal(gn_kiosk_view(&three, &s, S).caption, GN_KIOSK_CAPTION_MODE);
    assert_int_equal(gn_kiosk_view(&three, &s, S).caption_mode, 1);
    s = ready(&three, s, 2 * S, 2, 0); /* not what is wanted */
    assert_int_equal(s.shown.mode, 0);
    s = ready(&three, s, 2 * S, 1, 0);
    assert_int_equal(gn_kiosk_view(&three, &s, 2 * S).mode, 1);
    assert_false(gn_kiosk_waits(&s));
}

static void a_lesson_names_its_first_step(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_FRAME, S);
    assert_int_equal(gn_kiosk_view(&r, &s, S).caption, GN_KIOSK_CAPTION_NONE);
    r.names_first = true;
    s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_FRAME, S);
    assert_int_equal(gn_kiosk_view(&r, &s, S).caption, GN_KIOSK_CAPTION_MODE);
    assert_int_equal(gn_kiosk_view(&r, &s, S).caption_mode, 0);
    s = on(&r, on(&r, s, GN_KIOSK_FRAME, 2 * S), GN_KIOSK_TICK, 3 * S);
    assert_int_equal(gn_kiosk_view(&r, &s, 3 * S).caption, GN_KIOSK_CAPTION_NONE);
}

static void presses_while_something_loads_add_up(void **state) {
    (void)state;
    struct gn_kiosk s = {0};
    for (int i = 0; i < 2; i++) s = act(&three, s, S, GN_ACTION_NEXT);
    assert_int_equal(s.wanted.mode, 2);
    s = act(&three, s, S, GN_ACTION_NEXT);
    assert_false(gn_kiosk_waits(&s)); /* round, and home again */
    s = act(&three, s, S, GN_ACTION_PREV);
    assert_int_equal(s.wanted.mode, 2);
}

static void the_scenes_speed_doubles_and_halves(void **state) {
    (void)state;
    struct gn_kiosk s = on(&three, (struct gn_kiosk){0}, GN_KIOSK_FRAME, S);
    for (int i = 0; i < 2; i++)
        s = gn_kiosk_step(&three, &s, &(struct gn_kiosk_event){.kind = GN_KIOSK_SPEED, .by = 1});
    assert_int_equal(gn_kiosk_view(&three, &s, 2 * S).time_ns, 4 * S);
    s = on(&three, s, GN_KIOSK_FRAME, 2 * S);
    for (int i = 0; i < 3; i++)
        s = gn_kiosk_step(&three, &s, &(struct gn_kiosk_event){.kind = GN_KIOSK_SPEED, .by = -1});
    assert_int_equal(gn_kiosk_view(&three, &s, 4 * S).time_ns, 5 * S);
    for (int i = 0; i < 100; i++)
        s = gn_kiosk_step(&three, &s, &(struct gn_kiosk_event){.kind = GN_KIOSK_SPEED, .by = 1});
    assert_int_equal(s.speed, GN_KIOSK_SPEED_MOST);
}

static void a_camera_that_is_chosen_has_a_caption(void **state) {
    (void)state;
    const struct gn_kiosk s =
        gn_kiosk_step(&three, &(struct gn_kiosk){.camera = 1},
                      &(struct gn_kiosk_event){.kind = GN_KIOSK_CAMERA, .time_ns = S, .camera = 4});
    assert_int_equal(s.camera, 4);
    assert_int_equal(gn_kiosk_view(&three, &s, S).caption, GN_KIOSK_CAPTION_CAMERA);
}

static void a_note_replaces_a_caption_for_its_time(void **state) {
    (void)state;
    struct gn_kiosk s = act(&three, (struct gn_kiosk){0}, S, GN_ACTION_NEXT);
    s = gn_kiosk_step(&three, &s,
                      &(struct gn_kiosk_event){.kind = GN_KIOSK_NOTE,
                                               .time_ns = 2 * S,
                                               .caption = GN_KIOSK_CAPTION_NOTE});
    assert_int_equal(gn_kiosk_view(&three, &s, 3 * S).caption, GN_KIOSK_CAPTION_NOTE);
    assert_int_equal(gn_kiosk_view(&three, &s, 4 * S).caption, GN_KIOSK_CAPTION_NONE);
}

static void blank_swallows_the_first_action(void **state) {
    (void)state;
    struct gn_kiosk s = act(&three, (struct gn_kiosk){0}, S, GN_ACTION_BLANK);
    assert_true(gn_kiosk_view(&three, &s, S).dark);
    s = act(&three, s, 2 * S, GN_ACTION_NEXT);
    assert_false(gn_kiosk_view(&three, &s, 2 * S).dark);
    assert_int_equal(s.wanted.mode, 0);
    s = act(&three, s, 3 * S, GN_ACTION_NEXT);
    assert_int_equal(s.wanted.mode, 1);
}

static void a_pause_stands_and_goes_on_from_there(void **state) {
    (void)state;
    struct gn_kiosk s = on(&three, (struct gn_kiosk){0}, GN_KIOSK_FRAME, 100 * S);
    assert_int_equal(gn_kiosk_view(&three, &s, 100 * S).time_ns, 0);
    s = on(&three, s, GN_KIOSK_FRAME, 103 * S);
    s = act(&three, s, 103 * S, GN_ACTION_PAUSE);
    assert_int_equal(gn_kiosk_view(&three, &s, 105 * S).time_ns, 3 * S);
    s = on(&three, s, GN_KIOSK_FRAME, 110 * S);
    assert_int_equal(gn_kiosk_view(&three, &s, 111 * S).time_ns, 3 * S);
    s = act(&three, s, 200 * S, GN_ACTION_PAUSE);
    assert_int_equal(gn_kiosk_view(&three, &s, 201 * S).time_ns, 4 * S);
    s = on(&three, s, GN_KIOSK_FRAME, 201 * S);
    assert_int_equal(gn_kiosk_view(&three, &s, 202 * S).time_ns, 5 * S);
}

static void a_bad_scene_leaves_the_one_that_is_shown(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    r.scene_count = 3;
    struct gn_kiosk s = act(&r, (struct gn_kiosk){0}, S, GN_ACTION_NEXT_SCENE);
    const struct gn_kiosk_event failed = {.kind = GN_KIOSK_SCENE_FAILED, .time_ns = S, .scene = 1};
    s = gn_kiosk_step(&r, &s, &failed);
    assert_false(gn_kiosk_waits(&s));
    assert_int_equal(gn_kiosk_view(&r, &s, S).caption, GN_KIOSK_CAPTION_PROBLEM);
    s = act(&r, s, S, GN_ACTION_NEXT_SCENE); /* the one behind it */
    assert_int_equal(s.wanted.scene, 2);
    s = ready(&r, s, S, 0, 2);
    s = act(&r, s, S, GN_ACTION_NEXT_SCENE);
    assert_int_equal(s.wanted.scene, 0);
}

static void the_only_other_scene_is_tried_again(void **state) {
    (void)state;
    struct gn_kiosk s = {.bad_scenes = 2};
    s = act(&three, s, S, GN_ACTION_NEXT_SCENE);
    assert_int_equal(s.wanted.scene, 1);
    assert_int_equal(s.bad_scenes, 0);
}

static void a_mode_may_have_a_scene_of_its_own(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    r.own_scene[1] = 1 + 5;
    r.own_camera = 1 << 2;
    struct gn_kiosk s = act(&r, (struct gn_kiosk){0}, S, GN_ACTION_NEXT_CAMERA);
    s = act(&r, s, S, GN_ACTION_NEXT);
    s = ready(&r, s, S, 1, 0);
    assert_true(gn_kiosk_waits(&s)); /* that was the wrong scene */
    s = ready(&r, s, S, 1, 5);
    assert_int_equal(gn_kiosk_view(&r, &s, S).scene, 5);
    assert_int_equal(s.camera, 0);
    const struct gn_kiosk_event failed = {.kind = GN_KIOSK_SCENE_FAILED, .time_ns = S, .scene = 5};
    s = act(&r, (struct gn_kiosk){0}, S, GN_ACTION_NEXT);
    s = gn_kiosk_step(&r, &s, &failed);
    assert_int_equal(s.wanted.mode, 0);
    s = act(&r, s, S, GN_ACTION_NEXT);
    assert_int_equal(s.wanted.mode, 2);
    s = act(&r, s, S, GN_ACTION_NEXT_CAMERA);
    s = ready(&r, s, S, 2, 0);
    assert_int_equal(s.camera, 0); /* it names its camera */
}

static void a_mode_that_does_not_compile_is_passed_over(void **state) {
    (void)state;
    struct gn_kiosk s = act(&three, (struct gn_kiosk){0}, S, GN_ACTION_NEXT);
    const struct gn_kiosk_event failed = {.kind = GN_KIOSK_MODE_FAILED, .time_ns = S, .mode = 1};
    s = gn_kiosk_step(&three, &s, &failed);
    assert_false(gn_kiosk_waits(&s));
    s = act(&three, s, S, GN_ACTION_NEXT);
    assert_int_equal(s.wanted.mode, 2);
}

/* However long its programs took, the name stands with its picture for the time of a caption. */
static void a_caption_begins_anew_with_what_it_names(void **state) {
    (void)state;
    struct gn_kiosk s = act(&three, (struct gn_kiosk){0}, S, GN_ACTION_NEXT);
    assert_true(gn_kiosk_view(&three, &s, S).mode != gn_kiosk_view(&three, &s, S).caption_mode);
    s = ready(&three, s, 2 * S, 1, 0);
    s = on(&three, s, GN_KIOSK_TICK, 3 * S + S / 2);
    assert_int_equal(gn_kiosk_view(&three, &s, 3 * S + S / 2).caption, GN_KIOSK_CAPTION_MODE);
    s = on(&three, s, GN_KIOSK_TICK, 4 * S);
    assert_int_equal(gn_kiosk_view(&three, &s, 4 * S).caption, GN_KIOSK_CAPTION_NONE);
    s = on(&three, s, GN_KIOSK_TICK, 5 * S); /* without one none is made */
    s = act(&three, s, 5 * S, GN_ACTION_NEXT);
    s = on(&three, s, GN_KIOSK_TICK, 8 * S);
    s = ready(&three, s, 9 * S, 2, 0);
    assert_int_equal(gn_kiosk_view(&three, &s, 9 * S).caption, GN_KIOSK_CAPTION_NONE);
}

static void captions_and_fades_end(void **state) {
    (void)state;
    struct gn_kiosk s = act(&three, (struct gn_kiosk){0}, S, GN_ACTION_NEXT);
    s = ready(&three, s, S, 1, 0);
    assert_float_equal(gn_kiosk_view(&three, &s, S).old, 1.0f, 0.0f);
    assert_float_equal(gn_kiosk_view(&three, &s, S + S / 4).old, 0.5f, 1e-6f);
    assert_int_equal(gn_kiosk_deadline(&three, &s), S + S / 2);
    s = on(&three, s, GN_KIOSK_TICK, S + S / 2);
    assert_float_equal(gn_kiosk_view(&three, &s, 2 * S).old, 0.0f, 0.0f);
    assert_int_equal(gn_kiosk_deadline(&three, &s), 3 * S);
    s = on(&three, s, GN_KIOSK_TICK, 3 * S);
    assert_int_equal(gn_kiosk_view(&three, &s, 3 * S).caption, GN_KIOSK_CAPTION_NONE);
    assert_int_equal(gn_kiosk_deadline(&three, &s), INT64_MAX);
}

static void idleness_goes_to_the_first_or_to_the_next(void **state) {
    (void)state;
    struct gn_kiosk_rules r = three;
    r.idle = GN_IDLE_FIRST;
    r.idle_after_ns = 60 * S;
    struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_TICK, S);
    s = act(&r, s, 10 * S, GN_ACTION_NEXT);
    s = ready(&r, s, 10 * S, 1, 0);
    s = act(&r, s, 20 * S, GN_ACTION_PAUSE);
    assert_int_equal(on(&r, s, GN_KIOSK_TICK, 79 * S).wanted.mode, 1);
    assert_int_equal(on(&r, s, GN_KIOSK_TICK, 80 * S).wanted.mode, 0);
    assert_false(on(&r, s, GN_KIOSK_TICK, 80 * S).paused);
    r.idle = GN_IDLE_NEXT;
    s = on(&r, s, GN_KIOSK_TICK, 80 * S);
    assert_int_equal(s.wanted.mode, 2);
    s = on(&r, s, GN_KIOSK_TICK, 139 * S);
    assert_int_equal(s.wanted.mode, 2);
    s = act(&r, s, 140 * S, GN_ACTION_BLANK);
    s = on(&r, s, GN_KIOSK_TICK, 1000 * S);
    assert_true(s.blanked); /* the dark is left alone */
    assert_int_equal(s.wanted.mode, 2);
}

static void steps_of_the_sun_add_up_until_now_or_idleness(void **state) {
    (void)state;
    const int64_t hundred_years_s = 36525 * INT64_C(86400);
    const struct {
        int64_t step_s, ahead_s;
    } rows[] = {{3600, 3600},
                {-900, 2700},
                {0, 0},
                {hundred_years_s, hundred_years_s},
                {3600, hundred_years_s}, /* no farther */
                {-86400, hundred_years_s - 86400}};
    for (int idle = GN_IDLE_NONE; idle <= GN_IDLE_NEXT; idle++) {
        struct gn_kiosk_rules r = three;
        r.idle = (enum gn_idle)idle;
        r.idle_after_ns = 60 * S;
        struct gn_kiosk s = on(&r, (struct gn_kiosk){0}, GN_KIOSK_TICK, S);
        for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
            const struct gn_kiosk_event event = {.kind = GN_KIOSK_ACTION,
                                                 .time_ns = 2 * S,
                                                 .action = GN_ACTION_SUN,
                                                 .sun_s = rows[i].step_s};
            s = gn_kiosk_step(&r, &s, &event);
            assert_true(s.sun_ahead_s == rows[i].ahead_s);
            assert_int_equal(gn_kiosk_view(&r, &s, 3 * S).caption, GN_KIOSK_CAPTION_SUN);
        }
        s = on(&r, s, GN_KIOSK_TICK, 70 * S);
        assert_true((s.sun_ahead_s == 0) == (idle != GN_IDLE_NONE));
    }
}

static void idleness_closes_the_info_page(void **state) {
    (void)state;
    static const enum gn_idle ways[] = {GN_IDLE_FIRST, GN_IDLE_NEXT};
    for (int i = 0; i < 2; i++) {
        struct gn_kiosk_rules r = three;
        r.idle = ways[i];
        r.idle_after_ns = 60 * S;
        struct gn_kiosk s = act(&r, (struct gn_kiosk){0}, 10 * S, GN_ACTION_INFO);
        s = on(&r, s, GN_KIOSK_TICK, 69 * S);
        assert_true(gn_kiosk_view(&r, &s, 69 * S).info);
        s = on(&r, s, GN_KIOSK_TICK, 70 * S);
        assert_false(gn_kiosk_view(&r, &s, 70 * S).info);
    }
}

/* ---- at random ---- */

static uint32_t dice(uint64_t *seed, uint32_t sides) {
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(*seed >> 33) % sides;
}

static struct gn_kiosk_rules some_rules(uint64_t *seed) {
    struct gn_kiosk_rules r = {.mode_count = 1 + (int)dice(seed, GN_KIOSK_MODES_MAX),
                               .scene_count = 1 + (int)dice(seed, 5),
                               .own_camera = dice(seed, UINT32_MAX),
                               .fade_ns = dice(seed, 2) * S / 4,
                               .caption_ns = 2 * S};
    return r;
}

static void check_state(const struct gn_kiosk_rules *r, const struct gn_kiosk *s) {
    assert_in_range(s->shown.mode, 0, r->mode_count - 1);
    assert_in_range(s->wanted.mode, 0, r->mode_count - 1);
    assert_in_range(s->shown.scene, 0, r->scene_count - 1);
    assert_in_range(s->wanted.scene, 0, r->scene_count - 1);
}

/* However loads and presses fall among each other: in the end the mode is the sum of the presses
 * that were not swallowed by the dark, time has never run backwards, nor while it stood. */
static void no_press_is_lost_and_none_counts_twice(void **state) {
    (void)state;
    for (uint64_t life = 1; life <= 2000; life++) {
        uint64_t seed = life;
        const struct gn_kiosk_rules r = some_rules(&seed);
        struct gn_kiosk s = {0};
        int modes = 0, scenes = 0;
        int64_t now = S, last_ns = 0;
        bool stands = false;
        for (int i = 0; i < 300; i++) {
            static const enum gn_action_kind actions[] = {
                GN_ACTION_NEXT,  GN_ACTION_PREV,        GN_ACTION_NEXT_SCENE, GN_ACTION_PAUSE,
                GN_ACTION_BLANK, GN_ACTION_NEXT_CAMERA, GN_ACTION_INFO};
            const uint32_t kind = dice(&seed, 4);
            const bool dark = s.blanked;
            now += dice(&seed, 40) * (S / 100);
            if (kind == 0) {
                const enum gn_action_kind a = actions[dice(&seed, 7)];
                modes += dark ? 0 : a == GN_ACTION_NEXT ? 1 : a == GN_ACTION_PREV ? -1 : 0;
                scenes += !dark && a == GN_ACTION_NEXT_SCENE;
                s = act(&r, s, now, a);
                stands &= s.paused;
            } else if (kind == 1) {
                const bool right = dice(&seed, 2);
                s = ready(&r, s, now, right ? s.wanted.mode : (int)dice(&seed, 32),
                          gn_kiosk_scene(&r, &s.wanted));
            } else
                s = on(&r, s, kind == 2 ? GN_KIOSK_FRAME : GN_KIOSK_TICK, now);
            if (kind == 2) { /* what was seen */
                const int64_t time_ns = gn_kiosk_view(&r, &s, now).time_ns;
                assert_true(time_ns >= last_ns);
                if (stands && s.paused) assert_int_equal(time_ns, last_ns);
                stands = s.paused;
                last_ns = time_ns;
            }
            check_state(&r, &s);
        }
        s = ready(&r, s, now, s.wanted.mode, gn_kiosk_scene(&r, &s.wanted));
        assert_int_equal(s.shown.mode, (modes % r.mode_count + r.mode_count) % r.mode_count);
        assert_int_equal(s.shown.scene, scenes % r.scene_count);
    }
}

/* ---- bindings ---- */

static void the_default_buttons_do_what_the_design_says(void **state) {
    (void)state;
    struct gn_buttons buttons;
    struct gn_button_opts opts[GN_BUTTONS_MAX];
    gn_buttons_defaults(&buttons);
    assert_int_equal(gn_buttons_opts(&buttons, opts), buttons.count);
    for (int i = 0; i < buttons.count; i++) {
        const struct gn_gesture_event press = {.button = i, .gesture = GN_GESTURE_PRESS},
                                      hold = {.button = i, .gesture = GN_GESTURE_HOLD};
        const enum gn_action_kind does = gn_buttons_action(&buttons, &press).kind;
        assert_int_equal(opts[i].gestures, 1 << GN_GESTURE_PRESS);
        assert_int_not_equal(does, GN_ACTION_NONE);
        assert_int_equal(gn_buttons_action(&buttons, &hold).kind, GN_ACTION_NONE);
        if (opts[i].line && strcmp(opts[i].line, "GPIO17") == 0)
            assert_int_equal(does, GN_ACTION_NEXT);
        if (opts[i].line && strcmp(opts[i].line, "GPIO27") == 0)
            assert_int_equal(does, GN_ACTION_PREV);
        if (opts[i].line) assert_true(opts[i].optional);
    }
    const struct gn_gesture_event beyond = {.button = buttons.count};
    assert_int_equal(gn_buttons_action(&buttons, &beyond).kind, GN_ACTION_NONE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_old_mode_is_shown_until_the_new_one_is_ready),
        cmocka_unit_test(a_lesson_names_its_first_step),
        cmocka_unit_test(presses_while_something_loads_add_up),
        cmocka_unit_test(the_scenes_speed_doubles_and_halves),
        cmocka_unit_test(a_camera_that_is_chosen_has_a_caption),
        cmocka_unit_test(a_note_replaces_a_caption_for_its_time),
        cmocka_unit_test(blank_swallows_the_first_action),
        cmocka_unit_test(a_pause_stands_and_goes_on_from_there),
        cmocka_unit_test(a_bad_scene_leaves_the_one_that_is_shown),
        cmocka_unit_test(the_only_other_scene_is_tried_again),
        cmocka_unit_test(a_mode_may_have_a_scene_of_its_own),
        cmocka_unit_test(a_mode_that_does_not_compile_is_passed_over),
        cmocka_unit_test(a_caption_begins_anew_with_what_it_names),
        cmocka_unit_test(captions_and_fades_end),
        cmocka_unit_test(idleness_goes_to_the_first_or_to_the_next),
        cmocka_unit_test(steps_of_the_sun_add_up_until_now_or_idleness),
        cmocka_unit_test(idleness_closes_the_info_page),
        cmocka_unit_test(no_press_is_lost_and_none_counts_twice),
        cmocka_unit_test(the_default_buttons_do_what_the_design_says),
    };
    return RUN(tests);
}
