/* Faces, styles, hour lines.
 *
 * The shadow plane of an hour holds the earth's axis p and the point q of the celestial equator
 * below which the sun stands. It meets a face of normal n in the line along -q + p (q.n) / (p.n).
 * On a level plate that is Waugh's tan X = sin(latitude) tan(h), on a wall that faces D west of
 * south his cot X = (cos D cot h + sin D sin(latitude)) / cos(latitude), X from the vertical. */
#include <math.h>
#include <string.h>

#include "dial/private.h"

static const double LEAST_RISE_DEG = 5, LEAST_DIP_DEG = 15, MOST_DIP_DEG = 80;

void gn_dial_equator(double latitude_deg, double hour_deg, double out[3]) {
    const double lat = latitude_deg * GN_DIAL_RADIANS, h = hour_deg * GN_DIAL_RADIANS;
    out[0] = -sin(h);
    out[1] = cos(lat) * cos(h);
    out[2] = sin(lat) * cos(h);
}

void gn_dial_pole(double latitude_deg, double out[3]) {
    out[0] = 0;
    out[1] = sin(latitude_deg * GN_DIAL_RADIANS);
    out[2] = -cos(latitude_deg * GN_DIAL_RADIANS);
}

void gn_dial_to_sun(double latitude_deg, double declination_deg, double hour_deg, double out[3]) {
    const double declination = declination_deg * GN_DIAL_RADIANS;
    double q[3], p[3];
    gn_dial_equator(latitude_deg, hour_deg, q);
    gn_dial_pole(latitude_deg, p);
    for (int i = 0; i < 3; i++) out[i] = cos(declination) * q[i] + sin(declination) * p[i];
}

double gn_dial_hour_angle(const struct gn_dial *dial, double hour) {
    return 15 * (hour - 12) + dial->opts.shift_deg;
}

bool gn_dial_sees(const struct gn_dial *dial, int face, double hour_deg) {
    enum { STEPS = 48 };
    const double least = sin(0.5 * GN_DIAL_RADIANS); /* grazing light shows no time */
    for (int i = 0; i <= STEPS; i++) {
        double sun[3];
        gn_dial_to_sun(dial->opts.latitude_deg, GN_DIAL_OBLIQUITY_DEG * (2.0 * i / STEPS - 1),
                       hour_deg, sun);
        if (sun[1] > least && gn_dial_dot(sun, dial->faces[face].normal) > least) return true;
    }
    return false;
}

void gn_dial_place(const struct gn_dial *dial, int face, const double at[2], double height_m,
                   double out[3]) {
    const struct gn_dial_face *f = &dial->faces[face];
    for (int i = 0; i < 3; i++)
        out[i] = f->centre[i] + at[0] * f->right[i] + at[1] * f->up[i] + height_m * f->normal[i];
}

/* The sheet's shadow lies between its foot and the line, so its outer edge is cast by the edge that
 * is farther from the foot's direction. That changes where the line is perpendicular to the foot:
 * before six and after eighteen o'clock of a level plate (Waugh, chapter 6). */
struct gn_dial_ray gn_dial_hour_ray(const struct gn_dial *dial, int face, double hour_deg) {
    const struct gn_dial_face *f = &dial->faces[face];
    double q[3], p[3], line[3];
    gn_dial_equator(dial->opts.latitude_deg, hour_deg, q);
    gn_dial_pole(dial->opts.latitude_deg, p);
    const double share = gn_dial_dot(q, f->normal) / gn_dial_dot(p, f->normal);
    for (int i = 0; i < 3; i++) line[i] = share * p[i] - q[i];
    struct gn_dial_ray ray = {.along = {gn_dial_dot(line, f->right), gn_dial_dot(line, f->up)}};
    const double length = hypot(ray.along[0], ray.along[1]);
    for (int i = 0; i < 2; i++) ray.along[i] /= length;
    const double across[2] = {-f->along[1], f->along[0]};
    const double a = ray.along[0] * f->along[0] + ray.along[1] * f->along[1],
                 b = ray.along[0] * across[0] + ray.along[1] * across[1];
    ray.edge = fabs(a * b) < 1e-9 ? 0 : a * b > 0 ? 1 : -1;
    for (int i = 0; i < 2; i++)
        ray.from[i] = f->foot[i] + ray.edge * dial->thickness_m / 2 * across[i];
    return ray;
}

/* ---- analemmatic dials: Waugh, chapter 16 ---- */

