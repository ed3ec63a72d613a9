#include "options/schedule.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#include "core/text.h"

enum { DAY_MIN = 1440, DAYS = 7 };
static const int64_t DAY_S = 86400;
static const char names[DAYS][4] = {"sun", "mon", "tue", "wed", "thu", "fri", "sat"};

/* ---- text ----------------------------------------------------------------------------------- */

static void skip_spaces(const char **at) { *at += strspn(*at, " \t"); }

static bool parse_day(const char **at, int *day) {
    for (*day = 0; *day < DAYS; ++*day)
        if (strncmp(*at, names[*day], 3) == 0) {
            *at += 3;
            return true;
        }
    return false;
}

/* "mon" or "mon-fri", round the end of the week. */
static bool parse_days(const char **at, uint8_t *days) {
    int first, last;
    if (!parse_day(at, &first)) return false;
    last = first;
    if (**at == '-') {
        ++*at;
        if (!parse_day(at, &last)) return false;
    }
    for (int day = first;; day = (day + 1) % DAYS) {
        *days |= (uint8_t)(1 << day);
        if (day == last) return true;
    }
}

static bool parse_number(const char **at, int most, int *out) {
    const size_t digits = strspn(*at, "0123456789");
    if (digits < 1 || digits > 2) return false;
    *out = (*at)[0] - '0';
    if (digits == 2) *out = *out * 10 + (*at)[1] - '0';
    *at += digits;
    return *out <= most;
}

static bool parse_minute(const char **at, uint16_t *out) {
    int hour, minute;
    if (!parse_number(at, 24, &hour) || **at != ':') return false;
    ++*at;
    if (strspn(*at, "0123456789") != 2 || !parse_number(at, 59, &minute)) return false;
    *out = (uint16_t)(hour * 60 + minute);
    return *out <= DAY_MIN;
}

bool gn_schedule_parse(const char *text, const char *without, struct gn_schedule *out) {
    struct gn_schedule made = {0};
    uint8_t days = 0;
    *out = made;
    if (strcmp(text, without) == 0) return true;
    for (const char *at = text;; at++) {
        skip_spaces(&at);
        if (*at >= 'a' && !parse_days(&at, &days)) return false;
        skip_spaces(&at);
        if (*at != ',' || days == 0) { /* else: more days of the same span */
            if (made.count == GN_SCHEDULE_SPANS_MAX) return false;
            struct gn_schedule_span *span = &made.spans[made.count++];
            span->days = days ? days : 0x7f;
            days = 0;
            if (!parse_minute(&at, &span->from_min) || *at != '-') return false;
            at++;
            if (!parse_minute(&at, &span->to_min) || span->from_min == DAY_MIN) return false;
        }
        skip_spaces(&at);
        if (!*at) break;
        if (*at != ',') return false;
    }
    if (days) return false; /* days without times */
    *out = made;
    return true;
}

void gn_schedule_text(const struct gn_schedule *schedule, const char *without, char *out,
                      size_t size) {
    snprintf(out, size, "%s", schedule->count ? "" : without);
    for (int i = 0; i < schedule->count; i++) {
        const struct gn_schedule_span *span = &schedule->spans[i];
        const char *comma = "";
        for (int day = 1; day <= DAYS && span->days != 0x7f; day++) {
            if (!(span->days >> day % DAYS & 1)) continue;
            gn_text_add(out, size, "%s%s", comma, names[day % DAYS]);
            comma = ",";
        }
        gn_text_add(out, size, "%s%02d:%02d-%02d:%02d%s", span->days != 0x7f ? " " : "",
                    span->from_min / 60, span->from_min % 60, span->to_min / 60, span->to_min % 60,
                    i + 1 < schedule->count ? ", " : "");
    }
}

/* ---- local time ------------------------------------------------------------------------------ */

/* What the local clock shows, as seconds of a clock without time zone. */
static int64_t local_s(int64_t time_s) {
    const time_t t = (time_t)time_s;
    struct tm tm;
    return localtime_r(&t, &tm) ? time_s + tm.tm_gmtoff : time_s;
}

/* The first moment at which the local clock shows that or later. Time zones differ from UTC by at
 * most 26 hours, and their offset changes at most once in two days. */
static int64_t moment_of(int64_t shown_s) {
    int64_t low = shown_s - 26 * 3600, high = shown_s + 26 * 3600;
    const int64_t before = local_s(low) - low, after = local_s(high) - high;
    const int64_t early = shown_s - before, late = shown_s - after;
    if (local_s(early) == shown_s && local_s(early - 1) < shown_s) {
        const int64_t other = local_s(late) == shown_s ? late : early;
        return other < early ? other : early;
    }
    if (local_s(late) == shown_s && local_s(late - 1) < shown_s) return late;
    while (high - low > 1) { /* the clock skips it */
        const int64_t middle = low + (high - low) / 2;
        if (local_s(middle) >= shown_s)
            high = middle;
        else
            low = middle;
    }
    return high;
}

static int weekday_of(int64_t day) { return (int)(((day + 4) % DAYS + DAYS) % DAYS); }

/* Of the span that begins on that day (of the local calendar, since 1970). */
static void moments_of(const struct gn_schedule_span *span, int64_t day, int64_t *from_s,
                       int64_t *to_s) {
    const int64_t begin = day * DAY_S + span->from_min * 60;
    const int length = (span->to_min - span->from_min + DAY_MIN) % DAY_MIN;
    *from_s = moment_of(begin);
    *to_s = moment_of(begin + (length ? length : DAY_MIN) * 60);
}

/* The day before and the day after, too: a span may end on the next day, and a clock that is put
 * back at midnight shows a day again whose next one has begun. */
bool gn_schedule_is_on(const struct gn_schedule *schedule, int64_t time_s) {
    const int64_t shown = local_s(time_s),
                  today = (shown - (shown % DAY_S + DAY_S) % DAY_S) / DAY_S;
    for (int64_t day = today - 1; day <= today + 1; day++)
        for (int i = 0; i < schedule->count; i++) {
            int64_t from_s, to_s;
            if (!(schedule->spans[i].days >> weekday_of(day) & 1)) continue;
            moments_of(&schedule->spans[i], day, &from_s, &to_s);
            if (time_s >= from_s && time_s < to_s) return true;
        }
    return schedule->count == 0;
}

int64_t gn_schedule_next(const struct gn_schedule *schedule, int64_t time_s) {
    const int64_t today = local_s(time_s) / DAY_S;
    const bool is_on = gn_schedule_is_on(schedule, time_s);
    int64_t next_s = INT64_MAX;
    for (int64_t day = today - 1; day <= today + 8; day++)
        for (int i = 0; i < schedule->count; i++) {
            int64_t at_s[2];
            if (!(schedule->spans[i].days >> weekday_of(day) & 1)) continue;
            moments_of(&schedule->spans[i], day, &at_s[0], &at_s[1]);
            for (int k = 0; k < 2; k++)
                if (at_s[k] > time_s && at_s[k] < next_s &&
                    gn_schedule_is_on(schedule, at_s[k]) != is_on)
                    next_s = at_s[k];
        }
    return next_s;
}
