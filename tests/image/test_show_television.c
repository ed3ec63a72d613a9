/* A kiosk whose screen goes dark and comes back, and what its television is told of it: once each
 * time. The kiosk's clock is fake, so that nights pass; the television's thread has its own. */
#include "unit/check.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "unit/cec_fake.h"
#include "unit/gl_help.h"
#include "unit/show_help.h"

#define SECONDS(n) ((n)*GN_NS_PER_S)

static int64_t clock_ns;

static struct gn_show *open_show(const char *config) {
    struct gn_show *show = help_show_of(config, (const char *const[]){"--no-animation", NULL});
    clock_ns = gn_clock_monotonic_ns();
    gn_loop_fake_clock(show->loop, &clock_ns);
    return show;
}

/* The adapter that was configured is replaced by the fake. */
static void take_fake(struct gn_show *show, struct cec_fake *fake) {
    static struct gn_television_opts opts;
    opts = (struct gn_television_opts){
        .cec = {.ops = &cec_fake_ops, .context = fake, .drm = "/nonexistent"},
        .second_ns = GN_NS_PER_S / 500};
    gn_part_close(&show->parts, GN_PART_television);
    show->parts.host.television = &opts;
    gn_part_open(&show->parts, GN_PART_television);
}

/* What the status has of the television; NULL: it has none. */
static const char *status_of(struct gn_show *show, const char *key) {
    static char text[200];
    json_t *all = gn_parts_status(&show->parts, false);
    const json_t *value = json_object_get(json_object_get(all, "television"), key);
    snprintf(text, sizeof text, "%s", value ? json_string_value(value) : "");
    json_decref(all);
    return value ? text : NULL;
}

static void run_until(struct gn_show *show, int64_t until_ns) {
    struct gn_timer end = {.due_ns = until_ns};
    gn_loop_add_timer(show->loop, &end);
    for (int steps = 0; clock_ns < until_ns; steps++) {
        help_show_step(show);
        assert_true(steps < 100000); /* or time stands still */
    }
    gn_loop_remove_timer(&end);
}

/* Until the thread has told it, and a little longer. */
static void is_told(struct cec_fake *fake, int times_on, int times_standby) {
    for (int i = 0; i < 60000; i++, usleep(1000))
        if (cec_fake_count(fake, "40:04") >= times_on &&
            cec_fake_count(fake, "40:36") >= times_standby)
            break;
    usleep(20000);
    assert_int_equal(cec_fake_count(fake, "40:04"), times_on);
    assert_int_equal(cec_fake_count(fake, "40:36"), times_standby);
}

static void act(struct gn_show *show, enum gn_action_kind kind, enum gn_turn turn, bool pressed) {
    gn_show_act(&show->screen, &(struct gn_action){.kind = kind, .turn = turn, .pressed = pressed},
                clock_ns);
    run_until(show, clock_ns + SECONDS(1));
}

static void set_hours(struct gn_show *show, bool ended) {
    const struct gn_kiosk_event event = {.kind = GN_KIOSK_HOURS, .time_ns = clock_ns, .by = ended};
    show->screen.kiosk = gn_kiosk_step(&show->screen.rules, &show->screen.kiosk, &event);
    run_until(show, clock_ns + SECONDS(1));
}

static void each_night_is_one_standby_and_each_press_one_waking(void **state) {
    (void)state;
    struct gn_show *show =
        open_show("[schedule]\noff = cec\ncec_device = /dev/null\nwake = 60\nclock = trusted\n"
                  "[mode \"a\"]\nshadow = none\n");
    struct cec_fake *fake = cec_fake_new();
    take_fake(show, fake);
    help_show_step(show);
    is_told(fake, 1, 0); /* at the start */
    set_hours(show, true);
    is_told(fake, 1, 1);
    assert_true(show->screen.stage.display.screen.blank); /* its picture is off as well */
    run_until(show, clock_ns + SECONDS(8 * 3600));
    for (int i = 0; i < 1000; i++) set_hours(show, true); /* as each look at the clock finds */
    is_told(fake, 1, 1);
    act(show, GN_ACTION_NEXT, GN_TURN_OTHER, true);
    is_told(fake, 2, 1);
    run_until(show, clock_ns + SECONDS(61)); /* awake for a minute */
    is_told(fake, 2, 2);
    act(show, GN_ACTION_BLANK, GN_TURN_OFF, false);
    is_told(fake, 3, 2);
    act(show, GN_ACTION_BLANK, GN_TURN_ON, false);
    is_told(fake, 3, 3);
    set_hours(show, false);
    is_told(fake, 4, 3);
    assert_false(show->screen.stage.display.screen.blank);
    gn_show_close(show);
}

