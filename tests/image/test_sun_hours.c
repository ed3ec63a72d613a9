/* gnomon render --aov sun-hours: a street, a court and slopes against closed forms, by maps and by
 * rays; maps against rays, pixel by pixel; what is turned away, and what casts nothing. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/sun.h"
#include "image/shot.h"
#include "unit/check.h"
#include "unit/gltf_maker.h"

#define RAD      (M_PI / 180)
#define LATITUDE 52.5
#define PLACE    "52.5,13.4"

static char path[4096];

/* ---- closed forms ---- */

/* The sun at that date's noon: up = a + b cos H, west = c sin H, south = d cos H - e. */
struct day {
    double a, b, c, d, e;
};

static struct day day_of(double utc_s) {
    const double f = LATITUDE * RAD, n = gn_sun_at(utc_s).declination_deg * RAD;
    return (struct day){sin(f) * sin(n), cos(f) * cos(n), cos(n), sin(f) * cos(n), cos(f) * sin(n)};
}

/* What air adds to the sine of an altitude. */
static double lifted(double sine) {
    const double h = asin(fmin(fmax(sine, -1), 1));
    return sin(h + gn_sun_refraction_deg(h / RAD) * RAD) - sine;
}

/* Largest H, in radians, with a + b cos H > k c |sin H|: two walls along the meridian, k times as
 * high as they are far. k 0: the horizon. */
static double hour_between(const struct day *day, double k) {
    double hour = 0, air = 0;
    for (int i = 0; i < 4; i++) {
        const double r = hypot(day->b, k * day->c);
        hour = acos(-(day->a + air) / r) - atan2(k * day->c, day->b);
        air = lifted(day->a + day->b * cos(hour));
    }
    return hour;
}

/* The same with a wall in the south: a + b cos H > k (d cos H - e). Where k d < b only. */
static double hour_over(const struct day *day, double k) {
    double hour = 0, air = 0;
    for (int i = 0; i < 4; i++) {
        hour = acos(-(day->a + air + k * day->e) / (day->b - k * day->d));
        air = lifted(day->a + day->b * cos(hour));
    }
    return hour;
}

/* Of a plane that is lowered to the south by an angle: as level ground at that lower latitude. */
static double hour_of_slope(const struct day *day, double slope_rad) {
    const double up = cos(slope_rad), south = sin(slope_rad);
    double hour = 0, air = 0;
    for (int i = 0; i < 4; i++) {
        hour = acos(-(up * (day->a + air) - south * day->e) / (up * day->b + south * day->d));
        air = lifted(day->a + day->b * cos(hour));
    }
    return hour;
}

static double hours_of(double hour_rad) { return 2 * hour_rad / RAD / 15; }

/* ---- scenes ---- */

static void begin(struct gn_maker *m, const char *ground) {
    char node[300];
    gn_maker_init(m);
    gn_maker_square(m);
    gn_maker_cube(m);
    gn_maker_set(m, "cameras", "[{'type':'perspective','perspective':{'yfov':0.1,'znear':1}}]");
    snprintf(node, sizeof node, "[{'mesh':0,%s}]", ground);
    gn_maker_set(m, "nodes", node);
    gn_maker_add(m, "nodes",
                 "{'camera':0,'translation':[0,60,0],'rotation':[-0.70710678,0,0,0.70710678]}");
}

static void add_wall(struct gn_maker *m, double x, double z, double half_x, double half_z,
                     double height) {
    char node[200];
    snprintf(node, sizeof node, "{'mesh':1,'translation':[%g,%g,%g],'scale':[%g,%g,%g]}", x,
             height / 2, z, half_x, height / 2, half_z);
    gn_maker_add(m, "nodes", node);
}

static void end(struct gn_maker *m, int nodes) {
    struct gn_err err = {0};
    char text[100] = "[{'nodes':[0";
    for (int i = 1; i < nodes; i++) snprintf(text + strlen(text), 8, ",%d", i);
    strcat(text, "]}]");
    gn_maker_set(m, "scenes", text);
    snprintf(path, sizeof path, "%s/sun_hours.glb", gn_shot_build());
    if (!gn_maker_write(m, path, &err)) fail_msg("%s", err.text);
}

