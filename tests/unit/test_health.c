/* What boards suffer from, out of folders with the files of a kernel. */
#include "core/health.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "unit/check.h"
#include "unit/folder.h"
#include "unit/health_help.h"

#define ALARM    "sys/class/hwmon/hwmon1/in0_lcrit_alarm"
#define FIRMWARE "sys/devices/platform/soc/soc:firmware/get_throttled"
#define ZONE     "sys/class/thermal/thermal_zone0/temp"

static char root[64];

static int make_root(void **state) {
    (void)state;
    strcpy(root, "/tmp/gnomon-health.XXXXXX");
    return mkdtemp(root) ? 0 : 1;
}

static int remove_root(void **state) {
    (void)state;
    return gn_test_remove_folder(root);
}

static struct gn_health read_root(void) {
    struct gn_health h;
    memset(&h, 0x55, sizeof h);
    gn_health_read(&h, root);
    return h;
}

/* Whether it suffers from that, and the text is that. */
static void suffers(const struct gn_health *h, enum gn_health_kind kind, int64_t before,
                    const char *text) {
    char out[200] = "";
    assert_int_equal(gn_health_explain(h, kind, before, out, sizeof out), text != NULL);
    if (text) assert_string_equal(out, text);
}

static void is_well(const struct gn_health *h) {
    for (int i = 0; i < GN_HEALTH_COUNT; i++) suffers(h, (enum gn_health_kind)i, -1, NULL);
}

