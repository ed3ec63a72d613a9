/* Sundials: hour lines against closed forms of the books and against shadows that rays cast; what
 * is drawn on them; what cannot be. */
#include "dial/dial.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"
#include "unit/check.h"

#define RADIANS 0.017453292519943295

/* A repeatable number from 0 to 1. */
static double next_share(unsigned *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static struct gn_dial make_dial(const struct gn_dial_opts *opts) {
    struct gn_dial dial;
    struct gn_err err = {0};
    if (!gn_dial_build(&dial, opts, &err)) fail_msg("%s", err.text);
    return dial;
}

static const double latitudes[] = {78.2, 66.5, 52.5, 48.1,  35.7,  21.3,  10,    6,
                                   -6,   -12,  -23,  -33.9, -45.9, -54.8, -70.1, 90};
enum { LATITUDES = sizeof latitudes / sizeof *latitudes };

/* ---- the books' formulas ---- */

static void test_level_lines_have_waughs_angles(void **state) {
    (void)state;
    for (int i = 0; i < LATITUDES; i++) {
        struct gn_dial dial = make_dial(&(struct gn_dial_opts){.latitude_deg = latitudes[i]});
        const double side =
            latitudes[i] < 0 ? -1 : 1; /* up is to the pole, right is east or west */
        for (int h = -175; h <= 180; h += 5) {
            const struct gn_dial_ray ray = gn_dial_hour_ray(&dial, 0, h);
            const double sine = sin(fabs(latitudes[i]) * RADIANS);
            const double angle = atan2(sine * sin(h * RADIANS), cos(h * RADIANS));
            assert_float_equal(side * ray.along[0], sin(angle), 1e-9);
            assert_float_equal(ray.along[1], cos(angle), 1e-9);
        }
        gn_dial_finish(&dial);
    }
}

static void test_wall_lines_have_waughs_angles(void **state) {
    (void)state;
    for (int wall = -70; wall <= 70; wall += 10)
        for (int i = 3; i < 8; i++) {
            struct gn_dial dial = make_dial(&(struct gn_dial_opts){
                .kind = GN_DIAL_VERTICAL, .latitude_deg = latitudes[i], .wall_deg = wall});
            const double lat = latitudes[i] * RADIANS, d = wall * RADIANS;
            for (int h = -85; h <= 85; h += 10) {
                const struct gn_dial_ray ray = gn_dial_hour_ray(&dial, 0, h);
                const double cot = (cos(d) / tan(h * RADIANS) + sin(d) * sin(lat)) / cos(lat);
                assert_float_equal(ray.along[0] * cot, -ray.along[1], 1e-9 * fmax(1, fabs(cot)));
            }
            gn_dial_finish(&dial);
        }
}

static void test_equatorial_lines_are_15_degrees_apart(void **state) {
    (void)state;
    for (int i = 0; i < LATITUDES; i++) {
        struct gn_dial dial = make_dial(
            &(struct gn_dial_opts){.kind = GN_DIAL_EQUATORIAL, .latitude_deg = latitudes[i]});
        for (int face = 0; face < 2; face++)
            for (int h = -180; h < 180; h += 15) {
                const struct gn_dial_ray ray = gn_dial_hour_ray(&dial, face, h);
                const double side = (latitudes[i] < 0) == (face == 0) ? 1 : -1;
                assert_float_equal(ray.along[0], side * sin(h * RADIANS), 1e-9);
                assert_float_equal(ray.along[1], -cos(h * RADIANS), 1e-9);
            }
        gn_dial_finish(&dial);
    }
}

/* ---- shadows by rays ---- */

/* Where the shadow of a point falls on a face: (right, up). */
static void cast_shadow(const struct gn_dial_face *f, const double point[3], const double sun[3],
                        double out[2]) {
    double on[3], from[3];
    for (int i = 0; i < 3; i++) from[i] = point[i] - f->centre[i];
    const double t = dot(from, f->normal) / dot(sun, f->normal);
    for (int i = 0; i < 3; i++) on[i] = from[i] - t * sun[i];
    out[0] = dot(on, f->right);
    out[1] = dot(on, f->up);
}

/* A point of an edge of the style: side -1, 1 of the sheet; 0: its middle, or a rod's. */
static void style_point(const struct gn_dial *dial, int face, int side, double length,
                        double out[3]) {
    const struct gn_dial_face *f = &dial->faces[face];
    const double half = side * dial->thickness_m / 2;
    const double at[2] = {f->foot[0] - half * f->along[1], f->foot[1] + half * f->along[0]};
    gn_dial_place(dial, face, at, 0, out);
    for (int i = 0; i < 3; i++) out[i] += length * f->style[i];
}

/* How far a point lies to the left of a ray. */
static double left_of(const struct gn_dial_ray *ray, const double p[2]) {
    return ray->along[0] * (p[1] - ray->from[1]) - ray->along[1] * (p[0] - ray->from[0]);
}

/* The style's shadow under that sun is the drawn line, and the rest of the sheet's lies on one side
 * of it. False: the sun does not light the face. */
static bool check_shadow(const struct gn_dial *dial, int face, double declination, double hour) {
    const struct gn_dial_face *f = &dial->faces[face];
    double sun[3], point[3], shadow[2];
    gn_dial_to_sun(dial->opts.latitude_deg, declination, hour, sun);
    if (sun[1] < 0.01 || dot(sun, f->normal) < 0.01) return false;
    assert_true(gn_dial_sees(dial, face, hour));
    const struct gn_dial_ray ray = gn_dial_hour_ray(dial, face, hour);
    for (int i = 1; i <= 4; i++) {
        style_point(dial, face, ray.edge, dial->style_m * i / 4, point);
        cast_shadow(f, point, sun, shadow);
        assert_float_equal(left_of(&ray, shadow), 0, 1e-6 * dial->opts.size_m);
        const double along =
            (shadow[0] - ray.from[0]) * ray.along[0] + (shadow[1] - ray.from[1]) * ray.along[1];
        assert_true(along > 0);
    }
    if (ray.edge == 0) return true;
    double inner[2];
    style_point(dial, face, -ray.edge, dial->style_m, point);
    cast_shadow(f, point, sun, shadow);
    for (int i = 0; i < 2; i++) inner[i] = f->foot[i] + 0.1 * dial->style_m * f->along[i];
    assert_true(left_of(&ray, shadow) * left_of(&ray, inner) > 0);
    return true;
}

static void test_shadows_of_rays_lie_on_the_lines(void **state) {
    unsigned random = 7;
    (void)state;
    for (int kind = 0; kind < GN_DIAL_ANALEMMATIC; kind++) {
        int lit = 0;
        for (int i = 0; lit < 60 && i < 4000; i++) {
            struct gn_dial_opts opts = {.kind = (enum gn_dial_kind)kind,
                                        .latitude_deg = latitudes[i % LATITUDES],
                                        .wall_deg = 360 * next_share(&random) - 180};
            const double declination = 46.88 * next_share(&random) - 23.44,
                         hour = 360 * next_share(&random) - 180;
            struct gn_dial dial;
            if (gn_dial_build(&dial, &opts, NULL))
                for (int face = 0; face < dial.face_count; face++)
                    lit += check_shadow(&dial, face, declination, hour);
            gn_dial_finish(&dial);
        }
        assert_true(lit >= 60);
    }
}

static void test_a_pins_shadow_passes_the_hours_point(void **state) {
    unsigned random = 3;
    int lit = 0;
    (void)state;
    for (int i = 0; lit < 60; i++) {
        struct gn_dial_opts opts = {.kind = GN_DIAL_ANALEMMATIC,
                                    .latitude_deg =
                                        (i % 2 ? -1 : 1) * (15 + 65 * next_share(&random))};
        struct gn_dial dial = make_dial(&opts);
        const double declination = 46.88 * next_share(&random) - 23.44,
                     hour = 360 * next_share(&random) - 180;
        double sun[3], top[3], point[2], shadow[2];
        const double foot[2] = {0, gn_dial_pin(&dial, declination)};
        gn_dial_to_sun(opts.latitude_deg, declination, hour, sun);
        gn_dial_place(&dial, 0, foot, 1, top);
        gn_dial_hour_point(&dial, hour, point);
        if (sun[1] > 0.05) {
            cast_shadow(&dial.faces[0], top, sun, shadow);
            const double length = hypot(shadow[0] - foot[0], shadow[1] - foot[1]);
            struct gn_dial_ray ray = {
                .from = {foot[0], foot[1]},
                .along = {(shadow[0] - foot[0]) / length, (shadow[1] - foot[1]) / length}};
            assert_float_equal(left_of(&ray, point), 0, 1e-6 * opts.size_m + 1e-9);
            lit++;
        }
        gn_dial_finish(&dial);
    }
}

/* ---- what is drawn ---- */

static const struct gn_dial_stroke *find_line(const struct gn_dial *dial, int face, double hour) {
    for (size_t i = 0; i < dial->stroke_count; i++)
        if (dial->strokes[i].face == face && dial->strokes[i].hour == hour &&
            dial->strokes[i].role <= GN_DIAL_QUARTER)
            return &dial->strokes[i];
    return NULL;
}

static void test_drawn_lines_are_those_of_the_clocks_hours(void **state) {
    (void)state;
    /* Madrid is 3.7 degrees west of Greenwich and keeps the time of 15 degrees east */
    struct gn_dial dial =
        make_dial(&(struct gn_dial_opts){.latitude_deg = 40.4, .shift_deg = -18.7});
    for (int quarter = 0; quarter < 96; quarter++) {
        const double hour = quarter / 4.0, angle = 15 * (hour - 12) - 18.7;
        const struct gn_dial_stroke *line = find_line(&dial, 0, hour);
        assert_int_equal(line != NULL, gn_dial_sees(&dial, 0, angle));
        if (!line) continue;
        const struct gn_dial_ray ray = gn_dial_hour_ray(&dial, 0, angle);
        assert_int_equal(line->count, 2);
        for (int i = 0; i < 2; i++)
            assert_float_equal(left_of(&ray, dial.points[line->first + (size_t)i]), 0, 1e-12);
    }
    assert_null(find_line(&dial, 0, 1));
    gn_dial_finish(&dial);
}

static void test_noon_has_a_line_for_each_edge(void **state) {
    (void)state;
    struct gn_dial dial = make_dial(&(struct gn_dial_opts){.latitude_deg = 52.5});
    int lines = 0;
    double sum = 0, distance = 0;
    for (size_t i = 0; i < dial.stroke_count; i++)
        if (dial.strokes[i].hour == 12) {
            const double x = dial.points[dial.strokes[i].first][0];
            lines++;
            sum += x;
            distance += fabs(x);
        }
    assert_int_equal(lines, 2);
    assert_float_equal(sum, 0, 1e-12);
    assert_float_equal(distance, dial.thickness_m, 1e-12);
    gn_dial_finish(&dial);
}

static void test_all_that_is_drawn_lies_on_the_plate(void **state) {
    (void)state;
    for (int kind = 0; kind < GN_DIAL_KIND_COUNT; kind++)
        for (double latitude = -90; latitude <= 90; latitude += 2.5)
            for (double wall = -180; wall < 180; wall += kind == GN_DIAL_VERTICAL ? 15 : 360) {
                struct gn_dial dial;
                const struct gn_dial_opts opts = {
                    .kind = (enum gn_dial_kind)kind, .latitude_deg = latitude, .wall_deg = wall};
                if (gn_dial_build(&dial, &opts, NULL)) {
                    int hours = 0;
                    for (size_t i = 0; i < dial.stroke_count; i++)
                        hours += dial.strokes[i].hour >= 0;
                    if (hours < 8) fail_msg("%d %g %g: %d hours", kind, latitude, wall, hours);
                    for (size_t i = 0; i < dial.point_count; i++)
                        for (int k = 0; k < 2; k++)
                            if (!(dial.points[i][k] > dial.low[k] &&
                                  dial.points[i][k] < dial.high[k]))
                                fail_msg("%d %g %g: a point at %g %g", kind, latitude, wall,
                                         dial.points[i][0], dial.points[i][1]);
                }
                gn_dial_finish(&dial);
            }
}

/* ---- files ---- */

/* The vertex of the node Lines nearest to a point of a face, as a distance. */
static double nearest_vertex(const struct gn_scene *scene, const double place[3]) {
    double best = INFINITY;
    for (uint32_t i = 0; i < scene->buffers.vertex_count; i++) {
        const float *p = scene->buffers.positions + 3 * (size_t)i;
        const double d = hypot(hypot(p[0] - place[0], p[1] - place[1]), p[2] - place[2]);
        best = fmin(best, d);
    }
    return best;
}

/* Reads "x,y" in millimetres, y down. */
static const char *read_point(const char *text, double out[2]) {
    char *end;
    out[0] = strtod(text, &end) / 1000;
    if (*end != ',') return NULL;
    out[1] = -strtod(end + 1, &end) / 1000;
    return end;
}

/* Both ends of each hour line of the pattern, half its width to either side, are corners of the
 * model. */
static int compare_lines(const struct gn_dial *dial, const char *svg,
                         const struct gn_scene *scene) {
    int lines = 0;
    for (const char *at = svg; (at = strstr(at, "<polyline class=\"")) != NULL; at++) {
        const char *face = NULL, *role = at + strlen("<polyline class=\"");
        if (strncmp(role, "hour", 4) != 0 && strncmp(role, "half", 4) != 0 &&
            strncmp(role, "quarter", 7) != 0)
            continue;
        for (const char *f = svg; f && f < at; f = strstr(f + 1, "<g id=\"face")) face = f;
        const int number = face[11] - '0';
        const double width = strtod(strstr(at, "stroke-width=\"") + 14, NULL) / 1000;
        double a[2], b[2], place[3];
        const char *rest = read_point(strstr(at, "points=\"") + 8, a);
        assert_non_null(rest);
        assert_non_null(read_point(rest, b));
        const double length = hypot(b[0] - a[0], b[1] - a[1]);
        for (int side = -1; side <= 1; side += 2) {
            const double corner[2] = {a[0] + side * width / 2 * (b[1] - a[1]) / length,
                                      a[1] - side * width / 2 * (b[0] - a[0]) / length};
            gn_dial_place(dial, number, corner, GN_DIAL_RELIEF * dial->opts.size_m, place);
            assert_true(nearest_vertex(scene, place) < 1e-6);
        }
        lines++;
    }
    return lines;
}

static void test_the_patterns_lines_are_the_models(void **state) {
    (void)state;
    for (int kind = 0; kind < GN_DIAL_KIND_COUNT; kind++) {
        struct gn_dial dial = make_dial(&(struct gn_dial_opts){
            .kind = (enum gn_dial_kind)kind, .latitude_deg = -33.9, .wall_deg = 160});
        struct gn_bytes svg, glb;
        struct gn_err err = {0};
        struct gn_warnings warnings = {0};
        int drawn = 0;
        gn_dial_svg(&dial, &svg);
        gn_dial_model(&dial, &glb);
        assert_in_range(glb.size, 10000, 300000);
        struct gn_scene *scene =
            gn_scene_load_bytes("dial.glb", glb.data, glb.size, NULL, &warnings, &err);
        if (!scene) fail_msg("%s", err.text);
        assert_int_equal(warnings.count, 0);
        for (size_t i = 0; i < dial.stroke_count; i++) drawn += dial.strokes[i].hour >= 0;
        assert_int_equal(compare_lines(&dial, (const char *)svg.data, scene), drawn);
        assert_in_range(drawn, 30, 200);
        gn_scene_destroy(scene);
        gn_bytes_finish(&svg);
        gn_bytes_finish(&glb);
        gn_dial_finish(&dial);
    }
}

/* ---- what cannot be ---- */

static void assert_refused(const struct gn_dial_opts *opts, const char *cause, const char *cure) {
    struct gn_dial dial;
    struct gn_err err = {0};
    assert_false(gn_dial_build(&dial, opts, &err));
    assert_int_equal(err.status, GN_EXIT_USAGE);
    if (!strstr(err.text, cause) || !strstr(err.text, cure)) fail_msg("%s", err.text);
    gn_dial_finish(&dial);
}

static void test_what_cannot_be_names_what_can(void **state) {
    (void)state;
    assert_refused(&(struct gn_dial_opts){.latitude_deg = 0}, "--latitude 0", "--kind equatorial");
    assert_refused(&(struct gn_dial_opts){.latitude_deg = -4.9}, "4.9 degrees", "equatorial");
    assert_refused(
        &(struct gn_dial_opts){.kind = GN_DIAL_VERTICAL, .latitude_deg = 50, .wall_deg = 90},
        "--declination 90", "--kind horizontal or equatorial");
    assert_refused(
        &(struct gn_dial_opts){.kind = GN_DIAL_VERTICAL, .latitude_deg = -90, .wall_deg = 0},
        "near to the pole", "--kind horizontal");
    assert_refused(&(struct gn_dial_opts){.kind = GN_DIAL_ANALEMMATIC, .latitude_deg = 3},
                   "too flat", "--kind equatorial");
    assert_refused(&(struct gn_dial_opts){.kind = GN_DIAL_ANALEMMATIC, .latitude_deg = -88},
                   "too close", "--kind horizontal");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_level_lines_have_waughs_angles),
        cmocka_unit_test(test_wall_lines_have_waughs_angles),
        cmocka_unit_test(test_equatorial_lines_are_15_degrees_apart),
        cmocka_unit_test(test_shadows_of_rays_lie_on_the_lines),
        cmocka_unit_test(test_a_pins_shadow_passes_the_hours_point),
        cmocka_unit_test(test_drawn_lines_are_those_of_the_clocks_hours),
        cmocka_unit_test(test_noon_has_a_line_for_each_edge),
        cmocka_unit_test(test_all_that_is_drawn_lies_on_the_plate),
        cmocka_unit_test(test_the_patterns_lines_are_the_models),
        cmocka_unit_test(test_what_cannot_be_names_what_can),
    };
    return RUN(tests);
}
