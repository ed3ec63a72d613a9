/* The schedule of the screen against a clock that is looked at every minute, over a year in time
 * zones that change at different hours, by half an hour, and at midnight. GN_FULL=1: every schedule
 * in every zone, over two years. */
#include "unit/check.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "options/schedule.h"

enum { YEAR_S = 366 * 86400 };
static const int64_t BEGIN_S = 1767225600; /* 2026-01-01 in UTC */

static void set_zone(const char *zone) {
    setenv("TZ", zone, 1);
    tzset();
}

static struct gn_schedule parsed(const char *text) {
    struct gn_schedule schedule;
    if (!gn_schedule_parse(text, "always", &schedule)) fail_msg("not taken: %s", text);
    return schedule;
}

static void texts_are_read_and_written(void **state) {
    (void)state;
    static const char *const texts[][2] = {
        {"mon-fri 08:00-20:00, sat 10:00-18:00",
         "mon,tue,wed,thu,fri 08:00-20:00, sat 10:00-18:00"},
        {"8:00-24:00", "08:00-24:00"},
        {"sat-mon 22:00-02:00", "mon,sat,sun 22:00-02:00"},
        {"mon, wed 09:00-17:00", "mon,wed 09:00-17:00"},
        {"always", "always"},
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        const struct gn_schedule schedule = parsed(texts[i][0]);
        char out[200];
        gn_schedule_text(&schedule, "always", out, sizeof out);
        assert_string_equal(out, texts[i][1]);
        const struct gn_schedule again = parsed(out);
        assert_memory_equal(&again, &schedule, sizeof again);
    }
    static const char *const bad[] = {"",
                                      "always",
                                      "mon",
                                      "mon-fri",
                                      "8-20",
                                      "08:00",
                                      "08:60-09:00",
                                      "25:00-26:00",
                                      "24:00-25:00",
                                      "24:00-8:00",
                                      "24:30-08:00",
                                      "mon 8:00-9:00,",
                                      "mon 8:00-9:00 x",
                                      "moon 8:00-9:00",
                                      "08:0-09:00",
                                      "mon-8:00-9:00",
                                      "-1:00-2:00"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct gn_schedule unused;
        if (gn_schedule_parse(bad[i], "never", &unused)) fail_msg("taken: %s", bad[i]);
    }
}

/* ---- the other way: each span is switched by the minutes of the clock as they pass --------------
 */

enum { RUNS = 40 };
struct run { /* a span of a date, in calendar order; begun once for each date */
    long begun, from, to;
};
struct other {
    struct run runs[RUNS * GN_SCHEDULE_SPANS_MAX];
    int count;
};

/* A calendar's minutes: dates in order, without offsets. */
static long minutes_of(const struct tm *tm, int plus_days, int minute) {
    struct tm noon = {.tm_year = tm->tm_year, .tm_mon = tm->tm_mon, .tm_mday = tm->tm_mday};
    return (long)(timegm(&noon) / 60) + 1440L * plus_days + minute;
}

static bool other_is_on(struct other *o, const struct gn_schedule *s, int64_t now_s) {
    const time_t t = (time_t)now_s;
    struct tm tm;
    localtime_r(&t, &tm);
    const long shown = minutes_of(&tm, 0, tm.tm_hour * 60 + tm.tm_min);
    for (int i = 0; i < s->count; i++)
        for (int plus = -1; plus <= 0; plus++) {
            const struct gn_schedule_span *span = &s->spans[i];
            if (!(span->days >> (tm.tm_wday + 7 + plus) % 7 & 1)) continue;
            const long from = minutes_of(&tm, plus, span->from_min);
            const long to = minutes_of(&tm, plus + (span->to_min <= span->from_min), span->to_min);
            bool known = shown < from;
            for (int k = 0; k < o->count && !known; k++)
                known = o->runs[k].from == from && o->runs[k].to == to;
            if (known) continue;
            if (o->count == (int)(sizeof o->runs / sizeof o->runs[0]))
                memmove(o->runs, o->runs + 1, sizeof o->runs - sizeof o->runs[0]), o->count--;
            o->runs[o->count++] = (struct run){1, from, to};
        }
    bool is_on = false;
    for (int k = 0; k < o->count; k++) {
        if (shown >= o->runs[k].to) o->runs[k].begun = 0; /* for good, also when it comes twice */
        is_on |= o->runs[k].begun;
    }
    return is_on;
}

