/* Sundials read from pictures: the edge of the style's shadow, as gnomon draws it by a shadow map
 * and by rays, lies where the hour line of that moment would. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dial/dial.h"
#include "image/shot.h"
#include "unit/check.h"

enum { SIZE_PX = 640, SUNS = 40, CAST_SUNS = 10, STEPS = 60 };
static const double MOST_DEG = 0.3, GOAL_DEG = 0.2;

static unsigned random_state = 20260621;
static double next_between(double low, double high) {
    random_state = random_state * 1664525u + 1013904223u;
    return low + (high - low) * (random_state >> 8) / 16777216.0;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- the picture of a face ---- */

/* Visibility at a point of the first face: camera Face shows a square around the plate's centre. */
static double visibility_at(const struct gn_dial *dial, const struct gn_picture *picture,
                            const double at[2]) {
    const double width = dial->opts.size_m, tall = dial->high[1] - dial->low[1],
                 half = fmax(width, tall) / 2 + 0.09 * width;
    const double middle = (dial->low[1] + dial->high[1]) / 2;
    const double x = (at[0] / half + 1) / 2 * SIZE_PX - 0.5,
                 y = (1 - (at[1] - middle) / half) / 2 * SIZE_PX - 0.5;
    const int column = (int)floor(x), row = (int)floor(y);
    assert_in_range(column, 0, SIZE_PX - 2);
    assert_in_range(row, 0, SIZE_PX - 2);
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const int c = column + i % 2, r = row + i / 2;
        const double share =
            (i % 2 ? x - column : 1 - x + column) * (i / 2 ? y - row : 1 - y + row);
        sum += share * (double)*gn_picture_at(picture, c, r);
    }
    return sum;
}

/* How far to the left of the ray the edge of the shadow is at a distance, or NAN. */
static double edge_at(const struct gn_dial *dial, const struct gn_picture *picture,
                      const struct gn_dial_ray *ray, double t) {
    const double step = 0.0004 * dial->opts.size_m;
    double best = NAN, before = NAN;
    for (int i = -15; i <= 15; i++) {
        const double e = i * step;
        const double at[2] = {ray->from[0] + t * ray->along[0] - e * ray->along[1],
                              ray->from[1] + t * ray->along[1] + e * ray->along[0]};
        const double now = visibility_at(dial, picture, at) - 0.5;
        if (before * now <= 0 && before != now) {
            const double cross = e - step * now / (now - before);
            if (!(fabs(best) < fabs(cross))) best = cross;
        }
        before = now;
    }
    return best;
}

/* The line through the edges from one distance to another, and its angles to the ray in degrees: of
 * its direction, and of its middle seen from the foot of the style. */
static void measure_edge(const struct gn_dial *dial, const struct gn_picture *picture,
                         const struct gn_dial_ray *ray, const double reach[2], double degrees[2]) {
    double n = 0, t1 = 0, t2 = 0, e1 = 0, te = 0;
    for (int i = 0; i < STEPS; i++) {
        const double t = reach[0] + (reach[1] - reach[0]) * i / (STEPS - 1);
        const double e = edge_at(dial, picture, ray, t);
        if (isnan(e)) continue;
        n++, t1 += t, t2 += t * t, e1 += e, te += t * e;
    }
    assert_true(n > 0.9 * STEPS);
    degrees[0] = atan((n * te - t1 * e1) / (n * t2 - t1 * t1)) * 180 / M_PI;
    degrees[1] = atan(e1 / t1) * 180 / M_PI;
}

/* ---- a sun ---- */

/* How far along the ray the style's shadow goes, on the plate. */
static double shadow_reach(const struct gn_dial *dial, const struct gn_dial_ray *ray,
                           const double sun[3]) {
    const struct gn_dial_face *f = &dial->faces[0];
    const double lift = dial->style_m * dot(f->style, f->normal) / dot(sun, f->normal);
    double tip[2] = {0};
    for (int i = 0; i < 3; i++) {
        tip[0] += (dial->style_m * f->style[i] - lift * sun[i]) * f->right[i];
        tip[1] += (dial->style_m * f->style[i] - lift * sun[i]) * f->up[i];
    }
    double t = 0.95 * hypot(tip[0], tip[1]);
    for (int k = 0; k < 2; k++) {
        const double end = ray->along[k] < 0 ? dial->low[k] : dial->high[k];
        if (fabs(ray->along[k]) > 1e-9) t = fmin(t, 0.94 * (end - ray->from[k]) / ray->along[k]);
    }
    return t;
}

/* From the pin at its date to the point of the hour. */
static struct gn_dial_ray pin_ray(const struct gn_dial *dial) {
    struct gn_dial_ray ray = {.from = {0, gn_dial_pin(dial, dial->opts.sun_deg)}};
    double point[2];
    gn_dial_hour_point(dial, dial->opts.sun_hour_deg, point);
    const double length = hypot(point[0] - ray.from[0], point[1] - ray.from[1]);
    for (int i = 0; i < 2; i++) ray.along[i] = (point[i] - ray.from[i]) / length;
    return ray;
}

