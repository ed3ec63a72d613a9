/* Blanking: the screen stays dark through all events, does not fail over time, and returns at once.
 */
#include <errno.h>
#include <stdlib.h>

#include "client.h"
#include "unit/check.h"

static struct client c;

static const struct client_kind kinds[] = {
    {.name = "atomic", .traits = {.console = true}},
    {.name = "fences", .traits = {.console = true, .modifiers = true, .fences = true}},
    {.name = "legacy", .traits = {.console = true, .legacy = true}},
    {.name = "legacy by option", .opts = {.legacy = true}},
    {.name = "no vblank", .traits = {.no_vblank = true}},
    {.name = "copies", .gpu = {.no_surface = {true, true, true}}},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void begin(const struct client_kind *kind, int monitor) { client_begin(&c, kind, monitor); }
static void end(const struct client_kind *kind) { client_end(&c, kind); }

static void expect_dark(const struct client_kind *kind) {
    const struct gn_screen *s = client_screen(&c);
    if (!sim_is_dark()) fail_msg("%s: screen not dark: %s", kind->name, s->status);
    assert_true(s->blank);
    assert_false(s->lit || s->may_draw);
}

static void expect_right(const struct client_kind *kind) {
    int64_t took_ns;
    if (!client_settle(&c, SIM_S, &took_ns))
        fail_msg("%s: wrong picture: %s", kind->name, client_screen(&c)->status);
    assert_false(client_screen(&c)->blank);
}

/* Much longer than the recovery from a lost flip. */
static void test_long_blank(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        begin(&kinds[i], SIM_FULL_HD);
        client_blank(&c, true);
        client_run(&c, SIM_S);
        expect_dark(&kinds[i]);
        const long frames = c.frames, flips = sim_counts.flips, calls = sim_counts.all_calls;
        const uint64_t opened = client_screen(&c)->counts.opened;
        client_run(&c, 600 * SIM_S);
        expect_dark(&kinds[i]);
        assert_string_equal(client_screen(&c)->status, "switched off");
        assert_int_equal(c.frames, frames);
        assert_int_equal(sim_counts.flips, flips);
        assert_in_range(sim_counts.all_calls, calls, calls + 600); /* it is idle, too */
        assert_false(c.gave_up);
        assert_int_equal(client_screen(&c)->counts.opened, opened);
        const uint32_t last = c.colour;
        client_blank(&c, false);
        if (!sim_shows(last)) fail_msg("%s: last frame not shown at once", kinds[i].name);
        assert_true(client_screen(&c)->lit);
        expect_right(&kinds[i]);
        assert_int_equal(client_screen(&c)->counts.stalled, 0);
        end(&kinds[i]);
    }
}

static void test_blank_during_flip(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++)
        for (int64_t at = 0; at < 20; at++) {
            begin(&kinds[i], SIM_FULL_HD);
            client_run(&c, SIM_S + at * SIM_MS);
            client_blank(&c, true);
            client_run(&c, at * SIM_MS);
            client_blank(&c, false);
            client_blank(&c, true);
            client_run(&c, SIM_S);
            expect_dark(&kinds[i]);
            client_blank(&c, false);
            expect_right(&kinds[i]);
            end(&kinds[i]);
        }
}

/* The pending flip gets no event. */
static void test_blank_after_lost_flip(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        begin(&kinds[i], SIM_FULL_HD);
        const uint64_t opened = client_screen(&c)->counts.opened;
        sim_stall(0, SIM_STALLS);
        client_run(&c, 100 * SIM_MS);
        client_blank(&c, true);
        client_run(&c, 120 * SIM_S);
        expect_dark(&kinds[i]);
        assert_false(c.gave_up);
        assert_int_equal(client_screen(&c)->counts.opened, opened);
        sim_stall(0, SIM_FLOWS);
        client_blank(&c, false);
        expect_right(&kinds[i]);
        end(&kinds[i]);
    }
}

static void test_hotplug_while_blank(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        begin(&kinds[i], SIM_FULL_HD);
        client_blank(&c, true);
        client_run(&c, SIM_S);
        sim_plug(0, 0, SIM_NO_MONITOR);
        client_run(&c, 5 * SIM_S);
        sim_plug(0, 0, SIM_FULL_HD);
        client_run(&c, 5 * SIM_S);
        expect_dark(&kinds[i]);
        sim_plug(0, 0, SIM_SMALL);
        client_run(&c, 5 * SIM_S);
        expect_dark(&kinds[i]);
        client_blank(&c, false);
        expect_right(&kinds[i]);
        assert_int_equal(client_screen(&c)->width_px, 48);
        client_blank(&c, true);
        sim_plug(0, 0, SIM_NO_MONITOR);
        client_run(&c, 5 * SIM_S);
        client_blank(&c, false);
        client_run(&c, 5 * SIM_S);
        sim_plug(0, 0, SIM_SMALL);
        expect_right(&kinds[i]);
        end(&kinds[i]);
    }
}