static const char *const zones[] = {
    "CET-1CEST,M3.5.0,M10.5.0/3",                   /* Berlin */
    "EST5EDT,M3.2.0,M11.1.0",                       /* New York */
    "<+1030>-10:30<+11>-11,M10.1.0,M4.1.0",         /* Lord Howe: half an hour */
    "<-04>4<-03>,M9.1.6/24,M4.1.6/24",              /* Santiago: at midnight */
    "<+1245>-12:45<+1345>,M9.5.0/2:45,M4.1.0/3:45", /* Chatham */
    "<+0545>-5:45",                                 /* Kathmandu */
};
static const char *const texts[] = {
    "mon-fri 08:00-20:00, sat 10:00-18:00",
    "02:00-03:00",              /* the hour that is skipped, and comes twice */
    "02:30-06:00, 22:00-01:45", /* inside it, and over midnight */
    "sun 01:30-02:15, sat 20:00-02:45, sun-mon 23:30-00:30",
    "00:00-24:00",
    "sat 00:00-24:00, sun 23:00-23:30",
};

static void every_switch_is_right(void **state) {
    (void)state;
    const bool full = getenv("GN_FULL");
    const int years = full ? 2 : 1;
    for (size_t z = 0; z < sizeof zones / sizeof zones[0]; z++)
        for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
            if (!full && i != z) continue; /* else all with all */
            const struct gn_schedule schedule = parsed(texts[i]);
            static struct other other;
            int64_t next_s = 0;
            int switches = 0;
            bool before = false;
            set_zone(zones[z]);
            other.count = 0;
            /* begins two days early, so that what runs then is known */
            for (int64_t now_s = BEGIN_S - 2 * 86400; now_s < BEGIN_S + years * YEAR_S;
                 now_s += 60) {
                const bool wanted = other_is_on(&other, &schedule, now_s);
                if (now_s < BEGIN_S) continue;
                if (gn_schedule_is_on(&schedule, now_s) != wanted)
                    fail_msg("%s, \"%s\": at %lld it is %s", zones[z], texts[i], (long long)now_s,
                             wanted ? "off" : "on");
                if (now_s == BEGIN_S || wanted != before) {
                    if (now_s != BEGIN_S && next_s != now_s)
                        fail_msg("%s, \"%s\": next is %lld, not %lld", zones[z], texts[i],
                                 (long long)next_s, (long long)now_s);
                    switches += now_s != BEGIN_S;
                    next_s = gn_schedule_next(&schedule, now_s);
                } else if (now_s / 60 % 419 == 0) /* long after the last one */
                    assert_true(gn_schedule_next(&schedule, now_s) == next_s);
                before = wanted;
            }
            if (strcmp(texts[i], "00:00-24:00") == 0)
                assert_int_equal(switches, 0);
            else
                assert_in_range(switches, years * 104, years * 2 * 732 + 10);
        }
}

static void the_answer_does_not_depend_on_what_was_asked_before(void **state) {
    (void)state;
    const struct gn_schedule schedule = parsed(texts[0]);
    set_zone(zones[0]);
    srand(1);
    for (int i = 0; i < 1000; i++) { /* a clock that jumps */
        const int64_t at_s = BEGIN_S + rand() % YEAR_S;
        const bool first = gn_schedule_is_on(&schedule, at_s);
        gn_schedule_is_on(&schedule, BEGIN_S + rand() % YEAR_S);
        assert_int_equal(gn_schedule_is_on(&schedule, at_s), first);
    }
    const struct gn_schedule always = parsed("always");
    assert_true(gn_schedule_is_on(&always, 0) && gn_schedule_is_on(&always, -1));
    assert_true(gn_schedule_next(&always, BEGIN_S) == INT64_MAX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_are_read_and_written),
        cmocka_unit_test(every_switch_is_right),
        cmocka_unit_test(the_answer_does_not_depend_on_what_was_asked_before),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