static struct gn_picture shoot(const char *size, const char *date, const char *shadow) {
    const char *args[] = {"--size", size, "--backend", "egl",  "--aov", "sun-hours", "--sun", PLACE,
                          "--date", date, "--shadow",  shadow, NULL};
    struct gn_err err = {0};
    struct gn_picture shot;
    if (!gn_shot(&shot, NULL, &err, "pfm", path, args)) fail_msg("%s", err.text);
    return shot;
}

static double middle_of(const char *date, const char *shadow) {
    struct gn_picture shot = shoot("17x17", date, shadow);
    const double hours = (double)((const float *)shot.data)[8 * 17 + 8];
    gn_picture_finish(&shot);
    return hours;
}

static void lasts(const char *what, const char *date, double hours) {
    static const char *const ways[] = {"hard", "truth"};
    for (int i = 0; i < 2; i++) {
        const double shown = middle_of(date, ways[i]), off_min = 60 * (shown - hours);
        print_message("%-24s %s %-5s %.3f h, %.2f min off\n", what, date, ways[i], shown, off_min);
        assert_true(hours > 0.5 && fabs(off_min) <= 3);
    }
}

#define WINTER   "2026-12-21"
#define SUMMER   "2026-06-21"
#define WINTER_S 1797850800.0
#define SUMMER_S 1782039600.0

/* ---- tests ---- */

static void test_open_ground_has_the_time_above_the_horizon(void **state) {
    (void)state;
    struct gn_maker m;
    const struct day winter = day_of(WINTER_S), summer = day_of(SUMMER_S);
    begin(&m, "'scale':[50,1,50]");
    end(&m, 2);
    lasts("open ground", WINTER, hours_of(hour_between(&winter, 0)));
    lasts("open ground", SUMMER, hours_of(hour_between(&summer, 0)));
}

static void test_street_canyon(void **state) {
    (void)state;
    struct gn_maker m;
    const struct day winter = day_of(WINTER_S), summer = day_of(SUMMER_S);
    begin(&m, "'scale':[50,1,500]");
    add_wall(&m, 6, 0, 1, 500, 5);
    add_wall(&m, -6, 0, 1, 500, 5);
    end(&m, 4);
    lasts("street", WINTER, hours_of(hour_between(&winter, 1)));
    lasts("street", SUMMER, hours_of(hour_between(&summer, 1)));
}

/* In winter the wall in the south ends the sun, in summer those in the east and west. */
static void test_court(void **state) {
    (void)state;
    struct gn_maker m;
    const struct day winter = day_of(WINTER_S), summer = day_of(SUMMER_S);
    begin(&m, "'scale':[60,1,60]");
    add_wall(&m, 51 / 3.0, 0, 1 / 3.0, 30, 5);
    add_wall(&m, -51 / 3.0, 0, 1 / 3.0, 30, 5);
    add_wall(&m, 0, 26, 18, 1, 5);
    add_wall(&m, 0, -26, 18, 1, 5);
    end(&m, 6);
    const double k = 5 / (50 / 3.0);
    assert_true(hour_over(&winter, 0.2) < hour_between(&winter, k));
    lasts("court", WINTER, hours_of(hour_over(&winter, 0.2)));
    lasts("court", SUMMER, hours_of(hour_between(&summer, k)));
}

static void slope(const char *date, double utc_s, double slope_deg) {
    struct gn_maker m;
    char node[120], what[40];
    const struct day day = day_of(utc_s);
    snprintf(node, sizeof node, "'scale':[20,1,20],'rotation':[%.9f,0,0,%.9f]",
             sin(slope_deg / 2 * RAD), cos(slope_deg / 2 * RAD));
    begin(&m, node);
    end(&m, 2);
    snprintf(what, sizeof what, "slope, %g down to south", slope_deg);
    lasts(what, date, hours_of(fmin(hour_of_slope(&day, slope_deg * RAD), hour_between(&day, 0))));
}

/* One to the south loses the summer's morning, one to the north most of the winter's day. */
static void test_slopes_are_lit_where_they_face_the_sun(void **state) {
    (void)state;
    slope(SUMMER, SUMMER_S, 30);
    slope(WINTER, WINTER_S, -12);
    slope(WINTER, WINTER_S, 30);
}