static void a_reload_tells_nothing_again(void **state) {
    (void)state;
    struct gn_show *show = open_show("[schedule]\noff = cec-black\ncec_device = /dev/null\n"
                                     "[mode \"a\"]\nshadow = none\n");
    struct cec_fake *fake = cec_fake_new();
    take_fake(show, fake);
    assert_true(show->screen.rules.sleeps_black);
    set_hours(show, true);
    is_told(fake, 0, 1);
    assert_false(show->screen.stage.display.screen.blank);         /* black */
    gn_part_television.reopen(show->parts.of[GN_PART_television]); /* what a reload does */
    help_show_step(show);
    is_told(fake, 0, 1);
    gn_show_close(show);
}

/* Steps until the status has the problem, or none. */
static void problem_becomes(struct gn_show *show, bool is_there) {
    for (int i = 0; i < 60000; i++, usleep(1000)) {
        help_show_step(show);
        const char *text = gn_problem_last(&show->problems);
        if ((text && strstr(text, "/dev/")) == is_there) return;
    }
    fail_msg("the problem is \"%s\"", gn_problem_last(&show->problems));
}

static void its_problem_is_named_until_it_is_cured(void **state) {
    (void)state;
    struct gn_show *show = open_show("[schedule]\noff = cec\ncec_device = /dev/null\n"
                                     "[mode \"a\"]\nshadow = none\n");
    struct cec_fake *fake = cec_fake_new();
    fake->nacks = -1;
    take_fake(show, fake);
    problem_becomes(show, true);
    assert_non_null(
        strstr(gn_problem_last(&show->problems), "the television at /dev/cec0 does not answer"));
    cec_fake_lock();
    fake->nacks = 0;
    cec_fake_unlock();
    problem_becomes(show, false);
    assert_null(gn_problem_last(&show->problems));
    assert_string_equal(status_of(show, "told"), "on");

    /* one of something else is not taken away */
    cec_fake_lock();
    fake->nacks = -1;
    cec_fake_unlock();
    act(show, GN_ACTION_BLANK, GN_TURN_ON, false);
    problem_becomes(show, true);
    gn_problem_report(&show->problems, GN_PROBLEM_ACTION, "something else");
    cec_fake_lock();
    fake->nacks = 0;
    cec_fake_unlock();
    act(show, GN_ACTION_BLANK, GN_TURN_OFF, false);
    for (int i = 0; i < 60000 && strcmp(status_of(show, "told"), "on") != 0; i++) {
        help_show_step(show);
        usleep(1000);
    }
    assert_string_equal(gn_problem_last(&show->problems), "something else");
    gn_show_close(show);
}

static void other_ways_of_off_tell_nothing(void **state) {
    (void)state;
    struct gn_show *show = open_show("[schedule]\noff = dpms\ncec_device = /dev/null\n"
                                     "[mode \"a\"]\nshadow = none\n");
    help_show_step(show);
    assert_null(status_of(show, "told"));
    gn_show_close(show);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_night_is_one_standby_and_each_press_one_waking),
        cmocka_unit_test(a_reload_tells_nothing_again),
        cmocka_unit_test(its_problem_is_named_until_it_is_cured),
        cmocka_unit_test(other_ways_of_off_tell_nothing),
    };
    return RUN(tests);
}
