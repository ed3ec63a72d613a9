/* A message instead of frames: it waits for no flip, survives all events, and ends on request. */
#include <errno.h>
#include <string.h>

#include "client.h"
#include "unit/check.h"

enum { GROUND = 0x00202428 }; /* background of message.c */

static struct client c;
static const struct client_kind kinds[] = {
    {.name = "atomic", .traits = {.console = true}},
    {.name = "fences", .traits = {.modifiers = true, .fences = true}},
    {.name = "legacy", .traits = {.console = true, .legacy = true}},
    {.name = "no vblank", .traits = {.no_vblank = true}},
    {.name = "copies", .gpu = {.no_surface = {true, true, true}}},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void begin(const struct client_kind *kind) { client_begin(&c, kind, SIM_FULL_HD); }
static void end(const struct client_kind *kind) { client_end(&c, kind); }

static void say(const char *text) {
    c.told_ns = sim_now();
    gn_kms_show_message(c.kms, text, c.told_ns);
}

static void expect_notice(const struct client_kind *kind, const char *text) {
    if (!sim_shows(GROUND)) fail_msg("%s: message not visible", kind->name);
    assert_string_equal(client_screen(&c)->status, text);
    assert_false(client_screen(&c)->may_draw);
}

static void expect_right(const struct client_kind *kind) {
    int64_t took_ns;
    if (!client_settle(&c, SIM_S, &took_ns))
        fail_msg("%s: wrong picture: %s", kind->name, client_screen(&c)->status);
}

/* At every millisecond of two refreshes. */
static void test_message_waits_for_no_flip(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++)
        for (int64_t at = 0; at < 40; at++) {
            begin(&kinds[i]);
            client_run(&c, SIM_S + at * SIM_MS);
            const int64_t from_ns = sim_now();
            const long waits = sim_counts.waits;
            say("no such scene");
            assert_true(sim_now() - from_ns < 20 * SIM_MS); /* at most a modeset */
            client_run(&c, 100 * SIM_MS);
            expect_notice(&kinds[i], "no such scene");
            assert_int_equal(sim_counts.waits, waits);
            say(NULL);
            expect_right(&kinds[i]);
            end(&kinds[i]);
        }
}

static void test_successive_messages(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        begin(&kinds[i]);
        say("one");
        say("two");
        client_run(&c, 100 * SIM_MS);
        expect_notice(&kinds[i], "two");
        say("three");
        say(NULL);
        say(NULL); /* without a message */
        expect_right(&kinds[i]);
        say(NULL);
        expect_right(&kinds[i]);
        end(&kinds[i]);
    }
}

static void test_message_survives_events(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        begin(&kinds[i]);
        say("no such scene");
        client_run(&c, SIM_S);
        sim_plug(0, 0, SIM_NO_MONITOR);
        client_run(&c, 3 * SIM_S);
        sim_plug(0, 0, SIM_SMALL);
        client_run(&c, 3 * SIM_S);
        expect_notice(&kinds[i], "no such scene");
        client_leave_console(&c);
        client_run(&c, SIM_S);
        client_enter_console(&c);
        client_run(&c, SIM_S);
        expect_notice(&kinds[i], "no such scene");
        client_blank(&c, true);
        client_run(&c, SIM_S);
        assert_true(sim_is_dark());
        say("no such camera");
        client_run(&c, SIM_S);
        assert_true(sim_is_dark());
        client_blank(&c, false);
        client_run(&c, SIM_S);
        expect_notice(&kinds[i], "no such camera");
        client_run(&c, 60 * SIM_S);
        expect_notice(&kinds[i], "no such camera");
        say(NULL);
        expect_right(&kinds[i]);
        end(&kinds[i]);
    }
}

/* The flip's event never comes: after the recovery the message is shown. */
static void test_message_after_lost_flip(void **state) {
    (void)state;
    begin(&kinds[0]);
    sim_stall(0, SIM_STALLS_UNTIL_RELIT);
    client_run(&c, 100 * SIM_MS);
    say("no such scene");
    client_run(&c, 14 * SIM_S);
    expect_notice(&kinds[0], "no such scene");
    say(NULL);
    expect_right(&kinds[0]);
    end(&kinds[0]);
}

/* Without GL the reason is shown until GL starts. */
static void test_message_without_gl(void **state) {
    (void)state;
    sim_begin();
    sim_set_gpu(&(struct sim_gpu){.no_gl = true});
    sim_add_card(0, "/dev/dri/card0", &(struct sim_traits){.console = true});
    sim_plug(0, 0, SIM_FULL_HD);
    client_open(&c, &(struct gn_screen_opts){0});
    client_run(&c, SIM_S);
    assert_true(sim_shows(GROUND));
    assert_non_null(strstr(client_screen(&c)->status, "GL does not start"));
    say(NULL);
    client_run(&c, SIM_S);
    assert_true(sim_shows(GROUND));
    say("no such scene");
    client_run(&c, SIM_S);
    expect_notice(&kinds[0], "/dev/dri/card0: GL does not start");
    sim_set_gpu(&(struct sim_gpu){0});
    client_run(&c, 11 * SIM_S);
    expect_right(&kinds[0]);
    end(&kinds[0]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_message_waits_for_no_flip),
        cmocka_unit_test(test_successive_messages),
        cmocka_unit_test(test_message_survives_events),
        cmocka_unit_test(test_message_after_lost_flip),
        cmocka_unit_test(test_message_without_gl),
    };
    return RUN(tests);
}