static void test_console_switches_while_blank(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        begin(&kinds[i], SIM_FULL_HD);
        client_blank(&c, true);
        client_run(&c, SIM_S);
        client_leave_console(&c);
        client_run(&c, 5 * SIM_S);
        if (kinds[i].traits.console) assert_true(sim_shows_console(0));
        client_enter_console(&c);
        client_run(&c, SIM_S);
        expect_dark(&kinds[i]);
        client_blank(&c, false);
        expect_right(&kinds[i]);
        client_leave_console(&c);
        client_run(&c, SIM_S);
        client_blank(&c, true); /* while another console is shown */
        client_run(&c, SIM_S);
        if (kinds[i].traits.console) assert_true(sim_shows_console(0));
        client_enter_console(&c);
        client_run(&c, SIM_S);
        expect_dark(&kinds[i]);
        client_leave_console(&c);
        client_run(&c, SIM_S);
        client_blank(&c, false);
        client_enter_console(&c);
        expect_right(&kinds[i]);
        end(&kinds[i]);
    }
}

static void test_lost_card_while_blank(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        begin(&kinds[i], SIM_FULL_HD);
        client_blank(&c, true);
        client_run(&c, SIM_S);
        sim_lose_card(0);
        client_run(&c, 5 * SIM_S);
        sim_return_card(0, "/dev/dri/card2");
        client_run(&c, 5 * SIM_S);
        expect_dark(&kinds[i]);
        client_blank(&c, false);
        expect_right(&kinds[i]);
        end(&kinds[i]);
    }
}

static void test_blank_before_first_frame(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        begin(&kinds[i], SIM_NO_MONITOR);
        client_blank(&c, true);
        client_run(&c, SIM_S);
        sim_plug(0, 0, SIM_FULL_HD);
        client_run(&c, 5 * SIM_S);
        expect_dark(&kinds[i]);
        client_blank(&c, false);
        expect_right(&kinds[i]);
        end(&kinds[i]);
    }
}

static void test_end_restores_console(void **state) {
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        if (!kinds[i].traits.console) continue;
        begin(&kinds[i], SIM_FULL_HD);
        client_blank(&c, true);
        client_run(&c, SIM_S);
        expect_dark(&kinds[i]);
        gn_kms_destroy(c.kms);
        c.kms = NULL;
        if (!sim_shows_console(0) || sim_is_dark()) fail_msg("%s", kinds[i].name);
        end(&kinds[i]);
    }
}

/* Refused commits are retried until the screen is dark. */
static void test_blank_refused_temporarily(void **state) {
    (void)state;
    static const int errors[] = {EBUSY, EINTR, ENOMEM, EACCES, EINVAL, ENOSPC, ENODEV};
    for (int i = 0; i < KINDS; i++)
        for (size_t n = 0; n < sizeof errors / sizeof *errors; n++) {
            const bool legacy = kinds[i].traits.legacy || kinds[i].opts.legacy;
            begin(&kinds[i], SIM_FULL_HD);
            c.moves = false;
            client_run(&c, 2 * SIM_S);
            sim_fail(legacy ? SIM_ModeConnectorSetProperty : SIM_ModeAtomicCommit, 1, 3, errors[n]);
            client_blank(&c, true);
            client_run(&c, 8 * SIM_S);
            assert_true(sim_counts.failed > 0);
            expect_dark(&kinds[i]);
            client_blank(&c, false);
            expect_right(&kinds[i]);
            end(&kinds[i]);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_long_blank),
        cmocka_unit_test(test_blank_during_flip),
        cmocka_unit_test(test_blank_after_lost_flip),
        cmocka_unit_test(test_hotplug_while_blank),
        cmocka_unit_test(test_console_switches_while_blank),
        cmocka_unit_test(test_lost_card_while_blank),
        cmocka_unit_test(test_blank_before_first_frame),
        cmocka_unit_test(test_end_restores_console),
        cmocka_unit_test(test_blank_refused_temporarily),
    };
    return RUN(tests);
}
