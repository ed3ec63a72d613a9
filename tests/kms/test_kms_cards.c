/* Which card is taken, and what a card that comes and goes may not do. */
#include <errno.h>

#include "client.h"
#include "unit/check.h"

static struct client c;

static void begin(int monitor, const struct gn_screen_opts *opts) {
    client_begin_alone(&c, monitor, opts);
}

static void end(void) {
    client_close(&c);
    client_hears(true);
    assert_int_equal(sim_end(), 0);
}

static void test_without_a_monitor_it_may_go_as_often_as_it_likes(void **state) {
    (void)state;
    begin(SIM_NO_MONITOR, &(struct gn_screen_opts){0});
    for (int i = 0; i < 10; i++) {
        sim_lose_card(0);
        client_run(&c, 3 * SIM_S);
        sim_return_card(0, NULL);
        client_run(&c, 3 * SIM_S);
    }
    assert_false(c.gave_up);
    end();
}

/* Who opens a card that nobody has becomes its master. */
static void test_one_that_returns_is_left_to_who_has_the_console(void **state) {
    (void)state;
    begin(SIM_FULL_HD, &(struct gn_screen_opts){0});
    client_leave_console(&c);
    client_run(&c, SIM_S);
    sim_lose_card(0);
    client_run(&c, 3 * SIM_S);
    sim_return_card(0, NULL);
    client_run(&c, 3 * SIM_S);
    assert_true(gn_kms_fd(c.kms) >= 0);
    assert_false(sim_is_master(gn_kms_fd(c.kms)));
    client_enter_console(&c);
    client_run(&c, 3 * SIM_S);
    assert_true(client_screen(&c)->lit);
    end();
}

static void expect_taken(const char *card) {
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.card = card});
    assert_true(client_screen(&c)->lit);
    end();
}

static void test_by_any_of_its_names(void **state) {
    (void)state;
    expect_taken("/dev/dri/card0");
    expect_taken("platform-gpu0");
    expect_taken("platform-gpu0-card");
    expect_taken("/dev/dri/by-path/platform-gpu0-card");
}

static void test_one_that_is_not_there_is_named(void **state) {
    (void)state;
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.card = "platform-gpu7-card"});
    assert_string_equal(client_screen(&c)->status,
                        "waiting for a card: platform-gpu7-card is not there");
    end();
}

static void test_memory_that_is_short_for_a_moment(void **state) {
    (void)state;
    for (int calls = 1; calls <= 64; calls *= 2) {
        sim_begin();
        sim_add_card(0, "/dev/dri/card0", &(struct sim_traits){0});
        sim_plug(0, 0, SIM_FULL_HD);
        sim_fail(SIM_ModeAddFB2, 1, calls, ENOMEM);
        client_open(&c, &(struct gn_screen_opts){0});
        client_run(&c, 3 * SIM_S);
        assert_true(client_screen(&c)->lit);
        assert_int_equal(client_screen(&c)->width_px, 96);
        end();
    }
}

/* In a sandbox nobody tells of monitors. */
static void test_without_uevents_it_looks_by_itself(void **state) {
    (void)state;
    client_hears(false);
    begin(SIM_FULL_HD, &(struct gn_screen_opts){0});
    assert_true(client_screen(&c)->lit);
    sim_plug(0, 0, SIM_NO_MONITOR);
    client_run(&c, 12500 * SIM_MS);
    assert_false(client_screen(&c)->lit);
    sim_plug(0, 0, SIM_SMALL);
    client_run(&c, 12500 * SIM_MS);
    assert_true(client_screen(&c)->lit);
    sim_break_link(0, 0);
    client_run(&c, 12500 * SIM_MS);
    assert_int_equal(client_screen(&c)->width_px, 48);
    end();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_without_a_monitor_it_may_go_as_often_as_it_likes),
        cmocka_unit_test(test_one_that_returns_is_left_to_who_has_the_console),
        cmocka_unit_test(test_by_any_of_its_names),
        cmocka_unit_test(test_one_that_is_not_there_is_named),
        cmocka_unit_test(test_memory_that_is_short_for_a_moment),
        cmocka_unit_test(test_without_uevents_it_looks_by_itself),
    };
    return RUN(tests);
}