void gn_dial_hour_point(const struct gn_dial *dial, double hour_deg, double out[2]) {
    const double h = hour_deg * GN_DIAL_RADIANS,
                 lat = fabs(dial->opts.latitude_deg) * GN_DIAL_RADIANS;
    out[0] = (dial->opts.latitude_deg < 0 ? -1 : 1) * dial->ring_m * sin(h);
    out[1] = dial->ring_m * sin(lat) * cos(h);
}

double gn_dial_pin(const struct gn_dial *dial, double declination_deg) {
    const double reach =
        tan(declination_deg * GN_DIAL_RADIANS) * cos(dial->opts.latitude_deg * GN_DIAL_RADIANS);
    return (dial->opts.latitude_deg < 0 ? -1 : 1) * dial->ring_m * reach;
}

/* ---- faces ---- */

static void set_frame(struct gn_dial_face *face, const double up[3], const double normal[3]) {
    memcpy(face->up, up, sizeof face->up);
    memcpy(face->normal, normal, sizeof face->normal);
    gn_dial_cross(up, normal, face->right);
}

/* The style to the pole before the face, and its foot's direction; false: parallel to the face. */
static bool set_style(struct gn_dial_face *face, double latitude_deg) {
    double pole[3];
    gn_dial_pole(latitude_deg, pole);
    const double side = gn_dial_dot(pole, face->normal) < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) face->style[i] = side * pole[i];
    const double sine = fmin(gn_dial_dot(face->style, face->normal), 1);
    face->rise_deg = asin(sine) / GN_DIAL_RADIANS;
    const double foot[2] = {gn_dial_dot(face->style, face->right),
                            gn_dial_dot(face->style, face->up)};
    const double length = hypot(foot[0], foot[1]);
    for (int i = 0; i < 2; i++)
        face->along[i] = length > 1e-9 ? foot[i] / length : i; /* at the poles upwards */
    return face->rise_deg >= LEAST_RISE_DEG;
}

static bool place_level(struct gn_dial *d, struct gn_err *err) {
    const double latitude = d->opts.latitude_deg, north = latitude < 0 ? -1 : 1;
    set_frame(&d->faces[0], (double[3]){0, 0, -north}, (double[3]){0, 1, 0});
    return set_style(&d->faces[0], latitude) ||
           gn_fail_usage(err,
                         "--latitude %g: the style of a horizontal dial would lie on its plate "
                         "(%g degrees, at least %g): use --kind equatorial",
                         latitude, d->faces[0].rise_deg, LEAST_RISE_DEG);
}

static bool place_wall(struct gn_dial *d, struct gn_err *err) {
    const double wall = d->opts.wall_deg * GN_DIAL_RADIANS;
    set_frame(&d->faces[0], (double[3]){0, 1, 0}, (double[3]){-sin(wall), 0, cos(wall)});
    if (set_style(&d->faces[0], d->opts.latitude_deg)) return true;
    if (cos(d->opts.latitude_deg * GN_DIAL_RADIANS) < 2 * sin(LEAST_RISE_DEG * GN_DIAL_RADIANS))
        return gn_fail_usage(err,
                             "--latitude %g: a vertical dial is parallel to the earth's axis so "
                             "near to the pole: use --kind horizontal",
                             d->opts.latitude_deg);
    return gn_fail_usage(err,
                         "--declination %g: the wall is nearly parallel to the earth's axis "
                         "(%g degrees, at least %g), its hour lines do not meet: use --kind "
                         "horizontal or equatorial",
                         d->opts.wall_deg, d->faces[0].rise_deg, LEAST_RISE_DEG);
}

static bool place_equator(struct gn_dial *d) {
    double noon[3], pole[3], down[3];
    gn_dial_equator(d->opts.latitude_deg, 0, noon);
    gn_dial_pole(d->opts.latitude_deg, pole);
    const double side = d->opts.latitude_deg < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) pole[i] *= side, down[i] = -pole[i];
    set_frame(&d->faces[0], noon, pole);
    set_frame(&d->faces[1], noon, down);
    for (int i = 0; i < 2; i++) {
        memcpy(d->faces[i].style, i ? down : pole, sizeof pole);
        d->faces[i].rise_deg = 90;
    }
    d->face_count = 2;
    return true;
}

