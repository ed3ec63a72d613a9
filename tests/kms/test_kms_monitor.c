/* Which mode a monitor gets after another one, or after itself. */
#include <errno.h>
#include <string.h>

#include "client.h"
#include "unit/check.h"

static struct client c;

static void begin(int monitor, const struct gn_screen_opts *opts) {
    client_begin_alone(&c, monitor, opts);
}

static void end(void) {
    client_close(&c);
    assert_int_equal(sim_end(), 0);
}

static void expect_width(unsigned width_px) {
    int64_t took_ns;
    assert_true(client_settle(&c, SIM_S, &took_ns));
    assert_int_equal(client_screen(&c)->width_px, width_px);
    c.moves = true;
}

/* Lit with its second mode because the first was refused. */
static void begin_with_second_mode(void) {
    sim_begin();
    sim_add_card(0, "/dev/dri/card0", &(struct sim_traits){0});
    sim_plug(0, 0, SIM_FULL_HD);
    sim_refuse_mode((struct sim_refusal){96, EINVAL, false});
    client_open(&c, &(struct gn_screen_opts){0});
    client_frames(&c, 3);
    sim_allow_modes();
    expect_width(64);
}

static void test_the_same_one_keeps_its_mode_and_does_not_blink(void **state) {
    (void)state;
    begin_with_second_mode();
    const long blinks = sim_counts.blinks;
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 3 * SIM_S);
    sim_plug(0, 0, SIM_FULL_HD);
    expect_width(64);
    assert_int_equal(sim_counts.blinks, blinks);
    end();
}

static void test_another_one_gets_what_it_prefers(void **state) {
    (void)state;
    begin_with_second_mode();
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 3 * SIM_S);
    sim_plug(0, 0, SIM_TWIN);
    expect_width(96);
    end();
}

/* As after a reload that keeps the display: the names it was opened with are gone. */
static void test_names_need_not_outlive_the_opening(void **state) {
    (void)state;
    char name[] = "HDMI-A-1", card[] = "/dev/dri/card0";
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.connector = name, .card = card});
    memset(name, 'x', sizeof name - 1);
    memset(card, 'x', sizeof card - 1);
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 3 * SIM_S);
    assert_non_null(strstr(client_screen(&c)->status, "waiting for a monitor on HDMI-A-1"));
    sim_plug(0, 0, SIM_FULL_HD);
    expect_width(96);
    end();
}

static void test_another_one_in_a_moment(void **state) {
    (void)state;
    begin_with_second_mode();
    sim_plug(0, 0, SIM_TWIN);
    expect_width(96);
    end();
}

/* The twin's mode was refused too: a returning monitor must not take over the other one's. */
static void test_a_mode_belongs_to_the_one_it_was_lit_for(void **state) {
    (void)state;
    begin_with_second_mode();
    sim_stranger_takes(0);
    sim_plug(0, 0, SIM_TWIN);
    client_run(&c, SIM_S);
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 3 * SIM_S);
    sim_plug(0, 0, SIM_TWIN);
    client_run(&c, SIM_S);
    sim_stranger_leaves(0, false);
    client_run(&c, 2 * SIM_S);
    expect_width(96);
    end();
}

static void test_without_edid_by_what_it_prefers(void **state) {
    (void)state;
    begin(SIM_VIEWER, &(struct gn_screen_opts){0});
    expect_width(64);
    sim_plug(0, 0, SIM_WIDE_VIEWER);
    expect_width(96);
    const long blinks = sim_counts.blinks;
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 3 * SIM_S);
    sim_plug(0, 0, SIM_WIDE_VIEWER);
    expect_width(96);
    assert_int_equal(sim_counts.blinks, blinks);
    sim_plug(0, 0, SIM_VIEWER);
    expect_width(64);
    end();
}

static void test_what_is_configured_holds(void **state) {
    (void)state;
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.mode_width = 64, .mode_height = 48});
    expect_width(64);
    sim_plug(0, 0, SIM_TWIN);
    expect_width(64);
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 3 * SIM_S);
    sim_plug(0, 0, SIM_WIDE_VIEWER);
    expect_width(64);
    end();
}

static void test_a_cap_on_what_is_chosen_unasked(void **state) {
    (void)state;
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.cap_width = 64, .cap_height = 48});
    expect_width(64);
    sim_plug(0, 0, SIM_SMALL);
    expect_width(48);
    end();
}

/* The reason is shown on the screen, too. */
static void test_a_render_node_that_is_not_there(void **state) {
    (void)state;
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.render_node = "/dev/dri/renderD200"});
    assert_false(client_screen(&c)->has_context);
    assert_string_equal(
        client_screen(&c)->status,
        "/dev/dri/card0: render node /dev/dri/renderD200: No such file or directory");
    assert_false(sim_shows_console(0));
    end();
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.render_node = SIM_RENDER_NODE});
    expect_width(96);
    end();
}

/* Probing stalls slow machines: only after events, and every 10 s. */
static void test_while_there_is_none_the_wires_are_seldom_asked(void **state) {
    (void)state;
    begin(SIM_NO_MONITOR, &(struct gn_screen_opts){0});
    const long *calls = sim_counts.calls, probes = calls[SIM_ModeGetConnector],
               looks = calls[SIM_ModeGetConnectorCurrent];
    client_run(&c, 100 * SIM_S);
    assert_in_range(calls[SIM_ModeGetConnector] - probes, 10 * SIM_CONNECTORS, 12 * SIM_CONNECTORS);
    assert_in_range(calls[SIM_ModeGetConnectorCurrent] - looks, 38 * SIM_CONNECTORS,
                    42 * SIM_CONNECTORS);
    sim_plug(0, 0, SIM_FULL_HD);
    client_run(&c, 200 * SIM_MS); /* with a uevent */
    assert_true(client_screen(&c)->lit);
    end();
}

static void test_without_a_uevent_it_is_seen_later(void **state) {
    (void)state;
    begin(SIM_NO_MONITOR, &(struct gn_screen_opts){0});
    sim_plug(0, 0, SIM_FULL_HD);
    assert_true(sim_take_uevent()); /* discarded */
    client_run(&c, 10500 * SIM_MS);
    assert_true(client_screen(&c)->lit);
    end();
}

/* No probing while another console was shown. */
static void test_another_one_came_while_it_was_away(void **state) {
    (void)state;
    begin_with_second_mode();
    client_leave_console(&c);
    client_run(&c, SIM_S);
    sim_plug(0, 0, SIM_SMALL);
    assert_true(sim_take_uevent());
    client_run(&c, SIM_S);
    client_enter_console(&c);
    expect_width(48);
    end();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_same_one_keeps_its_mode_and_does_not_blink),
        cmocka_unit_test(test_another_one_gets_what_it_prefers),
        cmocka_unit_test(test_names_need_not_outlive_the_opening),
        cmocka_unit_test(test_another_one_in_a_moment),
        cmocka_unit_test(test_a_mode_belongs_to_the_one_it_was_lit_for),
        cmocka_unit_test(test_without_edid_by_what_it_prefers),
        cmocka_unit_test(test_what_is_configured_holds),
        cmocka_unit_test(test_while_there_is_none_the_wires_are_seldom_asked),
        cmocka_unit_test(test_without_a_uevent_it_is_seen_later),
        cmocka_unit_test(test_another_one_came_while_it_was_away),
        cmocka_unit_test(test_a_cap_on_what_is_chosen_unasked),
        cmocka_unit_test(test_a_render_node_that_is_not_there),
    };
    return RUN(tests);
}
