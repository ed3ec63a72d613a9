/* Dates of [sun], and the moments that they are by a clock. */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "options/date.h"
#include "unit/check.h"

static double moment(const char *text, const char *zone) {
    struct gn_date date;
    struct gn_err err = {0};
    double utc_s = 0;
    if (!gn_date_parse(text, &date)) fail_msg("%s is refused", text);
    if (!gn_date_utc(&date, zone, &utc_s, &err)) fail_msg("%s", err.text);
    return utc_s;
}

static void test_offsets_and_zones_name_the_same_moment(void **state) {
    (void)state;
    const double noon = 1782036000; /* 21 June 2026, 10:00 UTC */
    assert_true(moment("2026-06-21T10:00Z", NULL) == noon);
    assert_true(moment("2026-06-21 10:00:00+00:00", "Asia/Tokyo") == noon);
    assert_true(moment("2026-06-21T12:00+02:00", NULL) == noon);
    assert_true(moment("2026-06-21T04:30-05:30", NULL) == noon);
    assert_true(moment("2026-06-21T12:00", "Europe/Berlin") == noon);
    assert_true(moment("2026-06-21", "Europe/Berlin") == noon);
    assert_true(moment("2026-12-21", "Europe/Berlin") == moment("2026-12-21T11:00Z", NULL));
}

static void test_a_day_on_which_the_clock_changes_has_its_hours(void **state) {
    (void)state;
    assert_true(moment("2026-03-29T01:59", "Europe/Berlin") == moment("2026-03-29T00:59Z", NULL));
    assert_true(moment("2026-03-29T03:00", "Europe/Berlin") == moment("2026-03-29T01:00Z", NULL));
    assert_true(moment("2026-10-25T04:00", "Europe/Berlin") == moment("2026-10-25T03:00Z", NULL));
}

static void test_a_leap_second_is_the_next_one(void **state) {
    (void)state;
    assert_true(moment("2016-12-31T23:59:60Z", NULL) == moment("2017-01-01T00:00:00Z", NULL));
    assert_true(moment("2024-02-29", "UTC") + 86400 == moment("2024-03-01", "UTC"));
}

static void test_the_zone_of_the_process_stays(void **state) {
    (void)state;
    setenv("TZ", "America/New_York", 1);
    tzset();
    moment("2026-06-21", "Asia/Tokyo");
    assert_string_equal(getenv("TZ"), "America/New_York");
    assert_true(moment("2026-06-21", NULL) == moment("2026-06-21T16:00Z", NULL));
    unsetenv("TZ");
    moment("2026-06-21", "Asia/Tokyo");
    assert_null(getenv("TZ"));
}

static void test_an_unknown_zone_is_one_line(void **state) {
    (void)state;
    static const char *const zones[] = {"Europe/Brelin", "", "/etc/passwd", "../zoneinfo/UTC", "."};
    const struct gn_date date = {.year = 2026, .month = 6, .day = 21};
    for (size_t i = 0; i < sizeof zones / sizeof *zones; i++) {
        struct gn_err err = {0};
        double utc_s;
        assert_false(gn_date_utc(&date, zones[i], &utc_s, &err));
        assert_non_null(strstr(err.text, "there is no time zone"));
        assert_int_equal(err.status, GN_EXIT_USAGE);
    }
}

static void test_what_is_no_date_is_refused(void **state) {
    (void)state;
    static const char *const texts[] = {"",
                                        "2026",
                                        "2026-6-21",
                                        "2026-13-01",
                                        "2026-00-10",
                                        "2026-02-29",
                                        "2100-02-29",
                                        "1899-12-31",
                                        "2101-01-01",
                                        "2026-06-31",
                                        "2026-06-00",
                                        "26-06-21",
                                        "2026-06-21T",
                                        "2026-06-21T24:00",
                                        "2026-06-21T12",
                                        "today",
                                        "2026/06/21",
                                        "2026-06-21T12:60",
                                        "2026-06-21T12:00x",
                                        "2026-06-21T12:00+1:00",
                                        " 2026-06-21",
                                        "2026-06-21T12:00+15:00",
                                        "2026-06-21T12:00+01:60",
                                        "2026-06-21T12:00:61",
                                        "2026-06-21Z",
                                        "2026-06-21T12:00Z1"};
    struct gn_date date;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (gn_date_parse(texts[i], &date)) fail_msg("\"%s\" is taken", texts[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_offsets_and_zones_name_the_same_moment),
        cmocka_unit_test(test_a_day_on_which_the_clock_changes_has_its_hours),
        cmocka_unit_test(test_a_leap_second_is_the_next_one),
        cmocka_unit_test(test_the_zone_of_the_process_stays),
        cmocka_unit_test(test_an_unknown_zone_is_one_line),
        cmocka_unit_test(test_what_is_no_date_is_refused),
    };
    return RUN(tests);
}