static void numbers_are_whole_or_unknown(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int base;
        int64_t number;
    } rows[] = {
        {"0\n", 10, 0},
        {"1", 10, 1},
        {" 48312 \n", 10, 48312},
        {"50005\n", 16, 0x50005},
        {"0x5", 16, 5},
        {"e0008", 16, 0xe0008},
        {"", 10, -1},
        {"\n", 10, -1},
        {"-5\n", 10, -1},
        {"1x", 10, -1},
        {"12 13", 10, -1},
        {"a", 10, -1},
        {"0x", 16, -1},
        {"g", 16, -1},
        {"1234567890", 10, -1},
        {"999999999", 10, 999999999},
        {"+1", 10, -1},
        {"1.5", 10, -1},
        {"\xff\xfe", 16, -1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (gn_health_parse_number(rows[i].text, rows[i].base) != rows[i].number)
            fail_msg("\"%s\"", rows[i].text);
}

static void lines_are_found_by_their_whole_key(void **state) {
    (void)state;
    const char *text = "NotCmaTotal: 7 kB\nCmaTotal:     65536 kB\nCmaFree:12 kB\ncma_alloc_failed "
                       "9\ncma_alloc_fail 3\nMemTotal: nonsense kB\nSwapTotal: 5x kB\nBig: "
                       "1234567890123456789";
    assert_int_equal(gn_health_parse_line(text, "CmaTotal:"), 65536);
    assert_int_equal(gn_health_parse_line(text, "CmaFree:"), 12);
    assert_int_equal(gn_health_parse_line(text, "MemTotal:"), -1);
    assert_int_equal(gn_health_parse_line(text, "SwapTotal:"), -1);
    assert_int_equal(gn_health_parse_line(text, "Big:"), -1);
    assert_int_equal(gn_health_parse_line(text, "MemFree:"), -1);
    assert_int_equal(gn_health_parse_line("", "MemFree:"), -1);
    assert_int_equal(gn_health_parse_line("cma_alloc_fail 3\n", "cma_alloc_fail"), 3);
    assert_int_equal(gn_health_parse_line("cma_alloc_failed 9\n", "cma_alloc_fail"), -1);
}

static void a_pi_that_is_well_is_known_to_be(void **state) {
    (void)state;
    health_pi4(root);
    const struct gn_health h = read_root();
    assert_int_equal(h.undervoltage, 0);
    assert_int_equal(h.firmware, 0);
    assert_int_equal(h.cooled, -1); /* it has no such devices */
    assert_int_equal(h.hottest_mc, 48312);
    assert_int_equal(h.cma_kb, 524288);
    assert_int_equal(h.cma_free_kb, 401408);
    assert_int_equal(h.cma_failed, 3);
    is_well(&h);
}

static void a_pi_under_voltage_says_so_and_is_cured(void **state) {
    (void)state;
    health_pi4(root);
    health_write(root, ALARM, "1\n");
    health_write(root, FIRMWARE, "50005\n"); /* undervoltage, and the clock is lowered */
    struct gn_health h = read_root();
    assert_int_equal(h.undervoltage, 1);
    assert_int_equal(h.firmware, 0x50005);
    suffers(&h, GN_HEALTH_VOLTAGE, -1, "undervoltage: the board's supply is too weak");
    suffers(&h, GN_HEALTH_THROTTLED, -1,
            "throttled: the firmware lowers the clock because of undervoltage (48 C)");
    suffers(&h, GN_HEALTH_CMA, -1, NULL);
    health_write(root, ALARM, "0\n");
    health_write(root, FIRMWARE, "0\n");
    h = read_root();
    is_well(&h);
}

static void heat_lowers_a_clock_in_several_ways(void **state) {
    (void)state;
    health_pi4(root);
    health_write(root, ZONE, "81800\n");
    health_write(root, FIRMWARE, "80008\n");
    struct gn_health h = read_root();
    suffers(&h, GN_HEALTH_VOLTAGE, -1, NULL);
    suffers(&h, GN_HEALTH_THROTTLED, -1,
            "throttled: the firmware lowers the clock to stay cool (82 C)");
    health_write(root, FIRMWARE, "20000\n"); /* it was, since 2 s ago */
    h = read_root();
    suffers(&h, GN_HEALTH_THROTTLED, -1, "throttled: the firmware lowers the clock (82 C)");
    /* a Rockchip: no firmware, and of two cooling devices one is a fan */
    health_remove(root, "sys/devices");
    health_remove(root, "sys/class/hwmon");
    health_write(root, "sys/class/thermal/cooling_device0/type", "pwm-fan\n");
    health_write(root, "sys/class/thermal/cooling_device0/cur_state", "3\n");
    h = read_root();
    assert_int_equal(h.cooled, -1);
    is_well(&h);
    health_write(root, "sys/class/thermal/cooling_device1/type", "cpufreq-cpu4\n");
    health_write(root, "sys/class/thermal/cooling_device1/cur_state", "0\n");
    h = read_root();
    assert_int_equal(h.cooled, 0);
    is_well(&h);
    health_write(root, "sys/class/thermal/cooling_device1/cur_state", "2\n");
    h = read_root();
    assert_int_equal(h.cooled, 1);
    suffers(&h, GN_HEALTH_THROTTLED, -1, "throttled: cpufreq-cpu4 runs slower to stay cool (82 C)");
}

/* Without the driver that clears them, what was since the boot says nothing of now. */
static void past_bits_count_only_with_the_driver(void **state) {
    (void)state;
    health_pi4(root);
    health_write(root, FIRMWARE, "f0000\n");
    struct gn_health h = read_root();
    suffers(&h, GN_HEALTH_THROTTLED, -1,
            "throttled: the firmware lowers the clock to stay cool (48 C)");
    suffers(&h, GN_HEALTH_VOLTAGE, -1, NULL); /* the driver knows better */
    health_remove(root, "sys/class/hwmon");
    h = read_root();
    is_well(&h);
    health_write(root, FIRMWARE, "1\n");
    h = read_root();
    assert_int_equal(h.undervoltage, -1);
    suffers(&h, GN_HEALTH_VOLTAGE, -1, "undervoltage: the board's supply is too weak");
}

static void cma_runs_out_when_requests_fail_or_all_memory_does(void **state) {
    (void)state;
    health_pi4(root);
    struct gn_health h = read_root();
    suffers(&h, GN_HEALTH_CMA, 3, NULL);
    suffers(
        &h, GN_HEALTH_CMA, 2,
        "contiguous memory for screen and GPU (CMA) runs out: 392 of 512 MB are free, 1 request "
        "failed");
    suffers(&h, GN_HEALTH_CMA, 0,
            "contiguous memory for screen and GPU (CMA) runs out: 392 of 512 MB are free, 3 "
            "requests failed");
    h.cma_free_kb = 1; /* the page cache has it, and would give it back */
    suffers(&h, GN_HEALTH_CMA, 3, NULL);
    h.available_kb = 3884000 / 16 - 1;
    suffers(&h, GN_HEALTH_CMA, 3,
            "contiguous memory for screen and GPU (CMA) runs out: 0 of 512 MB are free");
    h.cma_free_kb = 524288 / 16;
    suffers(&h, GN_HEALTH_CMA, 3, NULL);
    h.cma_kb = h.cma_free_kb = 0; /* a board without any */
    suffers(&h, GN_HEALTH_CMA, 0, NULL);
}

static void what_is_not_there_or_garbage_is_unknown_and_no_trouble(void **state) {
    (void)state;
    static const char *const paths[] = {ALARM,
                                        FIRMWARE,
                                        ZONE,
                                        "proc/meminfo",
                                        "proc/vmstat",
                                        "sys/class/hwmon/hwmon1/name",
                                        "sys/class/thermal/cooling_device0/type",
                                        "sys/class/thermal/cooling_device0/cur_state"};
    static char huge[200001];
    static const char *const garbage[] = {
        "", "\n", "nonsense", "-1\n", "1 1\n", "\xff\xff\xff", "99999999999999999999\n", huge};
    memset(huge, '1', sizeof huge - 1);
    struct gn_health h = read_root(); /* an empty folder */
    for (int round = 0; round < 10; round++) {
        assert_int_equal(h.undervoltage, -1);
        assert_int_equal(h.firmware, -1);
        assert_int_equal(h.cooled, -1);
        assert_int_equal(h.hottest_mc, 0);
        assert_int_equal(h.cma_kb, -1);
        assert_int_equal(h.cma_failed, -1);
        is_well(&h);
        if (round < 8) {
            for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
                health_write(root, paths[i], garbage[round]);
            health_write(root, "sys/class/hwmon/hwmon1/name", "rpi_volt\n");
        } else { /* folders in place of files */
            for (size_t i = 0; i < sizeof paths / sizeof *paths && round == 8; i++) {
                char path[200];
                health_remove(root, paths[i]);
                snprintf(path, sizeof path, "%s/%s", root, paths[i]);
                assert_int_equal(mkdir(path, 0700), 0);
            }
        }
        h = read_root();
    }
}

static void a_root_that_is_too_long_or_not_there_is_no_harm(void **state) {
    (void)state;
    struct gn_health h;
    static char deep[6000];
    memset(deep, 'x', sizeof deep - 1);
    gn_health_read(&h, deep);
    is_well(&h);
    gn_health_read(&h, "/nonexistent");
    is_well(&h);
    assert_int_equal(h.undervoltage, -1);
}

static void one_trouble_outlasts_short_pauses_and_ends_after_calm(void **state) {
    (void)state;
    struct gn_health_log log = {0};
    const struct gn_health well = {.undervoltage = 0, .firmware = -1, .cooled = -1},
                           ill = {.undervoltage = 1, .firmware = -1, .cooled = -1};
    const struct gn_ailment *a = &log.of[GN_HEALTH_VOLTAGE];
    char text[200];
    gn_health_summarise(&log, text, sizeof text);
    assert_string_equal(text, "");
    gn_health_take(&log, &well);
    assert_false(a->lasts);
    for (int dip = 0; dip < 5; dip++) {
        gn_health_take(&log, &ill);
        assert_true(a->lasts);
        for (int i = 0; i < GN_HEALTH_CALM - 1; i++) gn_health_take(&log, &well);
        assert_true(a->lasts);
    }
    assert_int_equal(a->times, 1);
    assert_string_equal(a->text, "undervoltage: the board's supply is too weak");
    gn_health_summarise(&log, text, sizeof text);
    assert_string_equal(text, "undervoltage now");
    gn_health_take(&log, &well);
    assert_false(a->lasts);
    gn_health_summarise(&log, text, sizeof text);
    assert_string_equal(text, "undervoltage 1 time before");
    gn_health_take(&log, &ill);
    assert_int_equal(a->times, 2);
    gn_health_summarise(&log, text, sizeof text);
    assert_string_equal(text, "undervoltage now and 1 time before");
    assert_false(log.of[GN_HEALTH_THROTTLED].lasts || log.of[GN_HEALTH_CMA].lasts);
}

static void cma_failures_before_the_first_reading_are_not_ours(void **state) {
    (void)state;
    struct gn_health_log log = {0};
    struct gn_health h = {.undervoltage = -1,
                          .firmware = -1,
                          .cooled = -1,
                          .cma_kb = 65536,
                          .cma_free_kb = 60000,
                          .memory_kb = 1000000,
                          .available_kb = 900000,
                          .cma_failed = 40};
    gn_health_take(&log, &h);
    gn_health_take(&log, &h);
    assert_int_equal(log.of[GN_HEALTH_CMA].times, 0);
    h.cma_failed = -1; /* could not be read once */
    gn_health_take(&log, &h);
    h.cma_failed = 41;
    gn_health_take(&log, &h);
    assert_true(log.of[GN_HEALTH_CMA].lasts);
    for (int i = 0; i < GN_HEALTH_CALM; i++) gn_health_take(&log, &h);
    assert_false(log.of[GN_HEALTH_CMA].lasts);
}

int main(void) {
#define IN_ROOT(f) cmocka_unit_test_setup_teardown(f, make_root, remove_root)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_whole_or_unknown),
        cmocka_unit_test(lines_are_found_by_their_whole_key),
        IN_ROOT(a_pi_that_is_well_is_known_to_be),
        IN_ROOT(a_pi_under_voltage_says_so_and_is_cured),
        IN_ROOT(heat_lowers_a_clock_in_several_ways),
        IN_ROOT(past_bits_count_only_with_the_driver),
        IN_ROOT(cma_runs_out_when_requests_fail_or_all_memory_does),
        IN_ROOT(what_is_not_there_or_garbage_is_unknown_and_no_trouble),
        cmocka_unit_test(a_root_that_is_too_long_or_not_there_is_no_harm),
        cmocka_unit_test(one_trouble_outlasts_short_pauses_and_ends_after_calm),
        cmocka_unit_test(cma_failures_before_the_first_reading_are_not_ours),
    };
    return RUN(tests);
}
