/* The panel under the ring: the equation of time as a curve over the year, and the place; of an
 * analemmatic dial also the dates at which its pin stands. */
#include <math.h>
#include <stdio.h>

#include "core/sun.h"
#include "dial/private.h"

/* Noon of UTC on the first of January 2026, near the middle of the cycle of leap years: from year
 * to year the curve moves by up to a quarter of a minute, and the sun's declination by a tenth of a
 * degree. */
static const double YEAR_S = 1767268800, DAY_S = 86400;
static const int month_start[] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334, 365};
static const char *const month_names[] = {"J", "F", "M", "A", "M", "J",
                                          "J", "A", "S", "O", "N", "D"};

static struct gn_sun sun_of_day(double day) { return gn_sun_at(YEAR_S + day * DAY_S); }

static void draw_segment(struct gn_dial *d, int face, const double from[2], const double to[2],
                         double width) {
    const double ends[2][2] = {{from[0], from[1]}, {to[0], to[1]}};
    const struct gn_dial_stroke line = {
        .face = face, .role = GN_DIAL_YEAR, .width_m = width, .hour = -1};
    gn_dial_stroke(d, line, ends, 2);
}

static void write_at(struct gn_dial *d, int face, double x, double y, double height,
                     const char *text) {
    const struct gn_dial_text how = {
        .face = face, .role = GN_DIAL_YEAR, .at = {x, y}, .up = {0, 1}, .height_m = height};
    gn_dial_write(d, &how, text);
}

/* ---- the equation of time ---- */

/* What is to be added to the dial's time for that of the clock: less the equation of time. */
static void draw_curve(struct gn_dial *d, int face, double left, double middle, double wide,
                       double minute) {
    enum { STEPS = 73 };
    double points[STEPS + 1][2];
    for (int i = 0; i <= STEPS; i++) {
        points[i][0] = left + wide * i / STEPS;
        points[i][1] = middle - minute * sun_of_day(365.0 * i / STEPS).equation_of_time_s / 60;
    }
    const struct gn_dial_stroke curve = {
        .face = face, .role = GN_DIAL_YEAR, .width_m = 0.005 * d->opts.size_m, .hour = -1};
    gn_dial_stroke(d, curve, (const double(*)[2])points, STEPS + 1);
}

static void draw_graph(struct gn_dial *d, int face) {
    const double w = d->opts.size_m, left = -0.30 * w, wide = 0.60 * w, minute = 0.0032 * w;
    const double middle = d->low[1] + 0.105 * w, thin = 0.0025 * w;
    for (int i = 0; i <= 12; i++) {
        const double x = left + wide * month_start[i] / 365, tall = i % 3 ? 0.008 * w : 15 * minute;
        draw_segment(d, face, (double[2]){x, middle - tall}, (double[2]){x, middle + tall}, thin);
        if (i < 12)
            write_at(d, face, left + wide * (month_start[i] + month_start[i + 1]) / 730,
                     d->low[1] + 0.032 * w, 0.022 * w, month_names[i]);
    }
    for (int i = -1; i <= 1; i++) {
        const double y = middle + 15 * i * minute;
        draw_segment(d, face, (double[2]){left, y}, (double[2]){left + wide, y}, thin);
        write_at(d, face, left - 0.035 * w, y, 0.020 * w, i < 0 ? "-15" : i ? "+15" : "0");
    }
    draw_curve(d, face, left, middle, wide, minute);
}

static void write_degrees(struct gn_dial *d, int face, double y, double degrees, const char *ends) {
    char text[32];
    snprintf(text, sizeof text, "%.1f* %c", fabs(degrees), degrees < 0 ? ends[1] : ends[0]);
    write_at(d, face, 0.395 * d->opts.size_m, y, 0.024 * d->opts.size_m, text);
}

/* ---- dates ---- */

/* Dates go up the right of the scale while days grow longer in the north, and down its left. */
static void draw_dates(struct gn_dial *d) {
    const double w = d->opts.size_m, half = 0.05 * w, thin = 0.003 * w;
    const double most = gn_dial_pin(d, GN_DIAL_OBLIQUITY_DEG), least = -most;
    for (int i = -1; i <= 1; i++)
        draw_segment(d, 0, (double[2]){i * half, least}, (double[2]){i * half, most}, thin);
    draw_segment(d, 0, (double[2]){-half, least}, (double[2]){half, least}, thin);
    draw_segment(d, 0, (double[2]){-half, most}, (double[2]){half, most}, thin);
    for (int i = 0; i < 12; i++) {
        const double from = gn_dial_pin(d, sun_of_day(month_start[i]).declination_deg),
                     mid = gn_dial_pin(
                         d,
                         sun_of_day((month_start[i] + month_start[i + 1]) / 2.0).declination_deg);
        const double side = i < 6 ? half : -half;
        draw_segment(d, 0, (double[2]){0, from}, (double[2]){side, from}, thin);
        const double room = fabs(most) / 9;
        write_at(d, 0, 1.45 * side, mid, fmin(0.024 * w, room), month_names[i]);
    }
}

void gn_dial_draw_panel(struct gn_dial *d) {
    if (d->opts.kind == GN_DIAL_ANALEMMATIC) draw_dates(d);
    draw_graph(d, 0);
    write_degrees(d, 0, d->low[1] + 0.105 * d->opts.size_m, d->opts.latitude_deg, "NS");
}
