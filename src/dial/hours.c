/* What is drawn on a plate for its hours: lines, ticks, rings, numerals. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/arena.h"
#include "dial/private.h"

static const double INNER = 0.80, NUMERALS = 0.90; /* radii, as shares of the outer ring's */

static const char *const roman[] = {"XII", "I",   "II",   "III", "IV", "V",
                                    "VI",  "VII", "VIII", "IX",  "X",  "XI"};

bool gn_dial_build(struct gn_dial *d, const struct gn_dial_opts *opts, struct gn_err *err) {
    *d = (struct gn_dial){.opts = *opts};
    if (!(d->opts.size_m > 0)) d->opts.size_m = 0.3;
    if (!gn_dial_place_faces(d, err)) return false;
    gn_dial_draw_hours(d);
    gn_dial_draw_panel(d);
    return true;
}

void gn_dial_finish(struct gn_dial *d) {
    free(d->strokes);
    free(d->points);
    *d = (struct gn_dial){0};
}

/* ---- rings ---- */

static void draw_ring(struct gn_dial *d, int face, double across, double up, double width) {
    enum { STEPS = 96 };
    double points[STEPS + 1][2];
    for (int i = 0; i <= STEPS; i++) {
        const double angle = 2 * M_PI * (i % STEPS) / STEPS;
        points[i][0] = across * cos(angle);
        points[i][1] = up * sin(angle);
    }
    const struct gn_dial_stroke ring = {
        .face = face, .role = GN_DIAL_RING, .width_m = width, .hour = -1};
    gn_dial_stroke(d, ring, (const double(*)[2])points, STEPS + 1);
}

/* ---- hour lines ---- */

/* Distance along the ray to the circle around the centre; it starts inside. */
static double reach(const struct gn_dial_ray *ray, double radius) {
    const double b = ray->from[0] * ray->along[0] + ray->from[1] * ray->along[1];
    const double c = ray->from[0] * ray->from[0] + ray->from[1] * ray->from[1] - radius * radius;
    return -b + sqrt(fmax(b * b - c, 0));
}

static void point_on(const struct gn_dial_ray *ray, double t, double out[2]) {
    for (int i = 0; i < 2; i++) out[i] = ray->from[i] + t * ray->along[i];
}

struct tick { /* how a line of an hour looks */
    enum gn_dial_role role;
    double width, length; /* shares of the ring's radius; length 0: from near the style */
};
static const struct tick ticks[] = {[0] = {GN_DIAL_HOUR, 0.013, 0},
                                    [2] = {GN_DIAL_HALF, 0.010, 0.11},
                                    [1] = {GN_DIAL_QUARTER, 0.006, 0.055},
                                    [3] = {GN_DIAL_QUARTER, 0.006, 0.055}};

static void draw_line(struct gn_dial *d, int face, const struct gn_dial_ray *ray, double hour,
                      const struct tick *tick) {
    double ends[2][2];
    const double to = reach(ray, INNER * d->ring_m);
    point_on(ray, tick->length > 0 ? to - tick->length * d->ring_m : 0.16 * d->ring_m, ends[0]);
    point_on(ray, to, ends[1]);
    const struct gn_dial_stroke line = {
        .face = face, .role = tick->role, .width_m = tick->width * d->ring_m, .hour = hour};
    gn_dial_stroke(d, line, (const double(*)[2])ends, 2);
}

/* Both edges of the sheet cast the line that its foot lies on: a double line, as wide as the sheet.
 */
static void draw_hour(struct gn_dial *d, int face, double hour, const struct tick *tick) {
    const struct gn_dial_face *f = &d->faces[face];
    struct gn_dial_ray ray = gn_dial_hour_ray(d, face, gn_dial_hour_angle(d, hour));
    const double across = ray.along[1] * f->along[0] - ray.along[0] * f->along[1];
    if (ray.edge != 0 || fabs(across) > 0.5 || (f->along[0] == 0 && f->along[1] == 0)) {
        draw_line(d, face, &ray, hour, tick);
        return;
    }
    for (int side = -1; side <= 1; side += 2) {
        struct gn_dial_ray one = ray;
        one.from[0] -= side * d->thickness_m / 2 * f->along[1];
        one.from[1] += side * d->thickness_m / 2 * f->along[0];
        draw_line(d, face, &one, hour, tick);
    }
}

/* ---- numerals ---- */

struct place { /* of a numeral, and its top */
    double at[2], up[2];
};