/* Whether time is read in the middle of the shadow. */
static bool is_rod(const struct gn_dial *dial) {
    return dial->opts.kind == GN_DIAL_EQUATORIAL || dial->opts.kind == GN_DIAL_ANALEMMATIC;
}

/* A dial and a sun that lights it well; the shadow is long enough to be read. */
static void choose_dial(struct gn_dial *dial, int number, struct gn_dial_ray *ray,
                        double reach[2]) {
    static const enum gn_dial_kind kinds[] = {GN_DIAL_HORIZONTAL, GN_DIAL_VERTICAL,
                                              GN_DIAL_EQUATORIAL, GN_DIAL_ANALEMMATIC};
    for (;; gn_dial_finish(dial)) {
        const double south = number / 4 % 2 ? -1 : 1;
        const struct gn_dial_opts opts = {
            .kind = kinds[number % 4],
            .latitude_deg = south * next_between(20, 65),
            .wall_deg = (number / 4 % 2 ? 180 : 0) + next_between(-50, 50),
            .sun_deg = next_between(-23.4, 23.4),
            .sun_hour_deg = next_between(-105, 105),
        };
        double sun[3];
        if (!gn_dial_build(dial, &opts, NULL)) continue;
        gn_dial_to_sun(opts.latitude_deg, opts.sun_deg, opts.sun_hour_deg, sun);
        if (sun[1] < 0.15 || dot(sun, dial->faces[0].normal) < 0.15) continue;
        *ray = opts.kind == GN_DIAL_ANALEMMATIC ? pin_ray(dial)
                                                : gn_dial_hour_ray(dial, 0, opts.sun_hour_deg);
        reach[1] = shadow_reach(dial, ray, sun);
        reach[0] = 0.3 * reach[1];
        if (reach[1] < 0.3 * opts.size_m) continue;
        const double across =
            ray->along[0] * dial->faces[0].along[1] - ray->along[1] * dial->faces[0].along[0];
        if (is_rod(dial) || fabs(across) > 0.1) return;
    }
}

static void write_model(const struct gn_dial *dial, const char *path) {
    struct gn_bytes bytes;
    struct gn_err err = {0};
    gn_dial_model(dial, &bytes);
    if (!gn_file_write(path, bytes.data, bytes.size, &err)) fail_msg("%s", err.text);
    gn_bytes_finish(&bytes);
}

/* The larger of the two angles; of a rod the mean of its two edges, between which time is read. */
static double read_dial(const struct gn_dial *dial, const struct gn_dial_ray *ray,
                        const double reach[2], const char *technique) {
    const char *const args[] = {"--camera",  "Face",     "--aov",     "visibility", "--size",
                                "640x640",   "--shadow", technique,   "--map",      "4096",
                                "--backend", "egl",      "--samples", "1",          NULL};
    char path[400];
    struct gn_err err = {0};
    struct gn_picture picture;
    double degrees[2] = {0};
    snprintf(path, sizeof path, "%s/dial.glb", gn_shot_build());
    write_model(dial, path);
    if (!gn_shot(&picture, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    for (int side = -1; side <= 1; side += 2) {
        struct gn_dial_ray edge = *ray;
        double one[2];
        if (is_rod(dial))
            for (int i = 0; i < 2; i++)
                edge.from[i] += side * dial->thickness_m / 2 * (i ? ray->along[0] : -ray->along[1]);
        measure_edge(dial, &picture, &edge, reach, one);
        for (int i = 0; i < 2; i++) degrees[i] += one[i] / 2;
    }
    gn_picture_finish(&picture);
    return fmax(fabs(degrees[0]), fabs(degrees[1]));
}

static void test_the_time_can_be_read_from_pictures(void **state) {
    double worst[2] = {0};
    (void)state;
    for (int i = 0; i < SUNS; i++) {
        struct gn_dial dial;
        struct gn_dial_ray ray;
        double reach[2];
        choose_dial(&dial, i, &ray, reach);
        for (int by_rays = 0; by_rays < (i < CAST_SUNS ? 2 : 1); by_rays++) {
            const double degrees = read_dial(&dial, &ray, reach, by_rays ? "truth" : "hard");
            if (!(degrees < GOAL_DEG))
                print_message("sun %d, kind %d, latitude %.1f, declination %.1f, hour angle %.1f, "
                              "%s: %.3f degrees\n",
                              i, dial.opts.kind, dial.opts.latitude_deg, dial.opts.sun_deg,
                              dial.opts.sun_hour_deg, by_rays ? "rays" : "map", degrees);
            worst[by_rays] = fmax(worst[by_rays], degrees);
        }
        gn_dial_finish(&dial);
    }
    print_message("worst by maps %.3f, by rays %.3f degrees\n", worst[0], worst[1]);
    assert_true(worst[0] < MOST_DEG);
    assert_true(worst[1] < MOST_DEG);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_the_time_can_be_read_from_pictures)};
    return RUN(tests);
}