static bool place_ellipse(struct gn_dial *d, struct gn_err *err) {
    const double latitude = d->opts.latitude_deg, north = latitude < 0 ? -1 : 1;
    if (fabs(latitude) < LEAST_DIP_DEG)
        return gn_fail_usage(err,
                             "--latitude %g: the ellipse of an analemmatic dial is too flat so "
                             "near to the equator (at least %g degrees): use --kind equatorial",
                             latitude, LEAST_DIP_DEG);
    if (fabs(latitude) > MOST_DIP_DEG)
        return gn_fail_usage(err,
                             "--latitude %g: the dates of an analemmatic dial are too close so "
                             "near to the pole (at most %g degrees): use --kind horizontal",
                             latitude, MOST_DIP_DEG);
    set_frame(&d->faces[0], (double[3]){0, 0, -north}, (double[3]){0, 1, 0});
    memcpy(d->faces[0].style, (double[3]){0, 1, 0}, sizeof d->faces[0].style);
    d->faces[0].rise_deg = 90;
    return true;
}

/* ---- sizes, as shares of the width ---- */

static void set_sizes(struct gn_dial *d) {
    const double width = d->opts.size_m;
    const bool is_flat = d->opts.kind == GN_DIAL_ANALEMMATIC;
    const bool is_sheet = d->opts.kind == GN_DIAL_HORIZONTAL || d->opts.kind == GN_DIAL_VERTICAL;
    d->ring_m = (is_flat ? 0.38 : 0.455) * width;
    d->plate_m = 0.022 * width;
    d->thickness_m = (is_sheet ? 0.012 : 0.014) * width;
    double half = 0.5 * width;
    if (is_flat)
        half = fmax(d->ring_m * sin(fabs(d->opts.latitude_deg) * GN_DIAL_RADIANS),
                    fabs(gn_dial_pin(d, GN_DIAL_OBLIQUITY_DEG))) +
               0.115 * width;
    d->low[0] = -0.5 * width;
    d->high[0] = 0.5 * width;
    d->low[1] = -half - 0.17 * width;
    d->high[1] = half;
    const double sine = sin(d->faces[0].rise_deg * GN_DIAL_RADIANS);
    d->style_m = is_flat    ? 0.75 * d->ring_m
                 : is_sheet ? fmin(0.95, 0.75 / sine) * d->ring_m
                            : 0.85 * d->ring_m;
    for (int i = 0; is_sheet && i < 2; i++)
        d->faces[0].foot[i] =
            -0.7 * cos(d->faces[0].rise_deg * GN_DIAL_RADIANS) * d->ring_m * d->faces[0].along[i];
}

/* Lifts the dial so that it stands on what the model has below it (model.c). */
static void lift_faces(struct gn_dial *d) {
    const double width = d->opts.size_m;
    double height = 0.09 * width + d->plate_m;
    if (d->opts.kind == GN_DIAL_VERTICAL) height = 0.15 * width - d->low[1];
    if (d->opts.kind == GN_DIAL_EQUATORIAL)
        height = 0.09 * width + fmax(0.35 * width, -d->low[1] * d->faces[0].up[1]);
    d->faces[0].centre[1] = height;
    for (int i = 0; i < 3; i++)
        d->faces[1].centre[i] = d->faces[0].centre[i] - d->plate_m * d->faces[0].normal[i];
}

bool gn_dial_place_faces(struct gn_dial *d, struct gn_err *err) {
    d->face_count = 1;
    const bool can_be = d->opts.kind == GN_DIAL_HORIZONTAL   ? place_level(d, err)
                        : d->opts.kind == GN_DIAL_VERTICAL   ? place_wall(d, err)
                        : d->opts.kind == GN_DIAL_EQUATORIAL ? place_equator(d)
                                                             : place_ellipse(d, err);
    if (!can_be) return false;
    set_sizes(d);
    lift_faces(d);
    return true;
}

int gn_dial_sheet(const struct gn_dial *dial, double (*out)[2]) {
    enum { CURVE = 16 };
    const double rise = dial->faces[0].rise_deg * GN_DIAL_RADIANS;
    if (dial->faces[0].along[0] == 0 && dial->faces[0].along[1] == 0) return 0;
    const double tip[2] = {dial->style_m * cos(rise), dial->style_m * sin(rise)};
    const double end = fmax(tip[0], 0.25 * dial->ring_m);
    int count = 0;
    out[count][0] = out[count][1] = 0;
    count++;
    for (int i = 0; i <= CURVE;
         i++, count++) { /* a quadratic curve from the foot's end to the tip */
        const double t = (double)i / CURVE, a = (1 - t) * (1 - t), b = 2 * t * (1 - t), c = t * t;
        out[count][0] = end * (a + 0.7 * b) + tip[0] * c;
        out[count][1] = tip[1] * (0.42 * b + c);
    }
    return count;
}
