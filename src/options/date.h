/* Dates as ISO 8601 writes them, and the moments that they are. */
#ifndef GN_OPTIONS_DATE_H
#define GN_OPTIONS_DATE_H

#include <stdbool.h>
#include <stddef.h>

#include "core/err.h"

struct gn_date {
    int year, month, day; /* 1900 to 2100, from 1, from 1 */
    bool has_time;        /* else second is that of noon */
    int second;           /* of the day, 0 to 86400: a leap second is the next one */
    bool has_offset;      /* the text ends with Z or +01:00 */
    int offset_s;         /* how far that clock is ahead of UTC */
};

/* All of "2026-12-21", "2026-12-21T09:30", "2026-12-21 09:30:15+01:00" (T or a space, seconds and
 * offset may be missing). False: it is no date of the calendar, or of another form. */
bool gn_date_parse(const char *text, struct gn_date *out);

/* Seconds of UTC since 1970 of a date without an offset by the clock of that zone, of one with an
 * offset by that. zone: a name of the system's tz database, NULL: the system's own. An hour that
 * the clock skips is taken as the C library does, one that it repeats as the first or the second.
 * False: there is no such zone. Changes and restores TZ: for one thread, while no other uses local
 * time. */
bool gn_date_utc(const struct gn_date *date, const char *zone, double *utc_s, struct gn_err *err);

/* "21 June 2026, 14:05" by the clock of that zone, which is as above; of a moment in 1900 to 2100.
 * A zone that is not there counts as UTC. TZ as above. */
void gn_date_print(double utc_s, const char *zone, char *out, size_t size);

#endif
