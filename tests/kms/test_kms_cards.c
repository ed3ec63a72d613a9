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

static void test_repeated_loss_without_monitor(void **state) {
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

/* The kernel makes the process that opens a card without a master its master. */
static void test_no_master_on_another_console(void **state) {
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

static void test_select_by_name(void **state) {
    (void)state;
    expect_taken("/dev/dri/card0");
    expect_taken("platform-gpu0");
    expect_taken("platform-gpu0-card");
    expect_taken("/dev/dri/by-path/platform-gpu0-card");
}

/* udev creates such links in /dev/dri/by-path; their names may differ from the card's `place`. */
static void test_select_by_link(void **state) {
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

/* The mode set by firmware or console is kept, even if another mode is preferred. */
static void test_start_keeps_current_mode(void **state) {
    (void)state;
    begin(SIM_WIDE_VIEWER, &(struct gn_screen_opts){0});
    assert_true(client_screen(&c)->lit);
    assert_int_equal(client_screen(&c)->width_px, 64);
    end();
}

static void test_missing_card_is_named(void **state) {
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

/* A temporarily refused framebuffer is retried: no smaller mode, no copy. */
static void test_framebuffer_refused_temporarily(void **state) {
    (void)state;
    expect_a_wait(ENOMEM);
    expect_a_wait(EBUSY);
}

/* Containers receive no uevents. */
static void test_polling_without_uevents(void **state) {
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
        cmocka_unit_test(test_repeated_loss_without_monitor),
        cmocka_unit_test(test_no_master_on_another_console),
        cmocka_unit_test(test_select_by_name),
        cmocka_unit_test(test_select_by_link),
        cmocka_unit_test(test_start_keeps_current_mode),
        cmocka_unit_test(test_missing_card_is_named),
        cmocka_unit_test(test_framebuffer_refused_temporarily),
        cmocka_unit_test(test_polling_without_uevents),
    };
    return RUN(tests);
}
