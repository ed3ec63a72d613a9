/* When the screen is on: spans of local time on days of the week, "mon-fri 08:00-20:00, sat
 * 10:00-18:00". A span that ends at or before its start ends on the next day. Pure: the time is an
 * argument; only the time zone is the process's (localtime_r).
 *
 * A span begins at the first moment at which the local clock shows its start or later, and ends at
 * the first moment after that at which the clock shows its end or later: a time that a change to
 * summer time skips counts when it is skipped, one that comes twice counts the first time. */
#ifndef GN_OPTIONS_SCHEDULE_H
#define GN_OPTIONS_SCHEDULE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { GN_SCHEDULE_SPANS_MAX = 16 };
struct gn_schedule { /* zeroed: no spans, which is as good as always on */
    int count;
    struct gn_schedule_span {
        uint8_t days;              /* bits 1 << day, Sunday 0 */
        uint16_t from_min, to_min; /* of the day, 0 to 1440 */
    } spans[GN_SCHEDULE_SPANS_MAX];
};

/* Spans with a comma between two. Days: names as mon, or mon-fri, or several with commas; none:
 * every day. `without`: the word for no spans, "always" or "never", whichever that means. */
bool gn_schedule_parse(const char *text, const char *without, struct gn_schedule *out);
void gn_schedule_text(const struct gn_schedule *schedule, const char *without, char *out,
                      size_t size);
/* At that time, in seconds since 1970. */
bool gn_schedule_is_on(const struct gn_schedule *schedule, int64_t time_s);
/* The first time after that at which it switches; INT64_MAX: not within eight days. */
int64_t gn_schedule_next(const struct gn_schedule *schedule, int64_t time_s);

#endif
