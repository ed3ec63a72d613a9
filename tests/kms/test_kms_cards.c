/* Selection of cards, and cards that disappear and return. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "client.h"
#include "unit/check.h"

static struct client c;

static void begin(int monitor, const struct gn_screen_opts *opts) {
    client_begin_alone(&c, monitor, opts);
}

static void end(void) {
    client_close(&c);
    client_has_uevents(true);
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

/* Opening a card without a master makes the opener master. */
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

/* udev creates such links in /dev/dri/by-path; their names need not match the card's place. */
static void test_by_a_link_to_it(void **state) {
    (void)state;
    char folder[] = "/tmp/gnomon-cards-XXXXXX", node[80], link[80], other[80];
    assert_non_null(mkdtemp(folder));
    snprintf(node, sizeof node, "%s/card1", folder);
    snprintf(link, sizeof link, "%s/pci-0000:00:02.0-card", folder);
    snprintf(other, sizeof other, "%s/pci-0000:01:00.0-card", folder);
    fclose(fopen(node, "w"));
    assert_int_equal(symlink("card1", link), 0);
    assert_int_equal(symlink("card0", other), 0); /* dangling */
    for (int i = 0; i < 2; i++) {
        sim_begin();
        sim_add_card(0, "/dev/dri/card0", &(struct sim_traits){0});
        sim_add_card(1, node, &(struct sim_traits){0});
        sim_plug(0, 0, SIM_FULL_HD);
        sim_plug(1, 0, SIM_SMALL);
        client_open(&c, &(struct gn_screen_opts){.card = i ? other : link});
        client_run(&c, 3 * SIM_S);
        assert_int_equal(client_screen(&c)->lit, i == 0);
        if (i == 0) assert_int_equal(client_screen(&c)->width_px, 48);
        end();
    }
    unlink(link);
    unlink(other);
    unlink(node);
    rmdir(folder);
}

/* The mode set by firmware or console is kept, even if another one is preferred. */
static void test_the_mode_in_use_is_kept_at_the_start(void **state) {
    (void)state;
    begin(SIM_WIDE_VIEWER, &(struct gn_screen_opts){0});
    assert_true(client_screen(&c)->lit);
    assert_int_equal(client_screen(&c)->width_px, 64);
    end();
}

static void test_one_that_is_not_there_is_named(void **state) {
    (void)state;
    begin(SIM_FULL_HD, &(struct gn_screen_opts){.card = "platform-gpu7-card"});
    assert_string_equal(client_screen(&c)->status,
                        "waiting for a card: platform-gpu7-card not found");
    end();
}

static void expect_a_wait(int error) {
    for (int calls = 1; calls <= 64; calls *= 2) {
        sim_begin();
        sim_add_card(0, "/dev/dri/card0", &(struct sim_traits){0});
        sim_plug(0, 0, SIM_FULL_HD);
        sim_fail(SIM_ModeAddFB2, 1, calls, error);
        client_open(&c, &(struct gn_screen_opts){0});
        client_run(&c, 3 * SIM_S);
        assert_true(client_screen(&c)->lit);
        assert_int_equal(client_screen(&c)->width_px, 96);
        end();
    }
}

/* A framebuffer refused temporarily is retried: no smaller mode, no copy. */
static void test_a_framebuffer_that_is_refused_for_a_moment(void **state) {
    (void)state;
    expect_a_wait(ENOMEM);
    expect_a_wait(EBUSY);
}

/* Containers receive no uevents. */
static void test_without_uevents_it_looks_by_itself(void **state) {
    (void)state;
    client_has_uevents(false);
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
        cmocka_unit_test(test_by_a_link_to_it),
        cmocka_unit_test(test_the_mode_in_use_is_kept_at_the_start),
        cmocka_unit_test(test_one_that_is_not_there_is_named),
        cmocka_unit_test(test_a_framebuffer_that_is_refused_for_a_moment),
        cmocka_unit_test(test_without_uevents_it_looks_by_itself),
    };
    return RUN(tests);
}
