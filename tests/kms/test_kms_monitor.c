/* The mode of a monitor that is plugged again, or after another one. */
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

static void test_same_monitor_keeps_mode(void **state) {
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

static void test_other_monitor_gets_preferred_mode(void **state) {
    (void)state;
    begin_with_second_mode();
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 3 * SIM_S);
    sim_plug(0, 0, SIM_TWIN);
    expect_width(96);
    end();
}

/* The caller's option strings are gone, as after a reload that keeps the display. */
static void test_names_are_copied(void **state) {
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

static void test_fast_change_of_monitor(void **state) {
    (void)state;
    begin_with_second_mode();
    sim_plug(0, 0, SIM_TWIN);
    expect_width(96);
    end();
}

/* The twin's mode was refused too: the twin must not inherit the other monitor's mode. */
static void test_mode_belongs_to_monitor(void **state) {
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

static void test_preferred_mode_without_edid(void **state) {
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

static void test_configured_mode_is_kept(void **state) {
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

static void test_cap_of_automatic_mode(void **state) {
    (void)state;
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.cap_width = 64, .cap_height = 48});
    expect_width(64);
    sim_plug(0, 0, SIM_SMALL);
    expect_width(48);
    end();
}

/* The reason is shown on the screen, too. */
static void test_missing_render_node(void **state) {
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
static void test_probing_is_rare_without_monitor(void **state) {
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

static void test_hotplug_without_uevent(void **state) {
    (void)state;
    begin(SIM_NO_MONITOR, &(struct gn_screen_opts){0});
    sim_plug(0, 0, SIM_FULL_HD);
    assert_true(sim_take_uevent()); /* discarded */
    client_run(&c, 10500 * SIM_MS);
    assert_true(client_screen(&c)->lit);
    end();
}

/* Connectors are not probed while another console is active. */
static void test_hotplug_on_another_console(void **state) {
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

/* Full or limited range is set with the mode, and taken back at the end; what cannot is said. */
static void test_range_of_levels(void **state) {
    (void)state;
    static const struct {
        enum gn_screen_range asked;
        bool has, keeps, legacy;
        uint64_t set;
        const char *said;
    } rows[] = {
        {GN_RANGE_AUTO, true, false, false, SIM_RANGE_LIMITED, " atomic"},
        {GN_RANGE_FULL, true, false, false, SIM_RANGE_FULL, ", full range"},
        {GN_RANGE_LIMITED, true, false, false, SIM_RANGE_LIMITED, ", limited range"},
        {GN_RANGE_FULL, true, true, false, SIM_RANGE_LIMITED, " atomic"},
        {GN_RANGE_FULL, true, false, true, SIM_RANGE_FULL, ", full range"},
        {GN_RANGE_LIMITED, false, false, false, 0, " atomic"},
        {GN_RANGE_LIMITED, false, false, true, 0, " legacy"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct client_kind kind = {.name = rows[i].said,
                                         .traits = {.console = true,
                                                    .range = rows[i].has,
                                                    .keeps_range = rows[i].keeps,
                                                    .legacy = rows[i].legacy},
                                         .opts = {.range = rows[i].asked}};
        client_begin(&c, &kind, SIM_FULL_HD);
        const char *what = client_screen(&c)->what;
        assert_int_equal(sim_range(0), rows[i].set);
        const bool lacks = rows[i].asked != GN_RANGE_AUTO && (!rows[i].has || rows[i].keeps);
        assert_int_equal(client_screen(&c)->lacks_range, lacks);
        assert_int_equal(client_screen(&c)->range, lacks ? GN_RANGE_AUTO : rows[i].asked);
        assert_true(strlen(what) > strlen(rows[i].said));
        assert_string_equal(what + strlen(what) - strlen(rows[i].said), rows[i].said);
        sim_plug(0, 0, SIM_NO_MONITOR);
        client_run(&c, SIM_S);
        sim_plug(0, 0, SIM_SMALL);
        expect_width(48);
        assert_int_equal(sim_range(0), rows[i].set);
        client_close(&c);
        assert_int_equal(sim_range(0), rows[i].has ? SIM_RANGE_LIMITED : 0); /* as it was */
        assert_int_equal(sim_end(), 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_monitor_keeps_mode),
        cmocka_unit_test(test_other_monitor_gets_preferred_mode),
        cmocka_unit_test(test_names_are_copied),
        cmocka_unit_test(test_fast_change_of_monitor),
        cmocka_unit_test(test_mode_belongs_to_monitor),
        cmocka_unit_test(test_preferred_mode_without_edid),
        cmocka_unit_test(test_configured_mode_is_kept),
        cmocka_unit_test(test_probing_is_rare_without_monitor),
        cmocka_unit_test(test_hotplug_without_uevent),
        cmocka_unit_test(test_hotplug_on_another_console),
        cmocka_unit_test(test_cap_of_automatic_mode),
        cmocka_unit_test(test_missing_render_node),
        cmocka_unit_test(test_range_of_levels),
    };
    return RUN(tests);
}