/* Numerals of level plates are read from the style, those of others as they hang. */
static struct place numeral_place(const struct gn_dial *d, int face, int hour) {
    struct place place;
    const double angle = gn_dial_hour_angle(d, hour);
    if (d->opts.kind == GN_DIAL_ANALEMMATIC) {
        gn_dial_hour_point(d, angle, place.at);
        const double dip = place.at[1] / d->ring_m,
                     sine = sin(d->opts.latitude_deg * GN_DIAL_RADIANS);
        place.up[0] = place.at[0] / d->ring_m;
        place.up[1] = dip / (sine * sine);
    } else {
        const struct gn_dial_ray ray = gn_dial_hour_ray(d, face, angle);
        point_on(&ray, reach(&ray, NUMERALS * d->ring_m), place.at);
        for (int i = 0; i < 2; i++) place.up[i] = place.at[i];
    }
    const double length = hypot(place.up[0], place.up[1]);
    for (int i = 0; i < 2; i++) {
        place.up[i] /= length;
        if (d->opts.kind == GN_DIAL_ANALEMMATIC) place.at[i] += 0.155 * d->ring_m * place.up[i];
    }
    const bool hangs = d->opts.kind == GN_DIAL_VERTICAL || d->opts.kind == GN_DIAL_EQUATORIAL;
    if (hangs)
        for (int i = 0; i < 2; i++) place.up[i] = -place.up[i];
    return place;
}

/* Whether the numerals of each step-th hour fit beside each other at that height. */
static bool numerals_fit(const struct gn_dial *d, int face, int step, double height) {
    for (int hour = 0; hour < 24; hour += step) {
        const int next = (hour + step) % 24;
        if (!gn_dial_sees(d, face, gn_dial_hour_angle(d, hour)) ||
            !gn_dial_sees(d, face, gn_dial_hour_angle(d, next)))
            continue;
        const struct place a = numeral_place(d, face, hour), b = numeral_place(d, face, next);
        const double room = hypot(a.at[0] - b.at[0], a.at[1] - b.at[1]);
        if (room < (gn_dial_text_width(roman[hour % 12], height) +
                    gn_dial_text_width(roman[next % 12], height)) /
                           2 +
                       0.4 * height)
            return false;
    }
    return true;
}

static void draw_numerals(struct gn_dial *d, int face) {
    static const struct {
        int step;
        double height;
    } tries[] = {{1, .115}, {1, .095}, {1, .075}, {1, .06}, {2, .095}, {2, .07},
                 {3, .095}, {3, .07},  {6, .095}, {6, .05}, {12, .05}};
    size_t i = 0;
    while (i + 1 < sizeof tries / sizeof *tries &&
           !numerals_fit(d, face, tries[i].step, tries[i].height * d->ring_m))
        i++;
    for (int hour = 0; hour < 24; hour += tries[i].step) {
        if (!gn_dial_sees(d, face, gn_dial_hour_angle(d, hour))) continue;
        const struct place place = numeral_place(d, face, hour);
        struct gn_dial_text text = {
            .face = face, .role = GN_DIAL_NUMERAL, .height_m = tries[i].height * d->ring_m};
        memcpy(text.at, place.at, sizeof text.at);
        memcpy(text.up, place.up, sizeof text.up);
        gn_dial_write(d, &text, roman[hour % 12]);
    }
}

/* ---- ellipse ---- */

/* A tick across the ellipse, from its point outwards, perpendicular to it. */
static void draw_point(struct gn_dial *d, double hour, const struct tick *tick) {
    const double angle = gn_dial_hour_angle(d, hour),
                 sine = sin(fabs(d->opts.latitude_deg) * GN_DIAL_RADIANS);
    const double length = (tick->length > 0 ? tick->length / 2 : 0.08) * d->ring_m;
    double ends[2][2];
    gn_dial_hour_point(d, angle, ends[0]);
    const double out[2] = {ends[0][0], ends[0][1] / (sine * sine)};
    for (int i = 0; i < 2; i++) ends[1][i] = ends[0][i] + length * out[i] / hypot(out[0], out[1]);
    const struct gn_dial_stroke line = {
        .face = 0, .role = tick->role, .width_m = 1.4 * tick->width * d->ring_m, .hour = hour};
    gn_dial_stroke(d, line, (const double(*)[2])ends, 2);
}

void gn_dial_draw_hours(struct gn_dial *d) {
    const bool is_flat = d->opts.kind == GN_DIAL_ANALEMMATIC;
    const double sine = sin(fabs(d->opts.latitude_deg) * GN_DIAL_RADIANS);
    for (int face = 0; face < d->face_count; face++) {
        for (int quarter = 0; quarter < 96; quarter++) {
            const double hour = quarter / 4.0;
            if (!gn_dial_sees(d, face, gn_dial_hour_angle(d, hour))) continue;
            if (is_flat)
                draw_point(d, hour, &ticks[quarter % 4]);
            else
                draw_hour(d, face, hour, &ticks[quarter % 4]);
        }
        if (is_flat) {
            draw_ring(d, face, d->ring_m, d->ring_m * sine, 0.010 * d->ring_m);
        } else {
            draw_ring(d, face, INNER * d->ring_m, INNER * d->ring_m, 0.010 * d->ring_m);
            draw_ring(d, face, d->ring_m, d->ring_m, 0.018 * d->ring_m);
        }
        draw_numerals(d, face);
    }
}
