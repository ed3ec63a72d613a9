/* A kiosk on a board that suffers: a problem comes, goes when it is cured, and the status and the
 * information page have it meanwhile. */
#include "unit/check.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/clock.h"
#include "kiosk/private.h"
#include "unit/folder.h"
#include "unit/health_help.h"
#include "unit/show_help.h"

#define ALARM "sys/class/hwmon/hwmon1/in0_lcrit_alarm"

static json_t *board_of(struct gn_show *show) {
    json_t *all = gn_parts_status(&show->parts, false);
    json_t *board = json_incref(json_object_get(all, "board"));
    json_decref(all);
    return board;
}

static const char *board_line(struct gn_show *show) {
    struct gn_info info = {0};
    gn_parts_add_info(&show->parts, &info);
    return info.board;
}

static void board_is(struct gn_show *show, bool is_low, int times, int free_mb) {
    json_t *board = board_of(show);
    assert_non_null(board);
    assert_int_equal(json_is_true(json_object_get(board, "undervoltage")), is_low);
    assert_true(json_is_false(json_object_get(board, "throttled")));
    assert_int_equal(json_integer_value(json_object_get(board, "undervoltages")), times);
    assert_int_equal(json_integer_value(json_object_get(board, "cma_mb")), 512);
    assert_int_equal(json_integer_value(json_object_get(board, "cma_free_mb")), free_mb);
    json_decref(board);
}

/* Steps on until the problem is there or not. */
static void problem_becomes(struct gn_show *show, const char *start) {
    for (int i = 0; i < 60000; i++, usleep(1000)) {
        const char *problem = gn_problem_last(&show->problems);
        if (start ? problem && strstr(problem, start) == problem : !problem) return;
        help_show_step(show);
    }
    fail_msg("the problem is \"%s\"",
             gn_problem_last(&show->problems) ? gn_problem_last(&show->problems) : "");
}

/* A kiosk on a Pi 4 whose files are in `root`, and well. */
static struct gn_show *open_on_pi4(char *root) {
    assert_non_null(mkdtemp(root));
    health_pi4(root);
    struct gn_show *show =
        help_show_of("[kiosk]\n[mode \"a\"]\nshadow = none\n", (const char *const[]){NULL});
    show->parts.host.root = root;
    show->parts.host.reading_ns = GN_NS_PER_S / 200;
    gn_part_open(&show->parts, GN_PART_health);
    json_t *board;
    while (!(board = board_of(show))) help_show_step(show);
    json_decref(board);
    return show;
}

static void close_and_remove(struct gn_show *show, const char *root) {
    gn_show_close(show);
    usleep(20000); /* the thread ends */
    assert_int_equal(gn_test_remove_folder(root), 0);
}

static void an_undervoltage_is_a_problem_until_it_is_cured(void **state) {
    (void)state;
    char root[] = "/tmp/gnomon-board.XXXXXX";
    struct gn_show *show = open_on_pi4(root);
    problem_becomes(show, NULL);
    board_is(show, false, 0, 392);
    assert_string_equal(board_line(show), "");
    for (int times = 1; times <= 2; times++) {
        health_write(root, ALARM, "1\n");
        problem_becomes(show, "undervoltage: the board's supply is too weak; use the board's own");
        board_is(show, true, times, 392);
        assert_non_null(strstr(board_line(show), "undervoltage now"));
        health_write(root, ALARM, "0\n");
        problem_becomes(show, NULL);
        board_is(show, false, times, 392);
    }
    assert_string_equal(board_line(show), "undervoltage 2 times before");
    close_and_remove(show, root);
}

/* Heat and CMA are kinds of their own: one that is cured leaves the other. */
static void each_trouble_ends_for_itself(void **state) {
    (void)state;
    char root[] = "/tmp/gnomon-board.XXXXXX";
    struct gn_show *show = open_on_pi4(root);
    health_write(root, "sys/devices/platform/soc/soc:firmware/get_throttled", "8\n");
    problem_becomes(show, "throttled: the firmware lowers the clock to stay cool (48 C); cool");
    health_write(root, "proc/vmstat", "cma_alloc_fail 5\n");
    problem_becomes(show, "contiguous memory for screen and GPU (CMA) runs out: 392 of 512 MB are "
                          "free, 2 requests failed; set a larger cma=");
    problem_becomes(show, "throttled: "); /* no request has failed since */
    health_write(root, "sys/devices/platform/soc/soc:firmware/get_throttled", "0\n");
    problem_becomes(show, NULL);
    close_and_remove(show, root);
}

int main(int argc, char **argv) {
    if (argc > 1) cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_undervoltage_is_a_problem_until_it_is_cured),
        cmocka_unit_test(each_trouble_ends_for_itself),
    };
    return RUN(tests);
}