static void test_what_casts_nothing_is_dark_when_it_is_turned_away(void **state) {
    (void)state;
    struct gn_maker m;
    begin(&m, "'scale':[20,1,20],'rotation':[-0.25881905,0,0,0.96592583],"
              "'extras':{'gnomon_cast':false}");
    end(&m, 2);
    assert_true(middle_of(WINTER, "hard") == 0);
    assert_true(middle_of(WINTER, "truth") == 0);
}

/* Houses of several heights, over ground that the picture shows with its edges. */
static void test_maps_are_within_six_minutes_of_rays(void **state) {
    (void)state;
    struct gn_maker m;
    struct gn_picture maps, rays;
    long count = 0, near = 0, none = 0;
    begin(&m, "'scale':[2.9,1,2.2]");
    for (int i = 0; i < 6; i++) add_wall(&m, i % 3 - 1.1, i / 3 * 1.3 - .6, .25, .2, .3 + .15 * i);
    end(&m, 8);
    maps = shoot("96x72", "2026-03-20", "hard");
    rays = shoot("96x72", "2026-03-20", "truth");
    for (long i = 0; i < 96 * 72; i++) {
        const float a = ((const float *)maps.data)[i], b = ((const float *)rays.data)[i];
        none += a < 0 && b < 0;
        count += a >= 0 && b >= 0;
        near += a >= 0 && b >= 0 && fabsf(a - b) <= 0.1f;
    }
    print_message("%ld of %ld pixels within 6 minutes; %ld of the background\n", near, count, none);
    assert_true(none > 100 && count > 3500 && (double)near >= .95 * (double)count);
    gn_picture_finish(&maps);
    gn_picture_finish(&rays);
}

/* What a planner gets: the legend's paper and ink, the sky, and one colour for each band. */
static void test_picture_has_a_legend_and_bands(void **state) {
    (void)state;
    static struct gn_run run;
    struct gn_maker m;
    struct gn_err err = {0};
    struct gn_picture shot;
    char png[4200];
    long paper = 0, ink = 0, sky = 0;
    begin(&m, "'scale':[2.9,1,2.2]");
    add_wall(&m, 0, 0, .3, .3, 1);
    end(&m, 3);
    snprintf(png, sizeof png, "%s/sun_hours.png", gn_shot_build());
    const char *argv[] = {gn_shot_program(),
                          "render",
                          path,
                          "-o",
                          png,
                          "--backend",
                          "egl",
                          "--size",
                          "320x240",
                          "--aov",
                          "sun-hours",
                          "--sun",
                          PLACE,
                          "--floor",
                          "none",
                          "--from",
                          "2026-12-21T10:00Z",
                          "--to",
                          "2026-12-21T12:00Z",
                          NULL};
    assert_true(gn_run(&run, argv, 0, &err) && run.status == 0);
    assert_non_null(strstr(run.out, "hours of sun: 720 positions over the horizon, 2.00 h, in "));
    if (!gn_picture_read(&shot, png, &err)) fail_msg("%s", err.text);
    for (int i = 0; i < 320 * 240; i++) {
        const float *p = shot.data + shot.channels * i;
        const int y = i / 320, x = i % 320;
        paper += x < 160 && y < 160 && p[0] == 1 && p[1] == 1 && p[2] == 1;
        ink += x < 160 && y < 160 && lrintf(255 * p[0]) == 24 && lrintf(255 * p[2]) == 32;
        sky += lrintf(255 * p[0]) == 222 && lrintf(255 * p[2]) == 228;
    }
    print_message("%ld of paper, %ld of ink, %ld of the sky\n", paper, ink, sky);
    assert_true(paper > 1500 && ink > 100 && sky > 1000);
    /* level ground, which is shaded by .84 + .16 x .8, in full sun and in the last quarter */
    const float *open = shot.data + shot.channels * (320 * 150 + 250);
    assert_int_equal(lrintf(255 * open[0]), lrintf(252 * .968f));
    assert_int_equal(lrintf(255 * open[2]), lrintf(130 * .968f));
    gn_picture_finish(&shot);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_open_ground_has_the_time_above_the_horizon),
        cmocka_unit_test(test_street_canyon),
        cmocka_unit_test(test_court),
        cmocka_unit_test(test_slopes_are_lit_where_they_face_the_sun),
        cmocka_unit_test(test_what_casts_nothing_is_dark_when_it_is_turned_away),
        cmocka_unit_test(test_maps_are_within_six_minutes_of_rays),
        cmocka_unit_test(test_picture_has_a_legend_and_bands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
