#include "options/date.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

static int days_of(int year, int month) {
    static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leaps = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return days[month - 1] + (month == 2 && leaps);
}

/* A number of exactly so many digits, then one of `ends`; NULL, or what follows the digits. */
static const char *read_digits(const char *text, int count, const char *ends, int *out) {
    *out = 0;
    for (int i = 0; i < count; i++, text++) {
        if (*text < '0' || *text > '9') return NULL;
        *out = 10 * *out + (*text - '0');
    }
    return *text == '\0' || strchr(ends, *text) ? text : NULL;
}

/* "Z", "+01:00" or nothing. */
static bool read_offset(const char *text, struct gn_date *out) {
    int hours, minutes;
    const int sign = *text == '-' ? -1 : 1;
    if (*text == '\0') return true;
    out->has_offset = true;
    if (strcmp(text, "Z") == 0) return true;
    if ((*text != '+' && *text != '-') || !(text = read_digits(text + 1, 2, ":", &hours)) ||
        *text != ':' || !read_digits(text + 1, 2, "", &minutes))
        return false;
    out->offset_s = sign * (hours * 3600 + minutes * 60);
    return hours <= 14 && minutes <= 59;
}

static bool read_time(const char *text, struct gn_date *out) {
    int hours, minutes, seconds = 0;
    out->has_time = true;
    if (!(text = read_digits(text, 2, ":", &hours)) || *text != ':' ||
        !(text = read_digits(text + 1, 2, ":Z+-", &minutes)))
        return false;
    if (*text == ':' && !(text = read_digits(text + 1, 2, "Z+-", &seconds))) return false;
    out->second = hours * 3600 + minutes * 60 + seconds;
    return hours <= 23 && minutes <= 59 && seconds <= 60 && read_offset(text, out);
}

bool gn_date_parse(const char *text, struct gn_date *out) {
    *out = (struct gn_date){.second = 12 * 3600};
    if (!(text = read_digits(text, 4, "-", &out->year)) || *text != '-' ||
        !(text = read_digits(text + 1, 2, "-", &out->month)) || *text != '-' ||
        !(text = read_digits(text + 1, 2, "T ", &out->day)))
        return false;
    if (out->year < 1900 || out->year > 2100 || out->month < 1 || out->month > 12 || out->day < 1 ||
        out->day > days_of(out->year, out->month))
        return false;
    return *text == '\0' || read_time(text + 1, out);
}

static bool is_zone(const char *zone) {
    const char *folder = getenv("TZDIR");
    char path[300];
    struct stat info;
    snprintf(path, sizeof path, "%s/%.100s", folder ? folder : "/usr/share/zoneinfo", zone);
    return strcmp(zone, "UTC") == 0 || (zone[0] && zone[0] != '/' && !strstr(zone, "..") &&
                                        stat(path, &info) == 0 && S_ISREG(info.st_mode));
}

static void set_zone(const char *zone) {
    if (zone)
        setenv("TZ", zone, 1);
    else
        unsetenv("TZ");
    tzset();
}

/* What TZ was, to be given to restore_zone(). */
static char *change_zone(const char *zone) {
    const char *was = getenv("TZ");
    char *before = was ? strdup(was) : NULL;
    if (zone) set_zone(zone);
    return before;
}

static void restore_zone(const char *zone, char *before) {
    if (zone) set_zone(before);
    free(before);
}

bool gn_date_utc(const struct gn_date *date, const char *zone, double *utc_s, struct gn_err *err) {
    struct tm tm = {.tm_year = date->year - 1900,
                    .tm_mon = date->month - 1,
                    .tm_mday = date->day,
                    .tm_sec = date->second,
                    .tm_isdst = -1};
    if (zone && !is_zone(zone))
        return gn_fail_usage(
            err,
            "there is no time zone \"%.80s\" in the system's tz database; write one "
            "as Europe/Berlin, or install tzdata",
            zone);
    if (date->has_offset) {
        *utc_s = (double)timegm(&tm) - date->offset_s;
        return true;
    }
    char *before = change_zone(zone);
    /* seconds of the day at once would miss the change of the clock within it */
    tm.tm_hour = date->second / 3600;
    tm.tm_sec = date->second % 3600;
    *utc_s = (double)mktime(&tm);
    restore_zone(zone, before);
    return true;
}

void gn_date_print(double utc_s, const char *zone, char *out, size_t size) {
    static const char *const months[] = {"January",   "February", "March",    "April",
                                         "May",       "June",     "July",     "August",
                                         "September", "October",  "November", "December"};
    const time_t moment = (time_t)floor(utc_s);
    struct tm tm = {0};
    char *before = change_zone(zone);
    localtime_r(&moment, &tm);
    restore_zone(zone, before);
    snprintf(out, size, "%d %s %d, %02d:%02d", tm.tm_mday, months[tm.tm_mon], tm.tm_year + 1900,
             tm.tm_hour, tm.tm_min);
}
